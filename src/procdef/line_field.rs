//! Directions without sense, made whole where they are not determined: a harmonic extension of their tensors.
//!
//! A direction `d` acts through `d dᵀ` alone (equation 1), so opposite directions are the same. Where confidence is
//! lacking, the tensor is the mean of the neighbours' (a discrete harmonic function), and the direction is its main axis.
//! So the answer varies as smoothly as what surrounds it allows. On the axis of a tube, where all directions of a radial
//! field meet, no direction is right; any is as good there, and the rates across are the same on average.

use crate::math::Vec3;
use crate::mesh::VertexLists;
use nalgebra::Matrix3;

/// Sweeps of the extension; each carries values one vertex farther in one direction at least.
const SWEEPS: usize = 400;
/// Change of a tensor of unit length below which a sweep changes nothing.
const SETTLED: f64 = 1.0e-7;

/// A direction and how far it is to be believed: 0 not at all, 1 wholly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The direction; any length.
    pub direction: Vec3,
    /// Confidence in [0, 1].
    pub confidence: f32,
}

/// Unit directions at all vertices: believed candidates as they are, the others extended from their neighbours. Where
/// nothing reaches, the candidate, or an axis if it has no length.
pub fn extend(candidates: &[Candidate], neighbours: &VertexLists) -> Vec<Vec3> {
    let unit: Vec<Option<Vec3>> = candidates.iter().map(|c| c.direction.try_normalize()).collect();
    let trust: Vec<f64> =
        candidates.iter().zip(&unit).map(|(c, u)| if u.is_some() { f64::from(c.confidence) } else { 0.0 }).collect();
    let own: Vec<[f64; 6]> = unit.iter().map(|u| u.map_or([0.0; 6], tensor)).collect();
    let open: Vec<usize> = (0..candidates.len()).filter(|&i| trust[i] < 1.0).collect();
    let mut tensors: Vec<[f64; 6]> = own.iter().zip(&trust).map(|(t, w)| t.map(|v| v * w)).collect();
    for _ in 0..SWEEPS {
        let mut change = 0.0f64;
        // Forward and backward in turn, so that neither order of the vertices is favoured.
        for &i in open.iter().chain(open.iter().rev()) {
            let around = neighbours.of(i);
            if around.is_empty() {
                continue;
            }
            let mut mean = [0.0; 6];
            for &j in around {
                (0..6).for_each(|k| mean[k] += tensors[j as usize][k] / around.len() as f64);
            }
            for k in 0..6 {
                let value = trust[i] * own[i][k] + (1.0 - trust[i]) * mean[k];
                change = change.max((value - tensors[i][k]).abs());
                tensors[i][k] = value;
            }
        }
        if change < SETTLED {
            break;
        }
    }
    let mut directions: Vec<Vec3> = unit.iter().map(|u| u.unwrap_or(Vec3::ZERO)).collect();
    for &i in &open {
        if let Some(axis) = main_axis(&tensors[i]) {
            directions[i] = axis;
        }
    }
    // The sense of an extended direction follows its neighbours where they agree.
    for &i in &open {
        let around: Vec3 = neighbours.of(i).iter().map(|&j| directions[j as usize]).sum();
        if around.dot(directions[i]) < 0.0 {
            directions[i] = -directions[i];
        }
    }
    directions.into_iter().map(|d| d.normalize_or(Vec3::X)).collect()
}

/// The part of `direction` across the unit vector `across`, and the sine of the angle between them.
pub fn perpendicular(direction: Vec3, across: Vec3) -> (Vec3, f32) {
    let rest = direction - across * direction.dot(across);
    let length = direction.length();
    (rest, if length > 0.0 { rest.length() / length } else { 0.0 })
}

/// A unit vector across another, the same each time.
pub fn any_across(unit: Vec3) -> Vec3 {
    let size = unit.abs();
    let axis = if size.x <= size.y && size.x <= size.z {
        Vec3::X
    } else if size.y <= size.z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    (axis - unit * axis.dot(unit)).normalize_or(axis)
}

/// `d dᵀ` as xx, yy, zz, xy, yz, zx.
fn tensor(d: Vec3) -> [f64; 6] {
    let d = d.as_dvec3();
    [d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x]
}

/// The eigenvector of the largest eigenvalue; none for a tensor of no size.
fn main_axis(t: &[f64; 6]) -> Option<Vec3> {
    let matrix = Matrix3::new(t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]);
    if matrix.trace() <= 1.0e-9 {
        return None;
    }
    let eigen = matrix.symmetric_eigen();
    let v = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    let axis = Vec3::new(v[0] as f32, v[1] as f32, v[2] as f32);
    let first = axis.to_array().into_iter().find(|c| c.abs() > 0.1).unwrap_or(1.0);
    Some(axis * first.signum())
}
