//! A shape made ready to be taken apart, piece by piece, near a region.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::shape::{SharedShape, TypedShape};

use super::convex::{convex_part, wire};
use super::error::ObstacleError;
use super::heightfield::HeightFieldPieces;
use super::local_part::LocalPart;
use super::surface::SurfaceFaces;
use super::voxels;
use crate::math::Vec3;

/// How thick [`convex_parts`] makes surfaces, as a part of the longest side of the box around the shape.
///
/// In a [`crate::world::DeformationWorld`] the thickness is that of the body that meets the surface instead: see
/// [`crate::world::DeformationSettings::surface_thickness`].
pub const DEFAULT_THICKNESS: f32 = 0.25;

/// Surfaces without an inner side, and wires, are this part of the thickness of others thick: they are to be seen as
/// thin as they are. What goes in farther is led out by the side that its axis is on.
const SHEET: f32 = 1.0 / 512.0;

/// A shape made ready to be taken apart: see the module above.
///
/// Surfaces are given a thickness. A heightfield is solid below; a triangle mesh that is closed, or that rapier treats
/// as oriented, is solid behind its triangles, down to the middle between them and what is behind; a mesh that is
/// neither is a sheet with two outer sides, as it is for rapier.
pub enum PartSource {
    /// A convex shape.
    Convex(SharedShape),
    /// Convex members.
    Compound(SharedShape),
    /// Ground.
    HeightField(HeightFieldPieces),
    /// Triangles.
    Surface(SurfaceFaces),
    /// Filled cells of a grid.
    Voxels(SharedShape),
    /// Wires.
    Polyline(SharedShape),
}

impl PartSource {
    /// Makes a shape ready. For triangle meshes and heightfields this takes a time in proportion to their size.
    ///
    /// # Errors
    /// [`ObstacleError`] where the shape, or a member of a compound, is not known or has neither volume nor area.
    pub fn new(shape: &SharedShape) -> Result<Self, ObstacleError> {
        Ok(match shape.as_typed_shape() {
            TypedShape::Compound(compound) => {
                for (_, member) in compound.shapes() {
                    convex_part(member, 1.0)?;
                }
                Self::Compound(shape.clone())
            }
            TypedShape::HeightField(field) => Self::HeightField(HeightFieldPieces::new(field)?),
            TypedShape::TriMesh(mesh) => Self::Surface(SurfaceFaces::new(mesh, shape)?),
            TypedShape::Voxels(grid) if grid.voxels().next().is_none() => {
                return Err(ObstacleError::NoArea(shape.shape_type()));
            }
            TypedShape::Voxels(_) => Self::Voxels(shape.clone()),
            TypedShape::Polyline(_) => Self::Polyline(shape.clone()),
            _ => {
                convex_part(shape, 1.0)?;
                Self::Convex(shape.clone())
            }
        })
    }

    /// Appends the cells that a part of theirs may meet `region` of, in the shape's frame, for surfaces of this
    /// `thickness` in metres. Ascending, each once.
    pub fn cells_near(&self, region: &Aabb, thickness: f32, cells: &mut Vec<u64>) {
        match self {
            Self::Convex(_) => cells.push(0),
            Self::Compound(shape) => {
                if let Some(compound) = shape.as_compound() {
                    cells.extend(compound.bvh().intersect_aabb(&region.loosened(SHEET * thickness)).map(u64::from));
                }
            }
            Self::Polyline(shape) => {
                if let Some(line) = shape.as_polyline() {
                    cells.extend(line.bvh().intersect_aabb(&region.loosened(SHEET * thickness)).map(u64::from));
                }
            }
            Self::HeightField(pieces) => pieces.cells_near(region, thickness, cells),
            Self::Surface(faces) => faces.cells_near(region, thickness, cells),
            Self::Voxels(shape) => {
                if let Some(grid) = shape.as_voxels() {
                    voxels::cells_near(grid, region, cells);
                }
            }
        }
        cells.sort_unstable();
        cells.dedup();
    }

    /// The parts of a cell, each with a number that no other part of the shape has, ascending. Cells without volume
    /// have none.
    pub fn expand(&self, cell: u64, thickness: f32) -> Vec<(u32, LocalPart)> {
        let number = cell as u32;
        let one = |part: Option<LocalPart>| part.map(|part| (number, part)).into_iter().collect();
        match self {
            Self::Convex(shape) => one(convex_part(shape, SHEET * thickness).ok()),
            Self::Compound(shape) => {
                let member = shape.as_compound().and_then(|c| c.shapes().get(cell as usize));
                one(member.and_then(|(pose, member)| {
                    let part = convex_part(member, SHEET * thickness).ok()?;
                    Some(LocalPart { pose: *pose * part.pose, ..part })
                }))
            }
            Self::Polyline(shape) => {
                let line = shape.as_polyline().filter(|line| number < line.num_segments() as u32);
                one(line.map(|line| wire(&line.segment(number), 0.5 * SHEET * thickness)))
            }
            Self::HeightField(pieces) => pieces.expand(cell, thickness),
            Self::Surface(faces) => one(faces.expand(number, thickness, SHEET * thickness)),
            Self::Voxels(shape) => shape.as_voxels().map(|grid| voxels::expand(grid, cell)).unwrap_or_default(),
        }
    }
}

/// All convex parts of a shape. Surfaces are made [`DEFAULT_THICKNESS`] thick.
///
/// # Errors
/// [`ObstacleError`] where the shape, or a member of a compound, is not known or has neither volume nor area.
pub fn convex_parts(shape: &SharedShape) -> Result<Vec<LocalPart>, ObstacleError> {
    let source = PartSource::new(shape)?;
    let bounds = shape.compute_local_aabb();
    let thickness = DEFAULT_THICKNESS * bounds.extents().max_element();
    let mut cells = Vec::new();
    source.cells_near(&Aabb::new(Vec3::NEG_INFINITY, Vec3::INFINITY), thickness, &mut cells);
    Ok(cells.into_iter().flat_map(|cell| source.expand(cell, thickness)).map(|(_, part)| part).collect())
}
