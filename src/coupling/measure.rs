//! What a penetration looked like before the cancellation and what is left of it, by parry's exact queries.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::cancel::CancelReport;
use super::coherence::TimeCoherence;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, SAME_WAY};
use super::piercing::deepest_on_triangle;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// Depths and gaps as fractions of the body's size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenetrationFigures {
    /// Largest depth along the way out before the cancellation.
    pub max_depth_before: f32,
    /// Largest exact depth of a vertex after it.
    pub max_depth_after: f32,
    /// Largest depth of any point of a triangle after it; depths below [`PIERCING_RESOLUTION`] are not looked for.
    pub max_piercing: f32,
    /// Largest distance left between the skin of a contact that is pushed by a field of its own and the obstacle that it had
    /// penetrated.
    pub max_gap: f32,
    /// Largest distance to which skin was carried off an obstacle by the fields of other contacts: such a contact needs no
    /// push of its own.
    pub max_lift: f32,
    /// Vertices deeper than [`INSIDE`] after it.
    pub vertices_inside: u32,
    /// True where the penetration is beyond what cancellation can do: a vertex is left deeper than [`INSIDE`], or a
    /// triangle is pierced deeper than [`PIERCED`]. So it is where a body is pinned with no room for its volume, or where
    /// an obstacle cuts it in two.
    pub uncancelled: bool,
    /// How much the cancellation has changed since the step before, against what the body and the obstacles have moved.
    pub coherence: TimeCoherence,
}

/// A vertex counts as inside from this depth on, as a fraction of the body's size.
pub const INSIDE: f32 = 1.0e-3;

/// A triangle counts as pierced from this depth on, as a fraction of the body's size.
pub const PIERCED: f32 = 5.0e-3;

/// Triangles are searched for points deeper than this, as a fraction of the body's size.
pub const PIERCING_RESOLUTION: f32 = 2.0e-4;

/// Measures the skin of `body` against `parts`; the time coherence is left at zero.
pub fn measure(body: &ElasticBody, parts: &[ObstaclePart], size: f32, report: &CancelReport) -> PenetrationFigures {
    let depths = exact_depths(body.positions(), parts);
    let deepest = depths.iter().copied().fold(0.0, f32::max);
    let vertices_inside = depths.iter().filter(|&&depth| depth > INSIDE * size).count() as u32;
    let piercing = deepest_triangle(body, parts, PIERCING_RESOLUTION * size).max(deepest) / size;
    // A tip touches skin that the contact's field has carried there: a field is at most twice as strong as the deepest contact is deep.
    let farthest = 2.0 * report.contacts.iter().map(Contact::depth).fold(0.0, f32::max);
    let gaps = gaps(body, parts, size, report, |contact| contact.depth().max(contact.pushed.min(farthest)));
    let largest = |held: bool| {
        let of = report.contacts.iter().zip(&gaps).filter(|(contact, _)| contact.held == held);
        of.map(|(_, gap)| *gap).fold(0.0, f32::max)
    };
    let max_gap = largest(true);
    PenetrationFigures {
        max_depth_before: report.contacts.iter().map(Contact::depth).fold(0.0, f32::max) / size,
        max_depth_after: deepest / size,
        max_piercing: piercing,
        max_gap: max_gap / size,
        max_lift: largest(false) / size,
        vertices_inside,
        uncancelled: vertices_inside > 0 || piercing > PIERCED,
        coherence: TimeCoherence::default(),
    }
}

/// The exact depth of each vertex in the parts.
fn exact_depths(positions: &[Vec3], parts: &[ObstaclePart]) -> Vec<f32> {
    let depth = |&x: &Vec3| parts.iter().map(|part| part.exact_depth(x)).fold(0.0, f32::max);
    positions.par_iter().with_min_len(512).map(depth).collect()
}

/// The largest depth of a point of any triangle in any part, where it is above `least`; zero otherwise.
///
/// The signed distance is convex: the planes that touch it at the three corners bound it from below, and only triangles
/// whose bound lies below `-least` are searched.
fn deepest_triangle(body: &ElasticBody, parts: &[ObstaclePart], least: f32) -> f32 {
    let positions = body.positions();
    let triangle = |t: &[u32; 3]| {
        let corners = t.map(|v| positions[v as usize]);
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        let bounds = Aabb::new(low, high);
        let mut deepest = 0.0_f32;
        for part in parts.iter().filter(|part| part.aabb.intersects(&bounds)) {
            let bound = |&at: &Vec3| {
                let (height, gradient) = part.placed.signed_distance(at);
                corners.iter().map(|x| height + gradient.dot(*x - at)).fold(f32::INFINITY, f32::min)
            };
            if corners.iter().all(|at| bound(at) < -least.max(deepest)) {
                deepest = deepest.max(-deepest_on_triangle(&part.placed, corners).1);
            }
        }
        if deepest > least { deepest } else { 0.0 }
    };
    body.rig().mesh.triangles.par_iter().with_min_len(256).map(triangle).reduce(|| 0.0, f32::max)
}

