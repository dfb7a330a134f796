//! A heart: a thick left ventricle, and a right one that embraces it. The base lies in the plane y = 0, the apex points
//! down, the right ventricle lies towards -x.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::cells::Cells;
use super::disc::Disc;

/// Outer radius of the left ventricle at the base.
pub const RADIUS: f32 = 0.5;
/// From the base to the apex.
pub const HEIGHT: f32 = 1.25;
/// How far the right ventricle stands out from the left one.
const BULGE: f32 = 0.33;
/// Thickness of the wall of the right ventricle.
const RIGHT_WALL: f32 = 0.11;

/// How fine a heart is: everything goes by multiples of 24 vertices around and 14 layers.
#[derive(Clone, Copy, Debug)]
pub struct Fineness {
    /// Times 24 vertices around.
    pub around: u32,
    /// Times 14 layers.
    pub along: usize,
}

/// The simulated heart.
pub const COARSE: Fineness = Fineness { around: 1, along: 1 };
/// Its drawn surface.
pub const FINE: Fineness = Fineness { around: 3, along: 4 };

/// Outer radius of the left ventricle, by the share `s` of the height from the apex (0) to the base (1).
pub fn outer(s: f32) -> f32 {
    RADIUS * (1.0 - (0.85 * (1.0 - s)).powi(2)).sqrt() * (1.0 - 0.12 * s.powi(4))
}

/// Radius of its cavity.
pub fn inner(s: f32) -> f32 {
    outer(s) * (0.36 + 0.26 * s.sqrt())
}

/// How far the right ventricle's cavity stands out, before the curve around.
fn bulge(s: f32) -> f32 {
    let u = ((s - 0.12) / 0.75).clamp(0.0, 1.0);
    BULGE * (0.28 + 0.72 * u * (2.0 - u)) * (0.9 + 0.1 * s)
}

/// A place on the left ventricle: `depth` from the middle axis (-1) over the cavity's surface (0) to the outside (1).
pub fn in_left(s: f32, angle: f32, depth: f32) -> Vec3 {
    let radius = if depth < 0.0 { inner(s) * (1.0 + depth) } else { inner(s) + (outer(s) - inner(s)) * depth };
    let share = radius / outer(s);
    // The apex is a dome.
    let dip = 0.17 * (1.0 - share * share) * (1.0 - s).powi(4);
    at(radius, angle, HEIGHT * (s - 1.0) - dip)
}

fn at(radius: f32, angle: f32, height: f32) -> Vec3 {
    let flat = radius * Vec2::from_angle(angle);
    Vec3::new(flat.x, height, -flat.y)
}

/// The flat cross-section: where each vertex lies, and what its triangles belong to.
struct Section {
    triangles: Vec<[u32; 3]>,
    parts: Vec<Part>,
    /// Vertices of the disc of the left ventricle.
    left: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Part {
    LeftWall,
    LeftCavity,
    RightWall,
    RightCavity,
}

/// Vertices between the two places where the right wall grows from the left one, at 24 around.
const SPAN: u32 = 10;
/// The first of these places, on the ring of 24.
const START: u32 = 7;

fn section(disc: &Disc, around: u32) -> Section {
    let n = 24 * around;
    let left = disc.places.len() as u32;
    let ring = left - n;
    let inside = |t: &[u32; 3]| t.iter().any(|&v| disc.places[v as usize].0 < 2);
    let mut triangles = disc.triangles.clone();
    let mut parts: Vec<Part> =
        triangles.iter().map(|t| if inside(t) { Part::LeftCavity } else { Part::LeftWall }).collect();
    // The right wall leaves the left one over `around` edges on each side, and has as many cells through its thickness.
    let (first, cells) = (START * around, (SPAN - 2) * around);
    let chain = |depth: u32, k: u32| match k {
        0 => ring + first + around - depth,
        k if k == cells => ring + first + around + cells + depth,
        k => left + depth * (cells - 1) + k - 1,
    };
    let mut quad = |a: u32, b: u32, c: u32, d: u32, part| {
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            if p != q && q != r && r != p {
                triangles.push([p, q, r]);
                parts.push(part);
            }
        }
    };
    for k in 0..cells {
        let on_left = ring + first + around + k;
        quad(on_left, chain(0, k), chain(0, k + 1), on_left + 1, Part::RightCavity);
        for d in 0..around {
            quad(chain(d, k), chain(d + 1, k), chain(d + 1, k + 1), chain(d, k + 1), Part::RightWall);
        }
    }
    Section { triangles, parts, left }
}

/// Models a heart.
pub fn heart(fineness: Fineness) -> Cells {
    let (around, along) = (fineness.around, fineness.along);
    let n = 24 * around;
    let disc = Disc::new(&[1, n / 2, n, n, n]);
    let section = section(&disc, around);
    let layers = 14 * along + 1;
    let solid = |t: usize, layer: usize| match section.parts[t] {
        Part::LeftWall => true,
        Part::LeftCavity => layer < 2 * along,
        Part::RightWall => layer >= 2 * along,
        Part::RightCavity => (2 * along..3 * along).contains(&layer),
    };
    let cells = (SPAN - 2) * around;
    Cells::sweep(&section.triangles, layers, solid, |v, layer| {
        let s = layer as f32 / (layers - 1) as f32;
        if v < section.left {
            let (ring, turn) = disc.places[v as usize];
            let depth = [-1.0, -0.5, 0.0, 0.5, 1.0][ring];
            return in_left(s, turn * TAU, depth);
        }
        let k = v - section.left;
        let (depth, k) = (k / (cells - 1), k % (cells - 1) + 1);
        right(s, k as f32 / cells as f32, depth as f32 / around as f32)
    })
}

/// A place on the wall of the right ventricle: `u` around from 0 to 1, `depth` from the cavity (0) to the outside (1).
pub fn right(s: f32, u: f32, depth: f32) -> Vec3 {
    let turn = |edges: f32| TAU * edges / 24.0;
    let (first, span) = (START as f32, SPAN as f32);
    let inside = turn(first + 1.0 + u * (span - 2.0));
    let outside = turn(first + u * span);
    // The wall stands out like an arch.
    let arch = (std::f32::consts::PI * u).sin().powf(0.75);
    let radius = outer(s) + bulge(s) * arch + depth * RIGHT_WALL * (0.45 + 0.55 * arch);
    let height = HEIGHT * (s - 1.0);
    at(radius, inside + (outside - inside) * depth, height)
}
