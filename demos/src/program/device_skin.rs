//! A soft body whose skin never leaves the device: its cells are uploaded, compute passes deform the skin and lay paint on it.

use std::sync::Arc;

use glam::Vec3;
use pliant::gpu::{EmbedPipeline, GpuEmbeddedBody, GpuEmbeddedSkin, GpuError};

use crate::render::{MeshId, Paint, Renderer};

const WORKGROUP: u32 = 64;

/// The compute passes of a device, for all soft bodies.
pub struct SkinPasses {
    embed: EmbedPipeline,
    layout: wgpu::BindGroupLayout,
    paint: wgpu::ComputePipeline,
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
        let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: LABEL,
            entries: &[entry(0, true), entry(1, false)],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: LABEL,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::include_wgsl!("paint.wgsl"));
        let paint = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: LABEL,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("lay"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { embed: EmbedPipeline::new(device), layout, paint }
    }
}

const LABEL: Option<&str> = Some("paint");

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
            label: LABEL,
            size: u64::from(skin.vertices()) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: LABEL,
            layout: &passes.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: paint.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: body.normals().as_entire_binding() },
            ],
        });
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
            let groups = self.body.skin().vertices().div_ceil(WORKGROUP);
            let columns = groups.clamp(1, 32768);
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.passes.paint);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(columns, groups.div_ceil(columns), 1);
        }
        queue.submit([encoder.finish()]);
        Ok(())
    }
}
