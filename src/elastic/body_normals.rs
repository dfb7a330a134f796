//! Normals of the deformed skin on the processor.

use std::sync::Arc;

use rayon::prelude::*;

use super::palette::Palette;
use super::rig::ElasticRig;
use super::tangent_normals::tangent_epsilon;
use crate::math::Vec3;
use crate::mesh::NormalTopology;

/// How the normals of the deformed skin are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// Not at all: for who takes positions only, or lets the device find them.
    Skip,
    /// From the deformed triangles around each vertex, weighted by area.
    #[default]
    Triangles,
    /// From two further points in the tangent plane, deformed as the vertex itself (section 5.3).
    TangentPoints,
}

/// The normals of one body, with what is needed to renew them.
#[derive(Clone, Debug)]
pub(super) struct BodyNormals {
    /// None only for a mesh that no rig builder lets through.
    topology: Option<Arc<NormalTopology>>,
    epsilon: f32,
    faces: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

impl BodyNormals {
    pub fn new(rig: &ElasticRig) -> Self {
        Self {
            topology: NormalTopology::new(&rig.mesh.triangles, &rig.mesh.welded).ok().map(Arc::new),
            epsilon: tangent_epsilon(&rig.mesh.positions),
            faces: Vec::new(),
            normals: rig.mesh.normals.clone(),
        }
    }

    pub fn renew(&mut self, how: Normals, rig: &ElasticRig, palette: &Palette, positions: &[Vec3]) {
        match how {
            Normals::Skip => {}
            Normals::Triangles => {
                let Some(topology) = &self.topology else { return };
                // The lengths fit by construction; a mismatch would leave the last normals.
                let _ = topology.normals_into(positions, &mut self.faces, &mut self.normals);
            }
            Normals::TangentPoints => {
                let epsilon = self.epsilon;
                self.normals.par_iter_mut().with_min_len(256).enumerate().for_each(|(v, normal)| {
                    let (rest, skin) = (rig.mesh.positions[v], &rig.weights[v]);
                    *normal = palette.deform_with_normal(rest, rig.mesh.normals[v], skin, epsilon).1;
                });
            }
        }
    }
}
