//! The rotation nearest to a matrix, right for every matrix: also for flat, inverted and vanishing neighbourhoods.
//!
//! Of all rotations `R`, the one that maximises `tr(Rᵀ A)` is the largest eigenvector of a symmetric 4x4 matrix, as a
//! quaternion (Horn, *Closed-form solution of absolute orientation using unit quaternions*, 1987). It is the rotation of the
//! polar decomposition where `det A > 0`, and never a reflection. Where several are equally good (a neighbourhood in a
//! line or a point), the one nearest to the rotation of the step before is taken.

use glam::Mat3;
use nalgebra_sparse::na::{Matrix4, Vector4};

use crate::math::Quat;

/// Eigenvalues nearer to the largest one than this times the size of the matrix count as equal to it.
const EQUAL: f64 = 1e-5;

/// The rotation `R` that maximises `tr(Rᵀ A)`; where that is not unique, the one of them nearest to `previous`.
///
/// `previous` must have unit length. The result has unit length and lies in the half of the sphere of `previous`.
pub fn nearest_rotation(a: Mat3, previous: Quat) -> Quat {
    let scale = f64::from(a.x_axis.abs().max(a.y_axis.abs()).max(a.z_axis.abs()).max_element());
    // Written so that NaN keeps the rotation, too.
    if !(scale > f64::from(f32::MIN_POSITIVE) && scale.is_finite()) {
        return previous;
    }
    // m[row][column] of the matrix, about 1 in size.
    let m = a.to_cols_array_2d();
    let m = |row: usize, column: usize| f64::from(m[column][row]) / scale;
    let (xx, yy, zz) = (m(0, 0), m(1, 1), m(2, 2));
    let (x, y, z) = (m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
    let (xy, xz, yz) = (m(0, 1) + m(1, 0), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1));
    #[rustfmt::skip]
    let horn = Matrix4::new(
        xx + yy + zz, x, y, z,
        x, xx - yy - zz, xy, xz,
        y, xy, yy - xx - zz, yz,
        z, xz, yz, zz - xx - yy,
    );
    let eigen = horn.symmetric_eigen();
    let best = eigen.eigenvalues.max();
    let before = Vector4::new(previous.w, previous.x, previous.y, previous.z).map(f64::from);
    let mut projected = Vector4::zeros();
    let mut largest = 0;
    for k in 0..4 {
        if eigen.eigenvalues[k] >= best - EQUAL {
            let axis = eigen.eigenvectors.column(k);
            projected += axis * axis.dot(&before);
        }
        if eigen.eigenvalues[k] > eigen.eigenvalues[largest] {
            largest = k;
        }
    }
    if projected.norm_squared() < 1e-6 {
        projected = eigen.eigenvectors.column(largest).into_owned();
    }
    let q = projected.normalize().map(|v| v as f32);
    let q = Quat::from_xyzw(q[1], q[2], q[3], q[0]);
    if !q.is_finite() {
        return previous;
    }
    (if q.dot(previous) < 0.0 { -q } else { q }).normalize()
}
