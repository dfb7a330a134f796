//! Many bodies at once: none gets into another.

use crate::scene::{Scene, model};
use pliant::math::Vec3;

/// How many vertices of each body are inside another one, deeper than a tenth of its boundary edges.
fn inside(scene: &Scene, reach: f32) -> usize {
    use rapier3d::parry::query::PointQuery;
    use rapier3d::parry::shape::{TriMesh, TriMeshFlags};
    let bodies: Vec<_> = scene.bodies.iter().collect();
    let surfaces: Vec<TriMesh> = bodies
        .iter()
        .map(|&(handle, body)| {
            let boundary = scene.bodies.model(handle).expect("a model").boundary.clone();
            TriMesh::with_flags(body.positions().to_vec(), boundary, TriMeshFlags::ORIENTED).expect("a surface")
        })
        .collect();
    let mut count = 0;
    for (i, (_, body)) in bodies.iter().enumerate() {
        for (_, surface) in surfaces.iter().enumerate().filter(|&(j, _)| j != i) {
            let bounds = surface.local_aabb();
            for &x in body.positions().iter().filter(|&&x| bounds.contains_local_point(x)) {
                let nearest = surface.project_local_point(x, false);
                if nearest.is_inside && nearest.point.distance(x) > reach {
                    count += 1;
                }
            }
        }
    }
    count
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
    assert_eq!(inside(&scene, 0.1 * worm.boundary_edge()), 0);
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
    assert_eq!(inside(&scene, 0.1 * jellyfish.boundary_edge()), 0);
}

#[test]
fn bodies_that_are_in_each_other_are_counted() {
    let worm = model("short_worm");
    let mut scene = Scene::new(0.0, 1);
    scene.insert(&worm, Vec3::ZERO);
    scene.insert(&worm, Vec3::new(0.13, 0.1, 0.05));
    assert!(inside(&scene, 0.0) > 0);
}
