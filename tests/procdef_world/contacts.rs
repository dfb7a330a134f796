//! Rigid balls against bodies: momentum, no overlap, stimuli by touch.

use crate::scene::{Scene, model};
use pliant::math::Vec3;
use rapier3d::parry::query::PointQuery;
use rapier3d::parry::shape::TriMesh;
use rapier3d::prelude::*;

const RADIUS: f32 = 0.15;

/// How deep a ball is in the boundary of a body, in metres; negative for a gap.
fn depth(boundary: &[[u32; 3]], positions: &[Vec3], centre: Vec3) -> f32 {
    let surface = TriMesh::new(positions.to_vec(), boundary.to_vec()).expect("a surface");
    let nearest = surface.project_local_point(centre, false);
    RADIUS - nearest.point.distance(centre)
}

#[test]
fn a_ball_that_hits_a_body_in_space_keeps_the_momentum_of_both() {
    for name in ["jellyfish", "worm", "snail", "heart", "bowel", "bending_bar"] {
        let kind = model(name);
        let mut scene = Scene::new(0.0, 2);
        let handle = scene.insert(&kind, Vec3::ZERO);
        let side = kind.rig.mesh().positions.iter().copied().max_by(|a, b| a.z.total_cmp(&b.z)).expect("vertices");
        let ball = RigidBodyBuilder::dynamic().translation(side + Vec3::Z * 0.3).linvel(Vec3::Z * -3.0);
        let ball = scene.physics.insert(ball, ColliderBuilder::ball(RADIUS).density(1000.0)).0;
        let attachments: Vec<_> =
            scene.bodies.link(handle).expect("a link").attachments.iter().copied().flatten().collect();
        let momentum = |scene: &Scene| {
            let rigid = |&b: &RigidBodyHandle| scene.physics.bodies[b].linvel() * scene.physics.bodies[b].mass();
            scene.momentum(handle) + rigid(&ball) + attachments.iter().map(rigid).sum::<Vec3>()
        };
        let before = momentum(&scene);
        let (mut deepest, mut hit) = (f32::MIN, false);
        for _ in 0..60 {
            scene.run(1.0 / 60.0);
            let rigid = &scene.physics.bodies[ball];
            deepest = deepest.max(depth(&kind.boundary, scene.body(handle).positions(), rigid.translation()));
            hit |= (rigid.linvel() - Vec3::Z * -3.0).length() > 0.3;
        }
        let error = (momentum(&scene) - before).length() / before.length();
        println!("{name}: momentum {error:e}, depth {deepest} m, hit {hit}");
        assert!(hit, "{name} is hit");
        assert!(error < 1e-4, "{name}: {error}");
        // Rapier lets surfaces overlap for a step or two at 3 m/s: 2.5 cm a step of 1/120 s.
        assert!(deepest < 0.03, "{name}: {deepest}");
    }
}

#[test]
fn a_snail_answers_a_ball_once_and_not_the_ground_that_it_lies_on() {
    let snail = model("snail");
    let mut scene = Scene::new(9.81, 4);
    scene.floor();
    let handle = scene.insert_on_floor(&snail);
    let mut touched = 0;
    let mut run = |scene: &mut Scene, seconds: f32| {
        for _ in 0..(seconds * 240.0) as u32 {
            scene.physics.integration_parameters.dt = 1.0 / 240.0;
            scene.physics.step();
            touched += scene.bodies.step(&mut scene.physics).bodies.iter().filter(|(_, b)| b.touched.is_some()).count();
        }
        std::mem::take(&mut touched)
    };
    assert_eq!(run(&mut scene, 2.0), 0, "the ground is no touch");
    assert!(scene.bodies.motion(handle).expect("a motion").stimuli().is_empty());
    // A ball against its neck, from the front.
    let neck = Vec3::new(0.6, 0.35, 0.0);
    let ball = RigidBodyBuilder::dynamic().translation(neck + Vec3::X * 0.7).linvel(Vec3::X * -3.0).gravity_scale(0.0);
    scene.physics.insert(ball, ColliderBuilder::ball(0.1).density(1000.0));
    assert_eq!(run(&mut scene, 1.0), 1, "a ball is one");
}
