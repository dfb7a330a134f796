//! The exact step of a damped oscillator, in closed form for every damping ratio.

use super::SpringCoefficients;

/// How position and velocity of `y'' + 2ζω y' + ω² y = 0` after a time `h` depend on those before:
/// `y(h) = yy·y + yv·y'`, `y'(h) = vy·y + vv·y'`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Propagator {
    /// Position from position.
    pub yy: f32,
    /// Position from velocity, in seconds.
    pub yv: f32,
    /// Velocity from position, in 1/seconds.
    pub vy: f32,
    /// Velocity from velocity.
    pub vv: f32,
}

impl Propagator {
    /// The closed-form propagator over `h ≥ 0` seconds: under-, critically and over-damped. Unconditionally stable.
    pub fn new(spring: SpringCoefficients, h: f32) -> Self {
        let omega = f64::from(spring.angular_frequency());
        let zeta = f64::from(spring.damping_ratio);
        let h = f64::from(h);
        // y = e^{-ζωh} (c·y0 + s·(v0 + ζω y0)); c and s are cos and sin/ω_d, or their hyperbolic counterparts. The
        // decay is multiplied in before anything can overflow.
        let rate = zeta * omega;
        let discriminant = (1.0 - zeta * zeta) * omega * omega;
        let scaled = discriminant.abs().sqrt() * h;
        let (c, s) = if scaled < CRITICAL {
            let decay = (-rate * h).exp();
            (decay * (1.0 - 0.5 * discriminant * h * h), decay * h * (1.0 - discriminant * h * h / 6.0))
        } else if discriminant > 0.0 {
            let decay = (-rate * h).exp();
            let damped = discriminant.sqrt();
            (decay * scaled.cos(), decay * scaled.sin() / damped)
        } else {
            let spread = (-discriminant).sqrt();
            let slow = ((-omega * omega / (rate + spread)) * h).exp();
            let fast = (-(rate + spread) * h).exp();
            (0.5 * (slow + fast), 0.5 * (slow - fast) / spread)
        };
        Self { yy: (c + rate * s) as f32, yv: s as f32, vy: (-omega * omega * s) as f32, vv: (c - rate * s) as f32 }
    }
}

/// Below this phase the trigonometric and hyperbolic forms lose digits, and their common series is exact to 1e-17.
const CRITICAL: f64 = 1.0e-4;
