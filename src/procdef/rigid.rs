//! What a body does as a whole: its centre of mass, its rigid part of motion, and goals turned so that momentum is kept.

use glam::{DMat3, DVec3, Mat3};
use wide::f32x4;

use super::rotation::nearest_rotation;
use crate::math::{Quat, Vec3};

/// How many vertices are added up in 32 bits before 64 bits take the sum.
const RUN: usize = 16;

/// Rounds of [`keep_momentum`] at most; one is the rule.
const ROUNDS: u32 = 6;
/// The angular momentum that may be left, as a part of `Σ m r |g - x|`. The rounding of 32 bits leaves about as much.
const LEFT: f64 = 2e-6;

/// Turns and shifts the goals `g = x + d` as one rigid body so that going there from `x` changes neither linear nor angular momentum:
/// `Σ m (g - x) = 0` and `Σ m x × (g - x) = 0`.
///
/// One pass of matching does this by itself. Several passes, and the global solve, keep the angular momentum only to first
/// order in the deformation. Turning the goals by a small `ω` changes `Σ m r × g` by `(tr(S) 1 - S) ω` with
/// `S = Σ m r gᵀ`: Newton's method, on sums of the small differences `g - x`, so that few digits are lost. Where the turn is not
/// small, the nearest rotation to `S` comes first.
pub(super) fn keep_momentum(mass: &[f32], x: &[f32x4], d: &mut [f32x4]) {
    let (total, centre) = centre(mass, x);
    let c = wide(centre.as_vec3());
    for _ in 0..ROUNDS {
        let sums = Sums::of(mass, x, d, c);
        let shift = sums.way / total;
        // Σ m r rᵀ about the centre, and the part that the differences add.
        let s = sums.squares + sums.moments;
        let torque = axial(&sums.moments);
        let trace = s.x_axis.x + s.y_axis.y + s.z_axis.z;
        let hessian = DMat3::from_diagonal(DVec3::splat(trace)) - (s + s.transpose()) * 0.5;
        let omega = hessian.inverse() * -torque;
        let small = hessian.determinant() > 1e-4 * trace.powi(3) && trace > 0.0 && omega.length_squared() < 0.01;
        let turn = if small { cayley(omega) } else { nearest(s).as_dmat3() - DMat3::IDENTITY };
        if !(turn.is_finite() && shift.is_finite()) {
            return;
        }
        let [u, v, w] = [turn.x_axis, turn.y_axis, turn.z_axis].map(|v| wide(v.as_vec3()));
        let from = c + wide(shift.as_vec3());
        let back = wide(shift.as_vec3());
        for (d, &x) in d.iter_mut().zip(x) {
            let [a, b, c, _] = (x - from + *d).to_array();
            *d += u * f32x4::splat(a) + v * f32x4::splat(b) + w * f32x4::splat(c) - back;
        }
        if small && omega.length_squared() * trace <= LEFT * (trace * sums.ways).sqrt() {
            return;
        }
    }
}

/// Shifts the differences `d = g - x` so that `Σ m d = 0` to the rounding of a sum.
///
/// One pass of matching keeps the momentum, but rounds the goals of each vertex: thousands of steps would add that up.
pub(super) fn keep_linear_momentum(mass: &[f32], d: &mut [f32x4]) {
    let (_, mean) = centre(mass, d);
    let shift = wide(mean.as_vec3());
    if vec3(shift).is_finite() {
        d.iter_mut().for_each(|d| *d -= shift);
    }
}

/// The sums over all vertices that [`keep_momentum`] needs, with `r = x - c`.
struct Sums {
    /// `Σ m d`
    way: DVec3,
    /// `Σ m |d|²`
    ways: f64,
    /// `Σ m r rᵀ`
    squares: DMat3,
    /// `Σ m r dᵀ`
    moments: DMat3,
}

impl Sums {
    fn of(mass: &[f32], x: &[f32x4], d: &[f32x4], c: f32x4) -> Self {
        let mut out = Self { way: DVec3::ZERO, ways: 0.0, squares: DMat3::ZERO, moments: DMat3::ZERO };
        for ((mass, x), d) in mass.chunks(RUN).zip(x.chunks(RUN)).zip(d.chunks(RUN)) {
            let mut squares = [f32x4::ZERO; 3];
            let mut moments = [f32x4::ZERO; 3];
            let (mut way, mut ways) = (f32x4::ZERO, f32x4::ZERO);
            for ((&m, &x), &d) in mass.iter().zip(x).zip(d) {
                let r = x - c;
                let (mr, md) = (r * f32x4::splat(m), d * f32x4::splat(m));
                way += md;
                ways += md * d;
                let ([a, b, c, _], [e, f, h, _]) = (r.to_array(), d.to_array());
                squares = add(squares, mr, [a, b, c]);
                moments = add(moments, mr, [e, f, h]);
            }
            out.way += vec3(way).as_dvec3();
            out.ways += vec3(ways).as_dvec3().element_sum();
            out.squares += matrix(squares);
            out.moments += matrix(moments);
        }
        out
    }
}

#[inline]
fn add(columns: [f32x4; 3], v: f32x4, [a, b, c]: [f32; 3]) -> [f32x4; 3] {
    [columns[0] + v * f32x4::splat(a), columns[1] + v * f32x4::splat(b), columns[2] + v * f32x4::splat(c)]
}

fn matrix(columns: [f32x4; 3]) -> DMat3 {
    let [a, b, c] = columns.map(|v| vec3(v).as_dvec3());
    DMat3::from_cols(a, b, c)
}

/// `Σ r × d` of the matrix `Σ r dᵀ`.
fn axial(m: &DMat3) -> DVec3 {
    DVec3::new(m.z_axis.y - m.y_axis.z, m.x_axis.z - m.z_axis.x, m.y_axis.x - m.x_axis.y)
}

/// The rotation about `omega`, by its length to third order, without the identity.
fn cayley(omega: DVec3) -> DMat3 {
    let a = omega * 0.5;
    let cross = DMat3::from_cols(DVec3::new(0.0, a.z, -a.y), DVec3::new(-a.z, 0.0, a.x), DVec3::new(a.y, -a.x, 0.0));
    (cross + cross * cross) * (2.0 / (1.0 + a.length_squared()))
}

/// The rotation nearest to a matrix of any scale.
fn nearest(s: DMat3) -> Mat3 {
    let scale = s.x_axis.abs().max(s.y_axis.abs()).max(s.z_axis.abs()).max_element();
    if scale > 0.0 && scale.is_finite() {
        Mat3::from_quat(nearest_rotation((s * (1.0 / scale)).as_mat3(), Quat::IDENTITY))
    } else {
        Mat3::IDENTITY
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

/// The mass and its centre, in 64 bits.
fn centre(mass: &[f32], x: &[f32x4]) -> (f64, DVec3) {
    let (mut total, mut sum) = (0.0f64, DVec3::ZERO);
    for (mass, x) in mass.chunks(RUN).zip(x.chunks(RUN)) {
        let part = mass.iter().zip(x).fold(f32x4::ZERO, |s, (&m, &x)| s + x * f32x4::splat(m));
        sum += vec3(part).as_dvec3();
        total += f64::from(mass.iter().sum::<f32>());
    }
    (total, sum / total)
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
