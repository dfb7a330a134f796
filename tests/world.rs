//! The deformation world: frozen bodies, level of detail, thread counts, ragdolls that return to their rest pose.

mod common;

use std::sync::Arc;

use common::ball_rig;
use pliant::coupling::{Ragdoll, RagdollStart, convex_parts, decompose};
use pliant::elastic::{
    ElasticRig, ElasticRigBuilder, Joint, LevelOfDetail, Normals, Segment, SegmentMass, SegmentShape,
};
use pliant::math::{Pose, Vec3};
use pliant::mesh::TriangleMesh;
use pliant::spring::SpringCoefficients;
use pliant::world::{BodyReport, DeformationWorld, ElasticBodyHandle, Frozen, InsertError};
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::geometry::{ColliderBuilder, HalfSpace, InteractionGroups, SharedShape};
use rapier3d::pipeline::PhysicsWorld;

const CONTACT: SpringCoefficients = SpringCoefficients::new(3.0, 0.2);

fn ball_above_a_floor() -> (PhysicsWorld, DeformationWorld, ElasticBodyHandle) {
    let mut physics = PhysicsWorld::new();
    let floor = physics.insert_body(RigidBodyBuilder::fixed().translation(Vec3::new(0.0, -1.0, 0.0)));
    physics.insert_collider(ColliderBuilder::cuboid(50.0, 1.0, 50.0), Some(floor));
    let mut deformation = DeformationWorld::new();
    let start = RagdollStart { pose: Pose::from_translation(Vec3::new(0.0, 0.6, 0.0)), ..RagdollStart::default() };
    let ball = deformation.insert(ball_rig(0.5, 1.2, CONTACT), &start, &mut physics);
    (physics, deformation, ball)
}

fn step(physics: &mut PhysicsWorld, deformation: &mut DeformationWorld, ball: ElasticBodyHandle) -> BodyReport {
    physics.step();
    *deformation.step(physics).body(ball).expect("the ball is in the report")
}

#[test]
fn a_body_whose_parent_was_removed_stays_as_it_is_and_is_reported() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    for _ in 0..20 {
        assert_eq!(step(&mut physics, &mut deformation, ball).frozen, None);
    }
    let before = deformation.get(ball).expect("a body").positions().to_vec();
    physics.remove_body(deformation.ragdoll(ball).expect("a ragdoll").bodies[0]);
    for _ in 0..20 {
        assert_eq!(step(&mut physics, &mut deformation, ball).frozen, Some(Frozen::ParentRemoved));
    }
    assert_eq!(deformation.get(ball).expect("a body").positions(), before);
}

#[test]
fn a_disabled_body_is_frozen_until_it_is_enabled_again() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let rigid = deformation.ragdoll(ball).expect("a ragdoll").bodies[0];
    physics.bodies[rigid].set_enabled(false);
    assert_eq!(step(&mut physics, &mut deformation, ball).frozen, Some(Frozen::ParentDisabled));
    physics.bodies[rigid].set_enabled(true);
    assert_eq!(step(&mut physics, &mut deformation, ball).frozen, None);
}

#[test]
fn a_pose_that_is_not_finite_freezes_the_body_and_leaves_its_skin_finite() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    step(&mut physics, &mut deformation, ball);
    let rigid = deformation.ragdoll(ball).expect("a ragdoll").bodies[0];
    physics.bodies[rigid].set_translation(Vec3::new(f32::NAN, 0.0, 0.0), true);
    // Without a step of rapier, which would put such a body aside by itself.
    let report = *deformation.step(&mut physics).body(ball).expect("the ball is in the report");
    assert_eq!(report.frozen, Some(Frozen::NotFinite));
    assert!(deformation.get(ball).expect("a body").positions().iter().all(|x| x.is_finite()));
}

#[test]
fn a_body_that_teleports_keeps_a_finite_skin_and_its_volume() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let rigid = deformation.ragdoll(ball).expect("a ragdoll").bodies[0];
    for i in 0..30 {
        physics.bodies[rigid].set_translation(Vec3::new(1000.0 * (i % 2) as f32, 5.0, 0.0), true);
        let report = step(&mut physics, &mut deformation, ball);
        assert_eq!(report.frozen, None);
        // Half the radius of influence is a large displacement: its exact flow drifts by as much (see the design).
        assert!((report.volume_ratio - 1.0).abs() < 2e-3, "{}", report.volume_ratio);
    }
}

