//! Draggers: the held point arrives, the volume stays, the flow is certified, and let go, everything returns.

mod common;

use std::sync::Arc;

use common::ball_rig;
use pliant::elastic::{
    DraggerError, DraggerHandle, DraggerStart, ElasticBody, ElasticRig, ElasticRigBuilder, Grip, Joint, Segment,
    SegmentMass, SegmentShape, SkinWeights, load_rig,
};
use pliant::field::Lipschitz;
use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::TriangleMesh;
use pliant::mesh::measure::signed_volume;
use pliant::spring::SpringCoefficients;
use pliant::world::{DeformationWorld, ElasticBodyHandle};
use rapier3d::pipeline::PhysicsWorld;

const DT: f32 = 1.0 / 60.0;
const RADIUS: f32 = 0.5;

fn ball() -> ElasticBody {
    ElasticBody::new(ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.2)))
}

fn grip(body: &ElasticBody, towards: Vec3) -> Grip {
    Grip::nearest(body.rig(), towards).expect("a skin")
}

fn hold(body: &mut ElasticBody, grip: Grip, radius: f32) -> DraggerHandle {
    let position = body.grip_position(&grip);
    body.add_dragger(DraggerStart::new(grip, radius, position)).expect("a sound dragger")
}

fn step(body: &mut ElasticBody) {
    let motions = body.motions().to_vec();
    assert!(body.move_springs(&motions, DT));
    body.build_palette();
    body.deform_springs();
}

fn volume(body: &ElasticBody) -> f64 {
    signed_volume(body.positions(), &body.rig().mesh.triangles)
}

/// The largest distance of a vertex from where the segments alone put it.
fn deformation(body: &ElasticBody) -> f32 {
    let rest = body.rig().mesh.positions.iter().map(|&x| body.motions()[0].transform_point(x));
    rest.zip(body.positions()).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

#[test]
fn one_dragger_carries_the_held_vertex_to_its_goal_exactly() {
    let mut body = ball();
    body.place(&[Pose::from_parts(Vec3::new(3.0, 1.0, -2.0), Quat::from_rotation_y(1.0))]);
    body.build_palette();
    for (vertex, pull) in [(0, 0.3), (700, 1.0), (2000, 2.5)] {
        let grip = Grip::on_vertex(body.rig(), vertex).expect("a vertex");
        let handle = hold(&mut body, grip, 0.4);
        let goal = body.grip_position(&grip) + Vec3::new(0.3, 0.8, -0.5).normalize() * 0.4 * pull;
        assert!(body.move_dragger(handle, goal));
        step(&mut body);
        let apart = body.positions()[vertex].distance(goal);
        // The point moves at a constant velocity; what is left is rounding at coordinates of 3.
        assert!(apart < 5e-6, "{pull} radii: {apart:e}");
        assert!(body.remove_dragger(handle).is_some());
    }
}

#[test]
fn a_dragger_keeps_the_volume_and_leaves_what_is_far_from_it() {
    let mut body = ball();
    let rest = volume(&body);
    let grip = grip(&body, Vec3::Y * RADIUS);
    let handle = hold(&mut body, grip, 0.4);
    assert!(body.move_dragger(handle, grip.point + Vec3::Y * 0.4));
    step(&mut body);
    // A pull of a whole radius: the design measured a drift of 0.24 % for it, for a ball that is wholly inside the field.
    assert!((volume(&body) / rest - 1.0).abs() < 2.4e-3, "{}", volume(&body) / rest);
    for (x, y) in body.rig().mesh.positions.iter().zip(body.positions()) {
        if x.distance(grip.point) > 0.4 {
            assert_eq!(x, y, "out of reach");
        }
    }
    assert!(deformation(&body) > 0.39);
}

#[test]
fn draggers_whose_fields_overlap_all_meet_their_goals() {
    let mut body = ball();
    let ways = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::new(1.0, 1.0, 0.0).normalize()];
    let held: Vec<(Grip, DraggerHandle)> = ways
        .iter()
        .map(|&way| {
            let grip = grip(&body, way * RADIUS);
            (grip, hold(&mut body, grip, 0.45))
        })
        .collect();
    for (i, (grip, handle)) in held.iter().enumerate() {
        assert!(body.move_dragger(*handle, grip.point + ways[i] * 0.1 + ways[(i + 1) % 5] * 0.1));
    }
    step(&mut body);
    let mut without = 0.0_f32;
    for (grip, handle) in &held {
        let goal = body.dragger(*handle).and_then(|dragger| dragger.goal()).expect("it is held");
        let apart = body.grip_position(grip).distance(goal);
        assert!(apart < 1e-3 * 0.2, "{apart:e} of a pull of 0.14");
        let plain = body.palette().drags.fields.iter().find(|drag| drag.field.p.distance(grip.point) < 1e-6);
        without = without.max(plain.expect("its field").field.q.distance(goal));
    }
    assert!(without > 0.02, "the fields do overlap, and are corrected for it: {without}");
}

