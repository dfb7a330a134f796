//! Obstacles: rapier's colliders as placed convex parts.
//!
//! A shape becomes a [`PartSource`], which names the cells of the shape near a region and expands a cell into convex
//! parts. A convex shape is one cell, a compound has one for each member; a heightfield has one for each flat piece, a
//! triangle mesh one for each flat face, a voxel grid one for each block of voxels. So a large shape costs only what
//! lies near a body. [`PartCache`] keeps what was expanded.

mod cache;
mod convex;
mod decompose;
mod decompose_file;
mod error;
mod flat_faces;
mod heightfield;
mod local_part;
mod outer_face;
mod part;
mod source;
mod surface;
mod voxels;

pub use cache::PartCache;
pub use decompose::decompose;
pub use decompose_file::decompose_cached;
pub use error::ObstacleError;
pub use local_part::LocalPart;
pub use outer_face::OuterFace;
pub use part::{ObstaclePart, PartId};
pub use source::{DEFAULT_THICKNESS, PartSource, convex_parts};
