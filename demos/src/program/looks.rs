//! What a scene looks like that says little about it: materials, light, and the region in which shadows fall.

use glam::Vec3;

use crate::render::{Camera, Ground, Material, Region, Sun};
use crate::scene::{self, Obstacle, ObstacleShape, Scene};
use crate::simulation::{Actor, Simulation, SoftActor};

/// A fixed, level box at least this wide in both directions is drawn as the ground, in metres.
const GROUND_WIDTH: f32 = 20.0;

/// The camera of a scene.
pub fn camera(of: &scene::Camera) -> Camera {
    let near = (0.01 * of.eye.distance(of.target)).clamp(0.01, 0.1);
    Camera { eye: of.eye, target: of.target, fov: of.fov_degrees.to_radians(), near, ..Camera::default() }
}

/// A sun over the left shoulder of who looks along the scene's camera: it reaches into what is open towards the camera,
/// and shadows fall away to the right.
pub fn sun(of: &scene::Camera) -> Sun {
    let back = (of.eye - of.target).with_y(0.0).normalize_or(Vec3::Z);
    let left = back.cross(Vec3::Y);
    Sun { direction: 0.75 * back + 0.6 * left + 1.15 * Vec3::Y, ..Sun::default() }
}

/// Scenes give colours as screens show them; light is reckoned linear.
pub fn linear(colour: [f32; 3]) -> Vec3 {
    let decode = |c: f32| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    Vec3::from_array(colour.map(decode))
}

/// The skin of a body.
pub fn body(actor: &Actor) -> Material {
    let skin = Material::skin();
    Material { colour: actor.colour.map_or(skin.colour, linear), ..skin }
}

/// The flesh of a body that moves by itself: wet, and light goes into it. Colours of rigs are linear already.
pub fn soft_body(actor: &SoftActor) -> Material {
    let own = actor.kind.colour.map_or(Vec3::new(0.55, 0.32, 0.26), Vec3::from_array);
    let colour = actor.colour.map_or(own, linear);
    Material { colour, alpha: actor.opacity, roughness: 0.42, clearcoat: 0.35, subsurface: 0.8, ..Material::default() }
}

/// An obstacle: dark lacquer for bars, slate for walls, stone for meshes, varnish for balls; glass where one sees through.
pub fn obstacle(obstacle: &Obstacle) -> Material {
    let stone = Material { roughness: 0.75, ..Material::plain(Vec3::new(0.30, 0.285, 0.27)) };
    let wall = Material { colour: Vec3::new(0.36, 0.39, 0.43), ..Material::slate() };
    let bar = Material { colour: Vec3::new(0.07, 0.09, 0.13), roughness: 0.4, clearcoat: 0.6, ..Material::default() };
    let usual = match &obstacle.shape {
        ObstacleShape::Cylinder { .. } | ObstacleShape::Capsule { .. } => bar,
        ObstacleShape::Cuboid { half_extents, .. } if is_slender(*half_extents) => bar,
        ObstacleShape::Ball { .. } => Material::glossy(Vec3::new(0.42, 0.07, 0.05)),
        ObstacleShape::Mesh { .. } | ObstacleShape::TriangleMesh { .. } | ObstacleShape::HeightField { .. } => stone,
        ObstacleShape::Ring { .. } => {
            Material { colour: Vec3::new(0.16, 0.17, 0.19), roughness: 0.28, ..Material::steel() }
        }
        _ => wall,
    };
    let solid = match obstacle.colour {
        Some(colour) => Material { colour: linear(colour), ..usual },
        None => usual,
    };
    if obstacle.opacity >= 1.0 {
        return solid;
    }
    // Dark glass: a bright one would be a veil over what is behind it.
    let glass = Material { colour: Vec3::new(0.10, 0.15, 0.20), ..Material::glass() };
    let colour = obstacle.colour.map_or(glass.colour, linear);
    Material { colour, alpha: 0.6 * obstacle.opacity, ..glass }
}

/// Whether a box is a beam rather than a wall.
fn is_slender(half_extents: Vec3) -> bool {
    let mut sides = half_extents.to_array();
    sides.sort_by(f32::total_cmp);
    sides[2] > 4.0 * sides[1]
}

/// The ground that an obstacle is, if it is one.
pub fn ground(obstacle: &Obstacle) -> Option<Ground> {
    let ObstacleShape::Cuboid { half_extents, rounding: 0.0 } = obstacle.shape else { return None };
    let level = (obstacle.pose.rotation * Vec3::Y).y > 0.999_999;
    let wide = half_extents.x.min(half_extents.z) * 2.0 >= GROUND_WIDTH;
    if !obstacle.is_fixed() || !level || !wide || obstacle.opacity < 1.0 {
        return None;
    }
    let usual = Ground::default();
    Some(Ground {
        height: obstacle.pose.translation.y + half_extents.y,
        colour: obstacle.colour.map_or(usual.colour, linear),
        ..usual
    })
}

/// A ball around all that the scene begins with, and the ground under it.
pub fn region(simulation: &Simulation, ground: Option<&Ground>) -> Region {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let mut take = |p: Vec3| (low, high) = (low.min(p), high.max(p));
    for actor in &simulation.actors {
        if let Some(body) = simulation.deformation.get(actor.handle) {
            body.positions().iter().for_each(|p| take(*p));
        }
    }
    for actor in &simulation.soft_actors {
        if let Some(body) = simulation.creatures.get(actor.handle) {
            body.positions().iter().for_each(|p| take(*p));
        }
    }
    if !simulation.soft_actors.is_empty() {
        // They go about in what the camera shows.
        let camera = &simulation.scene.camera;
        let seen = camera.eye.distance(camera.target) * (0.5 * camera.fov_degrees.to_radians()).tan();
        take(camera.target - seen);
        take(camera.target + seen);
    }
    for obstacle in simulation.obstacles.iter().filter(|o| self::ground(&o.obstacle).is_none()) {
        let way = obstacle.obstacle.path.as_ref().map_or(vec![Vec3::ZERO], |path| path.points.clone());
        let pose = obstacle.obstacle.pose;
        for part in &obstacle.parts {
            let placed = part.positions.iter().map(|p| pose.transform_point(part.pose.transform_point(*p)));
            placed.for_each(|p| way.iter().for_each(|step| take(p + *step)));
        }
    }
    if low.x > high.x {
        return Region::default();
    }
    if let Some(ground) = ground {
        low.y = low.y.min(ground.height);
    }
    Region { centre: 0.5 * (low + high), radius: (0.5 * low.distance(high)).clamp(1.0, 100.0) }
}

/// Where the fade into the horizon begins and how far it takes: behind all that matters.
pub fn fog(scene: &Scene, region: &Region) -> [f32; 2] {
    let far = scene.camera.eye.distance(region.centre) + region.radius;
    [far, 3.0 * far]
}
