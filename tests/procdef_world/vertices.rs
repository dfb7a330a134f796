//! Contacts of vertices: momentum, ground, rigid bodies, and crowds as large as the paper's.

use crate::crowds::run_apart;
use crate::scene::{Scene, extents, model, with_vertices};
use pliant::math::Vec3;
use pliant::procdef::ContactKind;
use rapier3d::prelude::*;

#[test]
fn two_bodies_that_meet_in_space_keep_their_momentum_and_part() {
    let worm = with_vertices("short_worm");
    let mut scene = Scene::new(0.0, 2);
    let handles = [scene.insert(&worm, Vec3::ZERO), scene.insert(&worm, Vec3::new(0.2, 0.6, 0.1))];
    for (handle, speed) in handles.into_iter().zip([0.0, -3.0]) {
        let soft = scene.bodies.link(handle).expect("a link").soft_body;
        let soft = scene.physics.soft_bodies.get_mut(soft).expect("a soft body");
        (0..soft.num_particles()).for_each(|i| soft.set_particle_velocity(i, Vec3::Y * speed));
    }
    let momentum = |scene: &Scene| handles.iter().map(|&h| scene.momentum(h)).sum::<Vec3>();
    let before = momentum(&scene);
    run_apart(&mut scene, 1.0);
    let error = (momentum(&scene) - before).length() / before.length();
    assert!(error < 1e-4, "{error}");
    assert!(scene.momentum(handles[0]).length() > 0.3 * before.length(), "the first one was pushed");
}

#[test]
fn a_ball_that_hits_vertices_keeps_the_momentum_of_both() {
    for name in ["small_jellyfish", "short_worm", "heart"] {
        let kind = with_vertices(name);
        let mut scene = Scene::new(0.0, 2);
        let handle = scene.insert(&kind, Vec3::ZERO);
        let top = kind.rig.mesh().positions.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).expect("vertices");
        let ball = RigidBodyBuilder::dynamic().translation(top + Vec3::new(0.05, 0.35, 0.0)).linvel(Vec3::Y * -3.0);
        let ball = scene.physics.insert(ball, ColliderBuilder::ball(0.2).density(1000.0)).0;
        let rigid = |scene: &Scene| scene.physics.bodies[ball].linvel() * scene.physics.bodies[ball].mass();
        let before = scene.momentum(handle) + rigid(&scene);
        scene.run(0.5);
        let error = (scene.momentum(handle) + rigid(&scene) - before).length() / before.length();
        assert!(error < 1e-4, "{name}: {error}");
        assert!((rigid(&scene) - before).length() > 0.1 * before.length(), "{name} is hit");
    }
}

#[test]
fn vertices_lie_on_ground_of_every_kind() {
    let worm = with_vertices("short_worm");
    let grounds: [(&str, Collider); 4] = [
        ("box", ColliderBuilder::cuboid(5.0, 1.0, 5.0).translation(Vec3::NEG_Y).build()),
        ("half-space", ColliderBuilder::new(SharedShape::halfspace(Vec3::Y)).build()),
        ("heightfield", ColliderBuilder::heightfield(Array2::zeros(9, 9), Vec3::new(10.0, 1.0, 10.0)).build()),
        ("mesh", {
            let corners = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]].map(|[x, z]| Vec3::new(x, 0.0, z));
            ColliderBuilder::trimesh(corners.to_vec(), vec![[0, 2, 1], [0, 3, 2]]).expect("a mesh").build()
        }),
    ];
    for (name, ground) in grounds {
        let mut scene = Scene::new(9.81, 2);
        scene.physics.insert_collider(ground, None);
        let handle = scene.insert_on_floor(&worm);
        scene.run(2.0);
        let low = scene.body(handle).positions().iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
        let report = scene.bodies.report();
        assert!(report.refused.is_empty(), "{name}: {:?}", report.refused);
        // A tenth of an edge is kept free; half of it may be pressed in by what bends.
        assert!(low > 0.05 * worm.boundary_edge(), "{name}: {low}");
        assert!(low < 0.2 * worm.boundary_edge(), "{name}: it lies on the ground, {low}");
        assert!(report.body(handle).expect("an entry").on_ground > 3, "{name}");
    }
}

#[test]
fn a_worm_crawls_its_length_by_its_vertices_too_and_backwards() {
    let worm = with_vertices("worm");
    let cycle = worm.motion.cyclic().expect("a cycle").charts.cycle;
    let length = extents(&worm.rig.mesh().positions).x;
    for pace in [1.0, -1.0] {
        let mut scene = Scene::new(9.81, 2);
        scene.floor();
        let handle = scene.insert_on_floor(&worm);
        scene.bodies.motion_mut(handle).expect("a motion").pace = pace;
        let start = scene.centre(handle);
        scene.run(10.0 * cycle);
        let way = (scene.centre(handle) - start).x * pace;
        assert!(way > length, "{way} of {length}");
    }
}

#[test]
fn a_hundred_and_one_worms_in_a_heap_are_not_in_each_other() {
    let worm = model("short_worm");
    assert_eq!(worm.contacts, ContactKind::Vertices);
    let mut scene = Scene::new(9.81, 2);
    scene.floor();
    for i in 0..101 {
        let [x, y, z] = [i % 5, i / 25, i / 5 % 5].map(|k| k as f32);
        scene.insert(&worm, Vec3::new(1.35 * x + 0.3 * y, 0.3 + 0.45 * y, 0.45 * z + 0.1 * y));
    }
    run_apart(&mut scene, 3.0);
    let outer = |v: usize| worm.boundary.iter().flatten().any(|&b| b as usize == v);
    let places = scene.bodies.iter().flat_map(|(_, b)| b.positions().iter().enumerate());
    let lowest = places.filter(|&(v, _)| outer(v)).map(|(_, x)| x.y).fold(f32::INFINITY, f32::min);
    assert!(lowest > 0.0, "{lowest}");
}

#[test]
fn thirty_one_jellyfish_in_a_swarm_are_not_in_each_other() {
    let jellyfish = model("small_jellyfish");
    assert_eq!(jellyfish.contacts, ContactKind::Vertices);
    let mut scene = Scene::new(9.81, 2);
    scene.ocean();
    for i in 0..31 {
        let [x, y, z] = [i % 4, i / 16, i / 4 % 4].map(|k| k as f32);
        let handle = scene.insert(&jellyfish, Vec3::new(1.35 * x + 0.2 * y, 1.9 * y, 1.35 * z));
        scene.bodies.motion_mut(handle).expect("a motion").clock = f64::from(i) * 0.2;
    }
    let mut touched = false;
    for _ in 0..6 {
        run_apart(&mut scene, 0.5);
        touched |= scene.bodies.report().bodies.iter().any(|(_, body)| body.deepest > 0.0);
    }
    assert!(touched, "they meet");
}
