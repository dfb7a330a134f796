//! Every shipped scene, run without a window: nothing is seen inside an obstacle, nothing pops.
//!
//! `PLIANT_SUITE=full` runs the scenes in their whole length and more random starts.

mod worst;

use std::path::PathBuf;

use pliant_demos::scene::{find_scene, load_scene, scene_names};
use pliant_demos::simulation::Simulation;
use worst::WorstFigures;

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
                    "{} seed {seed} frame {frame} {}: {:?} {} passes",
                    simulation.scene.name, actor.name, report.penetration, report.passes
                );
            }
        }
    }
    worst
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn in_no_frame_of_a_shipped_scene_is_an_obstacle_seen_in_a_body_and_nothing_pops() {
    let frames = number("PLIANT_SUITE_FRAMES", if full() { u64::MAX } else { 300 });
    let only = std::env::var("PLIANT_SUITE_SCENES").ok();
    let mut faults = Vec::new();
    for name in scene_names() {
        if only.as_ref().is_some_and(|only| !only.split(',').any(|o| o == name)) {
            continue;
        }
        let worst = run(find_scene(&name).expect("a scene"), 0, frames);
        println!("{name}: {worst}");
        faults.extend(worst.faults().into_iter().map(|fault| format!("{name}: {fault} (pliant run {name})")));
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
