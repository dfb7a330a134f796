//! What all bodies of one kind share: the mesh at rest, masses, regions and the factors of the global solve.

use std::sync::{Arc, Mutex, PoisonError};

use super::ProcDefRigError;
use super::global_solve::{Factor, Stiffening};
use super::regions::Regions;
use super::volume::Cells;
use crate::mesh::TetrahedralMesh;

/// How many factors of the global solve a rig remembers: one for each stiffness and time step in use.
const FACTORS: usize = 8;

/// The rest data of a body, made once by [`ProcDefRigBuilder`].
#[derive(Debug)]
pub struct ProcDefRig {
    mesh: TetrahedralMesh,
    masses: Vec<f32>,
    size: f32,
    pub(super) regions: Regions,
    pub(super) stiffening: Stiffening,
    pub(super) cells: Cells,
    /// The latest factors and the `h c` they are for, the newest last.
    factors: Mutex<Vec<(f32, Option<Arc<Factor>>)>>,
}

impl ProcDefRig {
    /// The mesh at rest.
    pub fn mesh(&self) -> &TetrahedralMesh {
        &self.mesh
    }

    /// The mass of each vertex in kilograms.
    pub fn masses(&self) -> &[f32] {
        &self.masses
    }

    /// The mesh's size, [`TetrahedralMesh::size`], in metres.
    pub fn size(&self) -> f32 {
        self.size
    }

    /// The factor for waves that run `distance` metres in a step: made at its first use and shared by all bodies.
    pub(super) fn factor(&self, distance: f32) -> Option<Arc<Factor>> {
        let mut factors = self.factors.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, factor)) = factors.iter().find(|(d, _)| *d == distance) {
            return factor.clone();
        }
        let factor = self.stiffening.factor(distance).map(Arc::new);
        if factors.len() == FACTORS {
            factors.remove(0);
        }
        factors.push((distance, factor.clone()));
        factor
    }
}

/// Makes a [`ProcDefRig`] of a tetrahedral mesh.
#[derive(Clone, Debug)]
pub struct ProcDefRigBuilder {
    mesh: TetrahedralMesh,
    density: f32,
    masses: Option<Vec<f32>>,
}

impl ProcDefRigBuilder {
    /// Starts with a mesh of the density of water, 1000 kg/m³.
    pub fn new(mesh: TetrahedralMesh) -> Self {
        Self { mesh, density: 1000.0, masses: None }
    }

    /// The density in kg/m³: each vertex weighs a quarter of each of its cells.
    pub fn density(&mut self, density: f32) -> &mut Self {
        self.density = density;
        self
    }

    /// The mass of each vertex in kilograms, instead of a density.
    pub fn masses(&mut self, masses: Vec<f32>) -> &mut Self {
        self.masses = Some(masses);
        self
    }

    /// Computes regions and matrices.
    ///
    /// # Errors
    /// A density or mass that is not positive and finite, masses that are not one a vertex, a mesh or a cell so small or
    /// large that its volume is lost in 32 bits.
    pub fn build(&self) -> Result<ProcDefRig, ProcDefRigError> {
        let mesh = self.mesh.clone();
        let size = mesh.size();
        // Volumes are cubes of lengths, squares of them are divided by.
        if !(1e-6..1e6).contains(&size) {
            return Err(ProcDefRigError::Size(size));
        }
        let masses = match &self.masses {
            Some(masses) => masses.clone(),
            None if !(self.density > 0.0 && self.density.is_finite()) => {
                return Err(ProcDefRigError::Density(self.density));
            }
            None => mesh.vertex_volumes().iter().map(|v| (v * f64::from(self.density)) as f32).collect(),
        };
        let expected = mesh.vertex_count();
        if masses.len() != expected {
            return Err(ProcDefRigError::MassCount { given: masses.len(), expected });
        }
        if let Some((vertex, &mass)) = masses.iter().enumerate().find(|(_, m)| !(m.is_normal() && **m > 0.0)) {
            return Err(ProcDefRigError::Mass { vertex, mass });
        }
        let regions = Regions::new(&mesh, &masses);
        let stiffening = Stiffening::new(&mesh, &regions);
        let cells = Cells::new(&mesh, &regions)?;
        Ok(ProcDefRig { cells, mesh, masses, size, regions, stiffening, factors: Mutex::new(Vec::new()) })
    }
}
