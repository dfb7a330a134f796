//! A tetrahedral mesh that fills a closed surface and follows it.

use parry3d::query::PointQuery;
use parry3d::query::PointQueryWithLocation;
use parry3d::shape::{TriMesh, TriMeshFlags};

use super::fill_lattice::stuff;
use super::fill_smoothing::smooth;
use super::{Orientation, TetrahedralError, TetrahedralMesh, Topology, TriangleMesh, measure};
use crate::math::Vec3;

/// More cells than this are refused: the size of a cell must be a mistake.
const MOST_CELLS: f64 = 5e6;
/// Two triangles meet sharply where their normals differ by more than this, in degrees.
const SHARP_DEGREES: f32 = 40.0;
/// Vertices of the boundary go onto sharp features within so many cell sizes.
const SHARP_REACH: f32 = 0.45;

/// How well a tetrahedral mesh fills a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FillReport {
    /// The Hausdorff distance between the surface and the mesh's boundary in metres: the largest distance of a point of one
    /// from the other, taken at vertices, middles of edges and centres of triangles.
    pub hausdorff: f32,
    /// The smallest and the largest dihedral angle of the cells, in degrees.
    pub dihedral_angles: [f64; 2],
    /// Volume of the cells beside the volume that the surface encloses.
    pub volume_ratio: f64,
}

/// Fills a closed surface, facing outward, with tetrahedra of about this size in metres; the boundary of the cells follows the
/// surface, catches its sharp edges where the cells allow it, and no cell is inside out.
///
/// What is thinner than a cell is lost, and sharp edges and corners that the cells do not allow to be caught are cut off by up to
/// a cell: the report tells so by its Hausdorff distance. Choose smaller cells then.
///
/// # Errors
/// The surface is open or not facing outward, the size of the cells is not positive or makes more than five million of them,
/// nothing is left of the surface at this size.
pub fn fill_surface(surface: &TriangleMesh, cell_size: f32) -> Result<(TetrahedralMesh, FillReport), TetrahedralError> {
    let topology = Topology::of(surface);
    if !topology.is_closed() {
        return Err(TetrahedralError::Surface("it is not closed"));
    }
    if topology.orientation != Orientation::Outward {
        return Err(TetrahedralError::Surface("its triangles do not face outward"));
    }
    let bounds = measure::bounding_box(&surface.positions);
    let extent = bounds.maxs - bounds.mins;
    // Twelve cells a cube.
    let cells = 12.0 * extent.to_array().map(|e| f64::from(e) / f64::from(cell_size) + 3.0).iter().product::<f64>();
    if !(cell_size > 0.0 && cells < MOST_CELLS) {
        return Err(TetrahedralError::CellSize { cell_size, cells });
    }
    let shape = tri_mesh(surface)?;
    let signed_distance = |p: Vec3| {
        let (projection, _) = shape.project_local_point_and_get_location(p, false);
        let distance = p.distance(projection.point);
        if projection.is_inside { distance } else { -distance }
    };
    let (mut positions, cells) = stuff(signed_distance, [bounds.mins, bounds.maxs], cell_size);
    if cells.is_empty() {
        return Err(TetrahedralError::CellSize { cell_size, cells: 0.0 });
    }
    let boundary = TetrahedralMesh { positions: positions.clone(), cells: cells.clone() }.boundary();
    let features = Features::of(surface);
    smooth(
        &mut positions,
        &cells,
        &boundary,
        |p| shape.project_local_point(p, false).point,
        |p| features.nearest(p, SHARP_REACH * cell_size),
    );
    let mesh = TetrahedralMesh::new(positions, cells)?;
    let report = FillReport {
        hausdorff: hausdorff(surface, &shape, &mesh, &boundary),
        dihedral_angles: mesh.dihedral_angles(),
        volume_ratio: mesh.volume() / surface.volume(),
    };
    Ok((mesh, report))
}

/// The surface as parry's shape, its seams welded.
fn tri_mesh(surface: &TriangleMesh) -> Result<TriMesh, TetrahedralError> {
    let welded = |t: &[u32; 3]| t.map(|v| surface.welded[v as usize]);
    let triangles = surface.triangles.iter().map(welded).filter(|[a, b, c]| a != b && b != c && c != a).collect();
    TriMesh::with_flags(surface.positions.clone(), triangles, TriMeshFlags::ORIENTED)
        .map_err(|_| TetrahedralError::Surface("it has no triangles"))
}

/// Sharp edges of a surface, and the corners where they meet.
struct Features {
    edges: Vec<[Vec3; 2]>,
    corners: Vec<Vec3>,
}

impl Features {
    fn of(surface: &TriangleMesh) -> Self {
        let mut sides: Vec<([u32; 2], Vec3)> = Vec::new();
        for t in &surface.triangles {
            let t = t.map(|v| surface.welded[v as usize]);
            let [a, b, c] = t.map(|v| surface.positions[v as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            sides.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[u, v]| ([u.min(v), u.max(v)], normal)));
        }
        sides.sort_by_key(|s| s.0);
        let limit = SHARP_DEGREES.to_radians().cos();
        let mut at_vertex: Vec<Vec<Vec3>> = vec![Vec::new(); surface.positions.len()];
        let mut edges = Vec::new();
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            if same.len() == 2 && same[0].1.dot(same[1].1) < limit {
                let ends = same[0].0.map(|v| surface.positions[v as usize]);
                let along = (ends[1] - ends[0]).normalize_or_zero();
                at_vertex[same[0].0[0] as usize].push(along);
                at_vertex[same[0].0[1] as usize].push(-along);
                edges.push(ends);
            }
        }
        // Where one sharp edge goes straight on there is no corner.
        let is_corner = |d: &Vec<Vec3>| match d[..] {
            [] => false,
            [a, b] => a.dot(b) > -limit,
            _ => true,
        };
        let corners = at_vertex.iter().zip(&surface.positions).filter(|(d, _)| is_corner(d)).map(|(_, p)| *p).collect();
        Self { edges, corners }
    }

    /// The nearest corner within reach; otherwise the nearest point of a sharp edge.
    fn nearest(&self, p: Vec3, reach: f32) -> Option<Vec3> {
        let nearer = |a: &Vec3, b: &Vec3| a.distance_squared(p).total_cmp(&b.distance_squared(p));
        let corner = self.corners.iter().copied().min_by(nearer).filter(|c| c.distance(p) < reach);
        corner.or_else(|| {
            let on_edge = self.edges.iter().map(|&[a, b]| {
                let along = b - a;
                a + along * ((p - a).dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
            });
            on_edge.min_by(nearer).filter(|e| e.distance(p) < reach)
        })
    }
}

/// See [`FillReport::hausdorff`].
fn hausdorff(surface: &TriangleMesh, shape: &TriMesh, mesh: &TetrahedralMesh, boundary: &[[u32; 3]]) -> f32 {
    let farthest = |positions: &[Vec3], triangles: &[[u32; 3]], other: &TriMesh| {
        let samples = triangles.iter().flat_map(|t| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            [a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0]
        });
        samples.map(|p| p.distance(other.project_local_point(p, false).point)).fold(0.0, f32::max)
    };
    let there = farthest(&mesh.positions, boundary, shape);
    match TriMesh::new(mesh.positions.clone(), boundary.to_vec()) {
        Ok(own) => there.max(farthest(&surface.positions, &surface.triangles, &own)),
        Err(_) => f32::INFINITY,
    }
}

#[cfg(test)]
#[path = "tetrahedral_fill_tests.rs"]
mod tests;
