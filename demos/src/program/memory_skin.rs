//! A body whose vertices the processor deformed: positions are mixed, normals gathered, and both are uploaded.

use glam::{Vec3, Vec4};
use pliant::elastic::ElasticRig;
use pliant::mesh::{MeshError, NormalTopology};

use super::moment::BodyMoment;
use crate::render::{MeshData, MeshId, Renderer};

/// One body.
pub struct MemorySkin {
    mesh: MeshId,
    topology: NormalTopology,
    positions: Vec<Vec3>,
    faces: Vec<Vec3>,
    normals: Vec<Vec3>,
}

impl MemorySkin {
    /// Makes the mesh of a body.
    pub fn new(renderer: &mut Renderer, rig: &ElasticRig) -> Result<Self, MeshError> {
        let data = MeshData {
            positions: rig.mesh.positions.clone(),
            normals: rig.mesh.normals.clone(),
            indices: rig.mesh.triangles.as_flattened().to_vec(),
        };
        Ok(Self {
            mesh: renderer.add_mesh(&data),
            topology: NormalTopology::new(&rig.mesh.triangles, &rig.mesh.welded)?,
            positions: Vec::new(),
            faces: Vec::new(),
            normals: Vec::new(),
        })
    }

    /// Uploads the place `alpha` between two moments of the body and returns its mesh.
    pub fn show(&mut self, renderer: &Renderer, moments: [&BodyMoment; 2], alpha: f32) -> Result<MeshId, MeshError> {
        let [from, to] = moments.map(|moment| &moment.positions);
        self.positions.clear();
        self.positions.extend(from.iter().zip(to).map(|(a, b)| a.lerp(*b, alpha)));
        self.topology.normals_into(&self.positions, &mut self.faces, &mut self.normals)?;
        let positions: Vec<Vec4> = self.positions.iter().map(|p| p.extend(1.0)).collect();
        let normals: Vec<Vec4> = self.normals.iter().map(|n| n.extend(0.0)).collect();
        renderer.write_mesh(self.mesh, &positions, &normals);
        Ok(self.mesh)
    }
}
