//! The sun's view of the scene: the depth map that shadows are found in.
//!
//! The map covers a fixed ball, whatever the camera does, and its middle moves only by whole texels: edges of shadows
//! do not crawl.

use glam::{Mat4, Vec3};

use super::frame::{Region, Sun};
use super::list::DrawList;
use super::mesh::Meshes;
use super::pipeline::{POSITION, Recipe};
use super::targets::DEPTH;

/// Texels along a side of the map.
pub const MAP_SIZE: u32 = 2048;

/// How the sun sees the world.
pub struct LightSpace {
    /// World to the map's clip space; depth grows away from the sun.
    pub matrix: Mat4,
    /// Unit vector towards the sun.
    pub towards: Vec3,
    /// The map's axis to the right.
    pub x: Vec3,
    /// The map's axis upwards.
    pub y: Vec3,
    /// Half of the map's side, in metres.
    pub half_extent: f32,
    /// Metres of depth in the map.
    pub range: f32,
}

impl LightSpace {
    /// Fits the map to a ball. Casters count up to four radii towards the sun.
    pub fn new(sun: &Sun, region: &Region) -> Self {
        let towards = sun.direction.normalize_or(Vec3::Y);
        let x = Vec3::Y.cross(towards).try_normalize().unwrap_or(Vec3::X);
        let y = towards.cross(x);
        let half_extent = region.radius.max(0.1);
        let texel = 2.0 * half_extent / MAP_SIZE as f32;
        let snapped = |axis: Vec3| (region.centre.dot(axis) / texel).round() * texel;
        let (before, after) = (4.0 * half_extent, 2.0 * half_extent);
        let range = before + after;
        let rows = [
            (x / half_extent).extend(-snapped(x) / half_extent),
            (y / half_extent).extend(-snapped(y) / half_extent),
            (-towards / range).extend((region.centre.dot(towards) + before) / range),
            glam::Vec4::W,
        ];
        let matrix = Mat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
        Self { matrix, towards, x, y, half_extent, range }
    }
}

/// The depth map and the pipeline that fills it.
pub struct ShadowMap {
    /// The map.
    pub view: wgpu::TextureView,
    /// Compares and blends four texels.
    pub sampler: wgpu::Sampler,
    pipeline: wgpu::RenderPipeline,
}

impl ShadowMap {
    pub fn new(device: &wgpu::Device, module: &wgpu::ShaderModule, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: MAP_SIZE, height: MAP_SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow comparison"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let groups = [frame_layout];
        let pipeline = Recipe {
            vertex: "caster_vertex",
            fragment: Some("caster_fragment"),
            buffers: &[POSITION],
            colour: None,
            depth: Some((wgpu::CompareFunction::LessEqual, true)),
            samples: 1,
            ..Recipe::scene("shadow casters", module, &groups)
        }
        .build(device);
        Self { view: texture.create_view(&Default::default()), sampler, pipeline }
    }

    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, frame: &wgpu::BindGroup, list: &DrawList, meshes: &Meshes) {
        let mut pass = super::targets::depth_pass(encoder, "shadow map", &self.view, 1.0);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, frame, &[]);
        for batch in list.casters() {
            batch.draw_positions(&mut pass, meshes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_region_fits_into_the_map() {
        let region = Region { centre: Vec3::new(3.0, 5.0, -2.0), radius: 7.0 };
        let light = LightSpace::new(&Sun::default(), &region);
        let corners = [light.x, light.y, light.towards];
        for axis in corners.into_iter().flat_map(|axis| [axis, -axis]) {
            let clip = light.matrix.transform_point3(region.centre + axis * region.radius);
            assert!(clip.x.abs() < 1.01 && clip.y.abs() < 1.01, "{clip}");
            assert!(clip.z > 0.0 && clip.z < 1.0, "{clip}");
        }
        let far = light.matrix.transform_point3(region.centre - light.towards);
        let near = light.matrix.transform_point3(region.centre + light.towards);
        assert!(near.z < far.z);
    }
}
