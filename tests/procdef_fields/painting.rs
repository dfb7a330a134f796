//! The tools that place constraint points.

use std::f32::consts::PI;

use pliant::math::Vec3;
use pliant::procdef::{Brush, Canvas, PaintError};

use crate::meshes::{bar, cylinder};

#[test]
fn a_face_gives_its_three_corners() {
    let mesh = bar([2, 1, 1], 1.0);
    let corners = mesh.boundary()[3].map(|v| mesh.positions[v as usize]);
    assert_eq!(Canvas::new(&mesh).points(&Brush::Face(3)).unwrap(), corners);
}

#[test]
fn a_region_ends_at_edges_sharper_than_its_angle() {
    let mesh = bar([4, 2, 2], 0.5);
    let canvas = Canvas::new(&mesh);
    let region = |seed, degrees: f32| canvas.points(&Brush::Region { seed, angle: degrees.to_radians() }).unwrap();
    let top = region(Vec3::new(1.0, 1.0, 0.5), 30.0);
    assert!(top.iter().all(|p| p.y == 1.0));
    assert_eq!(top.len(), 5 * 3);
    // Across right angles it takes the whole surface: all but the three vertices inside.
    assert_eq!(region(Vec3::new(1.0, 1.0, 0.5), 91.0).len(), mesh.vertex_count() - 3);
}

#[test]
fn a_region_goes_around_a_smooth_bend() {
    let mesh = cylinder(4.0, 8, 4);
    let canvas = Canvas::new(&mesh);
    let side = canvas.points(&Brush::Region { seed: Vec3::new(2.0, 1.0, 0.0), angle: 30f32.to_radians() }).unwrap();
    // 32 vertices around, nine rings; the flat ends meet the side at right angles.
    assert_eq!(side.len(), 32 * 9);
    assert!(side.iter().all(|p| (p.y.hypot(p.z) - 1.0).abs() < 1e-5));
}

#[test]
fn strokes_lie_on_the_surface_and_sections_in_their_plane() {
    let mesh = cylinder(4.0, 8, 3);
    let canvas = Canvas::new(&mesh);
    let line = vec![Vec3::new(0.5, 1.05, 0.0), Vec3::new(3.5, 1.05, 0.0)];
    let drawn = canvas.points(&Brush::Stroke(line)).unwrap();
    assert!(drawn.len() > 10);
    assert!(drawn.iter().all(|p| (p.y - 1.0).abs() < 1e-4 && p.z.abs() < 1e-4));
    let plane = |stroke| Brush::Section { origin: Vec3::X * 1.7, normal: Vec3::X * 3.0, stroke };
    let all = canvas.points(&plane(vec![])).unwrap();
    assert!(all.len() >= 49 && all.iter().all(|p| (p.x - 1.7).abs() < 1e-5));
    let drawn = canvas.points(&plane(vec![Vec3::new(0.0, 0.0, -0.5), Vec3::new(3.0, 0.2, 0.5)])).unwrap();
    assert!(drawn.iter().all(|p| (p.x - 1.7).abs() < 1e-5 && p.z.abs() <= 0.5));
}

#[test]
fn tools_that_miss_the_body_say_by_how_much() {
    let mesh = bar([2, 1, 1], 1.0);
    let canvas = Canvas::new(&mesh);
    let error = |brush| canvas.points(&brush).unwrap_err();
    assert_eq!(error(Brush::Face(99)), PaintError::Face { face: 99, count: 20 });
    let away = error(Brush::Stroke(vec![Vec3::ZERO, Vec3::new(0.0, 4.0, 0.0)]));
    assert!(matches!(away, PaintError::Away { what: "surface", .. }), "{away}");
    let seed = error(Brush::Region { seed: Vec3::new(1.0, 5.0, 0.5), angle: 0.1 });
    assert_eq!(seed, PaintError::Away { point: 0, at: [1.0, 5.0, 0.5], distance: 4.0, what: "surface" });
    let plane = |origin, normal| Brush::Section { origin, normal, stroke: vec![] };
    assert_eq!(error(plane(Vec3::X * 3.0, Vec3::X)), PaintError::Misses);
    assert_eq!(error(plane(Vec3::X, Vec3::ZERO)), PaintError::NoNormal);
    assert_eq!(error(Brush::Region { seed: Vec3::ZERO, angle: 2.0 * PI }), PaintError::Angle(360.0));
    assert_eq!(error(Brush::Stroke(vec![])), PaintError::Short { least: 1, points: 0 });
    assert_eq!(error(Brush::Stroke(vec![Vec3::ZERO, Vec3::NAN])), PaintError::NotFinite(1));
}
