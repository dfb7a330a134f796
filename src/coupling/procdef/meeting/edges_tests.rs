use super::super::surface::ContactSurface;
use super::{PlacedEdges, SomePacks};
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;

#[test]
fn edges_within_reach_are_those_of_a_search_through_all_and_their_points_are_the_nearest() {
    let mut random = fastrand::Rng::with_seed(7);
    let corners: Vec<Vec3> =
        vec![Vec3::ZERO, Vec3::X, Vec3::new(0.1, 0.9, 0.0), Vec3::new(0.3, 0.3, 0.8), Vec3::new(0.4, 0.3, -0.9)];
    let mesh = TetrahedralMesh::new(corners.clone(), vec![[0, 1, 2, 3], [0, 2, 1, 4]]).expect("two cells");
    let surface = ContactSurface::new(&mesh, 0.5);
    assert_eq!((surface.edge_count, surface.edges.len(), surface.triangle_count()), (9, 16, 6));
    let mut placed = PlacedEdges::default();
    placed.place(&surface, &corners, &[]);
    let mut packs = SomePacks::default();
    placed.boxes.select([Vec3::splat(-9.0), Vec3::splat(9.0)], 0.0, &mut packs);
    let mut met = 0;
    for _ in 0..2000 {
        let [p, q] = std::array::from_fn(|_| Vec3::from_array(std::array::from_fn(|_| 3.0 * random.f32() - 1.0)));
        let mut found = vec![None; surface.edge_count];
        placed.within(&packs, [p, q], 0.3, |near, _| found[near.edge] = Some(near));
        for (edge, found) in surface.edges.iter().zip(found) {
            let [u, v] = edge.map(|i| corners[i as usize]);
            // The distance is convex along both: a fine search finds its least value from above.
            let along = |s: f32| {
                let x = p + (q - p) * s;
                let t = ((x - u).dot(v - u) / u.distance_squared(v)).clamp(0.0, 1.0);
                x.distance(u + (v - u) * t)
            };
            let exact = (0..=1000).map(|k| along(k as f32 / 1000.0)).fold(f32::INFINITY, f32::min);
            let Some(near) = found else {
                assert!(exact > 0.3 - 1e-4, "{exact} is within reach");
                continue;
            };
            met += 1;
            assert!(near.way.length() < exact + 1e-4 && near.way.length() > exact - 2e-3, "{} {exact}", near.way);
            let [s, t] = near.at;
            assert!((p + (q - p) * s - (u + (v - u) * t)).distance(near.way) < 1e-5);
        }
    }
    assert!(met > 1000, "{met}");
}
