//! A damped spring as rapier's steps see it: one impulse before each step, then a drift at an even velocity.
//!
//! With the depth `d`, the velocity out of the obstacle `v` and the step `h`, a step is `v' = α v + β d`, `d' = d − h v'`.
//! This linear map has the determinant `α` and the trace `1 + α − h β`. The exact solution of `d'' + 2 ζ ω d' + ω² d = 0`,
//! looked at every `h`, has the eigenvalues `exp(λ h)`, `λ² + 2 ζ ω λ + ω² = 0`. Equal determinants and traces give
//!
//! `α = exp((λ₁ + λ₂) h)`, `h β = (1 − exp(λ₁ h)) (1 − exp(λ₂ h))`:
//!
//! the sampled spring has the frequency and the damping that were asked for, and no others; without damping it keeps its
//! energy, where an implicit Euler step would lose a fifth of the speed in one bounce.

use crate::spring::SpringCoefficients;

/// A spring never turns by more than this angle in a step: then `h β` is 1, and one step undoes the whole depth. A
/// stiffer spring (above 10 Hz at 60 steps a second) acts like this one.
pub const STIFFEST: f32 = std::f32::consts::FRAC_PI_3;

/// Least `α`: what a spring damped beyond all measure leaves of the velocity.
const LEAST_ALPHA: f32 = 1.0e-3;

/// The impulse `push · d − drag · v'` of one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampledSpring {
    /// N s a metre of depth.
    pub push: f32,
    /// N s for each m/s at which the contact opens after the impulse, in kg.
    pub drag: f32,
}

impl SampledSpring {
    /// The impulses that let `mass` kilograms swing as `spring` says, in steps of `dt` seconds.
    pub fn new(spring: SpringCoefficients, mass: f32, dt: f32) -> Self {
        let turn = (spring.angular_frequency() * dt).min(STIFFEST);
        let zeta = spring.damping_ratio;
        let decay = (-zeta * turn).exp();
        let stiffness = if zeta < 1.0 {
            1.0 + decay * decay - 2.0 * decay * (turn * (1.0 - zeta * zeta).sqrt()).cos()
        } else {
            let root = (zeta * zeta - 1.0).sqrt();
            // ζ − √(ζ² − 1) without cancellation.
            let (slow, fast) = (turn / (zeta + root), turn * (zeta + root));
            (-slow).exp_m1() * (-fast).exp_m1()
        };
        let alpha = (decay * decay).max(LEAST_ALPHA);
        Self { push: mass * stiffness / (dt * alpha), drag: mass * (1.0 / alpha - 1.0) }
    }

    /// The same spring where something lighter than its mass swings on it: the pushes are weakened as far as the step
    /// stays stable. `bound` is an upper bound of the largest eigenvalue of pushes times responses, in 1/s.
    pub fn weakened(self, bound: f32, dt: f32) -> Self {
        if self.push <= 0.0 || bound <= 0.0 {
            return self;
        }
        let factor = (1.0 / bound + self.drag / self.push) / dt;
        Self { push: self.push * factor.min(1.0), drag: self.drag }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depths over time of a mass that enters an obstacle at 1 m/s.
    fn run(frequency: f32, damping_ratio: f32, dt: f32, steps: usize) -> Vec<f32> {
        let spring = SampledSpring::new(SpringCoefficients::new(frequency, damping_ratio), 2.0, dt);
        let (mut depth, mut velocity) = (0.0_f32, -1.0_f32);
        let mut depths = Vec::new();
        for _ in 0..steps {
            velocity = (velocity + spring.push * depth / 2.0) / (1.0 + spring.drag / 2.0);
            depth -= dt * velocity;
            depths.push(depth);
        }
        depths
    }

    #[test]
    fn an_undamped_spring_keeps_its_amplitude_for_a_thousand_steps() {
        for frequency in [1.0, 3.0, 9.0] {
            let depths = run(frequency, 0.0, 1.0 / 60.0, 1000);
            let most = |range: &[f32]| range.iter().fold(0.0_f32, |a, d| a.max(d.abs()));
            let (early, late) = (most(&depths[..200]), most(&depths[800..]));
            // Samples miss the peaks by the square of half a step's turn.
            assert!((early / late - 1.0).abs() < 0.02, "{frequency} Hz: {early} then {late}");
        }
    }

    #[test]
    fn the_sampled_motion_has_the_frequency_and_the_decay_of_the_exact_one() {
        let dt = 1.0 / 60.0;
        for (frequency, zeta) in [(1.0_f32, 0.1_f32), (3.0, 0.3), (6.0, 0.05)] {
            let depths = run(frequency, zeta, dt, 60);
            let omega = std::f32::consts::TAU * frequency * (1.0 - zeta * zeta).sqrt();
            let decay = zeta * std::f32::consts::TAU * frequency * dt;
            // Three samples of A exp(−δ n) sin(ω n h + φ) obey one recurrence, whatever A and φ.
            for w in depths.windows(3) {
                let next = 2.0 * (-decay).exp() * (omega * dt).cos() * w[1] - (-2.0 * decay).exp() * w[0];
                assert!((next - w[2]).abs() < 1e-5, "{frequency} Hz, ratio {zeta}: {next} against {}", w[2]);
            }
        }
    }

    #[test]
    fn springs_of_any_frequency_and_damping_give_finite_impulses_and_stay_bounded() {
        for frequency in [1e-3, 1.0, 10.0, 1000.0] {
            for zeta in [0.0, 0.9999, 1.0, 1.0001, 10.0, 1e4] {
                let depths = run(frequency, zeta, 1.0 / 60.0, 600);
                assert!(depths.iter().all(|d| d.abs() < 20.0), "{frequency} Hz, ratio {zeta}");
            }
        }
    }
}
