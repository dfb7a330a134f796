//! Triangle meshes: what a skin is at rest.

mod triangle_mesh;
pub use triangle_mesh::TriangleMesh;