#[test]
fn two_draggers_that_want_different_things_of_one_point_stay_bounded() {
    let mut body = ball();
    let grip = grip(&body, Vec3::Y * RADIUS);
    let handles = [hold(&mut body, grip, 0.4), hold(&mut body, grip, 0.4)];
    for (handle, side) in handles.into_iter().zip([1.0, -1.0]) {
        assert!(body.move_dragger(handle, grip.point + Vec3::new(0.3 * side, 0.1, 0.0)));
    }
    step(&mut body);
    assert!(body.is_finite());
    assert!(deformation(&body) < 0.6, "{}", deformation(&body));
}

#[test]
fn the_steps_are_certified_and_past_their_limit_the_pull_is_weakened() {
    let mut body = ball();
    let grip = grip(&body, Vec3::Y * RADIUS);
    let handle = hold(&mut body, grip, 0.3);
    for far in [0.05, 0.5, 1.5, 20.0] {
        assert!(body.move_dragger(handle, grip.point + Vec3::Y * far));
        step(&mut body);
        let drags = &body.palette().drags;
        let bound: f32 = drags.fields.iter().map(|drag| drag.field.lipschitz()).sum();
        // A midpoint step is injective up to z = 0.732; rounding of the pull back is far smaller than the rest.
        assert!(bound / drags.steps as f32 <= 0.7 && drags.steps <= body.settings.max_steps, "{far}: {bound}");
        assert!(body.is_finite());
    }
    assert!(deformation(&body) < 2.0, "20 metres are more than 24 steps can do: {}", deformation(&body));
    assert!(body.dragger(handle).is_some_and(|dragger| dragger.ends()[1].distance(grip.point) < 2.0));
}

