//! Finite differences of f32 functions.

use pliant::math::{Mat3, Vec3};

/// The Jacobian by central differences of order four with the step `h`.
///
/// The fields are computed in f32: a difference over `h` carries an error of about `2⁻²² |f| / h` from rounding and
/// `h⁴ f⁽⁵⁾ / 30` from the formula. At a step of one to ten thousandths of a field's width both are below `2e-4` of the
/// largest slope.
pub fn jacobian(f: impl Fn(Vec3) -> Vec3, x: Vec3, h: f32) -> Mat3 {
    let column = |axis: Vec3| {
        let (near, far) = (axis * h, axis * (2.0 * h));
        ((f(x + near) - f(x - near)) * 8.0 - (f(x + far) - f(x - far))) / (12.0 * h)
    };
    Mat3::from_cols(column(Vec3::X), column(Vec3::Y), column(Vec3::Z))
}

/// The trace: the divergence of the field with this Jacobian.
pub fn trace(m: &Mat3) -> f32 {
    m.x_axis.x + m.y_axis.y + m.z_axis.z
}

/// The largest singular value, by power iteration on `mᵀ m`.
pub fn spectral_norm(m: &Mat3) -> f32 {
    let square = m.transpose() * *m;
    let mut best = 0.0_f32;
    for start in [Vec3::new(1.0, 0.3, 0.2), Vec3::new(-0.2, 1.0, 0.3), Vec3::new(0.3, -0.2, 1.0)] {
        let mut v = start;
        for _ in 0..40 {
            v = (square * v).normalize_or_zero();
        }
        best = best.max((*m * v).length());
    }
    best
}
