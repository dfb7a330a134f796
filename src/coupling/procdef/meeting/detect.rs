//! Which vertices may touch which surfaces in the coming step.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::surface::PlacedSurface;
use super::{MeetingBody, SKIN};
use crate::math::Vec3;

/// How far inside a vertex is still found, in mean edges of the two bodies.
const DEEPEST: f32 = 0.5;

/// A vertex does not touch what faces the same way as its own surface, by this cosine: where bodies have got through each other,
/// the nearest way out leads deeper into the tangle.
const TURNED_AWAY: f32 = 0.25;

/// A body as the others see it in this step.
pub struct Sight {
    /// Its box now.
    pub bounds: Aabb,
    /// Its box now, with all that it may reach in the step.
    pub region: Aabb,
    /// The mean velocity of its boundary, in m/s.
    pub mean: Vec3,
    /// No vertex is faster than this relative to the mean.
    pub spread: f32,
    /// Half of the gap that is kept to it, in metres.
    pub skin: f32,
    /// Outward normals of the boundary's vertices, in their order; unit or zero.
    pub normals: Vec<Vec3>,
}

impl Sight {
    /// What is seen of a body in a step of `h` seconds. `drift` is the velocity that gravity adds in the mean.
    pub fn of(body: &MeetingBody<'_>, drift: Vec3, h: f32) -> Self {
        let (x, v) = (body.body.positions(), body.body.velocities());
        let vertices = &body.surface.vertices;
        let mut bounds = Aabb::new_invalid();
        let (mut swept, mut mean) = (Aabb::new_invalid(), Vec3::ZERO);
        for &i in vertices {
            let (x, v) = (x[i as usize], v[i as usize]);
            bounds.take_point(x);
            swept.take_point(x + (v + drift) * h);
            mean += v;
        }
        mean /= vertices.len().max(1) as f32;
        let spread = vertices.iter().map(|&i| v[i as usize].distance_squared(mean)).fold(0.0, f32::max).sqrt();
        let edge = body.surface.edge;
        let skin = SKIN * edge;
        swept.merge(&bounds);
        let normals = body.surface.normals(x);
        Self { bounds, region: swept.loosened(skin + DEEPEST * edge), mean, spread, skin, normals }
    }
}

/// A vertex of one body near a triangle of another.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// The vertex of the first body.
    pub vertex: u32,
    /// The other body.
    pub other: u32,
    /// The corners of the triangle.
    pub corners: [u32; 3],
    /// Barycentric coordinates of the nearest point.
    pub weights: [f32; 3],
    /// Unit normal, out of the other body.
    pub normal: Vec3,
    /// Distance of the surfaces with their skins, in metres; negative where they overlap.
    pub gap: f32,
}

/// The pairs of bodies whose regions meet and whose groups allow it, in ascending order.
pub fn pairs(bodies: &[MeetingBody<'_>], sights: &[Sight]) -> Vec<(u32, u32)> {
    let mut order: Vec<u32> = (0..sights.len() as u32).collect();
    let start = |i: u32| sights[i as usize].region.mins.x;
    order.sort_by(|&a, &b| start(a).total_cmp(&start(b)).then(a.cmp(&b)));
    let mut pairs = Vec::new();
    for (k, &a) in order.iter().enumerate() {
        let (seen, first) = (&sights[a as usize], &bodies[a as usize]);
        for &b in order[k + 1..].iter().take_while(|&&b| start(b) <= seen.region.maxs.x) {
            let second = &bodies[b as usize];
            // What rapier's surfaces do already is not done twice.
            if (first.own_contacts || second.own_contacts)
                && seen.region.intersects(&sights[b as usize].region)
                && first.groups.test(second.groups)
            {
                pairs.push((a.min(b), a.max(b)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// What the vertices of each body may touch in a step of `h` seconds, one list a body. Bodies are looked at in parallel; the
/// order in a list does not depend on it.
pub fn touches(bodies: &[MeetingBody<'_>], sights: &[Sight], pairs: &[(u32, u32)], h: f32) -> Vec<Vec<Touch>> {
    let mut others: Vec<Vec<u32>> = vec![Vec::new(); bodies.len()];
    for &(a, b) in pairs {
        others[a as usize].push(b);
        others[b as usize].push(a);
    }
    let surfaces: Vec<PlacedSurface> = bodies
        .par_iter()
        .zip(&others)
        .map(|(body, others)| {
            let mut placed = PlacedSurface::default();
            if !others.is_empty() {
                placed.place(body.surface, body.body.positions());
            }
            placed
        })
        .collect();
    (0..bodies.len())
        .into_par_iter()
        .map(|a| {
            let mut found = Vec::new();
            for &b in &others[a] {
                let (first, second) = (&bodies[a], &bodies[b as usize]);
                touches_of(first, &sights[a], (b, second, &sights[b as usize]), &surfaces[b as usize], h, &mut found);
            }
            found
        })
        .collect()
}

fn touches_of(
    first: &MeetingBody<'_>,
    own: &Sight,
    (other, second, seen): (u32, &MeetingBody<'_>, &Sight),
    surface: &PlacedSurface,
    h: f32,
    found: &mut Vec<Touch>,
) {
    let skins = own.skin + seen.skin;
    let deepest = DEEPEST * first.surface.edge.min(second.surface.edge);
    let (x, v) = (first.body.positions(), first.body.velocities());
    let box_of = |reach: f32| seen.bounds.loosened(reach);
    let widest = box_of((skins + h * (own.spread + own.mean.distance(seen.mean) + seen.spread)).max(deepest));
    for (&vertex, facing) in first.surface.vertices.iter().zip(&own.normals) {
        let (x, v) = (x[vertex as usize], v[vertex as usize]);
        if !widest.contains_local_point(x) {
            continue;
        }
        let travel = h * (v.distance(seen.mean) + seen.spread);
        let reach = (skins + travel).max(deepest);
        let Some(mut nearest) = surface.nearest(x, reach, |_| true) else { continue };
        if facing.dot(nearest.normal) >= TURNED_AWAY {
            // Outside it is beyond the other body already; inside it goes back the way that it came.
            let opposite = |normal: Vec3| facing.dot(normal) < TURNED_AWAY;
            if nearest.way.dot(nearest.normal) >= 0.0 {
                continue;
            }
            if let Some(back) = surface.nearest(x, 4.0 * deepest, opposite)
                && back.way.dot(back.normal) < 0.0
            {
                nearest = back;
            }
        }
        let corners = second.surface.triangles[nearest.triangle];
        let distance = nearest.way.length();
        let outside = nearest.way.dot(nearest.normal) >= 0.0;
        // Where the other body is folded, its normals say inside of what is far away.
        if !outside && (distance > 4.0 * deepest || !seen.bounds.contains_local_point(x)) {
            continue;
        }
        // At the surface itself the way to it has no direction; the triangle's normal has.
        let normal = if distance > 1e-3 * seen.skin {
            nearest.way * (if outside { 1.0 } else { -1.0 } / distance)
        } else {
            nearest.normal
        };
        let gap = if outside { distance } else { -distance } - skins;
        if gap <= travel && normal != Vec3::ZERO {
            found.push(Touch { vertex, other, corners, weights: nearest.weights, normal, gap });
        }
    }
}