#[test]
fn let_go_after_an_extreme_pull_the_skin_returns_to_its_rest_shape() {
    let rig = Arc::new(load_rig(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/rigs/head.toml")).expect("the head"));
    let size = rig.mesh.size();
    let mut body = ElasticBody::new(rig);
    let places = [Vec3::new(0.44, -0.11, 0.0), Vec3::new(-0.1, 0.05, 0.35), Vec3::new(-0.1, 0.05, -0.35), Vec3::Y];
    let held: Vec<(Grip, DraggerHandle)> = places
        .iter()
        .map(|&place| {
            let grip = grip(&body, place);
            (grip, hold(&mut body, grip, 0.4))
        })
        .collect();
    for frame in 1..=60 {
        for (grip, handle) in &held {
            assert!(body.move_dragger(*handle, grip.point * (1.0 + 1.5 * frame as f32 / 60.0)));
        }
        step(&mut body);
    }
    assert!(deformation(&body) > 0.7 * size, "an extreme deformation: {}", deformation(&body));
    held.iter().for_each(|(_, handle)| assert!(body.release_dragger(*handle)));
    for _ in 0..300 {
        step(&mut body);
    }
    assert!(deformation(&body) < 1e-4 * size, "{:e}", deformation(&body));
    assert_eq!(body.draggers().count(), 0, "they are gone by themselves");
    assert!(!body.move_dragger(held[0].1, Vec3::ZERO) && !body.release_dragger(held[0].1));
}

#[test]
fn nothing_jumps_when_a_dragger_takes_hold_or_lets_go() {
    let mut body = ball();
    let held = grip(&body, Vec3::Y * RADIUS);
    let side = grip(&body, Vec3::X * RADIUS);
    let (mut handles, mut before, mut speeds) = (Vec::new(), body.positions().to_vec(), Vec::new());
    for frame in 0..120 {
        match frame {
            10 => handles.push(hold(&mut body, held, 0.45)),
            // The second takes hold of skin that the first has moved.
            30 => handles.push(hold(&mut body, side, 0.45)),
            60 => assert!(body.release_dragger(handles[0])),
            _ => {}
        }
        if (10..60).contains(&frame) {
            // Smooth: still at the beginning, and still where it is let go.
            let s = (frame - 10) as f32 / 50.0;
            let rise = 0.3 * s * s * (3.0 - 2.0 * s);
            assert!(body.move_dragger(handles[0], held.point + Vec3::Y * rise));
        }
        step(&mut body);
        let moved = body.positions().iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        speeds.push(moved);
        before = body.positions().to_vec();
    }
    // Led, 0.3 m are done in 50 frames with a peak of 1.5 times the mean. A release swings at 4 Hz: at most 2π · 4 · 0.3
    // metres a second, 0.126 a frame.
    for (frame, &speed) in speeds.iter().enumerate() {
        let most = if frame < 60 { 0.3 / 50.0 * 1.5 * 1.5 } else { 0.126 };
        assert!(speed <= most, "frame {frame}: {speed}");
    }
    // From frame to frame the speed itself changes by no more than the oscillator's acceleration, ω² · 0.3 m a frame².
    let omega = std::f32::consts::TAU * 4.0;
    for pair in speeds.windows(2) {
        assert!((pair[1] - pair[0]).abs() < 1.1 * omega * omega * 0.3 * DT * DT, "{pair:?}");
    }
}

#[test]
fn a_grip_at_a_joint_arrives_although_two_segments_share_it() {
    let mut body = ElasticBody::new(sausage());
    let shared = |skin: &SkinWeights| skin.weights[0] > 0.3 && skin.weights[1] > 0.3;
    let vertex = body.rig().weights.iter().position(shared).expect("skin at the joint");
    let bent = Pose::from_parts(Vec3::ZERO, Quat::from_rotation_z(0.5));
    body.place(&[Pose::IDENTITY, bent]);
    body.build_palette();
    let grip = Grip::on_vertex(body.rig(), vertex).expect("a vertex");
    let handle = hold(&mut body, grip, 0.3);
    let goal = body.grip_position(&grip) + Vec3::new(0.05, 0.1, 0.15);
    assert!(body.move_dragger(handle, goal));
    step(&mut body);
    assert!(body.positions()[vertex].distance(goal) < 5e-6);
}

#[test]
fn skin_of_a_segment_that_the_grip_does_not_belong_to_stays() {
    let mut body = ElasticBody::new(sausage());
    let whole = |skin: &SkinWeights, segment: u16| skin.weight_of(segment) == 1.0;
    let grip = Grip::of_segment(0, Vec3::new(-0.1, 0.0, 0.0));
    let handle = hold(&mut body, grip, 1.0);
    assert!(body.move_dragger(handle, grip.point + Vec3::Y * 0.2));
    step(&mut body);
    let moved = |segment: u16| {
        let all = (0..body.positions().len()).filter(|&v| whole(&body.rig().weights[v], segment));
        all.map(|v| body.positions()[v].distance(body.rig().mesh.positions[v])).fold(0.0, f32::max)
    };
    assert!(moved(0) > 0.1);
    assert_eq!(moved(1), 0.0);
}

#[test]
fn eight_vertices_at_once_are_dragged_as_one_by_one() {
    let mut body = ElasticBody::new(sausage());
    for place in [Vec3::new(-0.4, 0.2, 0.0), Vec3::new(0.0, -0.2, 0.0), Vec3::new(0.5, 0.0, 0.2)] {
        let grip = grip(&body, place);
        let handle = hold(&mut body, grip, 0.4);
        assert!(body.move_dragger(handle, grip.point * 1.6 + Vec3::Y * 0.1));
    }
    step(&mut body);
    for (v, y) in body.positions().iter().enumerate() {
        let expected = body.palette().deform(body.rig().mesh.positions[v], &body.rig().weights[v]);
        // The same formula in another order of rounding, at coordinates of 1.
        assert!(y.distance(expected) < 1e-5, "{v}");
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let mut body = ball();
    let grip = grip(&body, Vec3::Y);
    let start = DraggerStart::new(grip, 0.3, grip.point);
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(matches!(body.add_dragger(DraggerStart { radius, ..start }), Err(DraggerError::Radius(_))));
    }
    let release = SpringCoefficients::new(0.0, 0.1);
    assert!(matches!(body.add_dragger(DraggerStart { release, ..start }), Err(DraggerError::Release(_))));
    let goal = Vec3::new(0.0, f32::NAN, 0.0);
    assert_eq!(body.add_dragger(DraggerStart { goal, ..start }), Err(DraggerError::NotFinite));
    let elsewhere = Grip::of_segment(7, Vec3::ZERO);
    assert_eq!(body.add_dragger(DraggerStart { grip: elsewhere, ..start }), Err(DraggerError::Weights));
    let handle = body.add_dragger(start).expect("a sound dragger");
    assert!(!body.move_dragger(handle, goal), "a goal that is not finite");
    step(&mut body);
    assert_eq!(body.positions(), body.rig().mesh.positions, "and nothing has moved");
}

#[test]
fn a_held_body_is_deformed_in_the_world_and_sleeps_again_after_the_release() {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vec3::ZERO;
    let mut world = DeformationWorld::new();
    let rig = ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.2));
    let ball: ElasticBodyHandle = world.insert(rig, &Default::default(), &mut physics);
    let body = world.get_mut(ball).expect("the ball");
    let grip = grip(body, Vec3::Y * RADIUS);
    let handle = hold(body, grip, 0.4);
    assert!(body.move_dragger(handle, grip.point + Vec3::Y * 0.3));
    let mut step = |world: &mut DeformationWorld| {
        physics.step();
        world.step(&mut physics);
    };
    (0..5).for_each(|_| step(&mut world));
    let highest = |world: &DeformationWorld| {
        world.get(ball).expect("the ball").positions().iter().map(|x| x.y).fold(f32::NEG_INFINITY, f32::max)
    };
    assert!((highest(&world) - 0.8).abs() < 1e-3, "{}", highest(&world));
    assert!(world.get_mut(ball).expect("the ball").release_dragger(handle));
    (0..300).for_each(|_| step(&mut world));
    assert!((highest(&world) - RADIUS).abs() < 1e-4 * RADIUS);
    assert_eq!(world.get(ball).expect("the ball").draggers().count(), 0);
}

/// A capsule along x of two segments with a joint in its middle.
fn sausage() -> Arc<ElasticRig> {
    let (points, triangles) = common::icosphere::icosphere(4);
    let points = points.into_iter().map(|p| p * 0.25 + Vec3::X * 0.5 * p.x.clamp(-0.6, 0.6) / 0.6).collect();
    let mut rig = ElasticRigBuilder::new(TriangleMesh::from_triangles(points, triangles).expect("a sausage"));
    let mut segment = |name: &str, ends: [f32; 2]| {
        rig.segment(Segment {
            name: name.into(),
            bone: ends.map(|x| Vec3::X * x),
            shape: SegmentShape::Capsule { radius: 0.12 },
            mass: SegmentMass::Mass(1.0),
        })
    };
    let (parent, child) = (segment("left", [-0.65, -0.05]), segment("right", [0.05, 0.65]));
    let spring = SpringCoefficients::new(3.0, 0.5);
    rig.joint(Joint { parent, child, anchor: Vec3::ZERO, limit: None, spring });
    Arc::new(rig.build().expect("a sound rig"))
}
