//! The set of bodies: handles, faults, threads, grips, attachments.

use crate::scene::{Scene, model};
use pliant::coupling::procdef::{ParticleFault, WaterRegion};
use pliant::math::Vec3;
use rapier3d::prelude::*;

#[test]
fn a_body_with_charts_of_no_strength_stays_at_rest_to_rounding() {
    let mut scene = Scene::new(0.0, 1);
    let jellyfish = model("jellyfish");
    let handle = scene.insert(&jellyfish, Vec3::new(1.0, 2.0, 3.0));
    scene.bodies.motion_mut(handle).expect("a motion").strength = 0.0;
    scene.run(5.0);
    let rest = &jellyfish.rig.mesh().positions;
    let moved = scene.body(handle).positions().iter().zip(rest);
    let farthest = moved.map(|(x, r)| x.distance(*r + Vec3::new(1.0, 2.0, 3.0))).fold(0.0, f32::max);
    assert!(farthest < 1e-4, "{farthest}");
}

#[test]
fn bodies_whose_particles_are_gone_or_not_finite_are_reported_and_the_others_go_on() {
    let worm = model("short_worm");
    let mut scene = Scene::new(9.81, 1);
    let handles = [0.0, 2.0, 4.0].map(|z| scene.insert(&worm, Vec3::Z * z));
    scene.run(0.1);
    let soft = handles.map(|h| scene.bodies.link(h).expect("a link").soft_body);
    scene.physics.remove_soft_body(soft[0]);
    scene.physics.soft_bodies.get_mut(soft[1]).expect("a soft body").set_particle_position(3, Vec3::NAN);
    scene.run(0.1);
    let frozen = handles.map(|h| scene.bodies.report().body(h).expect("an entry").frozen);
    assert_eq!(frozen[0], Some(ParticleFault::Removed));
    assert!(matches!(frozen[1], Some(ParticleFault::Disabled | ParticleFault::NotFinite)), "{frozen:?}");
    assert_eq!(frozen[2], None);
    assert!(scene.body(handles[1]).positions().iter().all(|x| x.is_finite()));
    let removed = scene.bodies.remove(handles[2]).expect("a link");
    assert_eq!(removed.soft_body, soft[2]);
    assert!(scene.bodies.get(handles[2]).is_none() && scene.bodies.report().bodies.len() == 3);
    scene.run(0.1);
    assert_eq!(scene.bodies.report().bodies.len(), 2);
}

#[test]
fn the_same_bits_come_out_on_one_thread_and_on_many() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let worm = model("short_worm");
            let mut scene = Scene::new(9.81, 1);
            scene.floor();
            let handles: Vec<_> =
                (0..9).map(|i| scene.insert(&worm, Vec3::new(0.1 * i as f32, 0.3 + 0.4 * i as f32, 0.2))).collect();
            scene.run(1.5);
            handles.iter().flat_map(|&h| scene.body(h).positions().to_vec()).collect::<Vec<Vec3>>()
        })
    };
    let one = run(1);
    assert!(one.iter().zip(&run(4)).all(|(a, b)| a.to_array().map(f32::to_bits) == b.to_array().map(f32::to_bits)));
}

/// Everything at once: matching by passes and by the solve, charts, stimuli, water, contacts of surfaces and of vertices, directed
/// friction, a shell, rigid balls.
fn menagerie(threads: usize) -> Vec<u32> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| {
        let mut scene = Scene::new(9.81, 4);
        scene.floor();
        let water = WaterRegion { min: Vec3::new(-9.0, -9.0, 2.5), max: Vec3::splat(9.0), flow: Vec3::X * 0.1 };
        scene.bodies.water.push(water);
        let mut handles = vec![
            scene.insert(&model("worm"), Vec3::new(0.0, 0.2, 0.0)),
            scene.insert(&model("snail"), Vec3::new(0.0, 0.02, 1.2)),
            scene.insert(&model("jellyfish"), Vec3::new(0.0, 1.3, 4.0)),
        ];
        let small = model("short_worm");
        handles.extend((0..4).map(|i| scene.insert(&small, Vec3::new(0.1 * i as f32, 0.5 + 0.4 * i as f32, 0.05))));
        let balls: Vec<_> = [Vec3::new(0.3, 0.8, 0.0), Vec3::new(0.5, 1.0, 1.2), Vec3::new(0.1, 2.2, 4.0)]
            .map(|x| {
                let body = RigidBodyBuilder::dynamic().translation(x).linvel(Vec3::NEG_Y);
                scene.physics.insert(body, ColliderBuilder::ball(0.12).density(800.0)).0
            })
            .to_vec();
        scene.run(1.0);
        assert!(
            handles.iter().any(|&h| !scene.bodies.motion(h).expect("a motion").stimuli().is_empty()),
            "one is felt"
        );
        let soft = handles.iter().flat_map(|&h| scene.body(h).positions().to_vec());
        let rigid = balls.iter().map(|&b| scene.physics.bodies[b].translation());
        soft.chain(rigid).flat_map(|x| x.to_array().map(f32::to_bits)).collect()
    })
}

