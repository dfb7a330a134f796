//! Skinning weights from the bones alone: each point of the surface follows its nearest bone, and near the border
//! between two bones' regions the weights cross over smoothly *along the surface*.
//!
//! Parts that touch in space without being joined on the surface (two legs) get nothing from each other: a bone that
//! the surface turns its back to counts as farther away, islands of a bone's region are given to what surrounds them,
//! and the blend is measured along edges only.

use super::weight_regions::{Surface, regions};
use super::{MAX_INFLUENCES, SkinWeights};
use crate::math::Vec3;
use crate::mesh::TriangleMesh;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// At most this many bones can be told apart by the indices of [`SkinWeights`].
pub const MAX_SEGMENTS: usize = u16::MAX as usize;

/// How weights are spread.
#[derive(Clone, Debug, PartialEq)]
pub struct WeightOptions {
    /// Radius about each bone in metres, subtracted from distances so that a fat bone does not lose to a thin one; one
    /// entry a bone, or empty for all zero. Not negative.
    pub radii: Vec<f32>,
    /// Half the width of the blend between two bones as a part of the local distance from surface to bone: 0 for hard
    /// borders, default 1. Range 0 to 10.
    pub blend: f32,
}

impl Default for WeightOptions {
    fn default() -> Self {
        Self { radii: Vec::new(), blend: 1.0 }
    }
}

/// Why no weights can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WeightsError {
    /// There is no bone.
    #[error("there are no bones to compute weights from")]
    NoBones,
    /// More bones than indices can name.
    #[error("{0} bones are more than the {MAX_SEGMENTS} that a body may have")]
    TooManyBones(usize),
    /// An end of a bone is NaN or infinite.
    #[error("bone {0} has an end that is not finite")]
    BoneNotFinite(usize),
    /// Another number of radii than bones.
    #[error("{given} radii were given for {bones} bones")]
    RadiiMismatch {
        /// Number of radii.
        given: usize,
        /// Number of bones.
        bones: usize,
    },
    /// A radius is negative or not finite.
    #[error("the radius {radius} of bone {bone} is not a finite number of 0 or more")]
    BadRadius {
        /// Index of the bone.
        bone: usize,
        /// Its radius.
        radius: f32,
    },
    /// The blend is out of its range.
    #[error("the blend {0} is not between 0 and 10")]
    BadBlend(f32),
    /// The arrays of the mesh do not fit each other.
    #[error("the mesh is not consistent: {0}")]
    BadMesh(&'static str),
}

/// Computes weights for each vertex of `mesh` from bones given by their two ends in the rest pose.
///
/// Weights are not negative, sum to 1 and are shared by welded vertices; at most [`MAX_INFLUENCES`] are kept and all
/// but the vertices near borders have one of exactly 1. Along an edge of length `l` no weight changes by more than about
/// `l / width`, where the width is `blend` times the local distance to the bone. The result is a function of the
/// arguments alone.
///
/// # Errors
/// See [`WeightsError`].
pub fn compute_weights(
    mesh: &TriangleMesh,
    bones: &[[Vec3; 2]],
    options: &WeightOptions,
) -> Result<Vec<SkinWeights>, WeightsError> {
    check(mesh, bones, options)?;
    let surface = Surface::new(mesh);
    let (label, cost_of) = regions(mesh, &surface, bones, &options.radii);
    let width: Vec<f64> = (0..mesh.positions.len())
        .map(|v| f64::from(options.blend) * distance_to_bone(mesh.positions[v], &bones[label[v] as usize]).1)
        .collect();
    let reach = match options.blend {
        0.0 => vec![Vec::new(); label.len()],
        _ => reach(&surface, &label, &width, cost_of),
    };
    Ok(mesh.welded.iter().map(|&v| pairs(label[v as usize], &reach[v as usize])).collect())
}

/// The point of a bone nearest to `p`, and its distance.
pub(super) fn distance_to_bone(p: Vec3, bone: &[Vec3; 2]) -> (Vec3, f64) {
    let [a, b] = bone.map(|e| e.as_dvec3());
    let p = p.as_dvec3();
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let nearest = if t.is_finite() { a + along * t } else { a };
    (nearest.as_vec3(), nearest.distance(p))
}

