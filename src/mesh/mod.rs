//! Triangle meshes, what a skin is at rest, and tetrahedral meshes, what a body is: how they are read, written, measured and
//! judged.

mod atomic_file;
mod error;
mod fill_cells;
mod fill_cracks;
mod fill_lattice;
mod fill_refinement;
mod fill_smoothing;
mod fill_target;
mod fill_undo;
pub mod measure;
mod normals;
mod obj_read;
mod obj_scan;
mod obj_write;
mod polygon;
mod tetrahedral_error;
mod tetrahedral_file;
mod tetrahedral_fill;
mod tetrahedral_formats;
mod tetrahedral_gmsh;
mod tetrahedral_mesh;
mod tetrahedral_scan;
mod topology;
mod triangle_mesh;
mod welding;

pub use atomic_file::AtomicFile;
pub use error::{MeshError, ObjFault};
pub use normals::{NormalTopology, vertex_normals};
pub use obj_read::{MAX_OBJ_BYTES, ObjReport, load_obj, load_obj_with_report};
pub use obj_write::write_obj;
pub use tetrahedral_error::{TetrahedralError, TetrahedralFault};
pub use tetrahedral_file::{TetrahedralFormat, load_tetrahedral, write_tetrahedral};
pub use tetrahedral_fill::{FillReport, fill_closely, fill_surface};
pub use tetrahedral_mesh::{CELL_EDGES, CELL_FACES, FLAT_CELL, TetrahedralMesh, VertexLists};
pub use tetrahedral_scan::MAX_TETRAHEDRAL_BYTES;
pub use topology::{Edge, Orientation, Topology};
pub use triangle_mesh::TriangleMesh;
pub use welding::{WELD_TOLERANCE, weld};
