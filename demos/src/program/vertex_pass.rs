//! A compute pass of the program with one invocation a vertex: its layout, its pipeline, and how it is recorded.

const WORKGROUP: u32 = 64;

/// One pass, for all bodies of a device.
pub struct VertexPass {
    name: &'static str,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// A buffer that a pass reads.
pub const READ: wgpu::BufferBindingType = wgpu::BufferBindingType::Storage { read_only: true };
/// A buffer that it writes.
pub const WRITTEN: wgpu::BufferBindingType = wgpu::BufferBindingType::Storage { read_only: false };
/// A few numbers for all vertices.
pub const UNIFORM: wgpu::BufferBindingType = wgpu::BufferBindingType::Uniform;

impl VertexPass {
    /// Compiles a shader whose entry point has this name, with these buffers in the order of their bindings.
    pub fn new(
        device: &wgpu::Device,
        name: &'static str,
        shader: wgpu::ShaderModuleDescriptor<'_>,
        buffers: &[wgpu::BufferBindingType],
    ) -> Self {
        let entry = |(binding, &ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        };
        let entries: Vec<_> = (0..).zip(buffers).map(entry).collect();
        let label = Some(name);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(shader);
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(name),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { name, layout, pipeline }
    }

    /// The buffers of one body, in the order of their bindings.
    pub fn group(&self, device: &wgpu::Device, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let (label, layout) = (Some(self.name), &self.layout);
        device.create_bind_group(&wgpu::BindGroupDescriptor { label, layout, entries: &entries })
    }

    /// Records the pass for so many vertices.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, group: &wgpu::BindGroup, vertices: u32) {
        let groups = vertices.div_ceil(WORKGROUP);
        let columns = groups.clamp(1, 32768);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(columns, groups.div_ceil(columns), 1);
    }
}
