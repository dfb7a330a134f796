//! A piece of bowel: a tube in the shape of an S, open at both ends.

use std::f32::consts::PI;

use glam::Vec3;

use super::cells::Cells;
use super::disc::Disc;

/// Outer radius of the tube.
pub const OUTER: f32 = 0.26;
/// Inner radius of the tube.
pub const INNER: f32 = 0.15;
/// Radius of the two bends.
const BEND: f32 = 0.55;
/// Straight pieces at the ends.
const STRAIGHT: f32 = 0.45;

/// A point of the middle line and the direction of the line there, by the share `u` of its length. It lies in the
/// plane z = 0 and begins at the lower left.
pub fn middle(u: f32) -> (Vec3, Vec3) {
    let bend = PI * BEND;
    let s = u * (2.0 * bend + 2.0 * STRAIGHT);
    let around = |centre: Vec3, angle: f32, turn: f32| {
        let (sin, cos) = angle.sin_cos();
        (centre + BEND * Vec3::new(cos, sin, 0.0), turn * Vec3::new(-sin, cos, 0.0))
    };
    if s < STRAIGHT {
        (Vec3::new(s - STRAIGHT, -2.0 * BEND, 0.0), Vec3::X)
    } else if s < STRAIGHT + bend {
        around(Vec3::new(0.0, -BEND, 0.0), -0.5 * PI + (s - STRAIGHT) / BEND, 1.0)
    } else if s < STRAIGHT + 2.0 * bend {
        around(Vec3::new(0.0, BEND, 0.0), -0.5 * PI - (s - STRAIGHT - bend) / BEND, -1.0)
    } else {
        (Vec3::new(s - STRAIGHT - 2.0 * bend, 2.0 * BEND, 0.0), Vec3::X)
    }
}

/// Models a tube of `around` vertices a ring and `layers` cross-sections; `haustra` is how deep the furrows between its pouches
/// are, as a share of the radius.
pub fn bowel(around: u32, layers: usize, haustra: f32) -> Cells {
    let disc = Disc::new(&[around; 3]);
    Cells::sweep(
        &disc.triangles,
        layers,
        |_, _| true,
        |v, layer| {
            let u = layer as f32 / (layers - 1) as f32;
            let (centre, along) = middle(u);
            let side = Vec3::Z.cross(along);
            let furrow = 1.0 - haustra * (PI * 16.0 * u).cos().powi(6);
            let radius = INNER + (OUTER * furrow - INNER) * disc.radius(v);
            let (sin, cos) = disc.angle(v).sin_cos();
            centre + radius * (side * cos + Vec3::Z * sin)
        },
    )
}
