//! The six rows of the paper's Table 1 in rapier's world, with contacts: what charts and matching cost, what rapier costs, and
//! what rapier's own soft bodies with shape matching cost in the same scene. `cargo run --release --example procdef_scenes`.
#![allow(clippy::print_stdout)] // it prints a table

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use pliant::coupling::procdef::{ProcDefStart, WaterRegion};
use pliant::math::{Pose, Vec3};
use pliant::procdef::{ProcDefModel, load_motion_rig};
use pliant::world::ProcDefWorld;
use rapier3d::prelude::*;

/// A row: rig, number of bodies, water instead of ground.
struct Row {
    rig: &'static str,
    count: u32,
    water: bool,
}

const ROWS: [Row; 6] = [
    Row { rig: "jellyfish", count: 1, water: true },
    Row { rig: "worm", count: 1, water: false },
    Row { rig: "small_jellyfish", count: 31, water: true },
    Row { rig: "short_worm", count: 101, water: false },
    Row { rig: "heart", count: 1, water: true },
    Row { rig: "bowel", count: 1, water: true },
];

/// Steps before the clock runs, in which heaps come down, and steps that are measured.
const STEPS: [u32; 2] = [240, 240];

fn places(row: &Row, model: &ProcDefModel) -> Vec<Vec3> {
    let positions = &model.rig.mesh().positions;
    let low = positions.iter().copied().fold(Vec3::MAX, Vec3::min);
    let size = positions.iter().copied().fold(Vec3::MIN, Vec3::max) - low;
    let wide = if row.count == 1 { 1 } else { f64::from(row.count).cbrt().ceil() as u32 };
    let place = |i: u32| {
        let [x, y, z] = [i % wide, i / (wide * wide), i / wide % wide].map(|k| k as f32 * 1.1);
        // Layers are shifted, so that bodies lie on several others.
        Vec3::new(x + 0.3 * y, y, z + 0.2 * y) * size - Vec3::Y * (low.y - 0.02)
    };
    (0..row.count).map(place).collect()
}

fn physics(row: &Row) -> PhysicsWorld {
    let mut physics = PhysicsWorld::new();
    physics.integration_parameters.dt = 1.0 / 120.0;
    physics.gravity = if row.water { Vec3::ZERO } else { Vec3::Y * -9.81 };
    if !row.water {
        let floor = ColliderBuilder::cuboid(50.0, 1.0, 50.0).friction(1.0);
        physics.insert(RigidBodyBuilder::fixed().translation(Vec3::Y * -1.0), floor);
    }
    physics
}

/// Milliseconds a step: all of it, the bodies' share, and of that charts and matching.
fn ours(row: &Row, model: &Arc<ProcDefModel>) -> [f64; 3] {
    let mut physics = physics(row);
    let mut world = ProcDefWorld::new();
    if row.water {
        world.water.push(WaterRegion { min: Vec3::splat(-1e3), max: Vec3::splat(1e3), flow: Vec3::ZERO });
    }
    for (i, place) in places(row, model).into_iter().enumerate() {
        let pose = Pose::from_translation(place);
        let start = ProcDefStart { pose, clock: 0.37 * i as f64, ..ProcDefStart::default() };
        world.insert(model.clone(), &start, &mut physics);
    }
    let mut times = [0.0; 3];
    for step in 0..STEPS.iter().sum() {
        let clock = Instant::now();
        physics.step();
        let rapier = clock.elapsed().as_secs_f64();
        let drive = f64::from(world.step(&mut physics).times.drive) * 1e-3;
        let all = clock.elapsed().as_secs_f64();
        if step >= STEPS[0] {
            times = [times[0] + all, times[1] + all - rapier, times[2] + drive];
        }
    }
    times.map(|t| t * 1e3 / f64::from(STEPS[1]))
}

/// Milliseconds a step of rapier's soft bodies with shape matching, which do not move by themselves.
fn rapiers(row: &Row, model: &ProcDefModel) -> f64 {
    let mut physics = physics(row);
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
    let mut time = 0.0;
    for step in 0..STEPS.iter().sum() {
        let clock = Instant::now();
        physics.step();
        time += if step >= STEPS[0] { clock.elapsed().as_secs_f64() } else { 0.0 };
    }
    time * 1e3 / f64::from(STEPS[1])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/rigs");
    println!(
        "{:16} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "rig", "bodies", "vertices", "drive", "bodies'", "step", "rapier's"
    );
    for row in &ROWS {
        let model = Arc::new(ProcDefModel::from_file(&load_motion_rig(folder.join(format!("{}.toml", row.rig)))?)?);
        let [all, bodies, drive] = ours(row, &model);
        let vertices = model.rig.masses().len();
        let rapiers = rapiers(row, &model);
        println!("{:16} {:6} {vertices:8} {drive:8.3} {bodies:8.3} {all:8.3} {rapiers:8.3}", row.rig, row.count);
    }
    Ok(())
}
