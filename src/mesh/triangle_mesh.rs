//! The triangle mesh: render vertices (split at texture and normal seams) and the welded topology beneath them.

use super::{MeshError, NormalTopology, weld};
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

impl TriangleMesh {
    /// Builds a mesh from positions in metres and triangles (corner indices, counter-clockwise seen from outside):
    /// welds equal positions ([`weld`]) and computes smooth, area-weighted normals. There are no texture coordinates.
    ///
    /// The triangles are kept as they are, also those without area, so that their numbers stay the caller's.
    ///
    /// # Errors
    /// No vertices, no triangles, more of them than `u32` can name, a coordinate that is not finite (with its vertex), an
    /// index out of range (with its triangle).
    pub fn from_triangles(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check(&positions, &triangles)?;
        let welded = weld(&positions);
        let mut normals = Vec::new();
        NormalTopology::new(&triangles, &welded)?.normals_into(&positions, &mut Vec::new(), &mut normals)?;
        Ok(Self { positions, normals, texture: Vec::new(), triangles, welded })
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }
}

/// Refuses positions and triangles that cannot be a mesh.
fn check(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let limit = u32::MAX as usize;
    for (what, count) in [("vertices", positions.len()), ("triangles", triangles.len())] {
        if count > limit {
            return Err(MeshError::TooMany { what, count, limit });
        }
    }
    if positions.is_empty() {
        return Err(MeshError::NoVertices);
    }
    if triangles.is_empty() {
        return Err(MeshError::NoTriangles);
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshError::NotFinite { vertex, position: positions[vertex].to_array() });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&c| c as usize >= positions.len()) {
            return Err(MeshError::IndexOutOfRange { triangle, index, vertices: positions.len() });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_from_triangles_has_unit_normals_and_welds() {
        let p = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        let mesh = TriangleMesh::from_triangles(p, vec![[0, 1, 2], [3, 5, 4]]).unwrap();
        assert_eq!(mesh.welded, [0, 1, 2, 1, 2, 5]);
        assert!(mesh.normals.iter().all(|n| (*n - Vec3::Z).length() < 1e-6));
        assert_eq!(mesh.vertex_count(), 6);
    }

    #[test]
    fn bad_arrays_are_refused_with_the_vertex_or_triangle_at_fault() {
        let p = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let message = |p: Vec<Vec3>, t: Vec<[u32; 3]>| TriangleMesh::from_triangles(p, t).unwrap_err().to_string();
        assert!(message(vec![], vec![[0, 1, 2]]).contains("no vertices"));
        assert!(message(p.clone(), vec![]).contains("no triangles"));
        assert!(message(p.clone(), vec![[0, 1, 2], [0, 1, 9]]).contains("triangle 1 uses vertex 9"));
        assert!(message(vec![Vec3::ZERO, Vec3::NAN, Vec3::X], vec![[0, 1, 2]]).contains("vertex 1"));
        assert!(message(vec![Vec3::ZERO, Vec3::X, Vec3::INFINITY], vec![[0, 1, 2]]).contains("vertex 2"));
    }
}
