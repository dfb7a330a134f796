//! What is pushed into bodies: obstacles of every kind, of random proportions, as rapier and as a scene file know them.

use std::path::PathBuf;
use std::sync::OnceLock;

use fastrand::Rng;
use pliant::math::{Pose, Vec3};
use rapier3d::geometry::SharedShape;
use rapier3d::parry::shape::HalfSpace;
use rapier3d::parry::utils::Array2;

use crate::icosphere::icosphere;
use crate::random::{between, in_cube};
use crate::scene_file::RawShape;

/// A kind of obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    HalfSpace,
    Box,
    Ball,
    Capsule,
    Cylinder,
    Cone,
    Plate,
    Hull,
    Rounded,
    Heightfield,
    TriangleMesh,
    Voxels,
}

/// A shape for rapier, and its words in a scene file.
#[derive(Clone)]
pub struct Shape {
    pub shared: SharedShape,
    pub raw: RawShape,
}

impl Shape {
    pub fn half_space() -> Self {
        let raw = RawShape { normal: Some([0.0, 1.0, 0.0]), ..RawShape::of_kind("half_space") };
        Self { shared: SharedShape::new(HalfSpace::new(Vec3::Y)), raw }
    }

    pub fn cuboid(half: Vec3) -> Self {
        let raw = RawShape { half_extents: Some(half.to_array()), ..RawShape::of_kind("cuboid") };
        Self { shared: SharedShape::cuboid(half.x, half.y, half.z), raw }
    }

    pub fn ball(radius: f32) -> Self {
        let raw = RawShape { radius: Some(radius), ..RawShape::of_kind("ball") };
        Self { shared: SharedShape::ball(radius), raw }
    }

    pub fn capsule(half_height: f32, radius: f32) -> Self {
        Self {
            shared: SharedShape::capsule_y(half_height, radius),
            raw: RawShape::along("capsule", half_height, radius),
        }
    }

    pub fn cylinder(half_height: f32, radius: f32) -> Self {
        Self {
            shared: SharedShape::cylinder(half_height, radius),
            raw: RawShape::along("cylinder", half_height, radius),
        }
    }

    pub fn cone(half_height: f32, radius: f32) -> Self {
        Self { shared: SharedShape::cone(half_height, radius), raw: RawShape::along("cone", half_height, radius) }
    }

    fn hull(points: &[Vec3]) -> Self {
        let raw = RawShape { points: Some(points.iter().map(Vec3::to_array).collect()), ..RawShape::of_kind("hull") };
        Self { shared: SharedShape::convex_hull(points).expect("random points span a volume"), raw }
    }

    fn rounded(half: Vec3, rounding: f32) -> Self {
        let mut shape = Self::cuboid(half);
        shape.shared = SharedShape::round_cuboid(half.x, half.y, half.z, rounding);
        shape.raw.rounding = Some(rounding);
        shape
    }

    /// Rolling ground, its heights up to `height` apart.
    fn heightfield(rng: &mut Rng, side: f32, height: f32) -> Self {
        const CELLS: usize = 8;
        let phases = [0; 4].map(|_| between(rng, 0.0, std::f32::consts::TAU));
        let at = |i: usize, j: usize| {
            let (u, v) = (i as f32 / CELLS as f32 * 6.0, j as f32 / CELLS as f32 * 6.0);
            0.25 * height * ((u + phases[0]).sin() + (v + phases[1]).sin() + (0.5 * (u + v) + phases[2]).sin())
        };
        let rows: Vec<Vec<f32>> = (0..=CELLS).map(|i| (0..=CELLS).map(|j| at(i, j)).collect()).collect();
        let mut heights = Array2::zeros(CELLS + 1, CELLS + 1);
        for (i, row) in rows.iter().enumerate() {
            for (j, height) in row.iter().enumerate() {
                heights[(i, j)] = *height;
            }
        }
        let raw = RawShape { heights: Some(rows), size: Some([side, side]), ..RawShape::of_kind("heightfield") };
        Self { shared: SharedShape::heightfield(heights, Vec3::new(side, 1.0, side)), raw }
    }

    /// The surface of a lump, about `radius` from its middle.
    fn triangle_mesh(rng: &mut Rng, radius: f32) -> Self {
        let lumps = lumps();
        let (file, points, triangles) = &lumps[rng.usize(..lumps.len())];
        let positions = points.iter().map(|x| *x * radius).collect();
        let shared = SharedShape::trimesh(positions, triangles.clone()).expect("triangles");
        let raw = RawShape {
            file: Some(file.clone()),
            scale: Some(radius),
            one_sided: Some(true),
            ..RawShape::of_kind("triangle_mesh")
        };
        Self { shared, raw }
    }

