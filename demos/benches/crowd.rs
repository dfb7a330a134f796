//! What a crowd costs: 1, 10, 30 and 100 camels in one tower, stage by stage, and how the cost grows.
//!
//! In the first table the tower is as large as the crowd: its bars, beams and rocks are repeated in rows, with walls around
//! all of them and none between, so that neighbours meet each other. In the second one a narrow tower is filled higher and
//! higher, and the camels fall upon each other. The crowds of a table step in turns, frame by frame, so that other work of
//! the machine is shared by all of them: what counts is the ratios.
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

use anyhow::Result;
use pliant::math::{Pose, Quat, Vec3};
use pliant_demos::scene::{Obstacle, ObstacleShape, Scene, find_scene, load_scene};
use pliant_demos::simulation::Simulation;

/// Columns of the tower along x and z, and camels above each other in each column.
type Crowd = [u32; 3];

/// Towers as large as their crowds.
const WIDE: [Crowd; 4] = [[1, 1, 1], [5, 2, 1], [6, 5, 1], [10, 10, 1]];

/// One narrow tower.
const NARROW: [Crowd; 3] = [[1, 1, 1], [1, 1, 3], [1, 1, 9]];

/// From column to column, in metres: the inside of the shipped tower.
const COLUMN: Vec3 = Vec3::new(3.76, 0.0, 2.5);

/// Height of the walls, and where their middle is, in metres.
const WALLS: [f32; 2] = [5.8, 5.2];

/// Where a camel's feet start: the uppermost bars are met in the first frames.
const START: f32 = 6.2;

/// From camel to camel in a column, in metres: a camel is 2.15 m high.
const LAYER: f32 = 2.4;

/// Frames that are timed: the fall upon the first two bars. `PLIANT_CROWD_FRAMES` sets another number.
const FRAMES: u64 = 75;

/// A tower of columns, each with the obstacles that stand inside the shipped one, and its camels.
fn crowd(shipped: &Scene, columns: Crowd) -> Result<Simulation> {
    let mut scene = shipped.clone();
    let whole = COLUMN * Vec3::new(columns[0] as f32, 0.0, columns[1] as f32);
    let named = |o: &&Obstacle, words: &[&str]| words.iter().any(|word| o.name.as_deref().unwrap_or("").contains(word));
    let inside: Vec<Obstacle> =
        shipped.obstacles.iter().filter(|o| named(o, &["bar", "beam", "rock"])).cloned().collect();
    scene.obstacles.retain(|o| o.name.as_deref() == Some("floor"));
    for (side, across) in [(Vec3::X, Vec3::Z), (Vec3::Z, Vec3::X)] {
        for sign in [-1.0, 1.0] {
            let Some(wall) = shipped.obstacles.iter().find(|o| named(o, &["left wall"])) else { continue };
            let half_extents = 0.12 * side + 0.5 * WALLS[0] * Vec3::Y + 0.5 * whole * across;
            let pose = Pose::from_translation(sign * (0.5 * whole + 0.12) * side + WALLS[1] * Vec3::Y);
            scene.obstacles.push(Obstacle {
                shape: ObstacleShape::Cuboid { half_extents, rounding: 0.0 },
                pose,
                ..wall.clone()
            });
        }
    }
    let camel = scene.bodies[0].clone();
    scene.bodies.clear();
    for i in 0..columns[0] {
        for k in 0..columns[1] {
            let place = COLUMN * Vec3::new(i as f32 + 0.5, 0.0, k as f32 + 0.5) - 0.5 * whole;
            for obstacle in &inside {
                let mut obstacle = obstacle.clone();
                obstacle.pose.translation += place;
                scene.obstacles.push(obstacle);
            }
            for layer in 0..columns[2] {
                let mut body = camel.clone();
                let number = scene.bodies.len();
                // By the golden ratio: each has another direction, and all directions are there in every crowd.
                let turn = 0.618_034 * number as f32 * std::f32::consts::TAU;
                let place = place + (START + LAYER * layer as f32) * Vec3::Y;
                body.pose = Pose::from_parts(place, Quat::from_rotation_y(turn) * camel.pose.rotation);
                body.name = format!("camel {number}");
                scene.bodies.push(body);
            }
        }
    }
    let mut simulation = Simulation::new(scene, 0)?;
    simulation.deformation.settings.measure = false;
    Ok(simulation)
}

