//! Distances through bodies, against exact ones.

use fastrand::Rng;
use pliant::math::Vec3;
use pliant::mesh::TetrahedralMesh;
use pliant::procdef::GeodesicMesh;

use crate::meshes::{bar, cubes};

fn distances(mesh: &TetrahedralMesh, source: Vec3) -> Vec<f32> {
    GeodesicMesh::new(mesh).distances(mesh, source)
}

#[test]
fn in_a_straight_bar_distances_are_exact_from_any_point() {
    let mut rng = Rng::with_seed(1);
    let mesh = bar([12, 3, 3], 0.25);
    for _ in 0..20 {
        let source = Vec3::new(3.0 * rng.f32(), 0.75 * rng.f32(), 0.75 * rng.f32());
        for (x, d) in mesh.positions.iter().zip(distances(&mesh, source)) {
            // Faces are widened by 1e-4, which lets ways through that are by that much too short.
            assert!((d - x.distance(source)).abs() < 2e-3 * x.distance(source) + 1e-5, "{d} {}", x.distance(source));
        }
    }
}

/// An L: a square of n × n × 2 cubes without its upper right quarter.
fn ell(n: u32, side: f32) -> TetrahedralMesh {
    cubes([n, n, 2], |[x, y, _]| x < n / 2 || y < n / 2, |p| p * side)
}

/// The exact distance in the L with the inner edge at (h, h): straight, or around the edge by unfolding.
fn exact_in_ell(h: f32, a: Vec3, b: Vec3) -> f32 {
    let corner = |p: Vec3| glam::Vec2::new(p.x - h, p.y - h);
    let (ca, cb) = (corner(a), corner(b));
    // The straight way leaves the L if the two are on different arms and it passes above the edge.
    let (over, right) = if ca.y > cb.y { (ca, cb) } else { (cb, ca) };
    let blocked = over.y > 0.0 && right.x > 0.0 && over.x <= 0.0 && right.y <= 0.0 && {
        let line = right - over;
        line.x * (-over.y) - line.y * (-over.x) < 0.0
    };
    if blocked { (ca.length() + cb.length()).hypot(a.z - b.z) } else { a.distance(b) }
}

#[test]
fn around_the_corner_of_an_l_distances_are_right_to_a_few_percent_and_better_on_finer_cells() {
    // Four cells across an arm, then eight: the error behind the bend is that of ways bound to the cells around the edge.
    for (n, most) in [(8, 0.05), (16, 0.04)] {
        let side = 2.0 / n as f32;
        let mesh = ell(n, side);
        let mut worst = 0.0f32;
        for source in [Vec3::new(0.3, 1.9, side), Vec3::new(0.9, 1.9, side), Vec3::new(0.1, 1.2, 0.0)] {
            for (x, d) in mesh.positions.iter().zip(distances(&mesh, source)) {
                let exact = exact_in_ell(1.0, source, *x);
                worst = worst.max((d - exact).abs() / exact.max(0.2));
            }
        }
        println!("L of {n} cubes a side: worst error {:.2} %", 100.0 * worst);
        assert!(worst < most, "{worst}");
    }
}

#[test]
fn through_a_u_the_way_goes_around_and_not_across_the_gap() {
    // Two arms of width 2 side by side, a gap of 1 cube between them, joined at the bottom.
    let mesh = cubes([5, 10, 2], |[x, y, _]| x != 2 || y < 2, |p| p * 0.2);
    let source = Vec3::new(0.4, 2.0, 0.2);
    let (mut worst, mut far) = (0.0f32, 0.0f32);
    for (x, d) in mesh.positions.iter().zip(distances(&mesh, source)) {
        if x.x < 0.599 || x.y < 0.41 {
            continue;
        }
        // Down along the gap to its first edge at (0.4, 0.4), over to the second at (0.6, 0.4), up to the vertex.
        let edges = [glam::Vec2::new(0.4, 0.4), glam::Vec2::new(0.6, 0.4)];
        let flat = source.truncate().distance(edges[0]) + 0.2 + edges[1].distance(x.truncate());
        let exact = flat.hypot(x.z - source.z);
        worst = worst.max((d - exact).abs() / exact);
        far = far.max(d / x.distance(source));
    }
    println!("U: worst error {:.2} %, the way is up to {far:.1} times the straight distance", 100.0 * worst);
    assert!(worst < 0.03, "{worst}");
    assert!(far > 10.0, "{far}");
}

#[test]
fn distances_grow_by_no_more_than_the_edge_between_two_vertices() {
    let mesh = ell(8, 0.25);
    let d = distances(&mesh, Vec3::new(0.1, 1.9, 0.1));
    let neighbours = mesh.neighbours();
    for i in 0..mesh.vertex_count() {
        for &j in neighbours.of(i) {
            let edge = mesh.positions[i].distance(mesh.positions[j as usize]);
            assert!((d[i] - d[j as usize]).abs() <= edge * 1.001 + 1e-5);
        }
    }
}

#[test]
fn the_length_of_a_bar_is_its_diagonal_and_other_pieces_are_infinitely_far() {
    let mesh = bar([10, 2, 1], 0.3);
    let diagonal = Vec3::new(3.0, 0.6, 0.3).length();
    assert!((GeodesicMesh::new(&mesh).length(&mesh) - diagonal).abs() < 2e-3 * diagonal);
    let two = cubes([5, 1, 1], |[x, ..]| x != 1, |p| p);
    let d = distances(&two, Vec3::new(0.5, 0.5, 0.5));
    assert!(two.positions.iter().zip(&d).all(|(x, d)| d.is_infinite() == (x.x > 1.5)));
    let longest = GeodesicMesh::new(&two).length(&two);
    assert!((longest - Vec3::new(3.0, 1.0, 1.0).length()).abs() < 1e-2, "{longest}");
}
