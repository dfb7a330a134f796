//! A detailed skin in the cells of a body: every vertex goes with the cell that it lies in.
//!
//! A vertex is bound by its barycentric coordinates: `x = Σ bᵢ xᵢ` over the corners of its cell. Its normal is carried by the
//! cofactors of the deformation gradient, `n ∝ cof(F) n⁰`, the inverse transpose but for its length, and without a division.
//! The gradient is constant in a cell; it is averaged at the corners and blended by the same coordinates, so that
//! normals do not jump from cell to cell. `vertex_gradients.wgsl` and `embed_vertex.wgsl` are the twins of this file.

use std::collections::HashMap;

use glam::Mat3;
use parry3d::query::PointQueryWithLocation;
use parry3d::shape::TriMesh;
use rayon::prelude::*;

use crate::math::Vec3;
use crate::mesh::{TetrahedralError, TetrahedralMesh, TriangleMesh};

/// A point counts as inside a cell when no barycentric coordinate is below this.
const INSIDE: f32 = -1e-5;

/// How a skin lies in the cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmbeddingReport {
    /// Vertices of the skin that lie outside of all cells. They go with the nearest cell, extrapolated.
    pub outside: usize,
    /// How far the farthest of them is from the cells, in metres.
    pub farthest: f32,
}

/// Where a vertex of the skin lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinBinding {
    /// The vertices of its cell.
    pub vertices: [u32; 4],
    /// Its barycentric coordinates there; they add up to 1, and outside of the cells some are negative.
    pub weights: [f32; 4],
}

/// A skin bound to the cells of a body.
#[derive(Clone, Debug)]
pub struct EmbeddedSkin {
    skin: TriangleMesh,
    bindings: Vec<SkinBinding>,
    pub(crate) cells: Vec<RestCell>,
    /// One over the volume of the cells around each vertex of the body.
    pub(crate) inverse_volumes: Vec<f32>,
}

/// A cell at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RestCell {
    pub vertices: [u32; 4],
    /// The inverse of the matrix of the edges from the first corner, at rest.
    pub inverse: Mat3,
    pub volume: f32,
}

/// A skin in a deformed state, and the buffers to get there.
#[derive(Clone, Debug, Default)]
pub struct DeformedSkin {
    /// Position of each vertex of the skin, in metres.
    pub positions: Vec<Vec3>,
    /// Unit normal of each vertex of the skin.
    pub normals: Vec<Vec3>,
    gradients: Vec<Mat3>,
}

impl EmbeddedSkin {
    /// Binds a skin to the cells of a body, both at rest in the same coordinates.
    ///
    /// # Errors
    /// The body has no cells.
    pub fn new(skin: TriangleMesh, body: &TetrahedralMesh) -> Result<(Self, EmbeddingReport), TetrahedralError> {
        let boundary = body.boundary();
        let owner = owners(body);
        let surface = TriMesh::new(body.positions.clone(), boundary.clone()).map_err(|_| TetrahedralError::NoCells)?;
        let grid = Grid::new(body);
        let mut report = EmbeddingReport { outside: 0, farthest: 0.0 };
        let mut bindings = Vec::with_capacity(skin.positions.len());
        for &p in &skin.positions {
            let inside =
                grid.near(p).iter().map(|&c| bind(body, c, p)).find(|b| b.weights.iter().all(|w| *w >= INSIDE));
            bindings.push(inside.unwrap_or_else(|| {
                let (projection, (triangle, _)) = surface.project_local_point_and_get_location(p, false);
                report.outside += 1;
                report.farthest = report.farthest.max(projection.point.distance(p));
                let mut face = boundary[triangle as usize];
                face.sort_unstable();
                bind(body, owner.get(&face).copied().unwrap_or(0), p)
            }));
        }
        let mut around = vec![0.0f32; body.vertex_count()];
        let mut cells = Vec::with_capacity(body.cells.len());
        for (&vertices, volume) in body.cells.iter().zip(body.volumes()) {
            vertices.iter().for_each(|&v| around[v as usize] += volume as f32);
            cells.push(RestCell {
                vertices,
                inverse: edges(&body.positions, vertices).inverse(),
                volume: volume as f32,
            });
        }
        let inverse_volumes = around.iter().map(|v| 1.0 / v).collect();
        Ok((Self { skin, bindings, cells, inverse_volumes }, report))
    }

    /// The skin at rest.
    pub fn skin(&self) -> &TriangleMesh {
        &self.skin
    }

    /// Where each vertex of the skin lies.
    pub fn bindings(&self) -> &[SkinBinding] {
        &self.bindings
    }