#[test]
fn a_removed_body_is_gone_and_its_rigid_bodies_stay() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let ragdoll = deformation.remove(ball).expect("it was there");
    assert!(physics.bodies.contains(ragdoll.bodies[0]));
    assert!(deformation.get(ball).is_none() && deformation.remove(ball).is_none());
    physics.step();
    assert!(deformation.step(&mut physics).bodies.is_empty());
}

#[test]
fn attaching_another_number_of_rigid_bodies_than_segments_is_refused() {
    let mut deformation = DeformationWorld::new();
    let result = deformation.attach(ball_rig(0.5, 1.2, CONTACT), Ragdoll::default(), InteractionGroups::all());
    assert_eq!(result, Err(InsertError::BodyCount { segments: 1, bodies: 0 }));
}

#[test]
fn a_set_too_small_for_its_distance_is_left_out() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let fields = |deformation: &DeformationWorld| {
        let palette = deformation.get(ball).expect("a body").palette();
        palette.segments.iter().map(|s| s.local.fields.len() + s.global.fields.len()).sum::<usize>()
    };
    for (threshold, expected) in [(0.01, 1), (0.2, 0)] {
        deformation.get_mut(ball).expect("a body").settings.level_of_detail =
            Some(LevelOfDetail { viewer: Vec3::new(0.0, 0.5, 10.0), threshold });
        step(&mut physics, &mut deformation, ball);
        assert_eq!(fields(&deformation), expected, "threshold {threshold}");
    }
}

#[test]
fn both_kinds_of_normals_agree_on_a_squashed_ball() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    for _ in 0..15 {
        step(&mut physics, &mut deformation, ball);
    }
    let body = deformation.get_mut(ball).expect("a body");
    let triangles = body.normals().to_vec();
    body.settings.normals = Normals::TangentPoints;
    body.renew_normals();
    let worst = triangles.iter().zip(body.normals()).map(|(a, b)| a.dot(*b)).fold(1.0, f32::min);
    // Facets of 4 degrees: the two differ by less than one facet.
    assert!(worst > 0.995, "{worst}");
}

#[test]
fn the_same_bits_come_out_for_any_number_of_threads() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let (mut physics, mut deformation, ball) = ball_above_a_floor();
            for _ in 0..60 {
                step(&mut physics, &mut deformation, ball);
            }
            let body = deformation.get(ball).expect("a body");
            (body.positions().to_vec(), body.normals().to_vec())
        })
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(4));
}

/// Two boxes in one closed skin, joined by an elastic joint.
fn two_segments() -> Arc<ElasticRig> {
    let (points, triangles) = common::icosphere::icosphere(3);
    let stretched = points.into_iter().map(|p| p * Vec3::new(1.0, 0.2, 0.2)).collect();
    let mut rig = ElasticRigBuilder::new(TriangleMesh::from_triangles(stretched, triangles).expect("a mesh"));
    let segment = |name: &str, a: f32, b: f32| Segment {
        name: name.into(),
        bone: [Vec3::new(a, 0.0, 0.0), Vec3::new(b, 0.0, 0.0)],
        shape: SegmentShape::Capsule { radius: 0.1 },
        mass: SegmentMass::Mass(1.0),
    };
    let parent = rig.segment(segment("left", -0.9, 0.0));
    let child = rig.segment(segment("right", 0.0, 0.9));
    rig.joint(Joint { parent, child, anchor: Vec3::ZERO, limit: Some(1.5), spring: SpringCoefficients::new(2.0, 0.5) });
    Arc::new(rig.build().expect("a sound rig"))
}

#[test]
fn an_elastic_joint_pulls_its_segments_back_to_the_rest_pose() {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vec3::ZERO;
    let mut deformation = DeformationWorld::new();
    let handle = deformation.insert(two_segments(), &RagdollStart::default(), &mut physics);
    let [left, right] = deformation.ragdoll(handle).expect("a ragdoll").bodies[..] else { panic!("two bodies") };
    let angle = |physics: &PhysicsWorld| {
        physics.bodies[left].position().rotation.angle_between(physics.bodies[right].position().rotation)
    };
    physics.bodies[right].set_angvel(Vec3::new(0.0, 0.0, 6.0), true);
    physics.bodies[left].set_angvel(Vec3::new(0.0, 0.0, -6.0), true);
    let mut largest = 0.0_f32;
    for _ in 0..240 {
        step(&mut physics, &mut deformation, handle);
        largest = largest.max(angle(&physics));
    }
    assert!(largest > 0.2, "it hardly bent: {largest}");
    assert!(angle(&physics) < 0.02, "still bent by {}", angle(&physics));
}

