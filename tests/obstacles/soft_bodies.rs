//! Soft balls dropped onto every kind of obstacle.

use pliant::coupling::RagdollStart;
use pliant::math::{Pose, Vec3};
use pliant::spring::SpringCoefficients;
use pliant::world::DeformationWorld;
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;
use rapier3d::prelude::RigidBodyBuilder;

use crate::common::ball_rig;
use crate::kinds;

const RADIUS: f32 = 0.35;

#[test]
fn a_soft_ball_dropped_on_every_kind_goes_in_and_is_never_seen_inside() {
    let rig = ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.3));
    let mut failures = Vec::new();
    for kind in kinds::all() {
        let mut physics = PhysicsWorld::new();
        let fixed = physics.insert_body(RigidBodyBuilder::fixed());
        physics.insert_collider(ColliderBuilder::new(kind.shape.clone()).friction(0.8), Some(fixed));
        let mut deformation = DeformationWorld::new();
        let start = RagdollStart {
            pose: Pose::from_translation(kind.drop_at + Vec3::new(0.03, 0.0, 0.02)),
            ..RagdollStart::default()
        };
        let ball = deformation.insert(rig.clone(), &start, &mut physics);
        let (mut before, mut after, mut gap, mut passes) = (0.0_f32, 0.0_f32, 0.0_f32, 0);
        let mut lowest = f32::INFINITY;
        for _ in 0..90 {
            physics.step();
            deformation.step(&mut physics);
            assert!(deformation.report().refused.is_empty(), "{}", kind.name);
            let report = *deformation.report().body(ball).expect("the ball");
            before = before.max(report.penetration.max_depth_before);
            gap = gap.max(report.penetration.max_gap);
            passes = passes.max(report.passes);
            let skin = deformation.get(ball).expect("the ball").positions();
            let truth = skin.iter().map(|x| (kind.truth)(*x)).fold(f32::NEG_INFINITY, f32::max) / RADIUS;
            after = after.max(truth).max(report.penetration.max_depth_after);
            lowest = lowest.min(skin.iter().map(|x| x.y).fold(f32::INFINITY, f32::min));
        }
        println!(
            "{:24} before {before:.3}  after {after:.5}  gap {gap:.4}  passes {passes}  lowest {lowest:.2}",
            kind.name
        );
        if before < 0.05 || after > 1.0e-3 {
            failures.push(kind.name);
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}
