//! A point of the skin: a vertex, or a point between the three vertices of a triangle.

use crate::elastic::{CollisionPass, ElasticBody, ElasticRig};
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

    /// The point's share in a field: see [`SkinWeights::share_of`](crate::elastic::SkinWeights::share_of).
    pub fn share_of(&self, rig: &ElasticRig, shares: &[f32]) -> f32 {
        self.corners().map(|(v, w)| rig.weights[v].share_of(shares) * w).sum()
    }

    /// Where a pass carries the point.
    pub fn flow(&self, body: &ElasticBody, pass: &CollisionPass) -> Vec3 {
        let integrator = body.settings.integrator;
        let moved = |(v, w): (usize, f32)| pass.flow(body.positions()[v], &body.rig().weights[v], integrator) * w;
        self.corners().map(moved).sum()
    }
}
