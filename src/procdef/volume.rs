//! Keeping the volume of the cells, which matching alone does not: a neighbourhood that is pressed flat is turned rightly, but
//! its flat shape is as good as any until the next step pulls it up again.
//!
//! Positions are projected, cell after cell, onto `V_c = V_c⁰ det T_c` (position-based dynamics, Müller et al. 2006), in sweeps
//! that go through the body forwards and backwards in turn until all cells are near enough. A projection moves the corners
//! along the gradients of the volume by their inverse masses: it keeps linear momentum, and angular momentum about the
//! projected positions. It turns a cell that is inside out right again, too. What the ground stops is projected within the
//! sweep, so that the material gives way to the sides.
//!
//! All conditions together were also solved by Newton's method with one pressure a vertex: it overshoots where cells are nearly
//! flat, and throws the body apart.

use glam::Mat3;
use wide::f32x4;

use super::regions::Regions;
use super::rigid::wide;
use super::{GroundPlane, ProcDefRigError};
use crate::mesh::TetrahedralMesh;

/// Sweeps at most: at 30 m/s and 60 steps a second a ball of 1 m keeps 90 % of its volume with 40 of them, 75 % with 20.
const MOST_SWEEPS: u32 = 40;
/// All cells within this part of their volume are near enough. Free flight then takes one sweep.
const NEAR: f32 = 0.01;

/// The cells of a body at rest, in the order of its regions.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    pub(super) corners: Vec<[u32; 4]>,
    /// Six times the volume of each.
    pub(super) rest: Vec<f32>,
    pub(super) inverse_mass: Vec<f32>,
}

impl Cells {
    /// The cells of a mesh.
    ///
    /// # Errors
    /// A cell whose volume is nothing in 32 bits.
    pub fn new(mesh: &TetrahedralMesh, regions: &Regions) -> Result<Self, ProcDefRigError> {
        let mut cells = Vec::with_capacity(mesh.cells.len());
        for (c, (cell, volume)) in mesh.cells.iter().zip(mesh.volumes()).enumerate() {
            let volume = (volume * 6.0) as f32;
            if !volume.is_normal() {
                return Err(ProcDefRigError::CellVolume { cell: c, volume: volume / 6.0 });
            }
            cells.push((cell.map(|v| regions.place[v as usize]), volume));
        }
        cells.sort_by_key(|(cell, _)| *cell.iter().min().unwrap_or(&0));
        let (corners, rest) = cells.into_iter().unzip();
        Ok(Self { corners, rest, inverse_mass: regions.mass.iter().map(|m| 1.0 / m).collect() })
    }

    /// Six times the volumes that the cells should have: each times the mean of the determinants at its corners.
    pub fn targets(&self, regions: &Regions, local: &[Mat3], targets: &mut Vec<f32>) {
        targets.clear();
        let shrinking = (0..self.corners.len()).map(|c| self.shrinking(c, regions, local));
        targets.extend(shrinking.zip(&self.rest).map(|(shrinking, rest)| rest * shrinking));
    }

    /// By what a cell's volume is multiplied: the mean of the determinants at its corners. 1 without deformations.
    pub fn shrinking(&self, c: usize, regions: &Regions, local: &[Mat3]) -> f32 {
        if local.len() != regions.len() {
            return 1.0;
        }
        let determinant = |&p: &u32| {
            let d = local[regions.vertex[p as usize] as usize].determinant().abs();
            if d.is_finite() { d } else { 1.0 }
        };
        self.corners[c].iter().map(determinant).sum::<f32>() * 0.25
    }

    /// Projects the positions `y` of all places.
    pub fn project(&self, y: &mut [f32x4], targets: &[f32], plane: Option<&GroundPlane>) {
        let plane = plane.map(|plane| (wide(plane.normal), plane.offset));
        for sweep in 0..MOST_SWEEPS {
            let worst = if sweep % 2 == 0 {
                (0..self.corners.len()).fold(0.0, |worst: f32, c| worst.max(self.project_cell(c, y, targets[c], plane)))
            } else {
                (0..self.corners.len())
                    .rev()
                    .fold(0.0, |worst: f32, c| worst.max(self.project_cell(c, y, targets[c], plane)))
            };
            if worst < NEAR {
                return;
            }
        }
    }

    /// Projects one cell and returns the relative error that it had.
    #[inline]
    fn project_cell(&self, c: usize, y: &mut [f32x4], target: f32, plane: Option<(f32x4, f32)>) -> f32 {
        let at = self.corners[c].map(|v| v as usize);
        let (volume, gradients) = volume_gradients(at.map(|v| y[v]));
        let error = volume - target;
        let inverse_masses = at.map(|v| self.inverse_mass[v]);
        let total: f32 = gradients.iter().zip(inverse_masses).map(|(g, w)| w * dot(*g, *g)).sum();
        // Corners in one line have no gradient to go along; not-a-number goes nowhere, too.
        let step = -error / total;
        if step.is_finite() {
            for ((v, g), w) in at.into_iter().zip(gradients).zip(inverse_masses) {
                y[v] += g * f32x4::splat(step * w);
                if let Some((normal, offset)) = plane {
                    y[v] += normal * f32x4::splat((offset - dot(y[v], normal)).max(0.0));
                }
            }
        }
        (error / target).abs()
    }
}

/// Six times the volume of a cell, and its gradients by the four corners.
#[inline]
pub(super) fn volume_gradients([p, q, r, s]: [f32x4; 4]) -> (f32, [f32x4; 4]) {
    let (u, v, w) = (q - p, r - p, s - p);
    let (a, b, c) = (cross(v, w), cross(w, u), cross(u, v));
    (dot(u, a), [-(a + b + c), a, b, c])
}

#[inline]
pub(super) fn dot(a: f32x4, b: f32x4) -> f32 {
    let [x, y, z, _] = (a * b).to_array();
    x + y + z
}

#[inline]
pub(super) fn cross(a: f32x4, b: f32x4) -> f32x4 {
    let ([ax, ay, az, _], [bx, by, bz, _]) = (a.to_array(), b.to_array());
    f32x4::new([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx, 0.0])
}
