//! Springs in the field's terms: natural frequency and damping ratio, and the paper's `(m_q, k, c)` beside them.

use std::f32::consts::TAU;

/// A damped harmonic oscillator by its natural frequency and damping ratio (as rapier's `SpringCoefficients`).
///
/// `y'' + 2 ζ ω y' + ω² y = 0` with `ω = 2π · natural_frequency`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringCoefficients {
    /// Undamped natural frequency in hertz, positive and finite.
    pub natural_frequency: f32,
    /// Damping ratio ζ: 0 rings for ever, 1 returns fastest without overshoot. Not negative, finite.
    pub damping_ratio: f32,
}

impl SpringCoefficients {
    /// Builds coefficients from a natural frequency in hertz and a damping ratio.
    pub const fn new(natural_frequency: f32, damping_ratio: f32) -> Self {
        Self { natural_frequency, damping_ratio }
    }

    /// Angular frequency `ω` in radians a second.
    pub fn angular_frequency(&self) -> f32 {
        TAU * self.natural_frequency
    }

    /// The oscillator of the paper's mass `m_q` (kg), stiffness `k` (N/m) and damping `c` (N s/m), section 3.1.
    pub fn from_mass_stiffness_damping(mass: f32, stiffness: f32, damping: f32) -> Self {
        let omega = (stiffness / mass).sqrt();
        Self { natural_frequency: omega / TAU, damping_ratio: damping / (2.0 * mass * omega) }
    }

    /// The paper's stiffness `k = m ω²` (N/m) and damping `c = 2 ζ m ω` (N s/m) for a mass `m_q` in kilograms.
    pub fn stiffness_damping(&self, mass: f32) -> (f32, f32) {
        let omega = self.angular_frequency();
        (mass * omega * omega, 2.0 * self.damping_ratio * mass * omega)
    }

    /// The speed after half an oscillation over the speed before it, `exp(−π ζ / √(1 − ζ²))`: what a bounce off such a
    /// spring leaves. 0 from critical damping on.
    pub fn restitution(&self) -> f32 {
        let zeta = self.damping_ratio;
        if zeta >= 1.0 { 0.0 } else { (-std::f32::consts::PI * zeta / (1.0 - zeta * zeta).sqrt()).exp() }
    }

    /// The oscillator with the given natural frequency in hertz and [`SpringCoefficients::restitution`], from 0 to 1:
    /// `ζ = −ln e / √(π² + ln² e)`; 0 is critical damping.
    pub fn from_restitution(natural_frequency: f32, restitution: f32) -> Self {
        let damping_ratio = if restitution > 0.0 {
            let log = restitution.ln();
            -log / (std::f32::consts::PI.powi(2) + log * log).sqrt()
        } else {
            1.0
        };
        Self { natural_frequency, damping_ratio }
    }

    /// True when both figures are finite, the frequency positive and the ratio not negative.
    pub fn is_valid(&self) -> bool {
        self.natural_frequency.is_finite()
            && self.natural_frequency > 0.0
            && self.damping_ratio.is_finite()
            && self.damping_ratio >= 0.0
    }
}