#[test]
fn a_ball_falls_onto_a_concave_mesh_cut_into_convex_parts_and_ends_outside_of_all_of_them() {
    // A ring of boxes cannot be one convex part: a bowl made from a coarse torus-like mesh would do, and so does an L.
    let l = |x: f32, y: f32| [Vec3::new(x, y, -0.6), Vec3::new(x, y, 0.6)];
    let outline = [(0.0, 0.0), (1.2, 0.0), (1.2, 0.4), (0.4, 0.4), (0.4, 1.2), (0.0, 1.2)];
    let positions: Vec<Vec3> = outline.iter().flat_map(|&(x, y)| l(x - 0.6, y)).collect();
    let mut triangles = Vec::new();
    for i in 0..6_u32 {
        let (a, b) = (2 * i, 2 * ((i + 1) % 6));
        triangles.extend([[a, b, a + 1], [b, b + 1, a + 1]]);
    }
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5_u32]] {
        triangles.extend([[2 * a + 1, 2 * b + 1, 2 * c + 1], [2 * a, 2 * c, 2 * b]]);
    }
    let mesh = TriangleMesh::from_triangles(positions, triangles).expect("an L");
    let shape = decompose(&mesh, 8).expect("parts");
    assert!(convex_parts(&shape).expect("parts").len() >= 2);
    let mut physics = PhysicsWorld::new();
    let fixed = physics.insert_body(RigidBodyBuilder::fixed());
    physics.insert_collider(ColliderBuilder::new(shape), Some(fixed));
    let mut deformation = DeformationWorld::new();
    let start = RagdollStart { pose: Pose::from_translation(Vec3::new(0.25, 1.2, 0.0)), ..RagdollStart::default() };
    let ball = deformation.insert(ball_rig(0.3, 1.2, CONTACT), &start, &mut physics);
    let mut deepest = 0.0_f32;
    for frame in 0..90 {
        let report = step(&mut physics, &mut deformation, ball);
        deepest = deepest.max(report.penetration.max_depth_before);
        assert_eq!(report.penetration.vertices_inside, 0, "frame {frame}: {report:?}");
    }
    assert!(deepest > 0.03, "it never went in: {deepest}");
}

#[test]
fn a_collider_without_convex_parts_is_reported_and_ignored() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let fixed = physics.insert_body(RigidBodyBuilder::fixed());
    // A triangle without an area.
    let triangle = vec![Vec3::new(-1.0, 0.2, -1.0), Vec3::new(1.0, 0.2, -1.0), Vec3::new(0.0, 0.2, -1.0)];
    let mesh = ColliderBuilder::trimesh(triangle, vec![[0, 1, 2]]).expect("a triangle mesh").sensor(false);
    let collider = physics.insert_collider(mesh, Some(fixed));
    step(&mut physics, &mut deformation, ball);
    let refused: Vec<_> = deformation.report().refused.iter().map(|(handle, _)| *handle).collect();
    assert_eq!(refused, [collider]);
}

/// Parry's projection onto convex polyhedra (GJK and EPA) called points outside of VHACD's hulls up to six millimetres
/// deep; the measured depth comes from their triangles instead.
#[test]
fn the_measured_depth_in_a_part_of_a_decomposed_mesh_is_the_height_below_its_nearest_face() {
    use pliant::coupling::{ObstaclePart, PartId};
    use pliant::field::PartShape;
    use rapier3d::geometry::ColliderHandle;

    let (points, triangles) = common::icosphere::icosphere(3);
    let lumps = points.into_iter().map(|p| p * (0.5 + 0.12 * (7.0 * p.x).sin() * (5.0 * p.y + 1.0).cos())).collect();
    let mesh = TriangleMesh::from_triangles(lumps, triangles).expect("a mesh");
    let mut rng = fastrand::Rng::with_seed(11);
    let mut checked = [0, 0];
    for local in convex_parts(&decompose(&mesh, 12).expect("a shape")).expect("parts") {
        let PartShape::Hull(hull) = &local.part.shape else { panic!("a hull") };
        let id = PartId { collider: (0, 0), part: 0 };
        let part = ObstaclePart::new(id, ColliderHandle::invalid(), &local, Pose::IDENTITY);
        for _ in 0..2000 {
            // Close to the surface, on both sides.
            let [a, b, c] = hull.triangles()[rng.usize(..hull.triangles().len())];
            let (u, v) = (rng.f32(), rng.f32());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
            let x = a + (b - a) * u + (c - a) * v + normal * ((rng.f32() - 0.5) * 0.01);
            let height = hull.planes().iter().map(|(n, o)| n.dot(x) - o).fold(f32::NEG_INFINITY, f32::max);
            let depth = part.exact_depth(x);
            if height > 1e-5 {
                assert_eq!(depth, 0.0, "{x} is {height} outside");
                checked[0] += 1;
            } else if height < -1e-5 {
                assert!((depth + height).abs() < 2e-4, "{x}: depth {depth}, but {} below the nearest face", -height);
                checked[1] += 1;
            }
        }
    }
    assert!(checked.iter().all(|&n| n > 1000), "{checked:?}");
}

