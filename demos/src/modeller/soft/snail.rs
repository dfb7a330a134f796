//! A snail without its shell: a flat foot along x, a raised head towards +x, two stalks with eyes and two feelers.

use glam::Vec3;

use super::cells::Cells;
use super::disc::Disc;

/// How fine a snail is.
#[derive(Clone, Copy, Debug)]
pub struct Snail<'a> {
    /// Vertices of the rings of the cross-section.
    pub rings: &'a [u32],
    /// Cross-sections.
    pub layers: usize,
    /// Layers of an eye's stalk.
    pub stalk: usize,
}

/// The simulated snail.
pub const COARSE: Snail = Snail { rings: &[1, 6, 12], layers: 27, stalk: 6 };

/// Middle of the foot at the share `u` from the tail (0) to the head (1).
pub fn middle(u: f32) -> Vec3 {
    let raised = ((u - 0.66) / 0.34).max(0.0);
    Vec3::new(1.9 * (u - 0.5) - 0.1 * raised * raised, 0.3 * raised.powf(1.6), 0.0)
}

/// Half width and height of the body at `u`.
fn profile(u: f32) -> (f32, f32) {
    let tail = (u / 0.5).min(1.0);
    let head = ((1.0 - u) / 0.12).min(1.0);
    let round = (1.0 - (1.0 - head).powi(2)).max(0.0).sqrt();
    let width = (0.06 + 0.2 * tail.powf(0.8)) * (0.6 + 0.4 * round) * (1.0 - 0.3 * ((u - 0.6) / 0.3).clamp(0.0, 1.0));
    // Thick enough at the tail that its lowest cells are not pressed flat by the ground.
    let height = (0.12 + 0.18 * tail) * (0.6 + 0.4 * round);
    (width, height)
}

/// Models a snail.
pub fn snail(form: &Snail) -> Cells {
    let disc = Disc::new(form.rings);
    let last = form.layers - 1;
    let place = |v: u32, layer: usize| {
        let u = layer as f32 / last as f32;
        let (width, height) = profile(u);
        let flat = disc.point(v);
        // The foot is flat: below the middle the cross-section is squeezed.
        let up = if flat.y < 0.0 { 0.3 * flat.y } else { 0.7 * flat.y };
        let ahead = (middle((u + 0.02).min(1.0)) - middle((u - 0.02).max(0.0))).normalize();
        let normal = Vec3::Z.cross(ahead);
        let bulge = if layer == 0 {
            -0.4
        } else if layer == last {
            0.5
        } else {
            0.0
        };
        let out = ahead * (bulge * width * (1.0 - disc.radius(v).powi(2)));
        middle(u) + normal * (height * (up + 0.3)) - Vec3::Z * (-width * flat.x) + out
    };
    // Seen from ahead the cross-section turns the other way round.
    let turned: Vec<[u32; 3]> = disc.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let mut cells = Cells::sweep(&turned, form.layers, |_, _| true, place);
    for side in [-1.0, 1.0] {
        let (eye, feeler) = (Vec3::new(0.2, 0.95, 0.28 * side), Vec3::new(0.8, 0.15, 0.25 * side));
        grow(&mut cells, Vec3::new(0.72, 0.58, 0.09 * side), eye, 0.42, form.stalk, 1.35);
        grow(&mut cells, Vec3::new(0.93, 0.3, 0.08 * side), feeler, 0.16, form.stalk / 2, 0.8);
    }
    cells
}

/// Grows a stalk of a length from the surface near a point; its end is `knob` times as thick as its middle.
fn grow(cells: &mut Cells, near: Vec3, direction: Vec3, length: f32, layers: usize, knob: f32) {
    let base = cells.patch(near);
    let mut vertices: Vec<u32> = base.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let centre = vertices.iter().map(|&v| cells.positions[v as usize]).sum::<Vec3>() / vertices.len() as f32;
    let direction = direction.normalize();
    cells.extrude(&base, layers, |p, layer| {
        let u = layer as f32 / layers as f32;
        let d = p - centre;
        let level = d - direction * d.dot(direction);
        let flat = d.lerp(level, (2.5 * u).min(1.0));
        let thick = 0.55 - 0.15 * u + (knob - 0.4) * 0.45 * ((u - 0.72) / 0.28).max(0.0);
        centre + direction * (length * u) + flat.clamp_length_max(0.085) * thick
    });
}
