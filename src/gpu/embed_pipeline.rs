//! The two passes that deform embedded skins, one pipeline each for all bodies of a device.

use super::embedded_skin::GpuEmbeddedBody;
use super::error::GpuError;
use super::shaders::{WORKGROUP, embed_shaders};
use crate::math::Vec3;

/// Deforms embedded skins: gradients at the vertices of the body, then positions and normals of the skin. No more than
/// four storage buffers a pass.
#[derive(Clone, Debug)]
pub struct EmbedPipeline {
    layouts: [wgpu::BindGroupLayout; 2],
    pipelines: [wgpu::ComputePipeline; 2],
}

/// Which buffers of each pass are only read.
const READ_ONLY: [&[bool]; 2] = [&[true, true, false], &[true, true, false, false]];

impl EmbedPipeline {
    /// Compiles the shaders for a device.
    pub fn new(device: &wgpu::Device) -> Self {
        let layouts = READ_ONLY.map(|buffers| {
            let entry = |(binding, &read_only): (u32, &bool)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            };
            let entries: Vec<_> = (0u32..).zip(buffers).map(entry).collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: LABEL, entries: &entries })
        });
        let mut layout = layouts.iter();
        let pipelines = embed_shaders().map(|(name, text)| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(name),
                source: wgpu::ShaderSource::Wgsl(text.into()),
            });
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(name),
                bind_group_layouts: &[layout.next()],
                immediate_size: 0,
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&layout),
                module: &module,
                entry_point: Some(name),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        Self { layouts, pipelines }
    }

    /// Uploads the positions of the body's vertices, in metres, and records the passes that write positions and normals of its
    /// skin.
    ///
    /// The upload takes place when the encoder's commands are submitted; of several for one body before one submission the
    /// last one counts for all.
    ///
    /// # Errors
    /// [`GpuError::BodyVertices`] for another number of positions than the body has vertices.
    pub fn encode(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        body: &mut GpuEmbeddedBody,
        positions: &[Vec3],
    ) -> Result<(), GpuError> {
        body.upload(queue, positions)?;
        let groups = body.groups.take().unwrap_or_else(|| self.bind_groups(device, body));
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: LABEL, timestamp_writes: None });
        let counts = [body.skin().body_vertices, body.skin().skin_vertices];
        for ((pipeline, group), count) in self.pipelines.iter().zip(&groups).zip(counts) {
            let workgroups = count.div_ceil(WORKGROUP);
            let columns = workgroups.min(device.limits().max_compute_workgroups_per_dimension);
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(columns, workgroups.div_ceil(columns), 1);
        }
        drop(pass);
        body.groups = Some(groups);
        Ok(())
    }

    fn bind_groups(&self, device: &wgpu::Device, body: &GpuEmbeddedBody) -> [wgpu::BindGroup; 2] {
        let group = |layout: &wgpu::BindGroupLayout, buffers: &[&wgpu::Buffer]| {
            let entries: Vec<_> = (0u32..)
                .zip(buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: LABEL, layout, entries: &entries })
        };
        let skin = body.skin();
        let [first, second] = &self.layouts;
        [
            group(first, &[&skin.body, &body.uploaded, &body.moved]),
            group(second, &[&skin.skin, &body.moved, body.positions(), body.normals()]),
        ]
    }
}

const LABEL: Option<&str> = Some("pliant embedded skin");
