//! The bowel carries a bead from one end to the other, by its waves alone.

use crate::scene::{Scene, model};
use pliant::math::Vec3;
use rapier3d::prelude::*;

/// The phases at which the wall next to the bead is, twice a second; phases run from 0 at one end to 1 at the other.
fn ways(strength: f32) -> Vec<f32> {
    let bowel = model("bowel");
    let mut scene = Scene::new(0.0, 2);
    let handle = scene.insert(&bowel, Vec3::ZERO);
    scene.bodies.motion_mut(handle).expect("a motion").strength = strength;
    let ball = RigidBodyBuilder::dynamic().translation(Vec3::new(-0.2758, -1.1, 0.0)).linear_damping(1.0);
    let ball = scene.physics.insert(ball, ColliderBuilder::ball(0.12).density(500.0).friction(0.1)).0;
    let mut phases = Vec::new();
    for _ in 0..7 {
        scene.run(0.5);
        let bead = scene.physics.bodies[ball].translation();
        let wall = scene.body(handle).positions();
        let distance = |v: usize| wall[v].distance(bead);
        let nearest = (0..wall.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).expect("vertices");
        // Its middle stays within the tube, a little more than its radius from the nearest wall.
        assert!((0.07..0.25).contains(&distance(nearest)), "{bead}: {}", distance(nearest));
        phases.push(bowel.motion.fields().phase[nearest]);
    }
    phases
}

#[test]
fn a_bead_in_the_bowel_is_carried_along() {
    let phases = ways(1.0);
    assert!(phases[0] < 0.2 && phases[6] > 0.8, "{phases:?}");
    assert!(phases.windows(2).all(|p| p[1] > p[0]), "always the same way: {phases:?}");
}

#[test]
fn a_bead_in_a_bowel_at_rest_stays() {
    let phases = ways(0.0);
    assert!(phases.iter().all(|p| (p - phases[0]).abs() < 0.05), "{phases:?}");
}
