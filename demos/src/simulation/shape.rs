//! From the shape of an obstacle in a scene to that of a collider.

use std::path::{Path, PathBuf};

use pliant::coupling::decompose_cached;
use pliant::field::ConvexHull;
use pliant::math::Vec3;
use pliant::mesh::{TriangleMesh, load_obj};
use rapier3d::geometry::{Array2, SharedShape};
use rapier3d::math::IVector;
use rapier3d::parry::shape::TriMeshFlags;
use rapier3d::parry::transformation::voxelization::FillMode;

use super::build::BuildError;
use super::ring::ring;
use crate::scene::{ObstacleShape, Points, VoxelSource};

/// Convex parts of a mesh obstacle that says nothing about their number.
const DEFAULT_PARTS: u32 = 16;

/// Most voxels along the longest side of a filled mesh.
const MOST_VOXELS: f32 = 512.0;

/// The collider's shape of an obstacle called `name`, and the mesh it was made from, if it was.
pub(super) fn shape_of(name: &str, shape: &ObstacleShape) -> Result<(SharedShape, Option<TriangleMesh>), BuildError> {
    let wrong = |message: &str| BuildError::Shape { name: name.into(), message: message.into() };
    let shape = match shape {
        ObstacleShape::Ball { radius } => SharedShape::ball(*radius),
        ObstacleShape::Cuboid { half_extents: h, rounding } if *rounding > 0.0 => {
            SharedShape::round_cuboid(h.x, h.y, h.z, *rounding)
        }
        ObstacleShape::Cuboid { half_extents: h, .. } => SharedShape::cuboid(h.x, h.y, h.z),
        ObstacleShape::Capsule { half_height, radius } => SharedShape::capsule_y(*half_height, *radius),
        ObstacleShape::Cylinder { half_height, radius, rounding } if *rounding > 0.0 => {
            SharedShape::round_cylinder(*half_height, *radius, *rounding)
        }
        ObstacleShape::Cylinder { half_height, radius, .. } => SharedShape::cylinder(*half_height, *radius),
        ObstacleShape::Cone { half_height, radius, rounding } if *rounding > 0.0 => {
            SharedShape::round_cone(*half_height, *radius, *rounding)
        }
        ObstacleShape::Cone { half_height, radius, .. } => SharedShape::cone(*half_height, *radius),
        ObstacleShape::Ring { radius, thickness } => ring(*radius, *thickness),
        ObstacleShape::HalfSpace { normal } => SharedShape::halfspace(*normal),
        ObstacleShape::Triangle { corners: [a, b, c], rounding } if *rounding > 0.0 => {
            SharedShape::round_triangle(*a, *b, *c, *rounding)
        }
        ObstacleShape::Triangle { corners: [a, b, c], .. } => SharedShape::triangle(*a, *b, *c),
        ObstacleShape::Polyline { points } => SharedShape::polyline(points.clone(), None),
        ObstacleShape::Hull { points, rounding } => {
            let points = match points {
                Points::List(points) => points.clone(),
                Points::File { file, scale } => scaled_mesh(file, *scale)?.positions,
            };
            // Rapier's own hull does not take points of one plane well.
            let hull = ConvexHull::from_points(&points).map_err(|error| wrong(&error.to_string()))?;
            let corners = hull.triangles().as_flattened();
            let hull = match *rounding > 0.0 {
                true => SharedShape::round_convex_hull(corners, *rounding),
                false => SharedShape::convex_hull(corners),
            };
            hull.ok_or_else(|| wrong("the points have no convex hull"))?
        }
        ObstacleShape::Mesh { file, scale, max_parts } => {
            let mesh = scaled_mesh(file, *scale)?;
            let shape = decompose_cached(&mesh, max_parts.unwrap_or(DEFAULT_PARTS), parts_file(file));
            let shape = shape.map_err(|error| BuildError::Parts { name: file.display().to_string(), error })?;
            return Ok((shape, Some(mesh)));
        }
        ObstacleShape::TriangleMesh { file, scale, one_sided } => {
            let mesh = scaled_mesh(file, *scale)?;
            let flags = match one_sided {
                true => TriMeshFlags::ORIENTED | TriMeshFlags::FIX_INTERNAL_EDGES,
                false => TriMeshFlags::FIX_INTERNAL_EDGES_TWO_SIDED,
            };
            let shape = SharedShape::trimesh_with_flags(mesh.positions.clone(), mesh.triangles.clone(), flags);
            return Ok((shape.map_err(|error| wrong(&error.to_string()))?, Some(mesh)));
        }
        ObstacleShape::HeightField { heights, size } => {
            let columns = heights.first().map_or(0, Vec::len);
            let by_column = (0..columns).flat_map(|column| heights.iter().map(move |row| row[column])).collect();
            let shape = SharedShape::heightfield(
                Array2::new(heights.len(), columns, by_column),
                Vec3::new(size[0], 1.0, size[1]),
            );
            let surface = shape.as_heightfield().map(|field| field.to_trimesh());
            let mesh = surface.and_then(|(p, t)| TriangleMesh::from_triangles(p, t).ok());
            return Ok((shape, mesh));
        }
        ObstacleShape::Voxels { voxel_size, source } => match source {
            VoxelSource::Cells(cells) => {
                let cells: Vec<IVector> = cells.iter().copied().map(IVector::from).collect();
                SharedShape::voxels(Vec3::splat(*voxel_size), &cells)
            }
            VoxelSource::Filled { file, scale } => {
                let mesh = scaled_mesh(file, *scale)?;
                let longest = pliant::mesh::measure::bounding_box(&mesh.positions).extents().max_element();
                if longest > MOST_VOXELS * voxel_size {
                    return Err(wrong(&format!("a voxel of {voxel_size} m is too small for {longest} m")));
                }
                let fill = FillMode::FloodFill { detect_cavities: false };
                SharedShape::voxelized_mesh(&mesh.positions, &mesh.triangles, *voxel_size, fill)
            }
        },
        ObstacleShape::Compound { members } => {
            let member = |member: &crate::scene::Member| Ok((member.pose, shape_of(name, &member.shape)?.0));
            SharedShape::compound(members.iter().map(member).collect::<Result<_, BuildError>>()?)
        }
    };
    Ok((shape, None))
}

/// Where the convex parts of a mesh are kept: beside it.
fn parts_file(mesh: &Path) -> PathBuf {
    let mut name = mesh.file_name().unwrap_or_default().to_os_string();
    name.push(".parts");
    mesh.with_file_name(name)
}

fn scaled_mesh(file: &Path, scale: f32) -> Result<TriangleMesh, BuildError> {
    let mut mesh = load_obj(file).map_err(BuildError::Mesh)?;
    mesh.positions.iter_mut().for_each(|p| *p *= scale);
    Ok(mesh)
}
