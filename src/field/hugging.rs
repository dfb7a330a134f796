//! The collision field that hugs a convex part: constant in the part itself, faded out with the distance from it.

use super::certificate::Lipschitz;
use super::curl::curl_of_weighted_rotation;
use super::kernel::CollisionKernel;
use super::part::PlacedPart;
use crate::math::Vec3;

/// Carries everything that lies before a convex part, shifted back by `d`, out of the part's true place.
///
/// The part moves rigidly from its place minus `d` to its place while `t` runs from 0 to 1, and lies in the region of
/// constant velocity all the time: nothing that is outside the shifted part at `t = 0` can be inside the part at
/// `t = 1`. The gauge point is where the material does not flow sideways; the bulge grows with the distance from it.
#[derive(Clone, Debug, PartialEq)]
pub struct HuggingField {
    /// The part in its true place.
    pub part: PlacedPart,
    /// Displacement `d`, out of the part.
    pub d: Vec3,
    /// Gauge point `g`.
    pub gauge: Vec3,
    /// Fade-out width `W = s · size`, positive.
    pub width: f32,
    /// Largest distance of the body from the gauge point: it enters the Lipschitz bound only.
    pub extent: f32,
}

impl HuggingField {
    /// `u(x, t)`: [`curl_of_weighted_rotation`] with the collision kernel of the distance from the moving part.
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        let (distance, direction) = self.part.distance(x + self.d * (1.0 - t));
        if distance >= self.width {
            return Vec3::ZERO;
        }
        let (phi, dphi) = CollisionKernel::weight(distance, self.width);
        curl_of_weighted_rotation(phi, direction * dphi, self.d, x - self.gauge)
    }

    /// True where the field may move the point `x`, should nothing else move it.
    #[inline]
    pub fn reaches(&self, x: Vec3) -> bool {
        self.part.distance(x).0 < self.width + self.d.length()
    }
}

impl Lipschitz for HuggingField {
    fn lipschitz(&self) -> f32 {
        collision_bound(self.d.length(), self.width, self.extent)
    }
}

/// `|∇u| ≤ |d| (4 max|∇φ| + 2 B max|∇∇φ|)` for `|b| ≤ B`, from the product rule on (F).
pub(super) fn collision_bound(d: f32, width: f32, extent: f32) -> f32 {
    d / width * (4.0 * CollisionKernel::MAX_SLOPE + 2.0 * CollisionKernel::MAX_CURVATURE * extent / width)
}
