//! Whole steps in rapier's world, and those of rapier's own soft bodies in the same scene, in turns.

use std::sync::Arc;
use std::time::Instant;

use pliant::coupling::procdef::{ProcDefStart, WaterRegion};
use pliant::math::{Pose, Vec3};
use pliant::procdef::ProcDefModel;
use pliant::world::ProcDefWorld;
use rapier3d::prelude::*;
use serde::Serialize;

use super::crowd::{clock, physics, places};
use super::matching::median;
use super::rows::Row;

/// Milliseconds a step, each the median of all measured steps but where it says otherwise.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SceneTimes {
    /// Charts, local transformations, matching, damping, water.
    pub drive: f64,
    /// Contacts that are found and solved here, contacts that are felt.
    pub contact: f64,
    /// Reading and writing rapier's particles.
    pub exchange: f64,
    /// Rapier's step.
    pub rapier: f64,
    /// All of it.
    pub step: f64,
    /// The mean of all of it.
    pub mean: f64,
    /// The longest step.
    pub worst: f64,
    /// A step of rapier's own soft bodies, which do not move by themselves.
    pub rapiers_own: f64,
}

/// Measures `steps` steps after as many in which bodies come down. The scene is run several times, always the same, and each
/// part of each step counts with its quickest run, so that other work of the machine does not look like a slow step. A step is
/// the sum of its parts.
pub fn measure(row: &Row, model: &Arc<ProcDefModel>, dt: f32, steps: u32, runs: u32) -> SceneTimes {
    let mut times = run(row, model, dt, steps);
    for _ in 1..runs {
        for (list, again) in times.iter_mut().zip(run(row, model, dt, steps)) {
            list.iter_mut().zip(again).for_each(|(time, again)| *time = time.min(again));
        }
    }
    let [drive, contact, exchange, rapier, _] = &times;
    let parts = drive.iter().zip(contact).zip(exchange).zip(rapier);
    let step: Vec<f64> = parts.map(|(((a, b), c), d)| a + b + c + d).collect();
    let mean = step.iter().sum::<f64>() / step.len().max(1) as f64;
    let worst = step.iter().copied().fold(0.0, f64::max);
    let step = median(step);
    let [drive, contact, exchange, rapier, rapiers_own] = times.map(median);
    SceneTimes { drive, contact, exchange, rapier, step, mean, worst, rapiers_own }
}

/// The times of each step of one run.
fn run(row: &Row, model: &Arc<ProcDefModel>, dt: f32, steps: u32) -> [Vec<f64>; 5] {
    let mut ours = physics(row, dt);
    let mut bodies = creatures(row, model, &mut ours);
    let mut theirs = own_soft_bodies(row, model, dt);
    let mut times: [Vec<f64>; 5] = Default::default();
    for step in 0..2 * steps {
        let start = Instant::now();
        ours.step();
        let rapier = start.elapsed().as_secs_f64() * 1e3;
        let parts = bodies.step(&mut ours).times;
        let start = Instant::now();
        theirs.step();
        let own = start.elapsed().as_secs_f64() * 1e3;
        if step >= steps {
            let parts = [parts.drive, parts.contact, parts.exchange].map(f64::from);
            for (list, time) in times.iter_mut().zip([parts[0], parts[1], parts[2], rapier, own]) {
                list.push(time);
            }
        }
    }
    times
}

fn creatures(row: &Row, model: &Arc<ProcDefModel>, physics: &mut PhysicsWorld) -> ProcDefWorld {
    let mut world = ProcDefWorld::new();
    if row.water {
        world.water.push(WaterRegion { min: Vec3::splat(-1e3), max: Vec3::splat(1e3), flow: Vec3::ZERO });
    }
    for (i, place) in places(row, model).into_iter().enumerate() {
        let pose = Pose::from_translation(place);
        let start = ProcDefStart { pose, clock: clock(i), ..ProcDefStart::default() };
        world.insert(model.clone(), &start, &mut *physics);
    }
    world
}

/// Rapier's soft bodies of the same meshes, masses and surfaces, with shape matching.
fn own_soft_bodies(row: &Row, model: &ProcDefModel, dt: f32) -> PhysicsWorld {
    let mut physics = physics(row, dt);
    for place in places(row, model) {
        let positions = model.rig.mesh().positions.iter().map(|&x| x + place).collect();
        let body = SoftBodyBuilder::new(positions)
            .masses(model.rig.masses().to_vec())
            .surface(model.boundary.clone())
            .shape_matching(true)
            .particle_radius(0.1 * model.boundary_edge())
            .can_sleep(false);
        physics.insert_soft_body(body);
    }
    physics
}
