//! The one formula behind every field: the curl of `A = φ (d × b)`.

use crate::math::Vec3;

/// Field (F): `curl(φ (d × b)) = 2 φ d + (∇φ · b) d − (∇φ · d) b` with `b = x − g`.
///
/// Divergence-free for every smooth weight `φ`, every constant direction `d` and every gauge point `g`. With the
/// weights of [`super::SpringKernel`] and [`super::CollisionKernel`] it equals the paper's `w` (equations 8 and 9) and
/// `‖d‖ ∇p × ∇q` (section 4.1).
#[inline]
pub fn curl_of_weighted_rotation(phi: f32, grad_phi: Vec3, d: Vec3, b: Vec3) -> Vec3 {
    d * (2.0 * phi + grad_phi.dot(b)) - b * grad_phi.dot(d)
}
