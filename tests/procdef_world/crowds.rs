//! Many bodies at once: none gets into another.

use std::collections::BTreeMap;

use crate::scene::{Scene, model};
use pliant::math::Vec3;

/// Body, vertex and other body, and how deep in metres.
pub type Insides = BTreeMap<(usize, usize, usize), f32>;

/// The vertices that are inside another body, deeper than `reach` metres: by the solid angle of its surface around them.
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
        for (j, surface) in surfaces.iter().enumerate().filter(|&(j, _)| j != i) {
            let bounds = surface.local_aabb();
            for (v, &x) in body.positions().iter().enumerate().filter(|(_, x)| bounds.contains_local_point(**x)) {
                if turns_around(x, boundary(j), bodies[j].1.positions()) > 0.5 {
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
    scene.run(6.0);
    assert!(scene.bodies.iter().all(|(_, body)| body.positions().iter().all(|x| x.is_finite())));
    assert_eq!(inside(&scene, 0.1 * worm.boundary_edge()), Insides::new());
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
    scene.run(6.0);
    assert!(scene.bodies.iter().all(|(_, body)| body.positions().iter().all(|x| x.is_finite())));
    assert_eq!(inside(&scene, 0.1 * jellyfish.boundary_edge()), Insides::new());
}

#[test]
fn bodies_that_are_in_each_other_are_counted() {
    let worm = model("short_worm");
    let mut scene = Scene::new(0.0, 1);
    scene.insert(&worm, Vec3::ZERO);
    scene.insert(&worm, Vec3::new(0.13, 0.1, 0.05));
    assert!(!inside(&scene, 0.0).is_empty());
}
