//! The tetrahedral mesh: a volume cut into cells, what its boundary is and who is whose neighbour.

use super::{TetrahedralError, measure};
use crate::math::Vec3;
use glam::DVec3;

/// A cell counts as flat when its volume is below this times the cube of its longest edge.
///
/// The regular tetrahedron has 0.118; with 32-bit coordinates no volume below 1e-7 times the cube means anything.
pub const FLAT_CELL: f64 = 1e-7;

/// The faces of a cell by the corners opposite to 0, 1, 2 and 3, counter-clockwise seen from outside.
pub const CELL_FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The edges of a cell.
pub const CELL_EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// A volume cut into tetrahedra, at rest.
///
/// What [`TetrahedralMesh::new`] has checked is: all coordinates are finite, all indices in range, every cell has a positive
/// volume, every vertex belongs to a cell, no face belongs to more than two cells.
#[derive(Clone, Debug, PartialEq)]
pub struct TetrahedralMesh {
    /// Position of each vertex, in metres.
    pub positions: Vec<Vec3>,
    /// The four vertices of each cell; seen from the last one, the first three turn clockwise, so that
    /// `(b - a) . ((c - a) x (d - a))` is positive.
    pub cells: Vec<[u32; 4]>,
}

/// For each vertex a list of vertices, one after the other in one array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexLists {
    /// Where the list of each vertex starts; one more entry than there are vertices.
    pub starts: Vec<u32>,
    /// The lists, each in ascending order.
    pub items: Vec<u32>,
}

impl VertexLists {
    /// The list of a vertex; empty where there is no such vertex.
    pub fn of(&self, vertex: usize) -> &[u32] {
        match (self.starts.get(vertex), self.starts.get(vertex + 1)) {
            (Some(&from), Some(&to)) => self.items.get(from as usize..to as usize).unwrap_or(&[]),
            _ => &[],
        }
    }

