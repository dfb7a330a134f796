//! The spring field `v` of a mass-spring set (equations 8 to 14).

use super::certificate::Lipschitz;
use super::curl::curl_of_weighted_rotation;
use super::kernel::SpringKernel;
use crate::math::Vec3;

/// The field of one mass-spring set: its path lines over `t` in `[0, 1]` carry `p` to `q` and leave everything
/// farther than `radius` from the segment `pq` alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringField {
    /// Anchor `p`.
    pub p: Vec3,
    /// Free end `q`.
    pub q: Vec3,
    /// Radius of influence `r_o`, positive.
    pub radius: f32,
}

impl SpringField {
    /// `v(x, t)`: equation (8) in the form of [`curl_of_weighted_rotation`].
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        let a = self.q - self.p;
        let b = x - (self.p + a * t);
        let (phi, dphi) = SpringKernel::weight(b.length_squared(), 1.0 / (self.radius * self.radius));
        curl_of_weighted_rotation(phi, b * (2.0 * dphi), a, b)
    }

    /// True where a path line that starts at `x` may move at all: `x` lies within `radius` of the segment `pq`.
    #[inline]
    pub fn reaches(&self, x: Vec3) -> bool {
        let a = self.q - self.p;
        let length_squared = a.length_squared();
        let along = if length_squared > 0.0 { ((x - self.p).dot(a) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
        (x - self.p - a * along).length_squared() < self.radius * self.radius
    }
}

impl Lipschitz for SpringField {
    /// `max |∇v| = 3.08 |q − p| / r_o`.
    fn lipschitz(&self) -> f32 {
        3.08 * (self.q - self.p).length() / self.radius
    }
}