#[test]
fn a_body_at_rest_keeps_its_skin_to_the_bit_until_something_changes() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    let mut last = Vec::new();
    let mut same = 0;
    for _ in 0..900 {
        step(&mut physics, &mut deformation, ball);
        let now = deformation.get(ball).expect("a body").positions();
        same = if now == last { same + 1 } else { 0 };
        last = now.to_vec();
    }
    assert!(same > 60, "the skin still moved {same} frames ago");
    deformation.settings.cancel.softness = Some(0.7);
    step(&mut physics, &mut deformation, ball);
    assert_ne!(deformation.get(ball).expect("a body").positions(), last);
}

/// A resting skin was kept although the shape of the collider under it, not its pose, had changed.
#[test]
fn a_body_at_rest_notices_that_the_shape_under_it_was_exchanged() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    for _ in 0..900 {
        step(&mut physics, &mut deformation, ball);
    }
    let before = deformation.get(ball).expect("a body").positions().to_vec();
    let (_, floor) = physics.colliders.iter_mut().next().expect("the floor");
    floor.set_shape(SharedShape::cuboid(50.0, 1.02, 50.0));
    deformation.step(&mut physics);
    assert_ne!(deformation.get(ball).expect("a body").positions(), before);
}

#[test]
fn a_ball_that_appears_inside_a_half_space_far_from_its_origin_is_let_out_upwards() {
    let mut physics = PhysicsWorld::new();
    let fixed = physics.insert_body(RigidBodyBuilder::fixed());
    physics.insert_collider(ColliderBuilder::new(SharedShape::new(HalfSpace::new(Vec3::Y))), Some(fixed));
    let mut deformation = DeformationWorld::new();
    let start = RagdollStart { pose: Pose::from_translation(Vec3::new(10.0, -0.1, 0.0)), ..RagdollStart::default() };
    let ball = deformation.insert(ball_rig(0.5, 1.2, CONTACT), &start, &mut physics);
    let mut last = BodyReport::default();
    for _ in 0..240 {
        last = step(&mut physics, &mut deformation, ball);
    }
    let rigid = deformation.ragdoll(ball).expect("a ragdoll").bodies[0];
    let at = physics.bodies[rigid].translation();
    assert!(at.y > 0.3 && (at.x - 10.0).abs() < 0.2, "{at}");
    assert_eq!(last.penetration.vertices_inside, 0, "{last:?}");
}

#[test]
fn a_floor_of_tiles_is_as_soft_as_a_floor_of_one_box() {
    let rest = |tiles: i32| {
        let mut physics = PhysicsWorld::new();
        let fixed = physics.insert_body(RigidBodyBuilder::fixed());
        let half = 2.0 / tiles as f32;
        for i in 0..tiles {
            for j in 0..tiles {
                let at = Vec3::new((2 * i + 1) as f32 * half - 2.0, -1.0, (2 * j + 1) as f32 * half - 2.0);
                let tile = ColliderBuilder::cuboid(half, 1.0, half).translation(at);
                physics.insert_collider(tile, Some(fixed));
            }
        }
        let mut deformation = DeformationWorld::new();
        let start = RagdollStart { pose: Pose::from_translation(Vec3::new(0.0, 0.6, 0.0)), ..RagdollStart::default() };
        let ball = deformation.insert(ball_rig(0.5, 1.2, CONTACT), &start, &mut physics);
        for _ in 0..600 {
            step(&mut physics, &mut deformation, ball);
        }
        physics.bodies[deformation.ragdoll(ball).expect("a ragdoll").bodies[0]].translation().y
    };
    let (one, many) = (rest(1), rest(4));
    // The force is the stiffness times the mean depth weighted by depth, two thirds of the largest in a cap of a sphere:
    // the ball sinks in by 3/2 g / ω² = 41 mm.
    assert!((0.5 - one - 0.041).abs() < 0.01, "{one}");
    assert!((one - many).abs() < 0.006, "{one} on one box, {many} on tiles");
}