/// The largest distance in metres that is left at a contact that is pushed by a field of its own.
pub(super) fn widest_held_gap(body: &ElasticBody, parts: &[ObstaclePart], size: f32, report: &CancelReport) -> f32 {
    let gaps = gaps(body, parts, size, report, Contact::depth);
    report.contacts.iter().zip(&gaps).filter(|(contact, _)| contact.held).map(|(_, gap)| *gap).fold(0.0, f32::max)
}

/// How far the skin of each contact is from its obstacles now.
///
/// The parts of one obstacle count together: they overlap, and what leaves one of them may have to stop at the next.
/// Contacts beside each other that push the same way, with one part or with parts that touch each other, count together
/// too: the deepest decides how far they are carried. `reach` is how far beside a contact skin is still at its place.
fn gaps(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    size: f32,
    report: &CancelReport,
    reach: impl Fn(&Contact) -> f32 + Sync,
) -> Vec<f32> {
    let mut obstacles: BTreeMap<(u32, u32), Vec<&ObstaclePart>> = BTreeMap::new();
    for part in parts {
        obstacles.entry(part.collider.into_raw_parts()).or_default().push(part);
    }
    let gap = |contact: &Contact| {
        let colliders: BTreeSet<(u32, u32)> =
            contact.parts().into_iter().map(|part| parts[part].collider.into_raw_parts()).collect();
        let obstacle: Vec<&ObstaclePart> =
            colliders.iter().flat_map(|collider| &obstacles[collider]).copied().collect();
        contact_gap(body, contact, parts, &obstacle, [reach(contact), PIERCING_RESOLUTION * size])
    };
    let own: Vec<f32> = report.contacts.par_iter().map(gap).collect();
    let together = |a: &Contact, b: &Contact| {
        let along = a.near.normal.dot(b.near.normal);
        let touch = || parts[a.near.part].aabb.intersects(&parts[b.near.part].aabb);
        overlap(a, b) && (a.near.part == b.near.part && along > ROUGHLY || along > SAME_WAY && touch())
    };
    let least = |a: &Contact| {
        let others = report.contacts.iter().zip(&own).filter(|(b, _)| together(a, b));
        others.map(|(_, gap)| *gap).fold(f32::INFINITY, f32::min)
    };
    report.contacts.iter().map(least).collect()
}

/// Cosine from which on two contacts with one part push the same way.
const ROUGHLY: f32 = 0.5;

/// Distance of a point from a box, 0 inside.
fn from_box(bounds: &Aabb, x: Vec3) -> f32 {
    (bounds.mins - x).max(x - bounds.maxs).max(Vec3::ZERO).length()
}

/// True where two contacts are beside each other.
fn overlap(a: &Contact, b: &Contact) -> bool {
    a.centre.distance(b.centre) <= a.radius + b.radius
}

/// The distance between the skin of a contact, `reach` metres around, and an obstacle; zero where it is at most `close`.
///
/// The skin that is at the place of the contact now counts, whether it was in the obstacle or not. Vertices first; then the triangles around them, whose nearest point may lie between the corners.
fn contact_gap(
    body: &ElasticBody,
    contact: &Contact,
    parts: &[ObstaclePart],
    obstacle: &[&ObstaclePart],
    [reach, close]: [f32; 2],
) -> f32 {
    let positions = body.positions();
    let own: BTreeSet<usize> = contact.parts();
    let own: Vec<&ObstaclePart> = own.into_iter().map(|part| &parts[part]).collect();
    let mut best = f32::INFINITY;
    let beside = contact.beside(body, parts, reach);
    // The contact's own parts are the likeliest ones.
    for among in [&own[..], obstacle] {
        for p in contact.points.iter().chain(&beside) {
            let x = p.point.position(positions);
            for part in among {
                // Most parts of a large obstacle are far off.
                if from_box(&part.aabb, x) < best {
                    best = best.min(part.exact_distance(x));
                }
            }
            if best <= close {
                return 0.0;
            }
        }
    }
    let all = contact.points.iter().chain(&beside);
    let members: Vec<usize> = all.flat_map(|p| p.point.corners()).map(|(v, _)| v).collect();
    let mut is_member = vec![false; positions.len()];
    members.iter().for_each(|&v| is_member[v] = true);
    for t in body.rig().mesh.triangles.iter().filter(|t| t.iter().any(|&v| is_member[v as usize])) {
        let corners = t.map(|v| positions[v as usize]);
        let longest = corners[0].distance(corners[1]).max(corners[1].distance(corners[2]));
        for part in obstacle {
            // No point of the triangle is nearer than a corner by more than its longest edges.
            let near = from_box(&part.aabb, corners[1]) - longest < best;
            if near && part.placed.distance(corners[1]).0 - longest < best {
                best = best.min(deepest_on_triangle(&part.placed, corners).1.max(0.0));
            }
        }
        if best <= close {
            return 0.0;
        }
    }
    best
}
