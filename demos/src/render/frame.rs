//! One picture in words: where the eye is, where the light comes from, and what stands where.

use glam::{Mat4, Vec2, Vec3};

use super::{Material, MeshId, Overlay};

/// The eye. The y axis of the world points up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: Vec3,
    /// What it looks at.
    pub target: Vec3,
    /// Which way is up in the picture.
    pub up: Vec3,
    /// Vertical field of view, in radians.
    pub fov: f32,
    /// What is nearer than this is not drawn, in metres.
    pub near: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { eye: Vec3::new(4.0, 2.5, 6.0), target: Vec3::Y, up: Vec3::Y, fov: 0.6, near: 0.05 }
    }
}

impl Camera {
    /// A camera at `eye` that looks at `target`.
    pub fn looking(eye: Vec3, target: Vec3) -> Self {
        Self { eye, target, ..Self::default() }
    }

    /// The directions right, up and forward of the picture in the world.
    pub fn axes(&self) -> [Vec3; 3] {
        let forward = (self.target - self.eye).normalize_or(Vec3::NEG_Z);
        let right = forward.cross(self.up).normalize_or(Vec3::X);
        [right, right.cross(forward), forward]
    }

    /// From the world to clip space; depth is one at the near plane and falls to zero at infinity.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        let [right, up, forward] = self.axes();
        let view = Mat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), glam::Vec4::W)
            .transpose()
            * Mat4::from_translation(-self.eye);
        let f = 1.0 / (0.5 * self.fov).tan();
        let projection = Mat4::from_cols_array_2d(&[
            [f / aspect, 0.0, 0.0, 0.0],
            [0.0, f, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, self.near, 0.0],
        ]);
        projection * view
    }

    /// Origin and unit direction of the ray through a place of the picture: (-1, -1) lower left, (1, 1) upper right.
    pub fn ray(&self, place: Vec2, aspect: f32) -> (Vec3, Vec3) {
        let [right, up, forward] = self.axes();
        let t = (0.5 * self.fov).tan();
        (self.eye, (forward + right * (place.x * t * aspect) + up * (place.y * t)).normalize())
    }
}

/// The light with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// From the world towards the light; need not be of length one.
    pub direction: Vec3,
    /// Light that reaches a surface that faces it.
    pub colour: Vec3,
    /// Tangent of the angular radius: how soft shadows are.
    pub softness: f32,
}

impl Default for Sun {
    fn default() -> Self {
        Self { direction: Vec3::new(-0.75, 1.0, 0.45), colour: Vec3::new(5.3, 4.95, 4.4), softness: 0.04 }
    }
}

/// The light from everywhere: radiance overhead, at the horizon and back from below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Straight up.
    pub zenith: Vec3,
    /// At the horizon, which is the background of most pictures.
    pub horizon: Vec3,
    /// From below.
    pub bounce: Vec3,
    /// How far the background turns to the light from below, straight down: 0 for not at all, as over a ground.
    pub depth: f32,
    /// Share of this light that reaches surfaces; below one, the background is lighter than what it lights.
    pub fill: f32,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            zenith: Vec3::new(0.95, 1.15, 1.45),
            horizon: Vec3::new(2.4, 2.42, 2.46),
            bounce: Vec3::new(0.80, 0.74, 0.68),
            depth: 0.0,
            fill: 0.36,
        }
    }
}

/// A plane without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Where it cuts the y axis.
    pub height: f32,
    /// Base colour.
    pub colour: Vec3,
    /// How dark the lines of the metre grid are, in 0..1.
    pub grid: f32,
}

impl Default for Ground {
    fn default() -> Self {
        Self { height: 0.0, colour: Vec3::new(0.70, 0.70, 0.71), grid: 0.3 }
    }
}

/// The ball of space in which things cast shadows. Keep it still while a scene plays, and shadows do not crawl.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Middle.
    pub centre: Vec3,
    /// Radius in metres.
    pub radius: f32,
}

impl Default for Region {
    fn default() -> Self {
        Self { centre: Vec3::Y, radius: 8.0 }
    }
}

/// A mesh at a place in a material.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// Which mesh.
    pub mesh: MeshId,
    /// From the mesh to the world.
    pub transform: Mat4,
    /// What it looks like.
    pub material: Material,
    /// Colour and opacity of its edges, drawn over it.
    pub wire: Option<[f32; 4]>,
    /// Whether it darkens what is behind it in the sun; what is nearly clear never does.
    pub casts_shadow: bool,
}

impl Item {
    /// An item that casts a shadow and has no wireframe.
    pub fn new(mesh: MeshId, transform: Mat4, material: Material) -> Self {
        Self { mesh, transform, material, wire: None, casts_shadow: true }
    }
}

/// All that one picture shows.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The eye.
    pub camera: Camera,
    /// The light with a direction.
    pub sun: Sun,
    /// The light from everywhere.
    pub sky: Sky,
    /// The ground, if there is one.
    pub ground: Option<Ground>,
    /// Where shadows are cast.
    pub region: Region,
    /// What is drawn.
    pub items: Vec<Item>,
    /// Lines and balls over it.
    pub overlay: Overlay,
    /// Factor on all light.
    pub exposure: f32,
    /// Reach of ambient occlusion in metres; none if zero.
    pub occlusion_radius: f32,
    /// Where the fade into the horizon begins and how far it takes, in metres from the eye.
    pub fog: [f32; 2],
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            sun: Sun::default(),
            sky: Sky::default(),
            ground: Some(Ground::default()),
            region: Region::default(),
            items: Vec::new(),
            overlay: Overlay::default(),
            exposure: 1.0,
            occlusion_radius: 0.6,
            fog: [15.0, 60.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_passes_through_what_it_shows() {
        let camera = Camera::looking(Vec3::new(3.0, 2.0, 5.0), Vec3::new(0.0, 1.0, 0.0));
        let place = Vec2::new(0.3, -0.6);
        let (origin, direction) = camera.ray(place, 1.5);
        let clip = camera.view_projection(1.5) * (origin + 7.0 * direction).extend(1.0);
        assert!((clip.truncate().truncate() / clip.w - place).length() < 1e-5);
        assert!(clip.z / clip.w > 0.0 && clip.z / clip.w < 1.0);
    }
}