#[test]
fn a_softness_of_zero_gives_a_finite_skin() {
    let (mut physics, mut deformation, ball) = ball_above_a_floor();
    deformation.settings.cancel.softness = Some(0.0);
    for _ in 0..60 {
        let report = step(&mut physics, &mut deformation, ball);
        assert!(report.frozen.is_none() && report.volume_ratio.is_finite(), "{report:?}");
    }
}

#[test]
fn attaching_a_skin_to_bodies_far_away_does_not_make_it_swing() {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vec3::ZERO;
    let rigid = physics.insert_body(RigidBodyBuilder::dynamic().translation(Vec3::new(100.0, 0.0, 0.0)));
    let mut deformation = DeformationWorld::new();
    let ragdoll = Ragdoll { bodies: vec![rigid], joints: Vec::new() };
    let rig = ball_rig(0.5, 1.2, CONTACT);
    let ball = deformation.attach(rig, ragdoll, InteractionGroups::all()).expect("one body for one segment");
    for _ in 0..3 {
        step(&mut physics, &mut deformation, ball);
        let set = deformation.get(ball).expect("a body").sets()[0];
        assert!(set.displacement().length() < 1e-4, "{}", set.displacement());
    }
}

#[test]
fn a_second_body_of_a_rig_is_like_the_first() {
    let rig = ball_rig(0.5, 1.2, CONTACT);
    let mut physics = PhysicsWorld::new();
    let mut deformation = DeformationWorld::new();
    let first = deformation.insert(rig.clone(), &RagdollStart::default(), &mut physics);
    for _ in 0..20 {
        step(&mut physics, &mut deformation, first);
    }
    deformation.get_mut(first).expect("a body").settings.enabled = false;
    let second = deformation.insert(rig.clone(), &RagdollStart::default(), &mut physics);
    let mut alone = DeformationWorld::new();
    let new = alone.insert(rig, &RagdollStart::default(), &mut PhysicsWorld::new());
    let (second, new) = (deformation.get(second).expect("a body"), alone.get(new).expect("a body"));
    assert_eq!(second.positions(), new.positions());
    assert_eq!(second.normals(), new.normals());
    assert_eq!(second.sets(), new.sets());
    assert_eq!(second.palette(), new.palette());
    assert_eq!(second.settings, new.settings);
}

#[test]
fn a_skin_deformed_in_batches_is_where_each_vertex_goes_by_itself() {
    let mut physics = PhysicsWorld::new();
    let floor = physics.insert_body(RigidBodyBuilder::fixed().translation(Vec3::new(0.0, -1.3, 0.0)));
    physics.insert_collider(ColliderBuilder::cuboid(50.0, 1.0, 50.0), Some(floor));
    let mut deformation = DeformationWorld::new();
    let handle = deformation.insert(two_segments(), &RagdollStart::default(), &mut physics);
    let [left, right] = deformation.ragdoll(handle).expect("a ragdoll").bodies[..] else { panic!("two bodies") };
    physics.bodies[right].set_angvel(Vec3::new(0.0, 2.0, 4.0), true);
    physics.bodies[left].set_angvel(Vec3::new(0.0, 0.0, -4.0), true);
    let (mut shared, mut touched) = (0, 0);
    for _ in 0..40 {
        step(&mut physics, &mut deformation, handle);
        let body = deformation.get(handle).expect("a body");
        touched += body.palette().passes.len();
        for ((batched, rest), skin) in body.positions().iter().zip(&body.rig().mesh.positions).zip(&body.rig().weights)
        {
            let alone = body.palette().deform(*rest, skin);
            assert!(batched.distance(alone) < 1e-5, "{batched} in a batch, {alone} alone");
            shared += usize::from(skin.weights[1] > 0.0);
        }
    }
    assert!(shared > 1000 && touched > 5, "{shared} shared vertices, {touched} collision passes");
}
