//! A skin embedded in the cells of a body.

#[path = "common/icosphere.rs"]
mod icosphere;

use glam::{Mat3, Quat};
use pliant::math::Vec3;
use pliant::mesh::{TetrahedralMesh, TriangleMesh, fill_surface};
use pliant::procdef::{DeformedSkin, EmbeddedSkin};

fn sphere(subdivisions: u32, radius: f32) -> TriangleMesh {
    let (points, triangles) = icosphere::icosphere(subdivisions);
    TriangleMesh::from_triangles(points.into_iter().map(|p| p * radius).collect(), triangles).unwrap()
}

fn ball() -> TetrahedralMesh {
    fill_surface(&sphere(3, 0.5), 0.15).unwrap().0
}

fn deformed(skin: &EmbeddedSkin, body: &TetrahedralMesh, map: impl Fn(Vec3) -> Vec3) -> DeformedSkin {
    let mut out = DeformedSkin::default();
    let positions: Vec<Vec3> = body.positions.iter().map(|&x| map(x)).collect();
    skin.deform(&positions, &mut out).unwrap();
    out
}

#[test]
fn at_rest_the_skin_is_where_it_was_inside_and_outside_of_the_cells() {
    let body = ball();
    for radius in [0.3, 0.5, 0.55] {
        let surface = sphere(4, radius);
        let (skin, report) = EmbeddedSkin::new(surface.clone(), &body).unwrap();
        let out = deformed(&skin, &body, |x| x);
        for v in 0..surface.vertex_count() {
            // Rounding of barycentric coordinates about 1.
            assert!(out.positions[v].distance(surface.positions[v]) < 1e-5);
            assert!(out.normals[v].dot(surface.normals[v]) > 1.0 - 1e-5);
        }
        assert_eq!(report.outside == 0, radius < 0.4, "{report:?}");
        assert!(report.farthest < 0.07, "{report:?}");
    }
}

#[test]
fn an_affine_map_of_the_body_is_that_of_the_skin_and_its_normals_stay_normal_to_it() {
    let body = ball();
    let surface = sphere(4, 0.48);
    let (skin, _) = EmbeddedSkin::new(surface.clone(), &body).unwrap();
    let turn = Mat3::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.0, -0.7));
    let map = turn * Mat3::from_cols(Vec3::new(2.0, 0.3, 0.0), Vec3::new(0.0, 0.5, 0.1), Vec3::new(0.2, 0.0, 1.0));
    let out = deformed(&skin, &body, |x| map * x + Vec3::ONE);
    for (v, (x, n)) in surface.positions.iter().zip(&surface.normals).enumerate() {
        assert!(out.positions[v].distance(map * *x + Vec3::ONE) < 1e-5);
        let expected = (map.inverse().transpose() * *n).normalize();
        assert!(out.normals[v].dot(expected) > 1.0 - 1e-5);
    }
}

#[test]
fn where_the_body_bends_the_normals_are_near_those_of_the_bent_skin() {
    let body = ball();
    let surface = sphere(4, 0.48);
    let (skin, _) = EmbeddedSkin::new(surface.clone(), &body).unwrap();
    let bend = |x: Vec3| Vec3::new(x.x, x.y + 0.6 * x.x * x.x, x.z);
    let out = deformed(&skin, &body, bend);
    let bent = TriangleMesh::from_triangles(surface.positions.iter().map(|&x| bend(x)).collect(), surface.triangles);
    for (n, expected) in out.normals.iter().zip(bent.unwrap().normals) {
        // The body's cells are 0.15 long; over them the bend turns by 0.18.
        assert!(n.dot(expected) > 0.99, "{}", n.dot(expected));
    }
}

#[test]
fn collapsed_bodies_give_unit_normals_and_wrong_lengths_an_error() {
    let body = ball();
    let (skin, _) = EmbeddedSkin::new(sphere(2, 0.48), &body).unwrap();
    for map in [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 0.0, 1.0)] {
        assert!(deformed(&skin, &body, |x| x * map).normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    }
    assert!(skin.deform(&[Vec3::ZERO], &mut DeformedSkin::default()).unwrap_err().to_string().contains("1 values"));
}
