//! Stacks come to rest, in rapier's sense, and stay where they are.

use pliant::elastic::ContactSettings;
use pliant::math::Vec3;
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::ColliderBuilder;

use crate::scene::{RADIUS, Scene, cushion_rig};

const SOFT: ContactSettings =
    ContactSettings { spring: pliant::spring::SpringCoefficients::new(4.0, 0.4), friction: 0.7 };

/// Runs ten seconds; the last five must be still, and all must be asleep at the end.
fn comes_to_rest(scene: &mut Scene, bodies: &[RigidBodyHandle], what: &str) {
    let mut marks = Vec::new();
    let mut asleep = None;
    for frame in 0..600 {
        scene.step();
        if frame == 299 {
            marks = bodies.iter().map(|&body| scene.position(body)).collect();
        }
        let all = bodies.iter().all(|&body| scene.physics.bodies[body].is_sleeping());
        asleep = all.then(|| asleep.unwrap_or(frame));
    }
    for (&body, mark) in bodies.iter().zip(&marks) {
        assert!(scene.position(body).distance(*mark) < 0.005, "{what}: drifts to {}", scene.position(body));
    }
    assert!(asleep.is_some(), "{what}: does not fall asleep");
}

#[test]
fn a_stack_of_crates_rests_on_an_elastic_body() {
    for count in [1, 3, 5] {
        let mut scene = Scene::new();
        scene.floor();
        let rig = cushion_rig(Vec3::new(1.0, 0.4, 1.0), 10.0, SOFT);
        let cushion = scene.body(&rig, Vec3::new(0.0, 0.4, 0.0), Vec3::ZERO);
        let mut bodies = vec![scene.rigid(cushion)];
        for i in 0..count {
            bodies.push(scene.crate_at(0.25, 1.0, Vec3::new(0.0, 1.06 + 0.501 * i as f32, 0.0)));
        }
        comes_to_rest(&mut scene, &bodies, &format!("{count} crates on a cushion"));
        for i in 0..count {
            let at = scene.position(bodies[i + 1]);
            assert!(Vec3::new(at.x, 0.0, at.z).length() < 0.1, "crate {i} went to {at}");
            assert!(at.y > 0.8 + 0.5 * i as f32, "crate {i} sank to {at}");
        }
    }
}

#[test]
fn an_elastic_body_rests_on_a_stack_of_crates() {
    let mut scene = Scene::new();
    scene.floor();
    let mut bodies: Vec<_> =
        (0..3).map(|i| scene.crate_at(0.25, 2.0, Vec3::new(0.0, 0.25 + 0.5 * i as f32, 0.0))).collect();
    let rig = cushion_rig(Vec3::new(0.4, 0.3, 0.4), 3.0, SOFT);
    let cushion = scene.body(&rig, Vec3::new(0.02, 1.82, 0.01), Vec3::ZERO);
    bodies.push(scene.rigid(cushion));
    comes_to_rest(&mut scene, &bodies, "a cushion on three crates");
    assert!(scene.position(bodies[3]).y > 1.6);
}

#[test]
fn an_elastic_body_rests_on_a_crate_on_an_elastic_body() {
    let mut scene = Scene::new();
    scene.floor();
    let lower = scene.body(&cushion_rig(Vec3::new(0.8, 0.4, 0.8), 8.0, SOFT), Vec3::new(0.0, 0.4, 0.0), Vec3::ZERO);
    let middle = scene.crate_at(0.3, 2.0, Vec3::new(0.0, 1.15, 0.0));
    let upper = scene.body(&cushion_rig(Vec3::new(0.3, 0.2, 0.3), 1.0, SOFT), Vec3::new(0.0, 1.7, 0.0), Vec3::ZERO);
    let bodies = [scene.rigid(lower), middle, scene.rigid(upper)];
    comes_to_rest(&mut scene, &bodies, "cushion, crate, cushion");
}

#[test]
fn a_sleeping_body_falls_when_what_carried_it_is_gone() {
    let mut scene = Scene::new();
    scene.floor();
    let table = scene.physics.insert_body(RigidBodyBuilder::fixed().translation(Vec3::new(0.0, 1.0, 0.0)));
    scene.physics.insert_collider(ColliderBuilder::cuboid(1.0, 0.1, 1.0), Some(table));
    let rig = cushion_rig(Vec3::new(0.4, 0.3, 0.4), 3.0, SOFT);
    let cushion = scene.body(&rig, Vec3::new(0.0, 1.4, 0.0), Vec3::ZERO);
    let carried = scene.crate_at(0.2, 1.0, Vec3::new(0.0, 1.9, 0.0));
    let rigid = scene.rigid(cushion);
    for _ in 0..300 {
        scene.step();
    }
    assert!(scene.physics.bodies[rigid].is_sleeping() && scene.physics.bodies[carried].is_sleeping());
    scene.physics.remove_body(table);
    for _ in 0..120 {
        scene.step();
    }
    assert!(scene.position(rigid).y < 0.4, "the cushion stayed at {}", scene.position(rigid));
    for _ in 0..300 {
        scene.step();
    }
    assert!(scene.physics.bodies[carried].is_sleeping());
    let ragdoll = scene.deformation.remove(cushion).expect("it was there");
    scene.physics.remove_body(ragdoll.bodies[0]);
    for _ in 0..120 {
        scene.step();
    }
    assert!(scene.position(carried).y < 0.25, "the crate stayed at {}", scene.position(carried));
}

#[test]
fn a_crate_on_a_rigid_floor_is_not_kicked_by_the_ball_that_lies_on_it() {
    let mut scene = Scene::new();
    scene.floor();
    let under = scene.crate_at(0.5, 2.0, Vec3::new(0.0, 0.5, 0.0));
    scene.ball(SOFT, Vec3::new(0.0, 1.0 + RADIUS - 0.02, 0.0), Vec3::ZERO);
    for frame in 0..600 {
        scene.step();
        let at = scene.position(under);
        assert!((at - Vec3::new(0.0, 0.5, 0.0)).length() < 0.003, "frame {frame}: {at}");
    }
}
