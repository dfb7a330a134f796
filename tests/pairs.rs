//! Elastic bodies against each other: what overlaps is parted, in proportion to the softness, and heaps stay apart.

mod common;

use common::ball_rig;
use pliant::coupling::RagdollStart;
use pliant::math::{Pose, Vec3};
use pliant::spring::SpringCoefficients;
use pliant::world::{DeformationWorld, ElasticBodyHandle};
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;

const RADIUS: f32 = 0.5;

fn ball(
    physics: &mut PhysicsWorld,
    deformation: &mut DeformationWorld,
    at: Vec3,
    contact: SpringCoefficients,
) -> ElasticBodyHandle {
    let start = RagdollStart { pose: Pose::from_translation(at), ..RagdollStart::default() };
    deformation.insert(ball_rig(RADIUS, 1.2, contact), &start, physics)
}

/// Two balls held at a distance: the extents along x that their skins end at, and what is left of the overlap.
fn pressed(overlap: f32, first: f32, second: f32) -> ([f32; 2], f32, [f32; 2]) {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vec3::ZERO;
    let mut deformation = DeformationWorld::new();
    let half = RADIUS - 0.5 * overlap;
    let a = ball(&mut physics, &mut deformation, Vec3::X * half, SpringCoefficients::new(first, 0.3));
    let b = ball(&mut physics, &mut deformation, -Vec3::X * half, SpringCoefficients::new(second, 0.3));
    deformation.step(&mut physics);
    let report = deformation.report();
    let left = [a, b].map(|h| report.body(h).expect("a report").max_pair_depth).into_iter().fold(0.0, f32::max);
    let volumes = [a, b].map(|h| report.body(h).expect("a report").volume_ratio);
    let lowest = deformation.get(a).expect("a").positions().iter().map(|x| x.x).fold(f32::INFINITY, f32::min);
    let highest = deformation.get(b).expect("b").positions().iter().map(|x| x.x).fold(f32::NEG_INFINITY, f32::max);
    ([lowest, highest], left, volumes)
}

#[test]
fn two_balls_pressed_together_touch_in_a_plane_and_keep_their_volumes() {
    for overlap in [0.02, 0.1, 0.2, 0.3] {
        let ([lowest, highest], left, volumes) = pressed(overlap, 3.0, 3.0);
        assert!(left <= 5e-3, "overlap {overlap}: {left} is left");
        // The ends meet halfway, by symmetry, within the tolerance.
        assert!(lowest.abs() < 5e-3 * RADIUS && highest.abs() < 5e-3 * RADIUS, "{lowest} and {highest}");
        assert!(volumes.iter().all(|v| (v - 1.0).abs() < 2e-3), "{volumes:?}");
    }
}

#[test]
fn of_two_balls_the_softer_one_yields_more() {
    // Stiffness goes with the square of the frequency: one yields four times as much as the other.
    let overlap = 0.2;
    let ([lowest, highest], left, _) = pressed(overlap, 2.0, 4.0);
    assert!(left <= 5e-3);
    // The first would reach down to -0.1 and yields 0.8 of 0.2.
    assert!((lowest - 0.06).abs() < 0.01 && (highest - 0.06).abs() < 0.01, "{lowest}, {highest}");
}

#[test]
fn a_heap_of_twenty_soft_balls_is_not_seen_in_each_other_and_slows_down() {
    let mut physics = PhysicsWorld::new();
    let fixed = physics.insert_body(RigidBodyBuilder::fixed());
    let wall = |at: Vec3, half: Vec3| ColliderBuilder::cuboid(half.x, half.y, half.z).translation(at);
    for (at, half) in [
        (Vec3::new(0.0, -1.0, 0.0), Vec3::new(5.0, 1.0, 5.0)),
        (Vec3::new(2.7, 2.0, 0.0), Vec3::new(1.0, 3.0, 5.0)),
        (Vec3::new(-2.7, 2.0, 0.0), Vec3::new(1.0, 3.0, 5.0)),
        (Vec3::new(0.0, 2.0, 2.7), Vec3::new(5.0, 3.0, 1.0)),
        (Vec3::new(0.0, 2.0, -2.7), Vec3::new(5.0, 3.0, 1.0)),
    ] {
        physics.insert_collider(wall(at, half), Some(fixed));
    }
    let mut deformation = DeformationWorld::new();
    let balls: Vec<_> = (0..20)
        .map(|i| {
            let at = Vec3::new(
                1.05 * ((i % 3) as f32 - 1.0) + 0.07 * (i / 9) as f32,
                0.55 + 1.02 * (i / 9) as f32,
                1.05 * (((i / 3) % 3) as f32 - 1.0) - 0.05 * (i / 9) as f32,
            );
            ball(&mut physics, &mut deformation, at, SpringCoefficients::new(5.0 + (i % 4) as f32, 0.4))
        })
        .collect();
    let mut worst: (f32, f32) = (0.0, 0.0);
    let mut fastest = 0.0_f32;
    let steps = 300;
    for frame in 0..steps {
        physics.step();
        deformation.step(&mut physics);
        for (handle, body) in &deformation.report().bodies {
            assert!(body.frozen.is_none(), "frame {frame}: {handle:?} {body:?}");
            worst.0 = worst.0.max(body.max_pair_depth);
            worst.1 = worst.1.max(body.penetration.max_depth_after);
        }
        if frame + 60 > steps {
            for ball in &balls {
                let rigid = deformation.ragdoll(*ball).expect("a ragdoll").bodies[0];
                fastest = fastest.max(physics.bodies[rigid].linvel().length());
            }
        }
    }
    assert!(worst.0 <= 5e-3 && worst.1 <= 1e-3, "left: {worst:?}");
    // Balls on top still roll off slowly: 0.12 m/s were measured after four seconds, 0.11 after ten.
    assert!(fastest < 0.2, "{fastest} m/s in the last second");
}

#[test]
fn skins_that_nearly_touch_are_known_before_they_do() {
    use pliant::coupling::{Overlap, SkinSide, pairs_of};
    use pliant::elastic::ElasticBody;
    let at = |x: f32| {
        let mut body = ElasticBody::new(ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.3)));
        body.place(&[Pose::from_translation(Vec3::X * x)]);
        body.build_palette();
        body.deform_springs();
        body
    };
    let second = at(0.0);
    for gap in [-0.05, -0.01, 0.005, 0.02, 0.04] {
        let first = at(2.0 * RADIUS + gap);
        let sides = [&first, &second].map(|body| SkinSide::whole(body, 0, body.positions()));
        let near = Overlap::within(sides[0], sides[1], Vec3::X, Vec3::ZERO, 0.03);
        let deep = Overlap::between(sides[0], sides[1], Vec3::X, Vec3::ZERO);
        assert_eq!(deep.is_empty(), gap > 0.0);
        // The balls lie along an axis of their boxes: these are as far apart as the skins.
        let found = |within: f32| pairs_of(&[&first, &second], within, |_, _| true).len();
        assert_eq!((found(0.0), found(0.03 / RADIUS)), (usize::from(gap < 0.0), usize::from(gap < 0.03)));
        if gap > 0.03 {
            assert!(near.is_empty());
        } else {
            // The facets of the balls are up to a hundredth of the radius inside of them.
            assert!((near.closeness() + gap).abs() < 0.01 * RADIUS, "{} for {gap}", near.closeness());
            assert!((near.depth() - (-gap).max(0.0)).abs() < 0.01 * RADIUS);
        }
    }
}
