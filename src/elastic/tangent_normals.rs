//! Normals of the deformed skin without its neighbours: the paper's two tangent points (section 5.3).
//! `tangent_normals.wgsl` is the twin of this file.

use super::palette::Palette;
use super::rig::SkinWeights;
use crate::math::Vec3;

/// Distance of the two tangent points from their vertex, as a fraction of the body's size.
///
/// Rounding of the deformed points tilts the normal by about `2⁻²² · size / ε`, and the bend of the deformation between
/// the points by about `ε · curvature`. The two balance near here: for a sphere in two spring fields the mean error was
/// 2.1e-4, 1.3e-4, 1.2e-4 and 2.0e-4 at 1/512, 1/1024, 1/2048 and 1/4096; the larger of the two best leaves more room
/// for bodies away from the origin, whose coordinates are coarser.
pub const TANGENT_STEP: f32 = 1.0 / 1024.0;

/// The step `ε` of [`Palette::deform_with_normal`] in metres for a body with these rest positions: [`TANGENT_STEP`]
/// times the longest side of their bounding box.
pub fn tangent_epsilon(positions: &[Vec3]) -> f32 {
    let low = positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
    let high = positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
    (high - low).max_element() * TANGENT_STEP
}

impl Palette {
    /// Deforms a vertex and its unit rest normal. Two points at the distance `epsilon` in the tangent plane are deformed
    /// with the vertex's own weights; the deformed normal is that of the triangle of the three.
    ///
    /// Where the three deformed points span no triangle the rest normal is returned.
    pub fn deform_with_normal(&self, x: Vec3, normal: Vec3, skin: &SkinWeights, epsilon: f32) -> (Vec3, Vec3) {
        let first = tangent(normal);
        let second = normal.cross(first);
        let y = self.deform(x, skin);
        let y1 = self.deform(x + first * epsilon, skin);
        let y2 = self.deform(x + second * epsilon, skin);
        (y, (y1 - y).cross(y2 - y).try_normalize().unwrap_or(normal))
    }
}

/// A unit vector at right angles to the unit vector `n` (Duff and others, *Building an Orthonormal Basis, Revisited*).
#[inline]
fn tangent(n: Vec3) -> Vec3 {
    let sign = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + n.z);
    Vec3::new(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x)
}
