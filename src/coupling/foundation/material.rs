//! What a body's flesh is like at a contact, and what two of them make together.

use std::f32::consts::PI;

use super::sampled_spring::SampledSpring;
use crate::elastic::ContactSettings;
use crate::spring::SpringCoefficients;

/// The flesh of one elastic body: a spring with the whole body's mass on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactMaterial {
    /// Stiffness `k = m ω²` in N/m.
    pub stiffness: f32,
    /// The mass on it, in kilograms.
    pub mass: f32,
    /// Coefficient of restitution, from 0 to 1.
    pub restitution: f32,
    /// Damping ratio of the spring.
    pub damping_ratio: f32,
    /// Coulomb friction coefficient.
    pub friction: f32,
}

impl ContactMaterial {
    /// Nothing: neither pushes nor rubs.
    pub(super) const NONE: Self =
        Self { stiffness: 0.0, mass: 1.0, restitution: 0.0, damping_ratio: 0.0, friction: 0.0 };

    /// The material of a body of `mass` kilograms; `factor` multiplies its stiffness.
    pub fn new(settings: &ContactSettings, mass: f32, factor: f32) -> Self {
        Self {
            stiffness: settings.spring.stiffness_damping(mass).0 * factor,
            mass,
            restitution: settings.restitution(),
            damping_ratio: settings.spring.damping_ratio,
            friction: settings.friction,
        }
    }

    /// The part of it that one of several contacts uses.
    pub fn share(self, share: f32) -> Self {
        Self { stiffness: self.stiffness * share, mass: self.mass * share, ..self }
    }

    /// Two elastic bodies against each other: springs in series, `1/k = 1/k₁ + 1/k₂`, with the reduced mass,
    /// `1/m = 1/m₁ + 1/m₂`. Each stores a part of the energy in proportion to its compliance and gives back the square of its
    /// restitution of that; damping ratios are weighed in the same way. Friction is the mean.
    pub fn against(self, other: Self) -> Self {
        let compliance = 1.0 / self.stiffness + 1.0 / other.stiffness;
        let own = 1.0 / (self.stiffness * compliance);
        let mix = |a: f32, b: f32| own * a + (1.0 - own) * b;
        let returned = mix(self.restitution * self.restitution, other.restitution * other.restitution);
        Self {
            stiffness: 1.0 / compliance,
            mass: 1.0 / (1.0 / self.mass + 1.0 / other.mass),
            restitution: returned.max(0.0).sqrt(),
            damping_ratio: mix(self.damping_ratio, other.damping_ratio),
            friction: 0.5 * (self.friction + other.friction),
        }
    }

    /// Natural frequency in hertz of the mass on the spring.
    pub fn natural_frequency(&self) -> f32 {
        (self.stiffness / self.mass).sqrt() / (2.0 * PI)
    }

    /// The impulses of one step.
    pub fn sampled(&self, dt: f32) -> SampledSpring {
        SampledSpring::new(SpringCoefficients::new(self.natural_frequency(), self.damping_ratio), self.mass, dt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(stiffness: f32, mass: f32, restitution: f32) -> ContactMaterial {
        ContactMaterial { stiffness, mass, restitution, damping_ratio: 0.1, friction: 0.5 }
    }

    #[test]
    fn against_something_much_harder_and_heavier_only_the_soft_one_counts() {
        let soft = material(100.0, 1.0, 0.3);
        let both = soft.against(material(1e9, 1e9, 0.9));
        assert!((both.stiffness / soft.stiffness - 1.0).abs() < 1e-5);
        assert!((both.natural_frequency() / soft.natural_frequency() - 1.0).abs() < 1e-5);
        assert!((both.restitution - 0.3).abs() < 1e-5);
    }

    #[test]
    fn the_order_of_the_two_does_not_matter_and_equal_ones_keep_frequency_and_restitution() {
        let (a, b) = (material(100.0, 1.0, 0.3), material(700.0, 5.0, 0.8));
        let (ab, ba) = (a.against(b), b.against(a));
        assert!((ab.restitution - ba.restitution).abs() < 1e-6 && ab.stiffness == ba.stiffness);
        let both = a.against(a);
        assert!((both.restitution - 0.3).abs() < 1e-6);
        assert!((both.natural_frequency() / a.natural_frequency() - 1.0).abs() < 1e-6);
        assert_eq!(both.stiffness, 50.0);
    }
}
