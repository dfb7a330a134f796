//! The compute pipeline, one for all bodies of a device.

use super::body::GpuBody;
use super::error::GpuError;
use super::shaders::{WORKGROUP, deform_shader};
use super::skin::GpuSkin;
use crate::elastic::Palette;

/// Deforms skins: four storage buffers, one pass, one invocation a vertex.
#[derive(Clone, Debug)]
pub struct DeformPipeline {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl DeformPipeline {
    /// Compiles the shader for a device.
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
            label: Some("pliant deformation"),
            entries: &[entry(0, true), entry(1, true), entry(2, false), entry(3, false)],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("pliant deformation"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("pliant deformation"),
            source: wgpu::ShaderSource::Wgsl(deform_shader().into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("pliant deformation"),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("deform_vertices"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { layout, pipeline }
    }

    /// Uploads `palette` and records one compute pass that writes the deformed positions and normals of `body`.
    ///
    /// The upload takes place when the encoder's commands are submitted; of several palettes for one body before one
    /// submission the last one counts for all.
    ///
    /// # Errors
    /// [`GpuError`] where skin, body and palette do not belong together, or the palette is too large for the device.
    pub fn encode(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        skin: &GpuSkin,
        body: &mut GpuBody,
        palette: &Palette,
    ) -> Result<(), GpuError> {
        body.upload(device, queue, skin, palette)?;
        let group = body.bind_group(device, &self.layout, skin);
        let groups = skin.vertices.div_ceil(WORKGROUP);
        let columns = groups.min(device.limits().max_compute_workgroups_per_dimension);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("pliant deformation"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(columns, groups.div_ceil(columns), 1);
        Ok(())
    }
}
