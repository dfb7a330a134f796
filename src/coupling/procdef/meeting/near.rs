//! What of two bodies that are apart may come together in the coming step: vertices and triangles, edges and edges.
//!
//! Nothing else can meet: two triangles that come to cross begin with a vertex in a triangle or with two crossing edges.

use super::MeetingBody;
use super::boxes::{SomePacks, are_near};
use super::detect::Sight;
use super::encounters::Placed;
use super::frames::Reach;
use super::lanes::LANES;
use crate::math::Vec3;

/// Nearer than this part of an edge there is no direction from one to the other.
const TOUCHING: f32 = 1e-6;

/// Surfaces come no nearer than this part of the gap that is kept between them: below it digits are lost.
const FLOOR: f32 = 0.05;
/// The part of a distance that is never used up in one step.
const KEPT: f32 = 0.1;

/// An exact normal and the way between nearest points are one direction from this cosine on.
const SAME_WAY: f32 = 0.99;
/// The square of the sine below which two edges are parallel.
const PARALLEL: f32 = 1e-6;

/// What is near of two bodies is not gathered beyond so many things: bodies that are so fast, and so fine, may get into each other.
const MOST: usize = 1 << 20;

/// A vertex holds several triangles of another body where it lies in a fold: their ways out differ by more than this cosine.
const OTHER_WAY: f32 = 0.7;

/// A vertex near a triangle, or an edge near an edge.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// The vertices, counted through all bodies: the vertex and three corners, or the ends of the edges.
    pub vertices: [u32; 4],
    /// How many of them are of the first body: one or two.
    pub first: usize,
    /// The nearest point of the first body minus that of the second is the sum of the vertices with these weights.
    pub weights: [f32; 4],
    /// Unit way from the second to the first.
    pub normal: Vec3,
    /// How far the nearest points are apart, in metres.
    pub distance: f32,
    /// How far both sides together may come in the step, in metres.
    pub room: f32,
    /// How far each vertex is behind the nearest point of its side, along the normal, in metres; below 0 by rounding alone.
    pub behind: [f32; 4],
    /// Whether a contact holds it: else it is only watched.
    pub presses: bool,
}

/// One of two bodies.
pub struct Side<'a> {
    /// The body.
    pub body: &'a MeetingBody<'a>,
    /// As the others see it.
    pub sight: &'a Sight,
    /// Its surface now.
    pub placed: &'a Placed,
    /// How far its vertices may go in the step.
    pub reach: &'a Reach,
    /// Its first vertex among those of all bodies.
    pub offset: u32,
}

/// All that is near of two bodies.
pub fn near_of(a: &Side<'_>, b: &Side<'_>) -> Vec<Near> {
    let mut found = Vec::new();
    let own = [a.sight.bounds.mins - a.reach.farthest, a.sight.bounds.maxs + a.reach.farthest];
    let other = [b.sight.bounds.mins - b.reach.farthest, b.sight.bounds.maxs + b.reach.farthest];
    let spare = a.reach.spare + b.reach.spare;
    if are_near(own, other, spare) {
        vertices_near_triangles(a, (b, other), spare, &mut found);
        vertices_near_triangles(b, (a, own), spare, &mut found);
        edges_near_edges(a, (b, other), spare, &mut found);
    }
    found
}

fn vertices_near_triangles(a: &Side<'_>, (b, other): (&Side<'_>, [Vec3; 2]), spare: f32, found: &mut Vec<Near>) {
    let triangles = &b.placed.triangles;
    let surface = a.body.surface;
    let mut packs = SomePacks::default();
    let mut seen = surface.vertices.len();
    for (points, &around) in surface.points.chunks_exact(LANES).zip(a.placed.points.corners()) {
        if are_near(around, other, spare) {
            triangles.boxes.select(around, spare, &mut packs);
            if !packs.is_empty() {
                for &[v] in points.iter().take(seen) {
                    vertex_near_triangles(v, a, b, &packs, spare, found);
                }
            }
        }
        seen = seen.saturating_sub(LANES);
    }
}

