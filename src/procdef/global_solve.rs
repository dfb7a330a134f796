//! The global solve: goals of a body of any stiffness for the price of one factorisation and one back-substitution a step.
//!
//! Iterated matching costs as much as it has iterations, and what it means depends on the mesh and the time step. Instead the
//! goals `y` minimise, with the maps `F_c` (the mean of `R_i T_i` at the corners of a cell `c`) held fixed,
//!
//! ```text
//! Σ_i m_i |y_i - x_i|² + (h c)² Σ_cells m_c |∇y - F_c|²
//! ```
//!
//! one local and one global step of projective dynamics (Bouaziz et al. 2014) with the energy of as-rigid-as-possible
//! deformation. The local step must be the best one for this very energy: `R_i` is the rotation nearest to
//! `Σ_cells m_c/4 ∇x T_iᵀ` around the vertex, by the cells' gradients and not by the positions of the region's vertices. Else the
//! force that comes of it is the gradient of no energy, and bodies swing ever higher. The second term is the elastic energy of a material in which longitudinal waves run at the speed `c`, whatever
//! the mesh is (linear finite elements), and `h²` makes of it what one time step does. The matrix `M + (h c)² K` is constant,
//! sparse, symmetric and positive: it is factored once for each `h c`, by nalgebra-sparse's Cholesky factorisation in the
//! order of [`super::ordering`].

use glam::{DMat3, DVec3};
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use wide::f32x4;

use super::factor::BlockFactor;
use super::regions::Regions;
use crate::mesh::TetrahedralMesh;

/// The stiffness matrix of a body, apart from the wave speed and the time step.
#[derive(Clone, Debug)]
pub(super) struct Stiffening {
    /// Beside each entry of the regions: `Σ (m_c / 4) ∇φ` over the cells that hold both vertices, and the element of `K`.
    pairs: Vec<[f32; 4]>,
    /// `K` as rows, columns and values of its lower half, in the order of the regions.
    matrix: Vec<(u32, u32, f64)>,
    mass: Vec<f64>,
    /// Beside each entry of the regions: `Σ m_c ∇φ` of that vertex over the cells around the region's own, beside their mass: `Σ x ⊗`
    /// these is the mean gradient of the shape around a vertex, the identity at rest.
    pub turning: Vec<f32x4>,
}

/// The factor of `M + (h c)² K`.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    /// `(h c)²` in square metres.
    scale: f32,
    matrix: BlockFactor,
}

impl Stiffening {
    pub fn new(mesh: &TetrahedralMesh, regions: &Regions) -> Self {
        let n = regions.len();
        let total_mass: f64 = regions.mass.iter().map(|&m| f64::from(m)).sum();
        let density = total_mass / mesh.volume();
        let mut gradients = vec![DVec3::ZERO; regions.items.len()];
        let mut elements = vec![0.0f64; regions.items.len()];
        let mut turning = vec![DVec3::ZERO; regions.items.len()];
        let mut around = vec![0.0f64; n];
        for (cell, volume) in mesh.cells.iter().zip(mesh.volumes()) {
            let places = cell.map(|v| regions.place[v as usize] as usize);
            let x = cell.map(|v| mesh.positions[v as usize].as_dvec3());
            let mass = volume * density;
            let shape = shape_gradients(x);
            for (k, &row) in places.iter().enumerate() {
                around[row] += mass;
                for (j, &column) in places.iter().enumerate() {
                    let Ok(at) = regions.items[regions.row(row)].binary_search(&(column as u32)) else { continue };
                    let at = regions.row(row).start + at;
                    gradients[at] += shape[k] * (mass / 4.0);
                    turning[at] += shape[j] * mass;
                    elements[at] += mass * shape[k].dot(shape[j]);
                }
            }
        }
        let mut matrix = Vec::new();
        for row in 0..n {
            for at in regions.row(row) {
                if regions.items[at] as usize <= row {
                    matrix.push((row as u32, regions.items[at], elements[at]));
                }
            }
        }
        let pairs =
            gradients.iter().zip(&elements).map(|(g, &e)| [g.x as f32, g.y as f32, g.z as f32, e as f32]).collect();
        let rows = (0..n).flat_map(|row| regions.row(row).map(move |_| row));
        let turning = turning.iter().zip(rows).map(|(g, row)| {
            let g = *g / around[row];
            f32x4::new([g.x as f32, g.y as f32, g.z as f32, 0.0])
        });
        Self { pairs, matrix, turning: turning.collect(), mass: regions.mass.iter().map(|&m| f64::from(m)).collect() }
    }

    /// Factors `M + (h c)² K` for `h c` in metres; none if that is not a positive finite matrix in 64 bits.
    pub fn factor(&self, distance: f32) -> Option<Factor> {
        let n = self.mass.len();
        let scale = f64::from(distance).powi(2);
        let mut triplets = CooMatrix::new(n, n);
        for &(row, column, value) in &self.matrix {
            let (i, j) = (row as usize, column as usize);
            let value = value * scale + if i == j { self.mass[i] } else { 0.0 };
            triplets.push(i, j, value);
            if i != j {
                triplets.push(j, i, value);
            }
        }
        let factor = CscCholesky::factor(&CscMatrix::from(&triplets)).ok()?.take_l();
        let (offsets, rows, values) = factor.csc_data();
        let column = |c: usize| {
            // The diagonal comes first in each column.
            let below = offsets[c] + 1..offsets[c + 1];
            let entries = below.clone().map(|at| (rows[at] as u32, values[at])).collect();
            (values[offsets[c]], entries)
        };
        let columns: Vec<(f64, Vec<(u32, f64)>)> = (0..n).map(column).collect();
        BlockFactor::new(&columns).map(|matrix| Factor { scale: scale as f32, matrix })
    }

    /// The ways from the shape `x` to the goals, for the maps of its regions.
    pub fn ways(&self, factor: &Factor, regions: &Regions, x: &[f32x4], maps: &[[f32x4; 3]], ways: &mut [f32x4]) {
        let scale = f32x4::splat(factor.scale);
        for (p, way) in ways.iter_mut().enumerate() {
            let row = regions.row(p);
            let own = x[p];
            let mut pushed = [f32x4::ZERO; 3];
            let mut pulled = f32x4::ZERO;
            for (&i, pair) in regions.items[row.clone()].iter().zip(&self.pairs[row]) {
                let [a, b, c, k] = *pair;
                let gradient = f32x4::new([a, b, c, 0.0]);
                let map = &maps[i as usize];
                pushed = [pushed[0] + map[0] * gradient, pushed[1] + map[1] * gradient, pushed[2] + map[2] * gradient];
                pulled += (x[i as usize] - own) * f32x4::splat(k);
            }
            let [u, v, w, t] = f32x4::transpose([pushed[0], pushed[1], pushed[2], f32x4::ZERO]);
            *way = ((u + v) + (w + t) - pulled) * scale;
        }
        factor.solve(ways);
    }
}

impl Factor {
    /// Divides by the matrix, in place, three right-hand sides at once.
    pub fn solve(&self, b: &mut [f32x4]) {
        self.matrix.solve(b);
    }
}

/// The gradients of the four linear shape functions of a cell.
fn shape_gradients([a, b, c, d]: [DVec3; 4]) -> [DVec3; 4] {
    let inverse = DMat3::from_cols(b - a, c - a, d - a).inverse().transpose();
    let [b, c, d] = [inverse.x_axis, inverse.y_axis, inverse.z_axis];
    [-(b + c + d), b, c, d]
}
