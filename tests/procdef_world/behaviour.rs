//! Swimming and crawling: motion of the whole from local deformations and what is around.

use crate::scene::{Scene, extents, model};
use pliant::math::Vec3;
use pliant::procdef::Stiffness;

#[test]
fn a_jellyfish_swims_its_length_in_three_strokes_and_stops_when_its_charts_stop() {
    let jellyfish = model("jellyfish");
    let cycle = jellyfish.motion.cyclic().expect("a cycle").charts.cycle;
    let length = extents(&jellyfish.rig.mesh().positions).y;
    let mut scene = Scene::new(9.81, 4);
    scene.ocean();
    let handle = scene.insert(&jellyfish, Vec3::ZERO);
    // One stroke from rest, to be under way.
    scene.run(cycle);
    let start = scene.centre(handle);
    scene.run(3.0 * cycle);
    let way = scene.centre(handle) - start;
    println!("{way} of {length}");
    assert!(way.y >= length, "{way} of {length}");
    assert!(way.x.hypot(way.z) < 0.2 * way.y, "it swims ahead: {way}");
    // Water slows it by a quadratic law: what is left after some seconds is a small part of its pace.
    scene.bodies.motion_mut(handle).expect("a motion").strength = 0.0;
    scene.run(6.0);
    let before = scene.centre(handle);
    scene.run(cycle);
    let rest = scene.centre(handle).distance(before);
    assert!(rest < 0.15 * way.y / 3.0, "{rest} in a cycle, {} in a stroke", way.y / 3.0);
}

/// How far the worm goes along its axis in ten cycles.
fn crawl(pace: f32) -> (f32, f32) {
    let worm = model("worm");
    let cycle = worm.motion.cyclic().expect("a cycle").charts.cycle;
    let mut scene = Scene::new(9.81, 2);
    scene.floor();
    let handle = scene.insert_on_floor(&worm);
    scene.bodies.motion_mut(handle).expect("a motion").pace = pace;
    let start = scene.centre(handle);
    scene.run(10.0 * cycle);
    let centre = scene.centre(handle);
    assert!(centre.y > 0.6 * start.y, "it lies on the floor: {centre}");
    (centre.x - start.x, extents(&worm.rig.mesh().positions).x)
}

#[test]
fn a_worm_crawls_its_length_in_ten_cycles() {
    let (way, length) = crawl(1.0);
    assert!(way > length, "{way} of {length}");
}

#[test]
fn a_worm_whose_phase_runs_backwards_crawls_backwards() {
    let (way, length) = crawl(-1.0);
    assert!(way < -length, "{way} of {length}");
}

#[test]
fn a_worm_without_directed_friction_goes_nowhere_near_as_far() {
    let mut worm = (*model("worm")).clone();
    worm.ground = None;
    let worm = std::sync::Arc::new(worm);
    let mut scene = Scene::new(9.81, 2);
    scene.floor();
    let handle = scene.insert_on_floor(&worm);
    let start = scene.centre(handle);
    scene.run(8.0);
    let way = (scene.centre(handle) - start).x.abs();
    assert!(way < 0.5 * extents(&worm.rig.mesh().positions).x, "{way}");
}

#[test]
fn a_jellyfish_swims_without_substeps_too() {
    for stiffness in [0.3, 0.5, 0.7, 0.9] {
        let mut jellyfish = (*model("jellyfish")).clone();
        jellyfish.settings.stiffness = Stiffness::Solve(stiffness);
        let jellyfish = std::sync::Arc::new(jellyfish);
        let mut scene = Scene::new(9.81, 1);
        scene.ocean();
        let handle = scene.insert(&jellyfish, Vec3::ZERO);
        let rest = extents(&jellyfish.rig.mesh().positions).max_element();
        scene.run(8.0);
        let now = extents(scene.body(handle).positions()).max_element();
        let fastest = scene.body(handle).velocities().iter().map(|v| v.length()).fold(0.0, f32::max);
        println!("stiffness {stiffness}: {now} of {rest} m, {fastest} m/s, at {}", scene.centre(handle));
        let volumes = jellyfish.rig.mesh().volumes_at(scene.body(handle).positions());
        assert!(volumes.iter().all(|v| *v > 0.0), "{stiffness}: no cell is inside out");
        assert!(now < 1.3 * rest, "{stiffness}: it keeps its size, {now} of {rest}");
        assert!(fastest < 20.0 * rest, "{stiffness}: {fastest} m/s");
        assert!(scene.centre(handle).y > 0.4 * rest, "{stiffness}: it swims, {}", scene.centre(handle));
    }
}
