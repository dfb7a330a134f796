//! Every shipped scene, run without a window: nothing is seen inside an obstacle, nothing pops.
//!
//! `PLIANT_SUITE=full` runs the scenes in their whole length, 10,000 steps of the tower and 1,000 steps with each number of
//! threads. `PLIANT_SUITE_SCENES=ring,press` picks scenes, `PLIANT_SUITE_FRAMES=200` bounds the steps,
//! `PLIANT_THREAD_STEPS=1000` sets those of the comparison of threads, and with `PLIANT_SUITE_LOG=1` every row that fails is
//! printed.
#![allow(clippy::print_stdout, reason = "the figures are what one runs the suite for")]

mod real_meshes;
mod threads;
mod worst;

use std::path::PathBuf;

use pliant::coupling::SMOOTH;
use pliant_demos::scene::{find_scene, load_scene, scene_names};
use pliant_demos::simulation::Simulation;
use rayon::prelude::*;
use threads::fingerprints;
use worst::{Limits, WorstFigures};

fn full() -> bool {
    std::env::var("PLIANT_SUITE").is_ok_and(|suite| suite == "full")
}

/// Runs a scene and gathers the worst figures of its bodies.
fn run(path: PathBuf, seed: u64, frames: u64) -> WorstFigures {
    let scene = load_scene(path).expect("a scene");
    let mut simulation = Simulation::new(scene, seed).expect("a scene that can be built");
    let mut worst = WorstFigures::default();
    let log = std::env::var("PLIANT_SUITE_LOG").is_ok();
    for frame in 0..frames.min(simulation.frames()) {
        simulation.step();
        for actor in &simulation.actors {
            let report = simulation.report(actor);
            let bad = worst.bad;
            worst.see(frame, &actor.name, &report);
            if log && worst.bad > bad {
                println!(
                    "{} seed {seed} frame {frame} {}: {:?} skins {:.4}, {} passes",
                    simulation.scene.name, actor.name, report.penetration, report.max_pair_depth, report.passes
                );
            }
        }
    }
    worst
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// The shipped scenes, or those that are asked for.
fn scenes() -> Vec<String> {
    let only = std::env::var("PLIANT_SUITE_SCENES").ok();
    let wanted = |name: &String| only.as_ref().is_none_or(|only| only.split(',').any(|o| o == name));
    scene_names().into_iter().filter(wanted).collect()
}

#[test]
fn in_no_frame_of_a_shipped_scene_is_an_obstacle_seen_in_a_body_and_nothing_pops() {
    let frames = number("PLIANT_SUITE_FRAMES", if full() { u64::MAX } else { 120 });
    let run = |name: String| {
        let worst = run(find_scene(&name).expect("a scene"), 0, frames);
        if worst.rows > 0 {
            println!("{name}: {worst}");
        }
        let faults = worst.faults(&Limits::of(&name));
        faults.into_iter().map(move |fault| format!("{name}: {fault} (pliant run {name})"))
    };
    let faults: Vec<String> = scenes().into_par_iter().flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn a_heap_of_two_dozen_comes_to_rest_and_does_not_pop_there() {
    // Its passes were chosen anew once they had become too many: a jump of 150 times the motion, in frame 220.
    let mut simulation =
        Simulation::new(load_scene(find_scene("heap").expect("a scene")).expect("a scene"), 0).expect("a world");
    let (steps, at_rest) = (300, 240);
    let mut fastest = 0.0_f32;
    for frame in 0..steps {
        simulation.step();
        for actor in &simulation.actors {
            let coherence = &simulation.report(actor).penetration.coherence;
            assert!(coherence.ratio <= SMOOTH, "frame {frame}, {}: {coherence:?}", actor.name);
            let ragdoll = simulation.deformation.ragdoll(actor.handle).expect("a ragdoll");
            let speed = simulation.physics.bodies[ragdoll.bodies[0]].linvel().length();
            fastest = if frame < at_rest { 0.0 } else { fastest.max(speed) };
        }
    }
    assert!(simulation.actors.len() >= 20);
    assert!(fastest < 0.01, "{fastest} m/s in the last second");
}

#[test]
fn random_starts_of_the_tower_hold_too() {
    let (starts, frames) = if full() { (20, 500) } else { (4, 150) };
    let (starts, frames) = (number("PLIANT_SUITE_STARTS", starts), number("PLIANT_SUITE_FRAMES", frames));
    let run = |seed| {
        let worst = run(find_scene("tower").expect("a scene"), seed, frames);
        println!("tower, seed {seed}: {worst}");
        worst
            .faults(&Limits::of("tower starts"))
            .into_iter()
            .map(move |fault| format!("seed {seed}: {fault} (pliant run tower --seed {seed})"))
    };
    let faults: Vec<String> = (1..=starts).into_par_iter().flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn one_two_and_four_threads_give_the_same_bits_in_every_scene() {
    let steps = number("PLIANT_THREAD_STEPS", if full() { 1000 } else { 40 });
    for name in scenes() {
        let one = fingerprints(&name, 1, steps);
        assert!(one.windows(2).any(|pair| pair[0] != pair[1]), "{name}: something moves");
        for threads in [2, 4] {
            let other = fingerprints(&name, threads, steps);
            let step = one.iter().zip(&other).position(|(a, b)| a != b);
            assert_eq!(step, None, "{name}: the first step that differs with {threads} threads");
        }
        println!("{name}: the same bits in {steps} steps");
    }
}

#[test]
fn a_held_body_stays_where_it_is_and_is_shown_without_its_penetration() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("held.toml");
    let rig = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/rigs/ball.toml");
    let text = format!(
        "name = \"held\"\nduration = 1.0\ncamera = {{ eye = [0, 1, 4], target = [0, 0, 0] }}\n\
         [[body]]\nname = \"ball\"\nrig = '{rig}'\nposition = [0.0, 0.4, 0.0]\nheld = true\n\
         [[obstacle]]\nshape = {{ kind = \"half_space\" }}\n"
    );
    std::fs::write(&path, text).expect("a file");
    let mut simulation = Simulation::new(load_scene(&path).expect("a scene"), 0).expect("a world");
    for _ in 0..30 {
        simulation.step();
    }
    let actor = &simulation.actors[0];
    let body = simulation.deformation.get(actor.handle).expect("it is there");
    assert_eq!(body.motions()[0].translation.to_array(), [0.0, 0.4, 0.0]);
    let penetration = simulation.report(actor).penetration;
    // A ball of radius 0.5 m, 0.1 m deep.
    assert!((penetration.max_depth_before - 0.2).abs() < 0.01 && !penetration.uncancelled, "{penetration:?}");
}
