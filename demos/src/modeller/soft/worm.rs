//! Worms: round bodies along x with domed ends, the head towards +x.

use glam::Vec3;

use super::cells::Cells;
use super::disc::Disc;

/// What a worm measures and how fine it is.
#[derive(Clone, Copy, Debug)]
pub struct Worm<'a> {
    /// Length without the tips.
    pub length: f32,
    /// Largest radius.
    pub radius: f32,
    /// Vertices of the rings of the cross-section.
    pub rings: &'a [u32],
    /// Cross-sections.
    pub layers: usize,
    /// Depth of the grooves between segments, as a share of the radius.
    pub grooves: f32,
}

/// The worm of figure 8.
pub const LONG: Worm = Worm { length: 2.4, radius: 0.16, rings: &[1, 6, 12], layers: 25, grooves: 0.0 };
/// Its drawn surface.
pub const LONG_SKIN: Worm = Worm { rings: &[1, 8, 16, 28], layers: 181, grooves: 0.08, ..LONG };
/// The short worm of figure 10.
pub const SHORT: Worm = Worm { length: 1.0, radius: 0.16, rings: &[1, 6], layers: 10, grooves: 0.0 };
/// Its drawn surface.
pub const SHORT_SKIN: Worm = Worm { rings: &[1, 8, 16], layers: 61, grooves: 0.08, ..SHORT };

/// Segments of a worm of length 1.
const SEGMENTS: f32 = 10.0;

/// Models a worm.
pub fn worm(worm: &Worm) -> Cells {
    let disc = Disc::new(worm.rings);
    let last = worm.layers - 1;
    // Shares of the length, closer together at the ends where the body is round.
    let share = |layer: usize| {
        let u = layer as f32 / last as f32;
        u - 0.35 / std::f32::consts::TAU * (std::f32::consts::TAU * u).sin()
    };
    let profile = |u: f32| {
        let end = 1.6 * worm.radius / worm.length;
        let near = (u.min(1.0 - u) / end).min(1.0);
        let dome = 0.62 + 0.38 * (1.0 - (1.0 - near).powi(2)).max(0.0).sqrt();
        // A little thicker behind the head.
        let swell = 0.92 + 0.12 * (-((u - 0.72) / 0.09).powi(2)).exp();
        let groove = 1.0 - worm.grooves * near * (std::f32::consts::PI * SEGMENTS * worm.length * u).cos().powi(8);
        worm.radius * dome * swell * groove
    };
    let place = |v: u32, layer: usize| {
        let u = share(layer);
        let flat = disc.point(v) * profile(u);
        // The end faces bulge.
        let bulge = if layer == 0 {
            -1.0
        } else if layer == last {
            1.0
        } else {
            0.0
        };
        let out = bulge * 0.38 * worm.radius * (1.0 - disc.radius(v).powi(2));
        Vec3::new((u - 0.5) * worm.length + out, flat.x, flat.y)
    };
    let mut cells = Cells::sweep(&disc.triangles, worm.layers, |_, _| true, place);
    if worm.rings.len() == 2 {
        // The coarsest worm gets pointed ends.
        for side in [-1.0, 1.0] {
            let end = 0.5 * side * worm.length;
            let cap = cells.boundary(|t| t.iter().all(|p| (p.x - end) * side > -1.0e-3));
            cells.tip(&cap, Vec3::X * (end + side * 0.55 * worm.radius));
        }
    }
    cells
}
