//! A jellyfish: a bell that opens downward, tentacles from its rim, and a stalk with the mouth from its middle.

use std::f32::consts::TAU;

use glam::Vec3;

use super::cells::Cells;
use super::disc::Disc;

/// How fine a jellyfish is.
#[derive(Clone, Copy, Debug)]
pub struct Jellyfish<'a> {
    /// Vertices of the rings from the top to the rim.
    pub rings: &'a [u32],
    /// Layers of vertices through the wall.
    pub wall: usize,
    /// Cells of the rim between the beginnings of two tentacles.
    pub spacing: u32,
    /// Cells of the rim that a tentacle is wide.
    pub width: u32,
    /// Layers of a tentacle.
    pub tentacle: usize,
    /// Layers of the stalk; it grows from the innermost ring.
    pub stalk: usize,
}

/// The jellyfish of figure 1.
pub const LARGE: Jellyfish =
    Jellyfish { rings: &[1, 8, 16, 24, 24, 24, 24], wall: 3, spacing: 3, width: 1, tentacle: 9, stalk: 6 };
/// The jellyfish of figure 10.
pub const SMALL: Jellyfish =
    Jellyfish { rings: &[1, 6, 12, 16, 16], wall: 3, spacing: 4, width: 1, tentacle: 7, stalk: 0 };
/// The drawn surface of the small one.
pub const SMALL_SKIN: Jellyfish =
    Jellyfish { rings: &[1, 6, 12, 32, 32, 64, 64, 64, 64], wall: 3, spacing: 16, width: 4, tentacle: 28, stalk: 0 };
/// The drawn surface of the large one.
pub const LARGE_SKIN: Jellyfish = Jellyfish {
    rings: &[1, 8, 16, 24, 48, 48, 48, 96, 96, 96, 96, 96, 96],
    wall: 3,
    spacing: 12,
    width: 4,
    tentacle: 36,
    stalk: 24,
};

/// Radius of the bell.
pub const RADIUS: f32 = 0.6;
/// Angle from the top to the rim.
const RIM: f32 = 1.72;

/// A place in the wall: `v` from the top (0) to the rim (1), `angle` around, `depth` from the inside (0) to the outside (1).
pub fn in_wall(v: f32, angle: f32, depth: f32) -> Vec3 {
    let theta = RIM * v;
    // The wall is thickest on top and thin at the rim; the rim waves a little.
    let thickness = 0.17 * (1.0 - 0.72 * v * v);
    let radius = RADIUS + (depth - 1.0) * thickness;
    let wave = 1.0 + 0.03 * v.powi(4) * (8.0 * angle).cos();
    let out = radius * theta.sin() * wave;
    Vec3::new(out * angle.cos(), 0.82 * radius * theta.cos(), -out * angle.sin())
}

/// Models a jellyfish.
pub fn jellyfish(form: &Jellyfish) -> Cells {
    let disc = Disc::new(form.rings);
    let around = form.rings[form.rings.len() - 1];
    let place = |v: u32, layer: usize| in_wall(disc.radius(v), disc.angle(v), layer as f32 / (form.wall - 1) as f32);
    let mut cells = Cells::sweep(&disc.triangles, form.wall, |_, _| true, place);
    let rim = rim_triangles(&cells, &disc, form);
    for tentacle in 0..around / form.spacing {
        let first = tentacle * form.spacing;
        let base: Vec<[u32; 3]> =
            rim.iter().filter(|(k, _)| (first..first + form.width).contains(k)).map(|r| r.1).collect();
        let angle = TAU * (first as f32 + 0.5 * form.width as f32) / around as f32;
        let length = if tentacle % 2 == 0 { 1.15 } else { 0.85 };
        hang(&mut cells, &base, form.tentacle, length, angle);
    }
    if form.stalk > 0 {
        stalk(&mut cells, form);
    }
    cells
}

/// The triangles of the rim with the cell of the rim that each lies in.
fn rim_triangles(cells: &Cells, disc: &Disc, form: &Jellyfish) -> Vec<(u32, [u32; 3])> {
    let (base, around) = (disc.places.len() as u32, form.rings[form.rings.len() - 1]);
    let last = base - around;
    let on_rim = |v: u32| v % base >= last;
    let rim = cells.boundary(|_| true).into_iter().filter(|t| t.iter().all(|&v| on_rim(v)));
    rim.map(|t| {
        let mut places = t.map(|v| v % base - last);
        places.sort_unstable();
        // The last cell goes from the last vertex of the ring to the first.
        let cell = if places[0] == 0 && places[2] == around - 1 { around - 1 } else { places[0] };
        (cell, t)
    })
    .collect()
}

/// Grows a tentacle down from the rim: it narrows, and sways outward and back.
fn hang(cells: &mut Cells, base: &[[u32; 3]], layers: usize, length: f32, angle: f32) {
    let mut vertices: Vec<u32> = base.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let centre = vertices.iter().map(|&v| cells.positions[v as usize]).sum::<Vec3>() / vertices.len() as f32;
    let out = Vec3::new(angle.cos(), 0.0, -angle.sin());
    let side = Vec3::new(angle.sin(), 0.0, angle.cos());
    cells.extrude(base, layers, |p, layer| {
        let u = layer as f32 / layers as f32;
        let along = centre + Vec3::NEG_Y * (length * u) + out * (0.05 * (4.0 * u).sin()) - out * (0.12 * u);
        let d = p - centre;
        // Cross-sections turn level soon and narrow to the end; sideways they are as thick as through the wall.
        let narrow = 1.0 - 0.45 * u;
        let level = Vec3::new(d.x, d.y * (1.0 - (4.0 * u).min(1.0)), d.z);
        let (wide, thick) = (level.dot(side), level.dot(out));
        let slim = 0.65 + 0.35 * (1.0 - (3.0 * u).min(1.0));
        along + (side * (wide * slim) + out * thick * 1.15 + Vec3::Y * level.y) * narrow
    });
}

/// Grows the stalk from the middle of the inside.
fn stalk(cells: &mut Cells, form: &Jellyfish) {
    let width = in_wall(1.05 / (form.rings.len() - 1) as f32 * stalk_rings(form), 0.0, 0.0).x;
    let inside = |p: Vec3| p.x.hypot(p.z) <= width && p.y < in_wall(0.0, 0.0, 0.5).y;
    let base = cells.boundary(|t| t.iter().all(|p| inside(*p)));
    let top = in_wall(0.0, 0.0, 0.0).y;
    let layers = form.stalk;
    cells.extrude(&base, layers, |p, layer| {
        let u = layer as f32 / layers as f32;
        let level = (1.0 - 2.0 * u).max(0.0);
        // Four folds at the mouth.
        let angle = p.z.atan2(p.x);
        let folds = 1.0 + 0.3 * u * u * (4.0 * angle).cos();
        let narrow = (0.85 - 0.2 * (3.0 * u).min(1.0) + 0.25 * u * u) * folds;
        Vec3::new(p.x * narrow, top - 0.62 * u + (p.y - top) * level - 0.02 * (1.0 - level), p.z * narrow)
    });
}

/// How many rings the stalk is wide: the same share of the bell for all forms.
fn stalk_rings(form: &Jellyfish) -> f32 {
    ((form.rings.len() - 1) as f32 / 6.0).round().max(1.0)
}
