//! A point of the skin: a vertex, or a point between the three vertices of a triangle.

use rayon::prelude::*;

use crate::elastic::{CollisionPass, ElasticBody, ElasticRig};
use crate::field::LANES;
use crate::math::Vec3;

/// A point of the skin as a weighted mean of vertices. Weights are not negative and sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinPoint {
    /// Three vertices; for a single vertex three times the same.
    pub vertices: [u32; 3],
    /// Their weights.
    pub weights: [f32; 3],
}

impl SkinPoint {
    /// A vertex.
    pub fn vertex(vertex: u32) -> Self {
        Self { vertices: [vertex; 3], weights: [1.0, 0.0, 0.0] }
    }

    /// True for a vertex, false for a point within a triangle.
    pub fn is_vertex(&self) -> bool {
        self.weights[0] == 1.0
    }

    /// The vertices that count, with their weights.
    pub fn corners(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        self.vertices.iter().zip(&self.weights).filter(|(_, w)| **w > 0.0).map(|(&v, &w)| (v as usize, w))
    }

    /// Where the point is on a skin with these vertices.
    pub fn position(&self, positions: &[Vec3]) -> Vec3 {
        self.corners().map(|(v, w)| positions[v] * w).sum()
    }

    /// Where the point is when its three vertices are at these corners.
    pub fn position_of(&self, corners: [Vec3; 3]) -> Vec3 {
        corners[0] * self.weights[0] + corners[1] * self.weights[1] + corners[2] * self.weights[2]
    }

    /// The point's share in a field: see [`SkinWeights::share_of`](crate::elastic::SkinWeights::share_of).
    pub fn share_of(&self, rig: &ElasticRig, shares: &[f32]) -> f32 {
        self.corners().map(|(v, w)| rig.weights[v].share_of(shares) * w).sum()
    }
}

/// Where a pass carries points of the skin: their corners are carried eight at a time.
pub(super) fn flow_all(body: &ElasticBody, pass: &CollisionPass, points: &[SkinPoint]) -> Vec<Vec3> {
    let (positions, weights, integrator) = (body.positions(), &body.rig().weights, body.settings.integrator);
    let corners: Vec<usize> = points.iter().flat_map(|point| point.corners().map(|(v, _)| v)).collect();
    let carry = |batch: &[usize]| {
        let at = |lane: usize| batch[lane.min(batch.len() - 1)];
        let x = std::array::from_fn(|lane| positions[at(lane)]);
        let skins = std::array::from_fn(|lane| &weights[at(lane)]);
        pass.flow_wide(x, skins, integrator)
    };
    let carried: Vec<[Vec3; LANES]> = corners.par_chunks(LANES).with_min_len(BATCHES).map(carry).collect();
    let mut carried = carried.into_iter().flatten();
    let mut next = |weight: f32| carried.next().unwrap_or_default() * weight;
    points.iter().map(|point| point.corners().map(|(_, weight)| next(weight)).sum()).collect()
}

/// Fewest batches that are worth another thread.
const BATCHES: usize = 8;
