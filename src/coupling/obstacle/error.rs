//! Why a shape has no convex parts.

use rapier3d::parry::shape::ShapeType;

use crate::field::HullError;

/// A shape that has no convex parts.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObstacleError {
    /// A shape of the user's own, about which nothing is known.
    #[error("the convex parts of a {0:?} collider are not known: give it a stand-in")]
    Unknown(ShapeType),
    /// A mesh that VHACD finds no part of.
    #[error("no convex part came out of the mesh: it is empty, too flat, or its size is not between 1 mm and 100 km")]
    NoParts,
    /// A mesh or heightfield whose triangles have no area, or whose corners are not finite; voxels of which none is filled.
    #[error("a {0:?} collider has nothing to touch: no finite triangle with an area, no filled voxel")]
    NoArea(ShapeType),
    /// A hull without a volume.
    #[error(transparent)]
    Flat(#[from] HullError),
}
