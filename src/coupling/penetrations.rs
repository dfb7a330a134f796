//! The contacts of a skin: which vertices of which segment have gone into which parts, and how deep.

use std::collections::{BTreeSet, HashMap};

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::contact::{Proximity, penetration};
use super::obstacle::ObstaclePart;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// A vertex that has gone into a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// The vertex.
    pub vertex: u32,
    /// Index of the part in the list of obstacles around the body.
    pub part: usize,
    /// How far it must move along the contact's direction.
    pub depth: f32,
}

/// One segment's penetration of one part, or of several that touch each other and push the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Segment, deepest part and direction.
    pub near: Proximity,
    /// The penetrating vertices, deepest first.
    pub vertices: Vec<Penetration>,
    /// Depth-weighted mean of the penetrating vertices, moved out to the part's surface.
    pub point: Vec3,
}

/// The contacts of a skin with the parts near it, vertices deeper than `tolerance` only.
///
/// A vertex that several segments share belongs to the contact that leads it out of the part on the shortest way.
pub fn find_contacts(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], tolerance: f32) -> Vec<Contact> {
    let points: Vec<SegmentPoints> =
        (0..body.skins().len()).into_par_iter().map(|segment| SegmentPoints::of(body, segment)).collect();
    let find = |near: &Proximity| {
        find_penetrations(body, &points[usize::from(near.segment)], &parts[near.part], near, tolerance)
    };
    let found: Vec<Vec<Penetration>> = near.par_iter().map(find).collect();
    let mut shortest: HashMap<(usize, u32), (f32, usize)> = HashMap::new();
    for (contact, (near, vertices)) in near.iter().zip(&found).enumerate() {
        for p in vertices {
            let best = shortest.entry((near.part, p.vertex)).or_insert((p.depth, contact));
            if p.depth < best.0 {
                *best = (p.depth, contact);
            }
        }
    }
    let mut contacts = Vec::new();
    for (contact, (near, mut vertices)) in near.iter().zip(found).enumerate() {
        vertices.retain(|p| shortest[&(near.part, p.vertex)].1 == contact);
        if !vertices.is_empty() {
            contacts.push(Contact::new(body, *near, vertices));
        }
    }
    merged(body, parts, contacts)
}

/// Contacts of one segment with parts that touch each other count as one where they push nearly the same way: the fields
/// of a hundred small parts side by side would only push against each other.
fn merged(body: &ElasticBody, parts: &[ObstaclePart], mut contacts: Vec<Contact>) -> Vec<Contact> {
    contacts.sort_by(|a, b| b.depth().total_cmp(&a.depth()).then(a.near.part.cmp(&b.near.part)));
    let mut groups: Vec<Contact> = Vec::new();
    for contact in contacts {
        let joins = |group: &&mut Contact| {
            group.near.segment == contact.near.segment
                && group.near.normal.dot(contact.near.normal) > SAME_WAY
                && group.parts().into_iter().any(|part| parts[part].aabb.intersects(&parts[contact.near.part].aabb))
        };
        match groups.iter_mut().find(joins) {
            Some(group) => group.absorb(body, parts, &contact),
            None => groups.push(contact),
        }
    }
    groups.into_iter().map(|group| Contact::new(body, group.near, group.vertices)).collect()
}

/// Cosine between two directions that count as one.
const SAME_WAY: f32 = 0.82;

