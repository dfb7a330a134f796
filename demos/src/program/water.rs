//! How water looks: from inside a blue that fades into the distance, from outside a clear block.

use glam::{Mat4, Vec3};

use crate::render::{Frame, Ground, Material, MeshId, Renderer, Sky, Sun, shapes};
use crate::scene::{Scene, Water};

/// Water that is wider than this is not drawn as a block, in metres.
const WIDEST_BLOCK: f32 = 200.0;

/// Whether the scene's camera is in the water.
pub fn is_diving(scene: &Scene) -> bool {
    let eye = scene.camera.eye;
    scene.water.iter().any(|water| eye.cmpge(water.min).all() && eye.cmple(water.max).all())
}

/// The blocks of water that are seen from outside, and where they are.
pub fn boxes(renderer: &mut Renderer, scene: &Scene) -> Vec<(MeshId, Mat4)> {
    if is_diving(scene) {
        return Vec::new();
    }
    let small = |water: &&Water| (water.max - water.min).max_element() < WIDEST_BLOCK;
    let blocks = scene.water.iter().filter(small).map(|water| {
        let half = 0.5 * (water.max - water.min);
        (renderer.add_mesh(&shapes::cuboid(half, 0.0)), Mat4::from_translation(water.min + half))
    });
    blocks.collect()
}

/// What such a block is made of.
pub fn material() -> Material {
    Material { colour: Vec3::new(0.05, 0.25, 0.38), alpha: 0.14, roughness: 0.1, ..Material::default() }
}

/// Takes a picture under water: light from above, blue around, dark below, and nothing seen far away.
pub fn dive(frame: &mut Frame) {
    frame.sky = Sky {
        zenith: Vec3::new(0.50, 1.45, 1.75),
        horizon: Vec3::new(0.022, 0.19, 0.36),
        bounce: Vec3::new(0.003, 0.022, 0.055),
        depth: 1.0,
        fill: 1.1,
    };
    let direction = 0.35 * frame.sun.direction + 1.2 * Vec3::Y;
    frame.sun = Sun { direction, colour: Vec3::new(4.4, 4.1, 3.9), softness: 0.08 };
    frame.ground = frame.ground.map(|ground| Ground { colour: ground.colour * Vec3::new(0.75, 0.8, 0.7), ..ground });
    // Light comes from all sides: nothing is dark in its corners.
    frame.occlusion_radius = 0.0;
    let reach = frame.camera.eye.distance(frame.region.centre);
    frame.fog = [0.55 * reach, 1.6 * reach];
}