fn check(mesh: &TriangleMesh, bones: &[[Vec3; 2]], options: &WeightOptions) -> Result<(), WeightsError> {
    if bones.is_empty() {
        return Err(WeightsError::NoBones);
    }
    if bones.len() > MAX_SEGMENTS {
        return Err(WeightsError::TooManyBones(bones.len()));
    }
    if let Some(bone) = bones.iter().position(|b| !b[0].is_finite() || !b[1].is_finite()) {
        return Err(WeightsError::BoneNotFinite(bone));
    }
    if !options.radii.is_empty() && options.radii.len() != bones.len() {
        return Err(WeightsError::RadiiMismatch { given: options.radii.len(), bones: bones.len() });
    }
    let bad = |r: &f32| !(0.0..f32::INFINITY).contains(r);
    if let Some(bone) = options.radii.iter().position(bad) {
        return Err(WeightsError::BadRadius { bone, radius: options.radii[bone] });
    }
    if !(0.0..=10.0).contains(&options.blend) {
        return Err(WeightsError::BadBlend(options.blend));
    }
    let vertices = mesh.positions.len();
    let beyond = |i: &u32| *i as usize >= vertices;
    if mesh.welded.len() != vertices || mesh.welded.iter().any(beyond) {
        return Err(WeightsError::BadMesh("`welded` must have one entry a vertex, each a vertex"));
    }
    if mesh.triangles.iter().flatten().any(beyond) {
        return Err(WeightsError::BadMesh("a triangle uses a vertex that does not exist"));
    }
    Ok(())
}

/// For each point the other regions in reach with their distance along the surface in widths, from 0 to 1.
///
/// The border crosses an edge where both bones cost the same; from there the distance runs along edges, each counted in
/// the mean width of its ends, so that it changes by no more than that along any edge.
fn reach(surface: &Surface, label: &[u16], width: &[f64], cost_of: impl Fn(usize, u16) -> f64) -> Vec<Vec<(u16, f64)>> {
    let span = |a: usize, b: usize, length: f64| length / (0.5 * (width[a] + width[b])).max(1e-12);
    // (distance, region that reaches, point): one search for all regions at once.
    let mut queue: BinaryHeap<Reverse<(Distance, u16, usize)>> = BinaryHeap::new();
    for from in 0..label.len() {
        for (to, length) in surface.around(from) {
            let (mine, theirs) = (label[from], label[to]);
            if mine != theirs {
                let here = cost_of(from, theirs) - cost_of(from, mine);
                let there = cost_of(to, mine) - cost_of(to, theirs);
                let part = if here >= 0.0 && there >= 0.0 && here + there > 0.0 { here / (here + there) } else { 0.5 };
                queue.push(Reverse((Distance(part * span(from, to, length)), theirs, from)));
            }
        }
    }
    let mut reached: Vec<Vec<(u16, f64)>> = vec![Vec::new(); label.len()];
    while let Some(Reverse((Distance(x), region, at))) = queue.pop() {
        if x >= 1.0 {
            break;
        }
        if label[at] == region || reached[at].iter().any(|r| r.0 == region) {
            continue;
        }
        reached[at].push((region, x));
        for (to, length) in surface.around(at) {
            queue.push(Reverse((Distance(x + span(at, to, length)), region, to)));
        }
    }
    reached
}

/// The pairs of one point: its own region counts 1, others fall off smoothly to 0 at one width; then normalised.
fn pairs(own: u16, reached: &[(u16, f64)]) -> SkinWeights {
    let fall = |x: f64| (1.0 - x) * (1.0 - x) * (1.0 + 2.0 * x);
    let mut all: Vec<(u16, f64)> =
        reached.iter().map(|&(region, x)| (region, fall(x))).filter(|w| w.1 > 1e-4).collect();
    all.push((own, 1.0));
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    all.truncate(MAX_INFLUENCES);
    let sum: f64 = all.iter().map(|w| w.1).sum();
    let mut result = SkinWeights { segments: [0; MAX_INFLUENCES], weights: [0.0; MAX_INFLUENCES] };
    for (k, (region, weight)) in all.into_iter().enumerate() {
        result.segments[k] = region;
        result.weights[k] = (weight / sum) as f32;
    }
    result
}

/// A distance with the total order of floats.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Distance(pub f64);

impl Eq for Distance {}

impl PartialOrd for Distance {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Distance {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

#[cfg(test)]
#[path = "weights_tests.rs"]
mod tests;
