//! A tetrahedral mesh that fills a closed surface and follows it.

use super::fill_cells::Filling;
use super::fill_lattice::stuff;
use super::fill_refinement::{SPACING, hausdorff, refine};
use super::fill_smoothing::{catch_features, smooth};
use super::fill_target::Target;
use super::{Orientation, TetrahedralError, TetrahedralMesh, Topology, TriangleMesh, measure};

/// More cells than this are refused: the size of a cell must be a mistake.
const MOST_CELLS: f64 = 5e6;
/// The boundary of the cells is at most this part of the surface's size away from it, and the other way round.
const FOLLOWS: f32 = 0.02;
/// Refined until it is as near as this part of what is asked for: between the points that are looked at it may be farther.
const MARGIN: f32 = 0.7;
/// Sizes of cells that are tried one after the other, beside the one asked for, until the boundary follows the surface.
const TRIED: [f32; 3] = [1.0, 0.9, 0.8];
/// Vertices of the boundary go onto sharp features within so many cell sizes.
const SHARP_REACH: f32 = 0.45;

/// How well a tetrahedral mesh fills a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FillReport {
    /// The size of the cells that were taken, in metres.
    pub cell_size: f32,
    /// The Hausdorff distance between the surface and the mesh's boundary in metres: the largest distance of a point of one
    /// from the other, both ways, taken at corners, along sharp edges and all over the triangles, a sixteenth of a cell apart.
    pub hausdorff: f32,
    /// The same beside the size of the surface ([`TriangleMesh::size`]).
    pub relative: f32,
    /// The smallest and the largest dihedral angle of the cells, in degrees.
    pub dihedral_angles: [f64; 2],
    /// Volume of the cells beside the volume that the surface encloses.
    pub volume_ratio: f64,
}

impl FillReport {
    /// Whether surface and boundary are within 2 % of the size of each other.
    pub fn follows(&self) -> bool {
        self.relative <= FOLLOWS
    }
}

/// Fills a closed surface, facing outward, with tetrahedra of about this size in metres; the boundary of the cells follows the
/// surface with its sharp edges and corners, and no cell is inside out.
///
/// Where cells of this size are farther than 2 % of the surface's size from it, they are split there, and if that is not enough,
/// cells smaller by a tenth and by a fifth are tried. What is thinner than a cell is lost all the same: then
/// [`FillReport::follows`] is false, and the report has the distance. Choose smaller cells.
///
/// # Errors
/// The surface is open or not facing outward, the size of the cells is not positive or makes more than five million of them,
/// nothing is left of the surface at this size.
pub fn fill_surface(surface: &TriangleMesh, cell_size: f32) -> Result<(TetrahedralMesh, FillReport), TetrahedralError> {
    fill_with_one_of(surface, &TRIED.map(|part| part * cell_size))
}

/// Sizes of cells that [`fill_closely`] tries, as parts of the size of the surface.
const SIZES: [f32; 7] = [0.06, 0.048, 0.038, 0.03, 0.024, 0.019, 0.015];

/// Fills a closed surface like [`fill_surface`], with cells of 6 % of its size ([`TriangleMesh::size`]), or where their boundary is
/// farther than 2 % from it with smaller ones, by a fifth each time, down to 1.5 %. Where none of them follow, the nearest are taken.
///
/// # Errors
/// Those of [`fill_surface`].
pub fn fill_closely(surface: &TriangleMesh) -> Result<(TetrahedralMesh, FillReport), TetrahedralError> {
    fill_with_one_of(surface, &SIZES.map(|part| part * surface.size()))
}

/// Fills a surface with cells of the first size, in metres, of which the boundary follows it, or else of that which is nearest. The
/// sizes get smaller.
fn fill_with_one_of(surface: &TriangleMesh, sizes: &[f32]) -> Result<(TetrahedralMesh, FillReport), TetrahedralError> {
    let topology = Topology::of(surface);
    if !topology.is_closed() {
        return Err(TetrahedralError::Surface("it is not closed"));
    }
    if topology.orientation != Orientation::Outward {
        return Err(TetrahedralError::Surface("its triangles do not face outward"));
    }
    let bounds = measure::bounding_box(&surface.positions);
    let extent = (bounds.maxs - bounds.mins).to_array();
    let mut target = None;
    let mut best = Err(TetrahedralError::Surface("it has no size"));
    for &size in sizes {
        // Twelve cells a cube.
        let cells = 12.0 * extent.map(|e| f64::from(e) / f64::from(size) + 3.0).iter().product::<f64>();
        if !(size > 0.0 && cells < MOST_CELLS) {
            return best.or(Err(TetrahedralError::CellSize { cell_size: size, cells }));
        }
        let target = match &mut target {
            Some(target) => target,
            None => target.insert(Target::of(surface)?),
        };
        let known = best.as_ref().map_or(f32::INFINITY, |(_, report): &(_, FillReport)| report.hausdorff);
        match fill(surface, target, size) {
            Ok((mesh, report)) if report.hausdorff < known => {
                let follows = report.follows();
                best = Ok((mesh, report));
                if follows {
                    break;
                }
            }
            Err(error) if best.is_err() => best = Err(error),
            _ => {}
        }
    }
    best
}

/// One filling with cells of one size.
fn fill(
    surface: &TriangleMesh,
    target: &Target,
    cell_size: f32,
) -> Result<(TetrahedralMesh, FillReport), TetrahedralError> {
    let bounds = measure::bounding_box(&surface.positions);
    let (positions, cells) = stuff(|p| target.signed_distance(p), [bounds.mins, bounds.maxs], cell_size);
    if cells.is_empty() {
        return Err(TetrahedralError::CellSize { cell_size, cells: 0.0 });
    }
    let mut filling = Filling::new(positions, cells);
    let boundary = filling.boundary();
    // First the cells get better, then features are caught, then the rest follows.
    for passes in [2, 4, 4, 2] {
        smooth(&mut filling, &boundary, target, passes);
        catch_features(&mut filling, &boundary, target, SHARP_REACH * cell_size);
    }
    let size = surface.size();
    refine(&mut filling, target, cell_size, MARGIN * FOLLOWS * size);
    filling.drop_flat();
    let hausdorff = hausdorff(&filling, &filling.boundary(), target, SPACING * cell_size * 0.25);
    let mesh = TetrahedralMesh::new(filling.positions, filling.cells)?;
    let report = FillReport {
        cell_size,
        hausdorff,
        relative: hausdorff / size,
        dihedral_angles: mesh.dihedral_angles(),
        volume_ratio: mesh.volume() / surface.volume(),
    };
    Ok((mesh, report))
}

#[cfg(test)]
#[path = "tetrahedral_fill_tests.rs"]
mod tests;
