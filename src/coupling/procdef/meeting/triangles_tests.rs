use super::super::surface::ContactSurface;
use super::PlacedTriangles;
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;
use rapier3d::parry::query::PointQuery;
use rapier3d::parry::shape::Triangle;

/// A bumpy ball of 20 triangles and more.
fn bumpy() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (rings, around) = (7u32, 11u32);
    let mut x = vec![Vec3::Y];
    let mut triangles = Vec::new();
    for ring in 1..rings {
        for k in 0..around {
            let (polar, turn) =
                (std::f32::consts::PI * ring as f32 / rings as f32, std::f32::consts::TAU * k as f32 / around as f32);
            let radius = 1.0 + 0.2 * (3.0 * turn + ring as f32).sin();
            x.push(Vec3::new(polar.sin() * turn.cos(), polar.cos(), polar.sin() * turn.sin()) * radius);
        }
    }
    x.push(Vec3::NEG_Y);
    let at = |ring: u32, k: u32| 1 + (ring - 1) * around + k % around;
    let last = x.len() as u32 - 1;
    for k in 0..around {
        triangles.push([0, at(1, k + 1), at(1, k)]);
        triangles.push([last, at(rings - 1, k), at(rings - 1, k + 1)]);
        for ring in 1..rings - 1 {
            triangles.push([at(ring, k), at(ring, k + 1), at(ring + 1, k)]);
            triangles.push([at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)]);
        }
    }
    (x, triangles)
}

#[test]
fn the_nearest_point_is_that_of_a_search_through_all_triangles_and_its_side_is_right() {
    let (x, triangles) = bumpy();
    let middle = x.len() as u32;
    let mut all = x.clone();
    all.push(Vec3::ZERO);
    let cells = triangles.iter().map(|t| [middle, t[0], t[1], t[2]]).collect();
    let mesh = TetrahedralMesh::new(all, cells).expect("a ball");
    let surface = ContactSurface::new(&mesh, 0.3);
    assert_eq!(surface.triangles.len() % 8, 0);
    let mut placed = PlacedTriangles::default();
    placed.place(&surface, &x, &[]);
    let mut random = fastrand::Rng::with_seed(5);
    let mut found = 0;
    for _ in 0..3000 {
        let p = Vec3::from_array(std::array::from_fn(|_| 3.0 * random.f32() - 1.5));
        let distance = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| x[v as usize]);
            Triangle::new(a, b, c).project_local_point(p, false).point.distance(p)
        };
        let exact = triangles.iter().map(distance).fold(f32::INFINITY, f32::min);
        let Some(nearest) = placed.nearest(p, 0.4, |_| true) else {
            assert!(exact > 0.4 - 1e-4, "{exact} is within reach");
            continue;
        };
        found += 1;
        assert!((nearest.way.length() - exact).abs() < 1e-4, "{} {exact}", nearest.way.length());
        let corners = surface.triangles[nearest.triangle].map(|v| x[v as usize]);
        let point: Vec3 = corners.iter().zip(nearest.weights).map(|(c, w)| *c * w).sum();
        assert!((point + nearest.way).distance(p) < 1e-5);
        // The ball is a star about its middle: a ray from there tells inside from outside.
        let hits = |t: &[u32; 3]| {
            let m = glam::Mat3::from_cols_array_2d(&t.map(|v| x[v as usize].to_array()));
            let c = m.inverse() * p;
            c.min_element() >= 0.0 && c.element_sum() >= 1.0
        };
        let outside = triangles.iter().any(hits);
        if exact > 1e-3 {
            assert_eq!(nearest.normal.dot(nearest.way) > 0.0, outside, "at {p}");
        }
    }
    assert!(found > 500, "{found}");
}
