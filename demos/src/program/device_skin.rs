//! A soft body whose skin never leaves the device: its cells are uploaded, compute passes deform the skin and lay paint on it.

use std::sync::Arc;

use glam::Vec3;
use pliant::gpu::{EmbedPipeline, GpuEmbeddedBody, GpuEmbeddedSkin, GpuError};

use super::vertex_pass::{READ, VertexPass, WRITTEN};
use crate::render::{MeshId, Paint, Renderer};

/// The compute passes of a device, for all soft bodies.
pub struct SkinPasses {
    embed: EmbedPipeline,
    paint: VertexPass,
}

/// One body.
pub struct DeviceSkin {
    passes: Arc<SkinPasses>,
    body: GpuEmbeddedBody,
    paint: wgpu::Buffer,
    group: wgpu::BindGroup,
    mesh: MeshId,
}

impl SkinPasses {
    /// Compiles the shaders.
    pub fn new(device: &wgpu::Device) -> Self {
        let paint = VertexPass::new(device, "lay", wgpu::include_wgsl!("paint.wgsl"), &[READ, WRITTEN]);
        Self { embed: EmbedPipeline::new(device), paint }
    }
}

impl DeviceSkin {
    /// Makes the mesh of a body that wears a skin with these triangles.
    pub fn new(
        renderer: &mut Renderer,
        passes: &Arc<SkinPasses>,
        skin: &GpuEmbeddedSkin,
        triangles: &[[u32; 3]],
    ) -> Self {
        let device = renderer.device().clone();
        let body = GpuEmbeddedBody::new(&device, skin);
        let paint = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("paint"),
            size: u64::from(skin.vertices()) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = passes.paint.group(&device, &[&paint, body.normals()]);
        let mesh = renderer.add_shared_mesh(body.positions().clone(), body.normals().clone(), triangles.as_flattened());
        Self { passes: passes.clone(), body, paint, group, mesh }
    }

    /// Its mesh.
    pub fn mesh(&self) -> MeshId {
        self.mesh
    }

    /// Deforms the skin with the cells, in metres, and lays paint on its vertices, if there is any.
    ///
    /// # Errors
    /// Another number of positions than the body has vertices.
    pub fn show(&mut self, renderer: &Renderer, cells: &[Vec3], paint: &[Paint]) -> Result<(), GpuError> {
        let (device, queue) = (renderer.device(), renderer.queue());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.passes.embed.encode(device, queue, &mut encoder, &mut self.body, cells)?;
        // The deformation leaves none.
        if !paint.is_empty() {
            let bits: Vec<u32> = paint.iter().map(|paint| paint.0).collect();
            queue.write_buffer(&self.paint, 0, bytemuck::cast_slice(&bits));
            self.passes.paint.encode(&mut encoder, &self.group, self.body.skin().vertices());
        }
        queue.submit([encoder.finish()]);
        Ok(())
    }
}