    /// Deforms the skin for these positions of the body's vertices. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// Another number of positions than the body has vertices.
    pub fn deform(&self, positions: &[Vec3], out: &mut DeformedSkin) -> Result<(), TetrahedralError> {
        let expected = self.inverse_volumes.len();
        if positions.len() != expected {
            return Err(TetrahedralError::LengthMismatch { given: positions.len(), expected });
        }
        self.vertex_gradients(positions, &mut out.gradients);
        let gradients = &out.gradients;
        out.positions.resize(self.bindings.len(), Vec3::ZERO);
        out.normals.resize(self.bindings.len(), Vec3::ZERO);
        (&mut out.positions, &mut out.normals, &self.bindings, &self.skin.normals).into_par_iter().for_each(
            |(position, normal, binding, &rest)| {
                (*position, *normal) = embed_vertex(binding, rest, positions, gradients);
            },
        );
        Ok(())
    }

    /// The deformation gradient at each vertex of the body: the mean of those of its cells, weighted by their volumes.
    fn vertex_gradients(&self, positions: &[Vec3], gradients: &mut Vec<Mat3>) {
        gradients.clear();
        gradients.resize(self.inverse_volumes.len(), Mat3::ZERO);
        for cell in &self.cells {
            let gradient = edges(positions, cell.vertices) * cell.inverse * cell.volume;
            cell.vertices.iter().for_each(|&v| gradients[v as usize] += gradient);
        }
        gradients.iter_mut().zip(&self.inverse_volumes).for_each(|(g, v)| *g *= *v);
    }
}

/// Position and normal of a vertex of the skin whose normal at rest is `rest`.
fn embed_vertex(binding: &SkinBinding, rest: Vec3, positions: &[Vec3], gradients: &[Mat3]) -> (Vec3, Vec3) {
    let (mut x, mut f) = (Vec3::ZERO, Mat3::ZERO);
    for (&v, w) in binding.vertices.iter().zip(binding.weights) {
        x += positions[v as usize] * w;
        f += gradients[v as usize] * w;
    }
    (x, (cofactors(f) * rest).normalize_or(rest))
}

/// The edges of a cell from its first corner, as columns.
fn edges(positions: &[Vec3], [a, b, c, d]: [u32; 4]) -> Mat3 {
    let at = |v: u32| positions[v as usize];
    Mat3::from_cols(at(b) - at(a), at(c) - at(a), at(d) - at(a))
}

/// The matrix of cofactors: `det(F) F⁻ᵀ`, also where `F` has no inverse.
fn cofactors(f: Mat3) -> Mat3 {
    Mat3::from_cols(f.y_axis.cross(f.z_axis), f.z_axis.cross(f.x_axis), f.x_axis.cross(f.y_axis))
}

fn bind(body: &TetrahedralMesh, cell: u32, p: Vec3) -> SkinBinding {
    let vertices = body.cells[cell as usize];
    let [b, c, d] =
        (edges(&body.positions, vertices).inverse() * (p - body.positions[vertices[0] as usize])).to_array();
    SkinBinding { vertices, weights: [1.0 - b - c - d, b, c, d] }
}

/// The cell of each face of the boundary, by its vertices in ascending order.
fn owners(body: &TetrahedralMesh) -> HashMap<[u32; 3], u32> {
    let mut owners = HashMap::new();
    for (c, cell) in (0u32..).zip(&body.cells) {
        for corners in crate::mesh::CELL_FACES {
            let mut face = corners.map(|k| cell[k]);
            face.sort_unstable();
            owners.insert(face, c);
        }
    }
    owners
}

/// Cells by the cubes of a grid that their bounding boxes touch.
struct Grid {
    cubes: HashMap<[i32; 3], Vec<u32>>,
    size: f32,
}

impl Grid {
    fn new(body: &TetrahedralMesh) -> Self {
        // Cubes about as large as the boxes of cells.
        let boxes: Vec<[Vec3; 2]> = body
            .cells
            .iter()
            .map(|cell| {
                let x = cell.map(|v| body.positions[v as usize]);
                [x[0].min(x[1]).min(x[2]).min(x[3]), x[0].max(x[1]).max(x[2]).max(x[3])]
            })
            .collect();
        let extents: f32 = boxes.iter().map(|[low, high]| (*high - *low).max_element()).sum();
        let size = (extents / boxes.len().max(1) as f32).max(f32::MIN_POSITIVE);
        let mut grid = Self { cubes: HashMap::new(), size };
        for (c, [low, high]) in (0u32..).zip(boxes) {
            let (low, high) = (grid.cube(low - size * 1e-3), grid.cube(high + size * 1e-3));
            for z in low[2]..=high[2] {
                for y in low[1]..=high[1] {
                    for x in low[0]..=high[0] {
                        grid.cubes.entry([x, y, z]).or_default().push(c);
                    }
                }
            }
        }
        grid
    }

    fn cube(&self, p: Vec3) -> [i32; 3] {
        (p / self.size).to_array().map(|x| x.floor() as i32)
    }

    /// The cells that may hold a point, in ascending order.
    fn near(&self, p: Vec3) -> &[u32] {
        self.cubes.get(&self.cube(p)).map_or(&[], Vec::as_slice)
    }
}