impl Contact {
    fn new(body: &ElasticBody, near: Proximity, mut vertices: Vec<Penetration>) -> Self {
        vertices.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.vertex.cmp(&b.vertex)));
        let mut sum = Vec3::ZERO;
        let mut weight = 0.0;
        for p in &vertices {
            sum += (body.positions()[p.vertex as usize] + near.normal * p.depth) * p.depth;
            weight += p.depth;
        }
        Self { near, vertices, point: sum / weight }
    }

    /// Depth of the deepest vertex.
    pub fn depth(&self) -> f32 {
        self.vertices.first().map_or(0.0, |p| p.depth)
    }

    /// The parts that the vertices are in, each once.
    pub fn parts(&self) -> BTreeSet<usize> {
        self.vertices.iter().map(|p| p.part).collect()
    }

    /// The same contact with the direction in which its vertices are nearest to the surface, on the whole.
    ///
    /// The way towards the segment's axis is right for all of a contact; what it leaves over, wedged between segments that
    /// are pushed different ways, gets out on the shortest way. A direction that leads to the far side of a thin part is
    /// not taken.
    pub fn by_the_nearest_way(self, body: &ElasticBody, parts: &[ObstaclePart]) -> Self {
        let mut sum = Vec3::ZERO;
        for p in &self.vertices {
            sum += parts[p.part].way_to_surface(body.positions()[p.vertex as usize]);
        }
        let Some(normal) = sum.try_normalize().filter(|n| n.dot(self.near.normal) > 0.0) else { return self };
        let near = Proximity { normal, ..self.near };
        let reach = 2.0 * body.skins()[usize::from(near.segment)].size;
        let along = |p: &Penetration| {
            let depth = parts[p.part].exit(body.positions()[p.vertex as usize], normal, reach)?;
            Some(Penetration { depth, ..*p })
        };
        let vertices: Vec<Penetration> = self.vertices.iter().filter_map(along).collect();
        if vertices.is_empty() { self } else { Self::new(body, near, vertices) }
    }

    /// Takes over the vertices of another contact, with their depths along this one's direction.
    fn absorb(&mut self, body: &ElasticBody, parts: &[ObstaclePart], other: &Contact) {
        let reach = 2.0 * body.skins()[usize::from(self.near.segment)].size;
        let places: HashMap<u32, usize> = self.vertices.iter().enumerate().map(|(i, p)| (p.vertex, i)).collect();
        for p in &other.vertices {
            let x = body.positions()[p.vertex as usize];
            let depth = parts[p.part].exit(x, self.near.normal, reach).unwrap_or(p.depth);
            match places.get(&p.vertex).map(|&i| &mut self.vertices[i]) {
                Some(own) if own.depth >= depth => {}
                Some(own) => *own = Penetration { depth, ..*p },
                None => self.vertices.push(Penetration { depth, ..*p }),
            }
        }
    }
}

/// The skin of one segment as it is now, copied together: many parts are compared with it.
struct SegmentPoints {
    positions: Vec<Vec3>,
    bounds: Aabb,
}

impl SegmentPoints {
    fn of(body: &ElasticBody, segment: usize) -> Self {
        let positions: Vec<Vec3> =
            body.skins()[segment].vertices.iter().map(|&v| body.positions()[v as usize]).collect();
        let low = positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
        let high = positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
        Self { positions, bounds: Aabb::new(low, high) }
    }

    /// The largest value of `(point − x) · direction` over the box around the skin.
    fn farthest(&self, point: Vec3, direction: Vec3) -> f32 {
        let middle = 0.5 * (self.bounds.mins + self.bounds.maxs);
        (point - middle).dot(direction) + (self.bounds.maxs - middle).dot(direction.abs())
    }
}

fn find_penetrations(
    body: &ElasticBody,
    points: &SegmentPoints,
    part: &ObstaclePart,
    near: &Proximity,
    tolerance: f32,
) -> Vec<Penetration> {
    let skin = &body.skins()[usize::from(near.segment)];
    let motion = body.motions()[usize::from(near.segment)];
    let reach = 2.0 * skin.size;
    // Nothing outside the part's box and its shadow, on the far side from the segment, can have gone in.
    let depth = points.farthest(near.axis_point, near.normal).clamp(0.0, reach);
    let shift = near.normal * depth;
    let shadow = part.aabb.merged(&Aabb::new(part.aabb.mins - shift, part.aabb.maxs - shift));
    let mut vertices = Vec::new();
    if !shadow.intersects(&points.bounds) {
        return vertices;
    }
    let inward = motion.rotation.inverse() * near.normal;
    for (&vertex, &x) in skin.vertices.iter().zip(&points.positions) {
        if !shadow.contains_local_point(x) {
            continue;
        }
        let facing = body.rig().mesh.normals[vertex as usize].dot(inward);
        if let Some(depth) = penetration(part, near, x, facing, reach)
            && depth > tolerance
        {
            vertices.push(Penetration { vertex, part: near.part, depth });
        }
    }
    vertices
}
