//! The last pass: from light to the colours of the target.

use super::pipeline::{self, NUMBERS, Recipe};
use super::shaders;
use super::targets::{Targets, screen_pass};

pub struct Tone {
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl Tone {
    pub fn new(
        device: &wgpu::Device,
        frame_layout: &wgpu::BindGroupLayout,
        targets: &Targets,
        format: wgpu::TextureFormat,
    ) -> Self {
        let module = shaders::module(device, "tone", shaders::TONE);
        let layout = pipeline::layout(device, "tone", &[pipeline::texture(NUMBERS)]);
        let groups = [frame_layout, &layout];
        let recipe = Recipe {
            fragment: Some(if format.is_srgb() { "linear" } else { "encoded" }),
            colour: Some(format),
            ..Recipe::screen("tone", &module, &groups)
        };
        let pipeline = recipe.build(device);
        Self { group: Self::group(device, &layout, targets), layout, pipeline }
    }

    fn group(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, targets: &Targets) -> wgpu::BindGroup {
        pipeline::group(device, layout, &[wgpu::BindingResource::TextureView(&targets.light)])
    }

    pub fn resize(&mut self, device: &wgpu::Device, targets: &Targets) {
        self.group = Self::group(device, &self.layout, targets);
    }

    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, frame: &wgpu::BindGroup, target: &wgpu::TextureView) {
        let mut pass = screen_pass(encoder, "tone", target);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
