//! A rapier world with one or more bodies from the rig files.

use std::path::Path;
use std::sync::Arc;

use pliant::coupling::procdef::{ProcDefStart, WaterRegion};
use pliant::math::{Pose, Vec3};
use pliant::procdef::{ContactKind, ProcDefBody, ProcDefModel, load_motion_rig};
use pliant::world::{ProcDefHandle, ProcDefWorld};
use rapier3d::prelude::*;

pub struct Scene {
    pub physics: PhysicsWorld,
    pub bodies: ProcDefWorld,
    pub substeps: u32,
}

pub fn model(name: &str) -> Arc<ProcDefModel> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/rigs");
    let file = load_motion_rig(folder.join(format!("{name}.toml"))).unwrap_or_else(|e| panic!("{e}"));
    Arc::new(ProcDefModel::from_file(&file).expect("a model"))
}

/// A kind of body whose contacts are made by this crate.
pub fn with_vertices(name: &str) -> Arc<ProcDefModel> {
    let mut kind = (*model(name)).clone();
    kind.contacts = ContactKind::Vertices;
    Arc::new(kind)
}

impl Scene {
    pub fn new(gravity: f32, substeps: u32) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vec3::Y * -gravity;
        physics.integration_parameters.dt = 1.0 / 60.0;
        Self { physics, bodies: ProcDefWorld::new(), substeps }
    }

    pub fn floor(&mut self) {
        let floor = ColliderBuilder::cuboid(50.0, 1.0, 50.0).friction(1.0);
        self.physics.insert(RigidBodyBuilder::fixed().translation(Vec3::Y * -1.0), floor);
    }

    pub fn ocean(&mut self) {
        let water = WaterRegion { min: Vec3::splat(-100.0), max: Vec3::splat(100.0), flow: Vec3::ZERO };
        self.bodies.water.push(water);
    }

    pub fn insert(&mut self, model: &Arc<ProcDefModel>, at: Vec3) -> ProcDefHandle {
        let start = ProcDefStart { pose: Pose::from_translation(at), ..ProcDefStart::default() };
        self.bodies.insert(model.clone(), &start, &mut self.physics)
    }

    /// On the floor, with its lowest vertex a centimetre above it.
    pub fn insert_on_floor(&mut self, model: &Arc<ProcDefModel>) -> ProcDefHandle {
        let lowest = model.rig.mesh().positions.iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
        self.insert(model, Vec3::Y * (0.01 - lowest))
    }

    /// Runs for so many seconds.
    pub fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds * 60.0).round() as u32 {
            self.bodies.advance(&mut self.physics, self.substeps);
        }
    }

    pub fn body(&self, handle: ProcDefHandle) -> &ProcDefBody {
        self.bodies.get(handle).expect("a body")
    }

    pub fn centre(&self, handle: ProcDefHandle) -> Vec3 {
        let body = self.body(handle);
        let masses = body.rig().masses();
        let moment: glam::DVec3 = body.positions().iter().zip(masses).map(|(x, &m)| x.as_dvec3() * f64::from(m)).sum();
        (moment / masses.iter().map(|&m| f64::from(m)).sum::<f64>()).as_vec3()
    }

    pub fn momentum(&self, handle: ProcDefHandle) -> Vec3 {
        let soft = &self.physics.soft_bodies[self.bodies.link(handle).expect("a link").soft_body];
        soft.particles().iter().map(|p| p.velocity() * p.mass()).sum()
    }
}

/// The extents of the box around some points.
pub fn extents(points: &[Vec3]) -> Vec3 {
    let low = points.iter().copied().reduce(Vec3::min).expect("points");
    points.iter().copied().reduce(Vec3::max).expect("points") - low
}