fn vertex_near_triangles(v: u32, a: &Side<'_>, b: &Side<'_>, packs: &SomePacks, spare: f32, found: &mut Vec<Near>) {
    let (x, y) = (a.body.body.positions(), b.body.body.positions());
    let skins = a.sight.skin + b.sight.skin;
    let at = x[v as usize];
    let moves = a.reach.moves[v as usize];
    let spare = spare + moves;
    let from = found.len();
    b.placed.triangles.within(packs, at, spare, |near, farthest| {
        let distance = near.way.length();
        let touching = distance <= TOUCHING * b.body.surface.edge;
        if touching && near.normal == Vec3::ZERO || found.len() >= MOST {
            return;
        }
        let corners = b.body.surface.triangles[near.triangle];
        let inside = near.weights.iter().all(|w| *w > 0.0);
        let normal = match touching {
            true => near.normal,
            false => direction(near.way, distance, if inside { near.normal } else { Vec3::ZERO }),
        };
        let point = at - near.way;
        let [p, q, r] = corners.map(|c| normal.dot(point - y[c as usize]));
        let [wp, wq, wr] = near.weights;
        found.push(Near {
            vertices: [v + a.offset, corners[0] + b.offset, corners[1] + b.offset, corners[2] + b.offset],
            first: 1,
            weights: [1.0, -wp, -wq, -wr],
            normal,
            distance,
            room: room(near.way.dot(normal), skins),
            behind: [0.0, p, q, r],
            presses: distance - skins <= moves + farthest,
        });
    });
    // Of triangles in the same direction the nearest presses.
    let own = &mut found[from..];
    own.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.vertices.cmp(&b.vertices)));
    for k in 1..own.len() {
        let (before, rest) = own.split_at_mut(k);
        let same = |other: &Near| other.presses && other.normal.dot(rest[0].normal) > OTHER_WAY;
        rest[0].presses = rest[0].presses && !before.iter().any(same);
    }
}

fn edges_near_edges(a: &Side<'_>, (b, other): (&Side<'_>, [Vec3; 2]), spare: f32, found: &mut Vec<Near>) {
    let surface = a.body.surface;
    let mut packs = SomePacks::default();
    let mut seen = surface.edge_count;
    for (edges, &around) in surface.edges.chunks_exact(LANES).zip(a.placed.edges.boxes.corners()) {
        if are_near(around, other, spare) {
            b.placed.edges.boxes.select(around, spare, &mut packs);
            if !packs.is_empty() {
                for &edge in edges.iter().take(seen) {
                    edge_near_edges(edge, a, b, &packs, spare, found);
                }
            }
        }
        seen = seen.saturating_sub(LANES);
    }
}

fn edge_near_edges([v, w]: [u32; 2], a: &Side<'_>, b: &Side<'_>, packs: &SomePacks, spare: f32, found: &mut Vec<Near>) {
    let (x, y) = (a.body.body.positions(), b.body.body.positions());
    let skins = a.sight.skin + b.sight.skin;
    let (p, q) = (x[v as usize], x[w as usize]);
    let moves = a.reach.moves[v as usize].max(a.reach.moves[w as usize]);
    let spare = spare + moves;
    b.placed.edges.within(packs, [p, q], spare, |near, farthest| {
        let distance = near.way.length();
        if distance <= TOUCHING * b.body.surface.edge || found.len() >= MOST {
            return;
        }
        let [e, f] = b.body.surface.edges[near.edge];
        let [s, t] = near.at;
        // At an end a vertex is nearer to one of the triangles beside the edge, or as near.
        let crossed = s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
        let exact = if crossed { across(q - p, y[f as usize] - y[e as usize]) } else { Vec3::ZERO };
        let normal = direction(near.way, distance, exact);
        let (own, other) = (p + (q - p) * s, y[e as usize] + (y[f as usize] - y[e as usize]) * t);
        let own = [p, q].map(|x| normal.dot(x - own));
        let other = [e, f].map(|c| normal.dot(other - y[c as usize]));
        found.push(Near {
            vertices: [v + a.offset, w + a.offset, e + b.offset, f + b.offset],
            first: 2,
            weights: [1.0 - s, s, t - 1.0, -t],
            normal,
            distance,
            room: room(near.way.dot(normal), skins),
            behind: [own[0], own[1], other[0], other[1]],
            presses: crossed && distance - skins <= moves + farthest,
        });
    });
}

/// How far two things that are `distance` apart may come.
fn room(distance: f32, skins: f32) -> f32 {
    (distance - FLOOR * skins).min((1.0 - KEPT) * distance).max(0.0)
}

/// The unit way between nearest points; along `exact` where that is the same direction: what is at right angles to both things
/// does not lose its digits where they nearly touch.
fn direction(way: Vec3, distance: f32, exact: Vec3) -> Vec3 {
    let way = way / distance;
    if way.dot(exact).abs() > SAME_WAY { exact * way.dot(exact).signum() } else { way }
}

/// What is at right angles to two edges, unit; zero where they are so nearly parallel that its digits are lost.
fn across(first: Vec3, second: Vec3) -> Vec3 {
    let across = first.cross(second);
    let least = PARALLEL * first.length_squared() * second.length_squared();
    if across.length_squared() > least { across.normalize_or_zero() } else { Vec3::ZERO }
}

impl Near {
    /// How far each side comes towards the other beyond its nearest point, along the normal, if the vertices go these ways.
    #[inline]
    pub fn approaches(&self, ways: &[Vec3]) -> [f32; 2] {
        let mut most = [f32::NEG_INFINITY; 2];
        for (k, (&v, behind)) in self.vertices.iter().zip(self.behind).enumerate() {
            let second = k >= self.first;
            let along = ways[v as usize].dot(self.normal);
            let ahead = if second { along } else { -along } - behind;
            most[usize::from(second)] = most[usize::from(second)].max(ahead);
        }
        most
    }
}
