//! Many bodies at once: none gets into another.

use std::collections::BTreeMap;

use crate::scene::{Scene, model, with_vertices};
use pliant::math::Vec3;

/// Body, vertex and other body, and how deep in metres.
pub type Insides = BTreeMap<(usize, usize, usize), f32>;

/// The vertices of boundaries that are inside another body, deeper than `reach` metres: by the solid angle of its surface around
/// them. What is inside of a body is not asked: a cell that is pressed inside out puts its inner vertex out of its own body.
pub fn inside(scene: &Scene, reach: f32) -> Insides {
    use rapier3d::parry::query::PointQuery;
    use rapier3d::parry::shape::TriMesh;
    let bodies: Vec<_> = scene.bodies.iter().collect();
    let boundary = |k: usize| &scene.bodies.model(bodies[k].0).expect("a model").boundary;
    let surfaces: Vec<TriMesh> = bodies
        .iter()
        .enumerate()
        .map(|(k, (_, body))| TriMesh::new(body.positions().to_vec(), boundary(k).clone()).expect("a surface"))
        .collect();
    let mut found = Insides::new();
    for (i, (_, body)) in bodies.iter().enumerate() {
        let mut outer = vec![false; body.positions().len()];
        boundary(i).iter().flatten().for_each(|&v| outer[v as usize] = true);
        for (j, surface) in surfaces.iter().enumerate().filter(|&(j, _)| j != i) {
            let bounds = surface.local_aabb();
            for (v, &x) in body.positions().iter().enumerate().filter(|(_, x)| bounds.contains_local_point(**x)) {
                if outer[v] && turns_around(x, boundary(j), bodies[j].1.positions()) > 0.5 {
                    let depth = surface.project_local_point(x, false).point.distance(x);
                    if depth > reach {
                        found.insert((i, v, j), depth);
                    }
                }
            }
        }
    }
    found
}

fn count(scene: &Scene) -> usize {
    scene.bodies.crossings().into_iter().map(|(_, count)| count).sum()
}

/// Runs for so many seconds, and after each step asks that no body is in another: no vertex, and no edge.
pub fn run_apart(scene: &mut Scene, seconds: f32) {
    for step in 0..(seconds * 60.0).round() as u32 {
        scene.run(1.0 / 60.0);
        assert_eq!(count(scene), 0, "step {step}");
        // Nothing gets in without a crossing, but for what is in from the start.
        if step % 20 == 0 {
            assert_eq!(inside(scene, 0.0), Insides::new(), "step {step}");
        }
    }
}

/// How often a surface goes around a point: 1 inside, 0 outside (van Oosterom and Strackee's solid angles).
fn turns_around(x: Vec3, triangles: &[[u32; 3]], positions: &[Vec3]) -> f32 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize] - x);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        2.0 * a.dot(b.cross(c)).atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    triangles.iter().map(angle).sum::<f32>() / (4.0 * std::f32::consts::PI)
}

#[test]
fn worms_in_a_heap_lie_on_each_other_and_not_in_each_other() {
    let worm = model("short_worm");
    let mut scene = Scene::new(9.81, 2);
    scene.floor();
    for i in 0..25 {
        let (layer, place) = (i / 5, i % 5);
        scene.insert(&worm, Vec3::new(0.05 * layer as f32, 0.3 + 0.45 * layer as f32, 0.4 * place as f32));
    }
    run_apart(&mut scene, 6.0);
    assert!(scene.bodies.iter().all(|(_, body)| body.positions().iter().all(|x| x.is_finite())));
}

#[test]
fn jellyfish_in_a_swarm_meet_and_do_not_get_into_each_other() {
    let jellyfish = model("small_jellyfish");
    let mut scene = Scene::new(9.81, 2);
    scene.ocean();
    for i in 0..8 {
        let [x, y, z] = [i & 1, (i >> 1) & 1, i >> 2].map(|k| k as f32);
        let handle = scene.insert(&jellyfish, Vec3::new(1.35 * x + 0.2 * y, 1.9 * y, 1.35 * z));
        scene.bodies.motion_mut(handle).expect("a motion").clock = f64::from(i) * 0.2;
    }
    run_apart(&mut scene, 6.0);
    assert!(scene.bodies.iter().all(|(_, body)| body.positions().iter().all(|x| x.is_finite())));
}

#[test]
fn bodies_that_are_in_each_other_are_counted() {
    let worm = model("short_worm");
    let mut scene = Scene::new(0.0, 1);
    scene.insert(&worm, Vec3::ZERO);
    scene.insert(&worm, Vec3::new(0.13, 0.1, 0.05));
    assert!(!inside(&scene, 0.0).is_empty());
    assert!(count(&scene) > 0);
}

#[test]
fn bodies_that_start_in_each_other_get_apart_and_stay_so() {
    let worm = with_vertices("short_worm");
    for shift in [Vec3::new(0.1, 0.12, 0.0), Vec3::new(0.0, 0.1, 0.12), Vec3::new(0.05, 0.2, -0.05)] {
        let mut scene = Scene::new(0.0, 2);
        scene.insert(&worm, Vec3::ZERO);
        scene.insert(&worm, shift);
        assert!(count(&scene) > 0, "{shift}");
        scene.run(2.0);
        run_apart(&mut scene, 1.0);
    }
}

#[test]
fn bodies_that_are_shot_at_each_other_do_not_get_into_each_other_and_keep_their_momentum() {
    let worm = with_vertices("short_worm");
    let mut random = fastrand::Rng::with_seed(11);
    for shot in 0..12 {
        let mut scene = Scene::new(0.0, 1);
        let mut any = || Vec3::from_array(std::array::from_fn(|_| 2.0 * random.f32() - 1.0));
        // Up to forty metres a second: twice a worm's thickness and more in one step.
        let (way, aim) = (any().normalize(), any() * 0.04);
        let speed = 4.0 + 3.3 * shot as f32;
        let handles = [scene.insert(&worm, Vec3::ZERO), scene.insert(&worm, aim - way * 1.3)];
        for (handle, velocity) in handles.into_iter().zip([-way, way]) {
            let soft = scene.bodies.link(handle).expect("a link").soft_body;
            let soft = scene.physics.soft_bodies.get_mut(soft).expect("a soft body");
            (0..soft.num_particles()).for_each(|i| soft.set_particle_velocity(i, velocity * 0.5 * speed));
        }
        let all = |scene: &Scene| handles.iter().map(|&h| scene.momentum(h)).sum::<Vec3>();
        let own = scene.momentum(handles[1]);
        run_apart(&mut scene, 1.0);
        assert!(scene.bodies.iter().all(|(_, body)| body.positions().iter().all(|x| x.is_finite())));
        let error = all(&scene).length() / own.length();
        assert!(error < 1e-4, "shot {shot}: {error}");
        // Had one gone through the other in one step, nothing of it would be seen but this.
        let ahead = (scene.centre(handles[0]) - scene.centre(handles[1])).dot(way);
        assert!(ahead > 0.0, "shot {shot} at {speed} m/s: {ahead}");
        assert!(scene.momentum(handles[1]).distance(own) > 0.1 * own.length(), "shot {shot} meets");
    }
}
