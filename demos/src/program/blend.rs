//! A compute pass for pictures between two steps: it mixes the vertices of two states that are on the device already.

use pliant::gpu::GpuBody;

use crate::render::mesh::VERTEX_USAGE;

const WORKGROUP: u32 = 64;

/// The pipeline, one for all bodies of a device.
pub struct BlendPipeline {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

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
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        };
        let storage = |binding| entry(binding, wgpu::BufferBindingType::Storage { read_only: binding < 4 });
        let mut entries: Vec<_> = (0..6).map(storage).collect();
        entries.push(entry(6, wgpu::BufferBindingType::Uniform));
        let layout = device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("blend"), entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("blend"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::include_wgsl!("blend.wgsl"));
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("blend"),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("blend"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { layout, pipeline }
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
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("blend"),
            layout: &self.layout,
            entries: &entries,
        });
        Blended { positions, normals, share, group, vertices }
    }

    /// Records the mixing with a share of state 1 from 0 to 1.
    pub fn encode(&self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, target: &Blended, share: f32) {
        queue.write_buffer(&target.share, 0, bytemuck::cast_slice(&[share, 0.0, 0.0, 0.0]));
        let groups = target.vertices.div_ceil(WORKGROUP);
        let columns = groups.clamp(1, 32768);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &target.group, &[]);
        pass.dispatch_workgroups(columns, groups.div_ceil(columns), 1);
    }
}
