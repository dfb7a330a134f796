//! The triangle mesh: render vertices (split at texture and normal seams) and the welded topology beneath them.

use crate::math::{Vec2, Vec3};

/// A triangle mesh at rest.
///
/// Vertices are *render vertices*: where a texture or normal seam runs, one position is shared by several of them.
/// [`TriangleMesh::welded`] maps each to its point of the topology, so that the surface is closed across seams.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    /// Position of each vertex, in metres.
    pub positions: Vec<Vec3>,
    /// Unit normal of each vertex; same length as `positions`.
    pub normals: Vec<Vec3>,
    /// Texture coordinates of each vertex; same length as `positions`, or empty.
    pub texture: Vec<Vec2>,
    /// Corner indices of each triangle into `positions`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each vertex the lowest vertex index that has the same position (itself where there is no seam).
    pub welded: Vec<u32>,
}
