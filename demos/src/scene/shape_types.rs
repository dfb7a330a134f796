//! The shapes that obstacles have, all checked.

use pliant::math::{Pose, Vec3};
use std::path::PathBuf;

/// The shape of an obstacle. All lengths are in metres and positive; axes of round shapes are along y.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleShape {
    /// A ball.
    Ball {
        /// Radius.
        radius: f32,
    },
    /// A box.
    Cuboid {
        /// Half of each side.
        half_extents: Vec3,
        /// Radius of a round border around it, 0 for none.
        rounding: f32,
    },
    /// A capsule.
    Capsule {
        /// Half of the length without the caps.
        half_height: f32,
        /// Radius.
        radius: f32,
    },
    /// A cylinder.
    Cylinder {
        /// Half of the height.
        half_height: f32,
        /// Radius.
        radius: f32,
        /// Radius of a round border around it, 0 for none.
        rounding: f32,
    },
    /// A cone, its tip up.
    Cone {
        /// Half of the height.
        half_height: f32,
        /// Radius at the foot.
        radius: f32,
        /// Radius of a round border around it, 0 for none.
        rounding: f32,
    },
    /// A ring around the y axis, bent of a round bar.
    Ring {
        /// Radius of the opening.
        radius: f32,
        /// Radius of the bar.
        thickness: f32,
    },
    /// Everything below a plane through the origin.
    HalfSpace {
        /// Unit normal, out of the solid.
        normal: Vec3,
    },
    /// A triangle, solid on neither side; with rounding a smooth plate.
    Triangle {
        /// Its corners.
        corners: [Vec3; 3],
        /// Radius of a round border around it, 0 for none.
        rounding: f32,
    },
    /// Thin straight wires from point to point.
    Polyline {
        /// At least two points.
        points: Vec<Vec3>,
    },
    /// The convex hull of points.
    Hull {
        /// The points, or where they are.
        points: Points,
        /// Radius of a round border around it, 0 for none.
        rounding: f32,
    },
    /// A mesh that is cut into convex parts.
    Mesh {
        /// The OBJ file, which exists.
        file: PathBuf,
        /// Scale.
        scale: f32,
        /// At most this many convex parts, at least 1.
        max_parts: Option<u32>,
    },
    /// A mesh as it is: solid where it is closed, a sheet where it is not.
    TriangleMesh {
        /// The OBJ file, which exists.
        file: PathBuf,
        /// Scale.
        scale: f32,
        /// Solid behind its triangles although it is not closed.
        one_sided: bool,
    },
    /// Ground over a rectangle about the origin.
    HeightField {
        /// Rows along z, each with heights along x: at least two of at least two.
        heights: Vec<Vec<f32>>,
        /// Extents along x and z.
        size: [f32; 2],
    },
    /// Filled cells of a grid.
    Voxels {
        /// Side of a voxel.
        voxel_size: f32,
        /// Which voxels.
        source: VoxelSource,
    },
    /// Several convex shapes in one.
    Compound {
        /// At least one.
        members: Vec<Member>,
    },
}

/// Points of a hull.
#[derive(Clone, Debug, PartialEq)]
pub enum Points {
    /// At least four.
    List(Vec<Vec3>),
    /// The vertices of an OBJ file.
    File {
        /// The file, which exists.
        file: PathBuf,
        /// Scale.
        scale: f32,
    },
}

/// Which voxels are filled.
#[derive(Clone, Debug, PartialEq)]
pub enum VoxelSource {
    /// These, by their places in the grid; voxel `[0, 0, 0]` begins at the origin.
    Cells(Vec<[i32; 3]>),
    /// Those inside of a closed mesh.
    Filled {
        /// The OBJ file, which exists.
        file: PathBuf,
        /// Scale.
        scale: f32,
    },
}

/// A member of a compound.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Compound from member.
    pub pose: Pose,
    /// A convex shape.
    pub shape: ObstacleShape,
}

impl ObstacleShape {
    /// False for surfaces, wires and half-spaces, which have no mass.
    pub fn has_volume(&self) -> bool {
        !matches!(
            self,
            Self::HalfSpace { .. }
                | Self::Triangle { .. }
                | Self::Polyline { .. }
                | Self::TriangleMesh { .. }
                | Self::HeightField { .. }
        )
    }
}
