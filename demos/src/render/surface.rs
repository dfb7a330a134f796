//! The pipelines for everything that is lit: items, ground and background.

use super::list::DrawList;
use super::mesh::Meshes;
use super::pipeline::{self, NORMAL, NUMBERS, POSITION, Recipe};
use super::shaders;
use super::shadow::ShadowMap;
use super::targets::Targets;

pub struct Surfaces {
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
    solid: wgpu::RenderPipeline,
    /// Inner faces, then outer ones.
    translucent: [wgpu::RenderPipeline; 2],
    ground: wgpu::RenderPipeline,
    backdrop: wgpu::RenderPipeline,
}

impl Surfaces {
    pub fn new(
        device: &wgpu::Device,
        ground_module: &wgpu::ShaderModule,
        frame_layout: &wgpu::BindGroupLayout,
        shadow: &ShadowMap,
        targets: &Targets,
    ) -> Self {
        let layout = pipeline::layout(
            device,
            "light",
            &[
                pipeline::texture(wgpu::TextureSampleType::Depth),
                (wgpu::ShaderStages::FRAGMENT, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)),
                pipeline::texture(NUMBERS),
            ],
        );
        let module = shaders::module(device, "surface", shaders::SURFACE);
        let groups = [frame_layout, &layout];
        let items = Recipe {
            vertex: "surface_vertex",
            buffers: &[POSITION, NORMAL],
            fragment: Some("solid_fragment"),
            cull: Some(wgpu::Face::Back),
            ..Recipe::scene("solid items", &module, &groups)
        };
        let translucent = |cull| {
            Recipe {
                label: "translucent items",
                fragment: Some("translucent_fragment"),
                blend: true,
                depth: Some((wgpu::CompareFunction::GreaterEqual, false)),
                cull: Some(cull),
                buffers: &[POSITION, NORMAL],
                vertex: "surface_vertex",
                ..Recipe::scene("translucent items", &module, &groups)
            }
            .build(device)
        };
        let ground = Recipe {
            vertex: "ground_vertex",
            fragment: Some("ground_fragment"),
            strip: true,
            ..Recipe::scene("ground", ground_module, &groups)
        };
        let backdrop = Recipe {
            vertex: "backdrop_vertex",
            fragment: Some("backdrop_fragment"),
            depth: Some((wgpu::CompareFunction::GreaterEqual, false)),
            ..Recipe::scene("backdrop", ground_module, &groups)
        };
        let group = Self::group(device, &layout, shadow, targets);
        Self {
            solid: items.build(device),
            translucent: [translucent(wgpu::Face::Front), translucent(wgpu::Face::Back)],
            ground: ground.build(device),
            backdrop: backdrop.build(device),
            group,
            layout,
        }
    }

    fn group(
        device: &wgpu::Device,
        layout: &wgpu::BindGroupLayout,
        shadow: &ShadowMap,
        targets: &Targets,
    ) -> wgpu::BindGroup {
        let resources = [
            wgpu::BindingResource::TextureView(&shadow.view),
            wgpu::BindingResource::Sampler(&shadow.sampler),
            wgpu::BindingResource::TextureView(&targets.openness),
        ];
        pipeline::group(device, layout, &resources)
    }

    pub fn resize(&mut self, device: &wgpu::Device, shadow: &ShadowMap, targets: &Targets) {
        self.group = Self::group(device, &self.layout, shadow, targets);
    }

    /// Draws what hides other things. Group 0 is set.
    pub fn draw_solid(&self, pass: &mut wgpu::RenderPass<'_>, list: &DrawList, meshes: &Meshes, ground: bool) {
        pass.set_bind_group(1, &self.group, &[]);
        pass.set_pipeline(&self.solid);
        for batch in &list.solid {
            batch.draw(pass, meshes);
        }
        if ground {
            pass.set_pipeline(&self.ground);
            pass.draw(0..4, 0..1);
        }
        pass.set_pipeline(&self.backdrop);
        pass.draw(0..3, 0..1);
    }

    /// Draws what lets light through, over the rest. Group 0 is set.
    pub fn draw_translucent(&self, pass: &mut wgpu::RenderPass<'_>, list: &DrawList, meshes: &Meshes) {
        pass.set_bind_group(1, &self.group, &[]);
        for batch in &list.translucent {
            for pipeline in &self.translucent {
                pass.set_pipeline(pipeline);
                batch.draw(pass, meshes);
            }
        }
    }
}