/// Sums over all frames: milliseconds of each stage, and contacts.
#[derive(Clone, Copy, Default)]
struct Cost {
    rigid: f64,
    contact: f64,
    deform: f64,
    contacts: f64,
    active: f64,
}

impl Cost {
    /// Takes the last step. A contact is a segment that is pushed out of one obstacle or skin: a field of the first pass.
    fn see(&mut self, simulation: &Simulation) {
        let times = simulation.times();
        self.rigid += f64::from(simulation.rigid_ms);
        self.contact += f64::from(times.contact);
        self.deform += f64::from(times.springs + times.deform);
        for (_, body) in simulation.deformation.iter() {
            let fields = body.palette().passes.first().map_or(0, |pass| pass.fields.len());
            self.contacts += fields as f64;
            self.active += f64::from(u8::from(fields > 0));
        }
    }

    fn all(&self) -> f64 {
        self.rigid + self.contact + self.deform
    }
}

/// The exponent by which a cost grows with the number of bodies: 1 is linear, 2 is quadratic.
fn exponent(costs: [f64; 2], bodies: [f64; 2]) -> f64 {
    (costs[1] / costs[0]).ln() / (bodies[1] / bodies[0]).ln()
}

/// Lets crowds fall, in turns, and prints what they cost.
fn table(title: &str, shipped: &Scene, crowds: &[Crowd], frames: u64) -> Result<()> {
    let mut costs = vec![Cost::default(); crowds.len()];
    let mut crowds = crowds.iter().map(|columns| crowd(shipped, *columns)).collect::<Result<Vec<_>>>()?;
    for frame in 0..=frames {
        for (simulation, cost) in crowds.iter_mut().zip(&mut costs) {
            simulation.step();
            // In the first frame the obstacles are prepared.
            if frame > 0 {
                cost.see(simulation);
            }
        }
    }
    let count = |crowd: &Simulation| crowd.actors.len() as f64;
    let per_frame = frames.max(1) as f64;
    println!("\n{title}, {frames} frames of 1/60 s, ms a frame");
    println!("bodies    rigid   contact    deform       all   all a body   contacts   touching   contact ms a contact");
    for (crowd, cost) in crowds.iter().zip(&costs) {
        println!(
            "{:6} {:8.2} {:9.2} {:9.2} {:9.2} {:12.3} {:10.1} {:10.1} {:22.3}",
            count(crowd),
            cost.rigid / per_frame,
            cost.contact / per_frame,
            cost.deform / per_frame,
            cost.all() / per_frame,
            cost.all() / per_frame / count(crowd),
            cost.contacts / per_frame,
            cost.active / per_frame,
            cost.contact / cost.contacts.max(1.0),
        );
    }
    println!("\ngrowth exponent    rigid   contact    deform       all   contacts");
    for i in 1..crowds.len() {
        let bodies = [count(&crowds[i - 1]), count(&crowds[i])];
        let of = |cost: fn(&Cost) -> f64| exponent([cost(&costs[i - 1]), cost(&costs[i])], bodies);
        println!(
            "{:4} to {:4} {:13.2} {:9.2} {:9.2} {:9.2} {:10.2}",
            bodies[0],
            bodies[1],
            of(|c| c.rigid),
            of(|c| c.contact),
            of(|c| c.deform),
            of(Cost::all),
            of(|c| c.contacts),
        );
    }
    Ok(())
}

fn main() -> Result<()> {
    let frames = std::env::var("PLIANT_CROWD_FRAMES").ok().and_then(|text| text.parse().ok()).unwrap_or(FRAMES);
    let shipped = load_scene(find_scene("tower")?)?;
    table("camels in a tower as large as the crowd", &shipped, &WIDE, frames)?;
    // It takes twice as long until the upper ones come to lie upon the lower ones.
    table("camels in one narrow tower", &shipped, &NARROW, 2 * frames)
}
