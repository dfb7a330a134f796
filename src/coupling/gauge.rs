//! Gauge points by a coupled solve: where the material squeezed out of one contact does not flow into the next.

use glam::Mat3;

use crate::field::Spread;
use crate::math::Vec3;

/// The gauge point of a contact at `point`, kept on the planes of the `others` (their contact points and directions):
/// `g = argmin |g − c|² + w Σ (n_i · (g − c_i))²`, at most `reach` metres away: two planes that are nearly parallel meet far off,
/// and the material flows sideways in proportion to the distance.
pub fn gauge_point(point: Vec3, others: impl IntoIterator<Item = (Vec3, Vec3)>, reach: f32) -> Vec3 {
    let mut matrix = Mat3::IDENTITY;
    let mut right = Vec3::ZERO;
    for (other, normal) in others {
        matrix += outer(normal) * PLANE_WEIGHT;
        right += normal * (PLANE_WEIGHT * normal.dot(other - point));
    }
    point + (matrix.inverse() * right).clamp_length_max(reach)
}

/// Which way material gives way that a contact pushes along `normal`, between other contacts with the normals `others`:
/// rather along the direction across `normal` that fewer of them bar.
///
/// With `λ₁ ≥ λ₂` the eigenvalues of `Σ m mᵀ`, `m` the others' normals across `normal`, and `e` the eigenvector of `λ₂`,
/// the share is `(λ₁ − λ₂) / (λ₁ + λ₂ + ½)`: nearly all where two walls bar one way and none the other.
pub fn spread_between(normal: Vec3, others: impl IntoIterator<Item = Vec3>) -> Spread {
    let (x, y) = normal.any_orthonormal_pair();
    let (mut xx, mut xy, mut yy) = (0.0_f32, 0.0_f32, 0.0_f32);
    for other in others {
        let (u, v) = (other.dot(x), other.dot(y));
        (xx, xy, yy) = (xx + u * u, xy + u * v, yy + v * v);
    }
    let gap = ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt();
    if gap <= f32::EPSILON {
        return Spread::EVEN;
    }
    // The direction of the larger eigenvalue has twice the angle of (xx − yy, 2 xy); the other is across it.
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = angle.sin_cos();
    let along = (y * cos - x * sin).normalize();
    Spread { along, share: gap / (xx + yy + UNBARRED) }
}

/// What the bars are compared with: a single wall bars its way by two thirds.
const UNBARRED: f32 = 0.5;

/// How much more the planes count than the distance from the contact point.
const PLANE_WEIGHT: f32 = 50.0;

fn outer(n: Vec3) -> Mat3 {
    Mat3::from_cols(n * n.x, n * n.y, n * n.z)
}