#[test]
fn one_two_and_four_threads_move_bodies_of_every_kind_to_the_same_bits() {
    let one = menagerie(1);
    for threads in [2, 4] {
        assert!(menagerie(threads) == one, "{threads} threads");
    }
}

#[test]
fn a_grip_leads_the_held_place_to_its_target_and_lets_go() {
    let mut scene = Scene::new(0.0, 1);
    let handle = scene.insert(&model("bending_bar"), Vec3::ZERO);
    let grip = scene.bodies.grab(handle, Vec3::new(1.0, 0.0, 0.0), 0.3).expect("a grip");
    let held = grip.target;
    grip.target += Vec3::Y * 0.5;
    let target = grip.target;
    scene.run(1.5);
    let body = scene.body(handle).clone();
    let place = scene.bodies.grip_mut(handle).expect("a grip").place(&body);
    assert!(place.distance(target) < 0.1 * held.distance(target), "{place} {target}");
    scene.bodies.release(handle);
    assert!(scene.bodies.grip_mut(handle).is_none());
}

#[test]
fn a_shell_is_carried_by_the_vertices_that_it_is_attached_to() {
    let snail = model("snail");
    let mut scene = Scene::new(9.81, 4);
    scene.floor();
    let handle = scene.insert_on_floor(&snail);
    let link = scene.bodies.link(handle).expect("a link").clone();
    let shell = link.attachments[0].expect("a shell");
    let attached = &snail.attachments[0].vertices;
    let start = scene.physics.bodies[shell].position().to_owned();
    let middle = |scene: &Scene| {
        let now = scene.body(handle).positions();
        attached.iter().map(|&v| now[v as usize]).sum::<Vec3>() / attached.len() as f32
    };
    let local = start.inverse_transform_point(middle(&scene));
    scene.run(2.0);
    let now = scene.physics.bodies[shell].position().transform_point(local);
    assert!(now.distance(middle(&scene)) < 0.02, "{now} {}", middle(&scene));
    assert!(scene.physics.bodies[shell].linvel().length() < 0.2, "it rests");
    // On its side it would lie a body's breadth lower.
    assert!((scene.physics.bodies[shell].position().translation - start.translation).length() < 0.15);
    assert!(scene.physics.bodies[shell].rotation().angle_between(start.rotation) < 0.5);
}

#[test]
fn a_bone_moves_the_vertices_that_are_attached_to_it() {
    let mut scene = Scene::new(0.0, 2);
    let handle = scene.insert(&model("bending_bar"), Vec3::ZERO);
    let bone = scene.physics.insert_body(RigidBodyBuilder::kinematic_velocity_based().linvel(Vec3::Y * 0.3));
    let held = scene.bodies.attach(handle, bone, Vec3::new(-0.9, 0.0, 0.0), 0.25, &mut scene.physics);
    assert!(held > 4, "{held}");
    let vertices = scene.bodies.model(handle).expect("a model").vertices_within(Vec3::new(-0.9, 0.0, 0.0), 0.25);
    let middle = |scene: &Scene| vertices.iter().map(|&v| scene.body(handle).positions()[v as usize]).sum::<Vec3>();
    let start = middle(&scene);
    let centre = scene.centre(handle);
    scene.run(3.0);
    let way = (middle(&scene) - start) / vertices.len() as f32;
    assert!(way.distance(Vec3::Y * 0.9) < 0.02, "{way}");
    // The rest swings, but it comes along.
    assert!((scene.centre(handle) - centre).y > 0.5);
}
