//! Gauge points by a coupled solve: where the material squeezed out of one contact does not flow into the next.

use glam::Mat3;

use crate::field::Spread;
use crate::math::Vec3;

/// Another contact as one contact sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// A point of the skin where it is.
    pub point: Vec3,
    /// Its unit direction.
    pub normal: Vec3,
    /// How much it counts, from 0 to 1: less than 1 where the skin is not there yet.
    pub weight: f32,
}

/// The gauge point of a contact at `point`, kept on the planes of the `others`: `g = c + N (N² + ε² 1)⁻¹ Σ w n (n · (c_i − c))`
/// with `N = Σ w n nᵀ`, at most `reach` metres away.
///
/// Where the planes fix a direction well this is the point nearest to all of them. Planes that are nearly parallel meet far
/// off, and on the other side when they tilt the other way: such a direction, with an eigenvalue of `N` far below `ε`, is
/// left alone. `ε` is a quarter of half the trace of `N`, and no less than a quarter: many planes about one axis,
/// as of a ring, tilt together, and the point where they meet runs along it.
pub fn gauge_point(point: Vec3, others: impl IntoIterator<Item = Bar>, reach: f32) -> Vec3 {
    let mut matrix = Mat3::ZERO;
    let mut right = Vec3::ZERO;
    for other in others {
        matrix += outer(other.normal) * other.weight;
        right += other.normal * (other.weight * other.normal.dot(other.point - point));
    }
    let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
    let ridge = NEARLY_PARALLEL * (0.5 * trace).max(1.0);
    let ridge = Mat3::from_diagonal(Vec3::splat(ridge * ridge));
    point + (matrix * ((matrix * matrix + ridge).inverse() * right)).clamp_length_max(reach)
}

/// Which way material gives way that a contact pushes along `normal`, between other contacts with the normals `others`:
/// rather along the direction across `normal` that fewer of them bar.
///
/// With `λ₁ ≥ λ₂` the eigenvalues of `Σ w m mᵀ`, `m` the others' normals across `normal`, and `e` the eigenvector of `λ₂`,
/// the share is `(λ₁ − λ₂) / (λ₁ + λ₂ + ½)`: four fifths where two walls bar one way and none the other.
pub fn spread_between(normal: Vec3, others: impl IntoIterator<Item = Bar>) -> Spread {
    let (x, y) = normal.any_orthonormal_pair();
    let (mut xx, mut xy, mut yy) = (0.0_f32, 0.0_f32, 0.0_f32);
    for other in others {
        let (u, v, w) = (other.normal.dot(x), other.normal.dot(y), other.weight);
        (xx, xy, yy) = (xx + w * u * u, xy + w * u * v, yy + w * v * v);
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

/// The eigenvalue `ε` at which planes fix a direction by half, as a part of half of the trace of `N`, and of 1 where that is more.
const NEARLY_PARALLEL: f32 = 0.25;

fn outer(n: Vec3) -> Mat3 {
    Mat3::from_cols(n * n.x, n * n.y, n * n.z)
}
