//! Ambient occlusion: a small depth image of what is solid, and from it how open each place is to the light from
//! everywhere. Done before the main pass, so that only that light is dimmed by it, and not the sun.

use super::list::DrawList;
use super::mesh::Meshes;
use super::pipeline::{self, NUMBERS, POSITION, Recipe};
use super::shaders;
use super::targets::{OPENNESS, Targets, depth_pass, screen_pass};

pub struct Occlusion {
    layout: wgpu::BindGroupLayout,
    items: wgpu::RenderPipeline,
    ground: wgpu::RenderPipeline,
    gather: wgpu::RenderPipeline,
    smooth: wgpu::RenderPipeline,
    gather_group: wgpu::BindGroup,
    smooth_group: wgpu::BindGroup,
}

impl Occlusion {
    pub fn new(
        device: &wgpu::Device,
        caster: &wgpu::ShaderModule,
        ground: &wgpu::ShaderModule,
        frame_layout: &wgpu::BindGroupLayout,
        targets: &Targets,
    ) -> Self {
        let module = shaders::module(device, "occlusion", shaders::OCCLUSION);
        let layout = pipeline::layout(
            device,
            "occlusion",
            &[pipeline::texture(wgpu::TextureSampleType::Depth), pipeline::texture(NUMBERS)],
        );
        let frame_only = [frame_layout];
        let depth = |module, vertex, buffers, fragment, strip| {
            Recipe {
                vertex,
                buffers,
                fragment,
                strip,
                colour: None,
                samples: 1,
                ..Recipe::scene("half-size depth", module, &frame_only)
            }
            .build(device)
        };
        let groups = [frame_layout, &layout];
        let screen = |fragment| {
            Recipe { fragment: Some(fragment), colour: Some(OPENNESS), ..Recipe::screen(fragment, &module, &groups) }
                .build(device)
        };
        let [gather_group, smooth_group] = Self::groups(device, &layout, targets);
        Self {
            items: depth(caster, "depth_vertex", &[POSITION][..], None, false),
            ground: depth(ground, "ground_vertex", &[][..], Some("depth_only"), true),
            gather: screen("gather"),
            smooth: screen("smooth_out"),
            gather_group,
            smooth_group,
            layout,
        }
    }

    fn groups(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, targets: &Targets) -> [wgpu::BindGroup; 2] {
        // The first pass writes `gathered` and reads depth alone; its second binding only fills the layout.
        [&targets.openness, &targets.gathered].map(|image| {
            pipeline::group(
                device,
                layout,
                &[wgpu::BindingResource::TextureView(&targets.half_depth), wgpu::BindingResource::TextureView(image)],
            )
        })
    }

    pub fn resize(&mut self, device: &wgpu::Device, targets: &Targets) {
        [self.gather_group, self.smooth_group] = Self::groups(device, &self.layout, targets);
    }

    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &wgpu::BindGroup,
        (list, meshes, ground): (&DrawList, &Meshes, bool),
    ) {
        {
            let mut pass = depth_pass(encoder, "half-size depth", &targets.half_depth, 0.0);
            pass.set_bind_group(0, frame, &[]);
            pass.set_pipeline(&self.items);
            for batch in &list.solid {
                batch.draw_positions(&mut pass, meshes);
            }
            if ground {
                pass.set_pipeline(&self.ground);
                pass.draw(0..4, 0..1);
            }
        }
        for (pipeline, group, view) in [
            (&self.gather, &self.gather_group, &targets.gathered),
            (&self.smooth, &self.smooth_group, &targets.openness),
        ] {
            let mut pass = screen_pass(encoder, "occlusion", view);
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, frame, &[]);
            pass.set_bind_group(1, group, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