    /// A lump of cells that are joined by their faces.
    fn voxels(rng: &mut Rng, cell: f32) -> Self {
        let mut cells = vec![[0_i32; 3]];
        while cells.len() < 30 {
            let mut next = cells[rng.usize(..cells.len())];
            next[rng.usize(..3)] += if rng.bool() { 1 } else { -1 };
            if !cells.contains(&next) {
                cells.push(next);
            }
        }
        let grid: Vec<_> = cells.iter().map(|c| rapier3d::math::IVector::new(c[0], c[1], c[2])).collect();
        let raw = RawShape { voxel_size: Some(cell), cells: Some(cells), ..RawShape::of_kind("voxels") };
        Self { shared: SharedShape::voxels(Vec3::splat(cell), &grid), raw }
    }
}

/// A mesh of the tests: its file, points and triangles.
type Lump = (PathBuf, Vec<Vec3>, Vec<[u32; 3]>);

/// Spheres of 80 triangles with hills and hollows, written as files for the scenes.
fn lumps() -> &'static [Lump] {
    static LUMPS: OnceLock<Vec<Lump>> = OnceLock::new();
    LUMPS.get_or_init(|| {
        let lump = |number: u64| {
            let mut rng = Rng::with_seed(number);
            let (mut points, triangles) = icosphere(1);
            points.iter_mut().for_each(|x| *x *= between(&mut rng, 0.75, 1.1));
            let file = PathBuf::from(format!("{}/lump_{number}.obj", env!("CARGO_TARGET_TMPDIR")));
            let mut text = String::new();
            points.iter().for_each(|x| text += &format!("v {} {} {}\n", x.x, x.y, x.z));
            triangles.iter().for_each(|t| text += &format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1));
            std::fs::write(&file, text).expect("the tests' folder can be written");
            (file, points, triangles)
        };
        (0..8).map(lump).collect()
    })
}

impl Kind {
    pub const ALL: [Self; 12] = [
        Self::HalfSpace,
        Self::Box,
        Self::Ball,
        Self::Capsule,
        Self::Cylinder,
        Self::Cone,
        Self::Plate,
        Self::Hull,
        Self::Rounded,
        Self::Heightfield,
        Self::TriangleMesh,
        Self::Voxels,
    ];

    /// True where the y axis is the way out and no other.
    pub fn is_ground(self) -> bool {
        matches!(self, Self::HalfSpace | Self::Heightfield)
    }

    /// A shape of this kind for a body of the given size.
    pub fn shape(self, rng: &mut Rng, size: f32) -> Shape {
        let length = |rng: &mut Rng, low, high| size * between(rng, low, high);
        match self {
            Self::HalfSpace => Shape::half_space(),
            Self::Box => Shape::cuboid(Vec3::from([0; 3].map(|_| length(rng, 0.1, 1.5)))),
            Self::Ball => Shape::ball(length(rng, 0.1, 1.0)),
            Self::Capsule => Shape::capsule(length(rng, 0.5, 1.5), length(rng, 0.05, 0.2)),
            Self::Cylinder => Shape::cylinder(length(rng, 0.1, 1.5), length(rng, 0.05, 0.5)),
            Self::Cone => Shape::cone(length(rng, 0.2, 0.8), length(rng, 0.1, 0.6)),
            Self::Plate => {
                Shape::cuboid(Vec3::new(length(rng, 0.5, 1.5), length(rng, 0.01, 0.03), length(rng, 0.5, 1.5)))
            }
            Self::Hull => Shape::hull(&[0; 16].map(|_| in_cube(rng, 0.6 * size))),
            Self::Rounded => Shape::rounded(Vec3::from([0; 3].map(|_| length(rng, 0.05, 1.0))), length(rng, 0.02, 0.2)),
            Self::Heightfield => {
                let height = length(rng, 0.0, 0.6);
                Shape::heightfield(rng, 6.0 * size, height)
            }
            Self::TriangleMesh => {
                let radius = length(rng, 0.4, 1.2);
                Shape::triangle_mesh(rng, radius)
            }
            Self::Voxels => Shape::voxels(rng, 0.25 * size),
        }
    }
}

/// An obstacle in the world.
#[derive(Clone)]
pub struct Placed {
    pub shape: Shape,
    pub pose: Pose,
}
