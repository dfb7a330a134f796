//! A compute pass for pictures between two steps: it mixes the vertices of two states that are on the device already.

use pliant::gpu::GpuBody;

use super::vertex_pass::{READ, UNIFORM, VertexPass, WRITTEN};
use crate::render::mesh::VERTEX_USAGE;

/// The pass, one for all bodies of a device.
pub struct BlendPipeline(VertexPass);

/// The mixed vertices of one body.
pub struct Blended {
    /// Positions, as a renderer takes them.
    pub positions: wgpu::Buffer,
    /// Normals, not quite of length one.
    pub normals: wgpu::Buffer,
    share: wgpu::Buffer,
    group: wgpu::BindGroup,
    vertices: u32,
}

impl BlendPipeline {
    /// Compiles the shader.
    pub fn new(device: &wgpu::Device) -> Self {
        let buffers = [READ, READ, READ, READ, WRITTEN, WRITTEN, UNIFORM];
        Self(VertexPass::new(device, "blend", wgpu::include_wgsl!("blend.wgsl"), &buffers))
    }

    /// Buffers for mixtures of two states of one body.
    pub fn target(&self, device: &wgpu::Device, states: &[GpuBody; 2]) -> Blended {
        let buffer = |label, size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let vertices = states[0].vertices();
        let size = u64::from(vertices) * 16;
        let positions = buffer("blended positions", size, VERTEX_USAGE);
        let normals = buffer("blended normals", size, VERTEX_USAGE);
        let share = buffer("share", 16, wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST);
        let [a, b] = states;
        let buffers = [a.positions(), a.normals(), b.positions(), b.normals(), &positions, &normals, &share];
        let group = self.0.group(device, &buffers);
        Blended { positions, normals, share, group, vertices }
    }

    /// Records the mixing with a share of state 1 from 0 to 1.
    pub fn encode(&self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, target: &Blended, share: f32) {
        queue.write_buffer(&target.share, 0, bytemuck::cast_slice(&[share, 0.0, 0.0, 0.0]));
        self.0.encode(encoder, &target.group, target.vertices);
    }
}
