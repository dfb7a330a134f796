//! Elastic bodies against each other and against themselves.
//!
//! Two segments that overlap are parted by a plane across the line between their axes: each skin is pushed to its side of
//! it by the same collision fields that push skins out of obstacles, and yields in proportion to its softness. The plane
//! reaches only as far as the overlap; what is beside it stays as it is. Convex skins that are pressed together are flat
//! where they touch, as the two halves of a squeezed ball are.
//!
//! - `segments`: which segments come close, by a bounding volume tree;
//! - [`HeightMap`]: where a skin ends in a given direction;
//! - [`Overlap`]: how far two skins are in each other;
//! - [`Interface`]: the plane between them, and the convex parts that push the skins to it.

mod height_map;
mod interface;
mod overlap;
mod segments;

pub use height_map::HeightMap;
pub use interface::{Interface, Widening, interface_part};
pub use overlap::{Overlap, OverlapPoint, SkinSide};
pub use segments::{SegmentPair, SegmentRef, pairs_of, segment_bounds, self_pairs};
