//! What a body does as a whole: its centre of mass, its rigid part of motion, and goals turned so that momentum is kept.

use glam::{DMat3, DVec3, Mat3};
use wide::f32x4;

use super::rotation::nearest_rotation;
use crate::math::{Quat, Vec3};

/// How many vertices are added up in 32 bits before 64 bits take the sum.
const RUN: usize = 16;

/// Turns and shifts the goals `g` as one rigid body so that going there from `x` changes neither linear nor angular momentum:
/// `Σ m (g - x) = 0` and `Σ m x × (g - x) = 0`.
///
/// One pass of matching does this by itself. Several passes, and the global solve, keep the angular momentum only to first
/// order in the deformation. Of all rotations, the one nearest to `Σ m (x - c)(g - c_g)ᵀ` makes that matrix symmetric, which is
/// what the second equation says.
pub(super) fn keep_momentum(mass: &[f32], x: &[f32x4], g: &mut [f32x4]) {
    let (centre_x, centre_g) = (centre(mass, x), centre(mass, g));
    let (cx, cg) = (splat(centre_x), splat(centre_g));
    let mut total = DMat3::ZERO;
    for ((mass, x), g) in mass.chunks(RUN).zip(x.chunks(RUN)).zip(g.chunks(RUN)) {
        let mut sums = [f32x4::ZERO; 3];
        for ((&m, &x), &g) in mass.iter().zip(x).zip(g) {
            let d = (x - cx) * f32x4::splat(m);
            let [a, b, c, _] = (g - cg).to_array();
            sums = [sums[0] + d * f32x4::splat(a), sums[1] + d * f32x4::splat(b), sums[2] + d * f32x4::splat(c)];
        }
        let [a, b, c] = sums.map(|v| vec3(v).as_dvec3());
        total += DMat3::from_cols(a, b, c);
    }
    let scale = total.x_axis.abs().max(total.y_axis.abs()).max(total.z_axis.abs()).max_element();
    let turn = if scale > 0.0 && scale.is_finite() {
        Mat3::from_quat(nearest_rotation((total * (1.0 / scale)).as_mat3(), Quat::IDENTITY))
    } else {
        Mat3::IDENTITY
    };
    let [a, b, c] = [turn.x_axis, turn.y_axis, turn.z_axis].map(|v| f32x4::new([v.x, v.y, v.z, 0.0]));
    for g in g.iter_mut() {
        let [u, v, w, _] = (*g - cg).to_array();
        *g = cx + a * f32x4::splat(u) + b * f32x4::splat(v) + c * f32x4::splat(w);
    }
}

/// Slows down what is not rigid in the motion: after Müller, Heidelberger, Hennix and Ratcliff, *Position Based Dynamics*
/// (2006), section 3.5. `kept` is the part of it that stays, from 0 to 1. Linear and angular momentum stay as they are, and a
/// body that moves rigidly is not slowed at all.
pub(super) fn damp(mass: &[f32], x: &[Vec3], v: &mut [Vec3], kept: f32) {
    let mut total = 0.0f64;
    let (mut centre, mut mean) = (DVec3::ZERO, DVec3::ZERO);
    for ((&m, x), v) in mass.iter().zip(x).zip(v.iter()) {
        let m = f64::from(m);
        total += m;
        centre += x.as_dvec3() * m;
        mean += v.as_dvec3() * m;
    }
    let (centre, mean) = (centre / total, mean / total);
    let mut momentum = DVec3::ZERO;
    let mut squares = DMat3::ZERO;
    for ((&m, x), v) in mass.iter().zip(x).zip(v.iter()) {
        let r = x.as_dvec3() - centre;
        let mr = r * f64::from(m);
        momentum += mr.cross(v.as_dvec3() - mean);
        squares += DMat3::from_cols(mr * r.x, mr * r.y, mr * r.z);
    }
    let spread = squares.x_axis.x + squares.y_axis.y + squares.z_axis.z;
    // All in one point or along a line there is no spin, or one that is not known: a trace of inertia keeps it finite.
    let inertia = DMat3::from_diagonal(DVec3::splat(spread * (1.0 + 1e-9))) - squares;
    let spin = if spread > 0.0 { inertia.inverse() * momentum } else { DVec3::ZERO };
    if !(spin.is_finite() && mean.is_finite()) {
        return;
    }
    for (x, v) in x.iter().zip(v.iter_mut()) {
        let rigid = (mean + spin.cross(x.as_dvec3() - centre)).as_vec3();
        *v = rigid + (*v - rigid) * kept;
    }
}

/// The centre of mass, in 64 bits.
pub(super) fn centre(mass: &[f32], x: &[f32x4]) -> DVec3 {
    let (mut total, mut sum) = (0.0f64, DVec3::ZERO);
    for (mass, x) in mass.chunks(RUN).zip(x.chunks(RUN)) {
        let part = mass.iter().zip(x).fold(f32x4::ZERO, |s, (&m, &x)| s + x * f32x4::splat(m));
        sum += vec3(part).as_dvec3();
        total += f64::from(mass.iter().sum::<f32>());
    }
    sum / total
}

/// A vector in the first three lanes.
#[inline]
pub(super) fn wide(v: Vec3) -> f32x4 {
    f32x4::new([v.x, v.y, v.z, 0.0])
}

/// The first three lanes.
#[inline]
pub(super) fn vec3(v: f32x4) -> Vec3 {
    let [x, y, z, _] = v.to_array();
    Vec3::new(x, y, z)
}

fn splat(v: DVec3) -> f32x4 {
    wide(v.as_vec3())
}
