//! The collision field that hugs a convex part: constant in the part itself near a contact, faded out with the distance
//! from the part and with the distance from the contact.

use super::certificate::Lipschitz;
use super::curl::curl_of_weighted_rotation;
use super::kernel::CollisionKernel;
use super::part::PlacedPart;
use crate::math::Vec3;

/// The place of a contact: a ball that moves along with the part. Beyond it the field fades out sideways.
///
/// A floor has no end; without a patch a contact at one foot would lift everything else that stands on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Centre, with the part in its true place.
    pub centre: Vec3,
    /// Radius in metres, not negative; infinite for no patch.
    pub radius: f32,
    /// Fade-out width in metres, positive.
    pub width: f32,
}

impl Patch {
    /// The whole space.
    pub const EVERYWHERE: Self = Self { centre: Vec3::ZERO, radius: f32::INFINITY, width: 1.0 };

    /// `(φ, ∇φ)` of [`CollisionKernel`] at the distance of `x` from the patch.
    #[inline]
    pub fn weight(&self, x: Vec3) -> (f32, Vec3) {
        let away = x - self.centre;
        let distance = away.length();
        let (phi, dphi) = CollisionKernel::weight(distance - self.radius, self.width);
        (phi, if dphi == 0.0 { Vec3::ZERO } else { away * (dphi / distance) })
    }
}

/// Which way the material beside a contact gives way: all ways across the displacement alike, or rather along one of them.
///
/// The potential `A = φ (d × B b)` is as good as `φ (d × b)` for every symmetric `B` with `B d = 0` and trace 2: its curl is
/// field (F) with `B b` in the place of `b`. With `B b = (1 − s) b + 2 s e (e · b)` for a unit vector `e` across `d` the
/// material flows along `e` alone where `s = 1`, as between walls that leave no other way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Unit vector `e` across the displacement.
    pub along: Vec3,
    /// `s` from 0, all ways alike, to 1, along `e` alone.
    pub share: f32,
}

impl Spread {
    /// All ways alike.
    pub const EVEN: Self = Self { along: Vec3::ZERO, share: 0.0 };

    /// `B b`.
    #[inline]
    pub fn apply(&self, b: Vec3) -> Vec3 {
        b * (1.0 - self.share) + self.along * (2.0 * self.share * self.along.dot(b))
    }
}

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
    /// Which way the material gives way; `along` is across `d`.
    pub spread: Spread,
    /// Where on the part the contact is.
    pub patch: Patch,
    /// Largest distance of the body from the gauge point: it enters the Lipschitz bound only.
    pub extent: f32,
}

impl HuggingField {
    /// `u(x, t)`: [`curl_of_weighted_rotation`] with the weight `φ = 2 φ_part φ_patch = ½ (k_part k_patch)²`.
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        let shifted = x + self.d * (1.0 - t);
        let (patch, patch_slope) = self.patch.weight(shifted);
        if patch <= 0.0 {
            return Vec3::ZERO;
        }
        let (distance, direction) = self.part.distance(shifted);
        if distance >= self.width {
            return Vec3::ZERO;
        }
        let (phi, dphi) = CollisionKernel::weight(distance, self.width);
        let slope = direction * (2.0 * patch * dphi) + patch_slope * (2.0 * phi);
        curl_of_weighted_rotation(2.0 * patch * phi, slope, self.d, self.spread.apply(x - self.gauge))
    }

    /// True where the field may move the point `x`, should nothing else move it.
    #[inline]
    pub fn reaches(&self, x: Vec3) -> bool {
        self.patch_reaches(x) && self.part.distance(x).0 < self.width + self.d.length()
    }

    /// True where `x` lies within the patch and its border, wherever the part is on its way.
    #[inline]
    pub fn patch_reaches(&self, x: Vec3) -> bool {
        x.distance(self.patch.centre) < self.patch.radius + self.patch.width + self.d.length()
    }
}

impl Lipschitz for HuggingField {
    /// The bound for the product of two weights, that of the part with the width `W` and that of the patch with `V`:
    /// `|∇(2φψ)| ≤ S √(1/W² + 1/V²)` and `|∇∇(2φψ)| ≤ C (1/W² + 1/V²) + 0.14 / (W V)`, since both are never steep at once. A
    /// spread `B` with the norm `1 + s` multiplies all that `b` takes part in.
    fn lipschitz(&self) -> f32 {
        let along = if self.patch.radius.is_finite() { 1.0 / self.patch.width } else { 0.0 };
        let across = 1.0 / self.width;
        let squares = across * across + along * along;
        let slope = CollisionKernel::MAX_SLOPE * squares.sqrt();
        let curvature = CollisionKernel::MAX_CURVATURE * squares + CollisionKernel::MIXED_CURVATURE * across * along;
        let d = self.d.length();
        let aside = (self.patch.centre - self.gauge).reject_from_normalized(self.d.normalize_or(Vec3::X)).length();
        let extent = self.extent.min(self.patch.radius + self.patch.width + aside);
        collision_bound(d, slope, curvature, 1.0 + self.spread.share, extent)
    }
}

/// `|∇u| ≤ |d| ((2 + |B|) max|∇φ| + |B| b max|∇∇φ|)` where `b` bounds the distance from the gauge point across `d`.
///
/// With the Hessian `H` of `φ`, the derivative of (F), `u = 2 φ d + ∇φ × (d × B b)`, along `v` is
/// `2 (∇φ · v) d + H v × (d × B b) + ∇φ × (d × B v)`.
pub(super) fn collision_bound(d: f32, slope: f32, curvature: f32, spread: f32, extent: f32) -> f32 {
    d * ((2.0 + spread) * slope + spread * extent * curvature)
}
