//! Path lines: where the flow of a time-dependent field carries a point (equation 15).

use std::ops::{Add, Div, Mul};

/// A numerical integration rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Integrator {
    /// Explicit Euler, the paper's (12 steps).
    Euler,
    /// The explicit midpoint rule, the default (6 steps): the same number of evaluations, far more exact.
    #[default]
    Midpoint,
    /// The classical Runge-Kutta rule of order four (4 steps).
    RungeKutta4,
}

impl Integrator {
    /// The number of steps that this rule takes where no bound asks for more.
    pub const fn default_steps(self) -> u32 {
        match self {
            Self::Euler => 12,
            Self::Midpoint => 6,
            Self::RungeKutta4 => 4,
        }
    }
}

/// Carries `x` along the field `velocity(x, t)` from `t = 0` to `t = 1` in `steps` equal steps (`steps ≥ 1`).
///
/// `X` is a point, or eight of them.
#[inline]
pub fn path_line<X>(mut x: X, integrator: Integrator, steps: u32, velocity: impl Fn(X, f32) -> X) -> X
where
    X: Copy + Add<Output = X> + Mul<f32, Output = X> + Div<f32, Output = X>,
{
    let h = 1.0 / steps as f32;
    for i in 0..steps {
        let t = i as f32 * h;
        let increment = match integrator {
            Integrator::Euler => velocity(x, t),
            Integrator::Midpoint => velocity(x + velocity(x, t) * (0.5 * h), t + 0.5 * h),
            Integrator::RungeKutta4 => {
                let k1 = velocity(x, t);
                let k2 = velocity(x + k1 * (0.5 * h), t + 0.5 * h);
                let k3 = velocity(x + k2 * (0.5 * h), t + 0.5 * h);
                let k4 = velocity(x + k3 * h, t + h);
                (k1 + k2 * 2.0 + k3 * 2.0 + k4) / 6.0
            }
        };
        x = x + increment * h;
    }
    x
}
