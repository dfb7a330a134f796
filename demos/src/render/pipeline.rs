//! Short words for the long descriptors of bindings and pipelines.

use super::targets::{DEPTH, SAMPLES};

/// A uniform buffer that all stages see.
pub fn uniform() -> (wgpu::ShaderStages, wgpu::BindingType) {
    (wgpu::ShaderStages::VERTEX_FRAGMENT, buffer(wgpu::BufferBindingType::Uniform))
}

/// A storage buffer that the given stages read.
pub fn storage(stages: wgpu::ShaderStages) -> (wgpu::ShaderStages, wgpu::BindingType) {
    (stages, buffer(wgpu::BufferBindingType::Storage { read_only: true }))
}

fn buffer(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A texture that fragments load texels from.
pub fn texture(sample_type: wgpu::TextureSampleType) -> (wgpu::ShaderStages, wgpu::BindingType) {
    let ty =
        wgpu::BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false };
    (wgpu::ShaderStages::FRAGMENT, ty)
}

/// A texture of plain numbers.
pub const NUMBERS: wgpu::TextureSampleType = wgpu::TextureSampleType::Float { filterable: false };

/// A layout whose bindings are numbered in order.
pub fn layout(
    device: &wgpu::Device,
    label: &str,
    bindings: &[(wgpu::ShaderStages, wgpu::BindingType)],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = bindings
        .iter()
        .enumerate()
        .map(|(i, (visibility, ty))| wgpu::BindGroupLayoutEntry {
            binding: i as u32,
            visibility: *visibility,
            ty: *ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// A group whose resources are numbered in order.
pub fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .enumerate()
        .map(|(i, resource)| wgpu::BindGroupEntry { binding: i as u32, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// Position, and normal if wanted, of a mesh.
pub const POSITION: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 16,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4],
};

/// Normal and paint of a vertex; see [`POSITION`].
pub const NORMAL: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 16,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Float32x3, 2 => Uint32],
};

/// What differs between the pipelines of this renderer.
pub struct Recipe<'a> {
    /// Label for tools.
    pub label: &'a str,
    /// Shader module.
    pub module: &'a wgpu::ShaderModule,
    /// Layouts of the bind groups.
    pub groups: &'a [&'a wgpu::BindGroupLayout],
    /// Vertex entry point.
    pub vertex: &'a str,
    /// Vertex buffers.
    pub buffers: &'a [wgpu::VertexBufferLayout<'static>],
    /// Fragment entry point, if there is a fragment stage.
    pub fragment: Option<&'a str>,
    /// Colour format, if colours are written.
    pub colour: Option<wgpu::TextureFormat>,
    /// Whether colours are blended, premultiplied.
    pub blend: bool,
    /// Depth comparison and whether depth is written, if there is a depth buffer.
    pub depth: Option<(wgpu::CompareFunction, bool)>,
    /// Faces left out.
    pub cull: Option<wgpu::Face>,
    /// Whether four vertices make a strip of two triangles.
    pub strip: bool,
    /// Samples a pixel.
    pub samples: u32,
}

impl<'a> Recipe<'a> {
    /// A pipeline of the main pass.
    pub fn scene(label: &'a str, module: &'a wgpu::ShaderModule, groups: &'a [&'a wgpu::BindGroupLayout]) -> Self {
        Self {
            label,
            module,
            groups,
            vertex: "",
            buffers: &[],
            fragment: None,
            colour: Some(super::targets::LIGHT),
            blend: false,
            depth: Some((wgpu::CompareFunction::GreaterEqual, true)),
            cull: None,
            strip: false,
            samples: SAMPLES,
        }
    }

    /// A pass over the whole screen without depth.
    pub fn screen(label: &'a str, module: &'a wgpu::ShaderModule, groups: &'a [&'a wgpu::BindGroupLayout]) -> Self {
        Self { vertex: "whole_screen", depth: None, samples: 1, ..Self::scene(label, module, groups) }
    }

    /// Makes the pipeline.
    pub fn build(&self, device: &wgpu::Device) -> wgpu::RenderPipeline {
        let groups: Vec<_> = self.groups.iter().map(|group| Some(*group)).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let buffers: Vec<_> = self.buffers.iter().cloned().map(Some).collect();
        let targets: Vec<_> = self
            .colour
            .map(|format| {
                Some(wgpu::ColorTargetState {
                    format,
                    blend: self.blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })
            })
            .into_iter()
            .collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some(self.vertex),
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: if self.strip {
                    wgpu::PrimitiveTopology::TriangleStrip
                } else {
                    wgpu::PrimitiveTopology::TriangleList
                },
                cull_mode: self.cull,
                ..Default::default()
            },
            depth_stencil: self.depth.map(|(compare, write)| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(write),
                depth_compare: Some(compare),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: self.samples, ..Default::default() },
            fragment: self.fragment.map(|entry| wgpu::FragmentState {
                module: self.module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
