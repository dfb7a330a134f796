//! A body whose vertices never leave the device: the compute pass fills the buffers that are drawn.
//!
//! There are two states, for even and for odd steps. A new step fills one of them; a picture between two steps mixes
//! both in a third pair of buffers.

use pliant::elastic::ElasticRig;
use pliant::gpu::{DeformPipeline, GpuBody, GpuError, GpuSkin};

use super::blend::{BlendPipeline, Blended};
use super::moment::BodyMoment;
use crate::render::{MeshId, Renderer};

/// The compute passes of a device.
pub struct Passes {
    deform: DeformPipeline,
    blend: BlendPipeline,
}

impl Passes {
    /// Compiles them.
    pub fn new(device: &wgpu::Device) -> Self {
        Self { deform: DeformPipeline::new(device), blend: BlendPipeline::new(device) }
    }
}

/// One body.
pub struct ComputeSkin {
    skin: GpuSkin,
    states: [GpuBody; 2],
    /// The step that each state belongs to.
    steps: [Option<u64>; 2],
    meshes: [MeshId; 2],
    blended: Blended,
    blended_mesh: MeshId,
}

impl ComputeSkin {
    /// Uploads a body's rest data and makes its meshes.
    pub fn new(renderer: &mut Renderer, passes: &Passes, rig: &ElasticRig) -> Result<Self, GpuError> {
        let device = renderer.device().clone();
        let skin = GpuSkin::new(&device, rig)?;
        let states = [GpuBody::new(&device, &skin), GpuBody::new(&device, &skin)];
        let blended = passes.blend.target(&device, &states);
        let indices = rig.mesh.triangles.as_flattened();
        let meshes = [0, 1].map(|i: usize| mesh(renderer, states[i].positions(), states[i].normals(), indices));
        let blended_mesh = mesh(renderer, &blended.positions, &blended.normals, indices);
        Ok(Self { skin, states, steps: [None; 2], meshes, blended, blended_mesh })
    }

    /// Deforms what is new of two moments of the body, each with the number of its step, and returns the mesh that
    /// shows the place `alpha` between them.
    pub fn show(
        &mut self,
        renderer: &Renderer,
        passes: &Passes,
        moments: [(u64, &BodyMoment); 2],
        alpha: f32,
    ) -> Result<MeshId, GpuError> {
        let (device, queue) = (renderer.device(), renderer.queue());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mix = alpha < 1.0 && moments[0].0 + 1 == moments[1].0;
        let wanted = if mix { &moments[..] } else { &moments[1..] };
        for (step, moment) in wanted {
            let slot = slot(*step);
            if self.steps[slot] != Some(*step) {
                let state = &mut self.states[slot];
                passes.deform.encode(device, queue, &mut encoder, &self.skin, state, &moment.palette)?;
                self.steps[slot] = Some(*step);
            }
        }
        let latest = slot(moments[1].0);
        let shown = if mix {
            let share = if latest == 1 { alpha } else { 1.0 - alpha };
            passes.blend.encode(queue, &mut encoder, &self.blended, share);
            self.blended_mesh
        } else {
            self.meshes[latest]
        };
        queue.submit([encoder.finish()]);
        Ok(shown)
    }
}

fn slot(step: u64) -> usize {
    (step % 2) as usize
}

fn mesh(renderer: &mut Renderer, positions: &wgpu::Buffer, normals: &wgpu::Buffer, indices: &[u32]) -> MeshId {
    renderer.add_shared_mesh(positions.clone(), normals.clone(), indices)
}