    /// Number of vertices that have a list.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True when no vertex has a list.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl TetrahedralMesh {
    /// Builds a mesh from positions in metres and cells (see [`TetrahedralMesh::cells`] for their orientation).
    ///
    /// # Errors
    /// No vertices, no cells, more than `u32` can name, a coordinate that is not finite, an index out of range, a cell
    /// that is flat ([`FLAT_CELL`]) or inside out, a vertex without cell, a face with more than two cells; each with the
    /// vertex or cell.
    pub fn new(positions: Vec<Vec3>, cells: Vec<[u32; 4]>) -> Result<Self, TetrahedralError> {
        check(&positions, &cells)?;
        let mesh = Self { positions, cells };
        if let Some((face, cell)) = Faces::of(&mesh.cells).crowded {
            return Err(TetrahedralError::CrowdedFace { cell, face });
        }
        Ok(mesh)
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// The triangles that belong to one cell only, counter-clockwise seen from outside, in the order of their cells.
    pub fn boundary(&self) -> Vec<[u32; 3]> {
        Faces::of(&self.cells).boundary
    }

    /// The vertices of the boundary, in ascending order.
    pub fn surface_vertices(&self) -> Vec<u32> {
        let mut vertices: Vec<u32> = self.boundary().into_iter().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// For each vertex those that share a cell with it, without itself: its 1-ring.
    pub fn neighbours(&self) -> VertexLists {
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(12 * self.cells.len());
        for cell in &self.cells {
            for [a, b] in CELL_EDGES {
                pairs.push((cell[a], cell[b]));
                pairs.push((cell[b], cell[a]));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0u32; self.positions.len() + 1];
        for &(from, _) in &pairs {
            starts[from as usize + 1] += 1;
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        VertexLists { starts, items: pairs.into_iter().map(|(_, to)| to).collect() }
    }

    /// Signed volume of each cell in cubic metres at other positions of the same vertices; 0 where an index is out of range.
    pub fn volumes_at(&self, positions: &[Vec3]) -> Vec<f64> {
        self.cells.iter().map(|cell| corners(positions, cell).map_or(0.0, cell_volume)).collect()
    }

    /// Volume of each cell at rest, in cubic metres.
    pub fn volumes(&self) -> Vec<f64> {
        self.volumes_at(&self.positions)
    }

    /// Volume of the whole mesh at rest, in cubic metres.
    pub fn volume(&self) -> f64 {
        self.volumes().iter().sum()
    }

    /// The paper's size: the largest distance of a vertex from the mean of all, in metres.
    pub fn size(&self) -> f32 {
        measure::size(&self.positions)
    }

    /// The share of each vertex in the volume: a quarter of each of its cells, in cubic metres.
    pub fn vertex_volumes(&self) -> Vec<f64> {
        let mut shares = vec![0.0; self.positions.len()];
        for (cell, volume) in self.cells.iter().zip(self.volumes()) {
            cell.iter().for_each(|&v| shares[v as usize] += volume / 4.0);
        }
        shares
    }

    /// The smallest and the largest dihedral angle of all cells, in degrees. The regular tetrahedron has 70.5.
    pub fn dihedral_angles(&self) -> [f64; 2] {
        let mut worst = [180.0, 0.0f64];
        for x in self.cells.iter().filter_map(|cell| corners(&self.positions, cell)) {
            let normals = CELL_FACES.map(|[a, b, c]| (x[b] - x[a]).cross(x[c] - x[a]).normalize_or_zero());
            for [a, b] in CELL_EDGES {
                let angle = (-normals[a].dot(normals[b])).clamp(-1.0, 1.0).acos().to_degrees();
                worst = [worst[0].min(angle), worst[1].max(angle)];
            }
        }
        worst
    }
}

/// The faces of cells that are not between two of them.
pub(super) struct Faces {
    /// Of one cell only, counter-clockwise seen from outside, in the order of their cells.
    pub boundary: Vec<[u32; 3]>,
    /// A face of more than two cells, and the last of these.
    crowded: Option<([u32; 3], usize)>,
}

impl Faces {
    /// Counts how many cells have each face.
    pub fn of(cells: &[[u32; 4]]) -> Self {
        let mut faces: Vec<([u32; 3], u32)> = Vec::with_capacity(4 * cells.len());
        for (number, cell) in (0u32..).zip(cells) {
            for (side, corners) in (0u32..).zip(CELL_FACES) {
                let mut face = corners.map(|k| cell[k]);
                face.sort_unstable();
                faces.push((face, 4 * number + side));
            }
        }
        faces.sort_unstable();
        let mut open = Vec::new();
        let mut crowded = None;
        for same in faces.chunk_by(|a, b| a.0 == b.0) {
            match same {
                [one] => open.push(one.1),
                [_, _] => {}
                more => {
                    crowded.get_or_insert((more[0].0, (more[more.len() - 1].1 / 4) as usize));
                }
            }
        }
        open.sort_unstable();
        let triangle = |at: &u32| CELL_FACES[(at % 4) as usize].map(|k| cells[(at / 4) as usize][k]);
        Self { boundary: open.iter().map(triangle).collect(), crowded }
    }
}

/// The corners of a cell, none if an index is out of range.
pub(super) fn corners(positions: &[Vec3], cell: &[u32; 4]) -> Option<[DVec3; 4]> {
    let at = |k: usize| positions.get(cell[k] as usize).map(|p| p.as_dvec3());
    Some([at(0)?, at(1)?, at(2)?, at(3)?])
}

/// Signed volume of a tetrahedron: `(b - a) . ((c - a) x (d - a)) / 6`.
pub(super) fn cell_volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).dot((c - a).cross(d - a)) / 6.0
}

/// True when a tetrahedron of that volume has no volume to speak of: [`FLAT_CELL`].
pub(super) fn is_flat(x: [DVec3; 4], volume: f64) -> bool {
    let longest = CELL_EDGES.iter().map(|&[a, b]| x[a].distance_squared(x[b])).fold(0.0, f64::max).sqrt();
    volume.is_nan() || volume.abs() <= FLAT_CELL * longest.powi(3)
}

fn check(positions: &[Vec3], cells: &[[u32; 4]]) -> Result<(), TetrahedralError> {
    let limit = (u32::MAX / 4) as usize;
    for (what, count) in [("vertices", positions.len()), ("tetrahedra", cells.len())] {
        if count > limit {
            return Err(TetrahedralError::TooMany { what, count, limit });
        }
    }
    if positions.is_empty() {
        return Err(TetrahedralError::NoVertices);
    }
    if cells.is_empty() {
        return Err(TetrahedralError::NoCells);
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        return Err(TetrahedralError::NotFinite { vertex, position: positions[vertex].to_array() });
    }
    let mut used = vec![false; positions.len()];
    for (cell, vertices) in cells.iter().enumerate() {
        let Some(x) = corners(positions, vertices) else {
            let index = vertices.iter().copied().find(|&v| v as usize >= positions.len()).unwrap_or(u32::MAX);
            return Err(TetrahedralError::IndexOutOfRange { cell, index, vertices: positions.len() });
        };
        let volume = cell_volume(x);
        if volume <= 0.0 || is_flat(x, volume) {
            return Err(TetrahedralError::BadVolume { cell, volume });
        }
        vertices.iter().for_each(|&v| used[v as usize] = true);
    }
    match used.iter().position(|used| !used) {
        Some(vertex) => Err(TetrahedralError::UnusedVertex { vertex }),
        None => Ok(()),
    }
}

#[cfg(test)]
#[path = "tetrahedral_mesh_tests.rs"]
mod tests;
