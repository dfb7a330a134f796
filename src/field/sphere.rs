//! The paper's collision field `u`: constant inside a sphere, faded out to a larger one (section 4.1).

use super::certificate::Lipschitz;
use super::curl::curl_of_weighted_rotation;
use super::kernel::CollisionKernel;
use crate::math::Vec3;

/// Moves the ball of radius `inner` about `centre` by `d` rigidly, and fades out to the radius `outer`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereField {
    /// Centre `c` at `t = 0`; it moves to `c + d`.
    pub centre: Vec3,
    /// Displacement `d`.
    pub d: Vec3,
    /// Inner radius `r_i`, not negative.
    pub inner: f32,
    /// Outer radius `r_o > r_i`.
    pub outer: f32,
}

impl SphereField {
    /// `u(x, t) = ‖d‖ ∇p × ∇q` of section 4.1 in the form of [`curl_of_weighted_rotation`].
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        let b = x - (self.centre + self.d * t);
        let distance = b.length();
        let (phi, dphi) = CollisionKernel::weight(distance - self.inner, self.outer - self.inner);
        let grad = if distance > 0.0 { b * (dphi / distance) } else { Vec3::ZERO };
        curl_of_weighted_rotation(phi, grad, self.d, b)
    }

    /// True where the field may move the point `x`, should nothing else move it.
    #[inline]
    pub fn reaches(&self, x: Vec3) -> bool {
        x.distance(self.centre) < self.outer + self.d.length()
    }
}

impl Lipschitz for SphereField {
    /// The bound of [`super::HuggingField`] with the gauge point at the centre, so that `|b| ≤ r_o`.
    fn lipschitz(&self) -> f32 {
        let width = self.outer - self.inner;
        let (slope, curvature) = (CollisionKernel::MAX_SLOPE / width, CollisionKernel::MAX_CURVATURE / (width * width));
        super::hugging::collision_bound(self.d.length(), slope, curvature, 1.0, self.outer)
    }
}
