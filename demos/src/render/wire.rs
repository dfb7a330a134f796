//! Wireframes over items.

use super::list::DrawList;
use super::mesh::Meshes;
use super::pipeline::Recipe;
use super::shaders;

pub struct Wires {
    pipeline: wgpu::RenderPipeline,
}

impl Wires {
    pub fn new(device: &wgpu::Device, frame_layout: &wgpu::BindGroupLayout, meshes: &Meshes) -> Self {
        let module = shaders::module(device, "wire", shaders::WIRE);
        let groups = [frame_layout, &meshes.wire_layout];
        let recipe = Recipe {
            vertex: "wire_vertex",
            fragment: Some("wire_fragment"),
            blend: true,
            depth: Some((wgpu::CompareFunction::GreaterEqual, false)),
            cull: Some(wgpu::Face::Back),
            ..Recipe::scene("wireframes", &module, &groups)
        };
        Self { pipeline: recipe.build(device) }
    }

    /// Group 0 is set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, list: &DrawList, meshes: &Meshes) {
        pass.set_pipeline(&self.pipeline);
        for batch in list.wires() {
            batch.draw_wire(pass, meshes);
        }
    }
}
