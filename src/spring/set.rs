//! A mass-spring set: an anchor `p` that follows the body and a free mass `q` on a spring of length zero (section 3.1).

use super::{Propagator, SpringCoefficients};
use crate::math::Vec3;

/// The moving state of one mass-spring set, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassSpringSet {
    /// Anchor `p`.
    pub p: Vec3,
    /// Free mass `q`.
    pub q: Vec3,
    /// Velocity of `q` in metres a second.
    pub velocity: Vec3,
}

impl MassSpringSet {
    /// A set at rest at `p`.
    pub const fn at_rest(p: Vec3) -> Self {
        Self { p, q: p, velocity: Vec3::ZERO }
    }

    /// Moves the anchor linearly to `p` over `h` seconds and the mass by the exact solution.
    ///
    /// With `y = q − p` and a constant acceleration `gravity` (zero where the set is meant to ignore it) the equation is
    /// `y'' + 2ζω y' + ω² y = gravity`; its closed form is exact and stable for any `h`, frequency and damping ratio.
    /// `limit` bounds `|y|` in metres: past it `q` is pulled back and loses the velocity that leads farther out.
    #[must_use]
    pub fn stepped(&self, p: Vec3, h: f32, spring: SpringCoefficients, gravity: Vec3, limit: f32) -> Self {
        if h <= 0.0 {
            return Self { p, q: p + (self.q - self.p), velocity: self.velocity };
        }
        let anchor_velocity = (p - self.p) / h;
        let omega = spring.angular_frequency();
        let equilibrium = gravity / (omega * omega);
        let y = self.q - self.p - equilibrium;
        let v = self.velocity - anchor_velocity;
        let m = Propagator::new(spring, h);
        let next =
            Self { p, q: p + equilibrium + y * m.yy + v * m.yv, velocity: anchor_velocity + y * m.vy + v * m.vv };
        next.limited(anchor_velocity, limit)
    }

    /// Displacement `q − p`.
    pub fn displacement(&self) -> Vec3 {
        self.q - self.p
    }

    /// True when every figure of the state is finite.
    pub fn is_finite(&self) -> bool {
        self.p.is_finite() && self.q.is_finite() && self.velocity.is_finite()
    }

    fn limited(self, anchor_velocity: Vec3, limit: f32) -> Self {
        let y = self.displacement();
        let length = y.length();
        if length <= limit {
            return self;
        }
        let outward = y / length;
        let escape = (self.velocity - anchor_velocity).dot(outward).max(0.0);
        Self { q: self.p + outward * limit, velocity: self.velocity - outward * escape, ..self }
    }
}
