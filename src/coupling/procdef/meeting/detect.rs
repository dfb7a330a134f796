//! Which bodies may meet in the coming step, and where vertices of tangled ones get out of each other.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};

use super::near::Side;
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
    /// Half of the gap that is kept to it, in metres.
    pub skin: f32,
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
        let edge = body.surface.edge;
        let skin = SKIN * edge;
        swept.merge(&bounds);
        Self { bounds, region: swept.loosened(skin + DEEPEST * edge), mean, skin }
    }
}

/// A vertex of one body near a triangle of another.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// The vertex and the corners of the triangle, counted through all bodies.
    pub vertices: [u32; 4],
    /// 1, and less the barycentric coordinates of the nearest point.
    pub weights: [f32; 4],
    /// Unit normal, out of the other body.
    pub normal: Vec3,
    /// Distance of the surfaces with their skins, in metres; negative where they overlap.
    pub gap: f32,
}

/// The pairs of bodies whose regions meet and whose groups allow it, in ascending order.
pub fn pairs(bodies: &[MeetingBody<'_>], sights: &[Sight]) -> Vec<(u32, u32)> {
    // Along the axis on which they are spread most.
    let mut spread = Aabb::new_invalid();
    sights.iter().for_each(|sight| spread.take_point(sight.region.mins));
    let axis = spread.extents().max_position();
    let mut order: Vec<u32> = (0..sights.len() as u32).collect();
    let start = |i: u32| sights[i as usize].region.mins[axis];
    order.sort_by(|&a, &b| start(a).total_cmp(&start(b)).then(a.cmp(&b)));
    let mut pairs = Vec::new();
    for (k, &a) in order.iter().enumerate() {
        let (seen, first) = (&sights[a as usize], &bodies[a as usize]);
        for &b in order[k + 1..].iter().take_while(|&&b| start(b) <= seen.region.maxs[axis]) {
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

/// What the vertices of two bodies that are tangled may touch, and the way that leads apart.
pub fn touches_of(a: &Side<'_>, b: &Side<'_>) -> Vec<Touch> {
    let mut found = Vec::new();
    vertices_of(a, b, &mut found);
    vertices_of(b, a, &mut found);
    found
}

fn vertices_of(first: &Side<'_>, second: &Side<'_>, found: &mut Vec<Touch>) {
    let (own, seen) = (first.sight, second.sight);
    let surface = &second.placed.triangles;
    let skins = own.skin + seen.skin;
    let deepest = DEEPEST * first.body.surface.edge.min(second.body.surface.edge);
    let x = first.body.body.positions();
    let normals = first.body.surface.normals(x);
    for (&vertex, facing) in first.body.surface.vertices.iter().zip(&normals) {
        let x = x[vertex as usize];
        let travel = first.reach.moves[vertex as usize] + second.reach.farthest;
        let reach = (skins + travel).max(deepest);
        if !seen.bounds.loosened(reach).contains_local_point(x) {
            continue;
        }
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
        let corners = second.body.surface.triangles[nearest.triangle];
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
            let [p, q, r] = corners.map(|c| c + second.offset);
            let [wp, wq, wr] = nearest.weights;
            found.push(Touch {
                vertices: [vertex + first.offset, p, q, r],
                weights: [1.0, -wp, -wq, -wr],
                normal,
                gap,
            });
        }
    }
}
