//! Gauge points by a coupled solve: where the material squeezed out of one contact does not flow into the next.

use glam::Mat3;

use crate::math::Vec3;

/// The gauge point of a contact at `point`, kept on the planes of the `others` (their contact points and directions):
/// `g = argmin |g − c|² + w Σ (n_i · (g − c_i))²`.
pub fn gauge_point(point: Vec3, others: impl IntoIterator<Item = (Vec3, Vec3)>) -> Vec3 {
    let mut matrix = Mat3::IDENTITY;
    let mut right = Vec3::ZERO;
    for (other, normal) in others {
        matrix += outer(normal) * PLANE_WEIGHT;
        right += normal * (PLANE_WEIGHT * normal.dot(other - point));
    }
    point + matrix.inverse() * right
}

/// How much more the planes count than the distance from the contact point.
const PLANE_WEIGHT: f32 = 1.0e3;

fn outer(n: Vec3) -> Mat3 {
    Mat3::from_cols(n * n.x, n * n.y, n * n.z)
}
