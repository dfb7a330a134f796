//! Convex parts of the collision geometry: canonical shapes, rounded, placed in the world.

use std::sync::Arc;

use super::convex_hull::ConvexHull;
use crate::math::{Mat3, Pose, Vec3};

/// A convex shape in its own frame. The axis of a cylinder and a cone is y, as in parry.
#[derive(Clone, Debug, PartialEq)]
pub enum PartShape {
    /// A single point; with rounding a ball.
    Point,
    /// A segment; with rounding a capsule.
    Segment {
        /// First end.
        a: Vec3,
        /// Second end.
        b: Vec3,
    },
    /// A box about the origin.
    Cuboid {
        /// Half extents in metres.
        half_extents: Vec3,
    },
    /// A cylinder about the y axis.
    Cylinder {
        /// Half of the height in metres.
        half_height: f32,
        /// Radius in metres.
        radius: f32,
    },
    /// A cone about the y axis, its apex up.
    Cone {
        /// Half of the height in metres.
        half_height: f32,
        /// Radius of the base in metres.
        radius: f32,
    },
    /// Everything on the inner side of a plane through the origin.
    HalfSpace {
        /// Unit normal, out of the solid side.
        normal: Vec3,
    },
    /// A convex polyhedron.
    Hull(Arc<ConvexHull>),
}

/// A convex shape with an optional rounding radius (0 for sharp edges).
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPart {
    /// The shape before rounding.
    pub shape: PartShape,
    /// Rounding radius in metres, not negative.
    pub rounding: f32,
}

/// A convex part in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPart {
    part: ConvexPart,
    pose: Pose,
    /// Rotation of `pose`, kept as a matrix: the distance is asked for many times a frame.
    rotation: Mat3,
}

impl PlacedPart {
    /// Places a part.
    pub fn new(part: ConvexPart, pose: Pose) -> Self {
        Self { part, pose, rotation: Mat3::from_quat(pose.rotation) }
    }

    /// The part in its own frame.
    pub fn part(&self) -> &ConvexPart {
        &self.part
    }

    /// World from part.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Rotation of the pose as a matrix.
    pub fn rotation(&self) -> &Mat3 {
        &self.rotation
    }

    /// Euclidean distance of the world point `x` from the part (0 inside) and its gradient, the unit vector away from
    /// the part (zero inside).
    #[inline]
    pub fn distance(&self, x: Vec3) -> (f32, Vec3) {
        let local = self.rotation.transpose() * (x - self.pose.translation);
        let (distance, direction) = self.part.distance(local);
        (distance, self.rotation * direction)
    }
}
