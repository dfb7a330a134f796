//! What the shaders read, laid out as they read it (`view.wgsl`, `scene.wgsl`).

use bytemuck::{Pod, Zeroable};
use glam::{Mat3, Mat4, Vec3};

use super::frame::{Frame, Item};
use super::shadow::LightSpace;

/// Mirrors `View` of `view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct View {
    view_proj: [[f32; 4]; 4],
    light: [[f32; 4]; 4],
    eye: [f32; 4],
    right: [f32; 4],
    up: [f32; 4],
    forward: [f32; 4],
    sun: [f32; 4],
    sun_colour: [f32; 4],
    light_x: [f32; 4],
    light_y: [f32; 4],
    zenith: [f32; 4],
    horizon: [f32; 4],
    bounce: [f32; 4],
    ground: [f32; 4],
    ground_colour: [f32; 4],
    size: [f32; 4],
    occlusion: [f32; 4],
}

fn with(v: Vec3, w: f32) -> [f32; 4] {
    v.extend(w).to_array()
}

impl View {
    /// The view of a frame on a target of `size`, with half-size images of `half`.
    pub fn new(frame: &Frame, size: [u32; 2], half: [u32; 2]) -> Self {
        let camera = &frame.camera;
        let aspect = size[0] as f32 / size[1] as f32;
        let [right, up, forward] = camera.axes();
        let tangent = (0.5 * camera.fov).tan();
        let light = LightSpace::new(&frame.sun, &frame.region);
        let ground = frame.ground.unwrap_or_default();
        let occlusion = if frame.occlusion_radius > 0.0 { 1.0 } else { 0.0 };
        Self {
            view_proj: camera.view_projection(aspect).to_cols_array_2d(),
            light: light.matrix.to_cols_array_2d(),
            eye: with(camera.eye, camera.near),
            right: with(right, tangent * aspect),
            up: with(up, tangent),
            forward: with(forward, 0.0),
            sun: with(light.towards, frame.sun.softness),
            sun_colour: with(frame.sun.colour, 0.0),
            light_x: with(light.x, light.half_extent),
            light_y: with(light.y, light.range),
            zenith: with(frame.sky.zenith, frame.sky.fill),
            horizon: with(frame.sky.horizon, frame.sky.depth),
            bounce: with(frame.sky.bounce, 0.0),
            ground: [ground.height, ground.grid, frame.fog[0], frame.fog[1].max(1e-3)],
            ground_colour: with(ground.colour, 0.0),
            size: [size[0] as f32, size[1] as f32, half[0] as f32, half[1] as f32],
            occlusion: [frame.occlusion_radius.max(1e-3), occlusion, frame.exposure, frame.overlay.hidden],
        }
    }
}

/// Mirrors `Instance` of `scene.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Instance {
    model: [[f32; 4]; 4],
    normal: [[f32; 4]; 3],
    colour: [f32; 4],
    surface: [f32; 4],
    depth: [f32; 4],
    wire: [f32; 4],
}

impl From<&Item> for Instance {
    fn from(item: &Item) -> Self {
        let m = &item.material;
        let normal = normal_matrix(item.transform);
        Self {
            model: item.transform.to_cols_array_2d(),
            normal: [with(normal.x_axis, 0.0), with(normal.y_axis, 0.0), with(normal.z_axis, 0.0)],
            colour: with(m.colour, m.alpha),
            surface: [m.roughness, m.metallic, m.clearcoat, m.sheen],
            depth: [m.subsurface, 0.0, 0.0, 0.0],
            wire: item.wire.unwrap_or_default(),
        }
    }
}

/// Cofactors of the linear part: the inverse transpose up to a factor, and defined even where that is not.
fn normal_matrix(transform: Mat4) -> Mat3 {
    let m = Mat3::from_mat4(transform);
    let cofactors = Mat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    if m.determinant() < 0.0 { -cofactors } else { cofactors }
}
