//! Finding contacts: which vertices and triangles of which segment have gone into which parts, and how deep.

use std::collections::HashMap;

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::contact::{Proximity, faces, penetration};
use super::obstacle::ObstaclePart;
use super::penetrations::{ASKEW, Contact, Penetration, SAME_WAY};
use super::piercing::{Height, pierced};
use super::skin_point::SkinPoint;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// The contacts of a skin with the parts near it, vertices deeper than `tolerance` only.
///
/// A vertex that several segments share belongs to the contact that leads it out of the part on the shortest way; of two that
/// are about as short, to that of the segment that moves it most.
pub fn find_contacts(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], tolerance: f32) -> Vec<Contact> {
    let points: Vec<SegmentPoints> =
        (0..body.skins().len()).into_par_iter().map(|segment| SegmentPoints::of(body, segment)).collect();
    let find = |near: &Proximity| {
        let (points, part) = (&points[usize::from(near.segment)], &parts[near.part]);
        find_penetrations(body, points, part, near, tolerance)
    };
    let found: Vec<Vec<Penetration>> = near.par_iter().map(find).collect();
    let mut shortest: HashMap<(usize, u32), (f32, usize)> = HashMap::new();
    for (contact, (near, vertices)) in near.iter().zip(&found).enumerate() {
        for p in vertices.iter().filter(|p| p.point.is_vertex()) {
            let vertex = p.point.vertices[0];
            let own = body.rig().weights[vertex as usize].weight_of(near.segment);
            let way = p.depth * (1.0 + FOREIGN * (1.0 - own));
            let best = shortest.entry((near.part, vertex)).or_insert((way, contact));
            if way < best.0 {
                *best = (way, contact);
            }
        }
    }
    let mut contacts = Vec::new();
    for (contact, (near, mut vertices)) in near.iter().zip(found).enumerate() {
        vertices.retain(|p| !p.point.is_vertex() || shortest[&(near.part, p.point.vertices[0])].1 == contact);
        if !vertices.is_empty() {
            contacts.push(Contact::new(body, *near, vertices));
        }
    }
    merged(body, parts, contacts)
}

/// The way out with a segment that does not move the vertex at all is taken to be longer by this part.
const FOREIGN: f32 = 0.25;

/// The contacts of triangles that tips and edges pierce between their corners, each with the shortest way out.
///
/// The points of one part that get out nearly the same way make one contact.
pub fn find_piercings(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], tolerance: f32) -> Vec<Contact> {
    let points: Vec<SegmentPoints> =
        (0..body.skins().len()).into_par_iter().map(|segment| SegmentPoints::of(body, segment)).collect();
    let find = |near: &Proximity| {
        find_pierced(body, &points[usize::from(near.segment)], &parts[near.part], near, PIERCED * tolerance)
    };
    let found: Vec<Vec<Penetration>> = near.par_iter().map(find).collect();
    let mut contacts = Vec::new();
    for (near, mut points) in near.iter().zip(found) {
        points.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.point.vertices.cmp(&b.point.vertices)));
        let mut groups: Vec<(Vec3, Vec<Penetration>)> = Vec::new();
        for p in points {
            let x = p.point.position(body.positions());
            // The way of the whole contact, unless the point lies beside a flank that this way leads along.
            let along = parts[p.part].exit(x, near.normal, ASKEW * p.depth);
            let (out, depth) = match along {
                Some(depth) if depth < ASKEW * p.depth => (near.normal, depth),
                _ => {
                    let way = parts[p.part].way_to_surface(x);
                    (way.normalize_or(near.normal), way.length().max(p.depth))
                }
            };
            let p = Penetration { depth, ..p };
            match groups.iter_mut().find(|(normal, _)| normal.dot(out) > SAME_WAY) {
                Some((_, group)) => group.push(p),
                None => groups.push((out, vec![p])),
            }
        }
        for (normal, group) in groups {
            contacts.push(Contact::new(body, Proximity { normal, ..*near }, group));
        }
    }
    contacts
}

/// Adds contacts of pierced triangles to those of vertices: points of the same segment and part that go the same way make one.
pub fn add_piercings(body: &ElasticBody, parts: &[ObstaclePart], pierced: Vec<Contact>, contacts: &mut Vec<Contact>) {
    for piercing in pierced {
        match contacts.iter_mut().find(|contact| contact.goes_with(&piercing, parts)) {
            Some(contact) => {
                contact.absorb(body, parts, &piercing);
                let Contact { near, points, .. } = contact.clone();
                *contact = Contact::new(body, near, points);
            }
            None => contacts.push(piercing),
        }
    }
}

/// A triangle counts as pierced from this many times the tolerance of vertices on.
pub(super) const PIERCED: f32 = 2.0;

/// Contacts of one segment with parts that touch each other count as one where they push nearly the same way: the fields
/// of a hundred small parts side by side would only push against each other.
fn merged(body: &ElasticBody, parts: &[ObstaclePart], mut contacts: Vec<Contact>) -> Vec<Contact> {
    // Those that led a group in the step before lead it again: groups that change from step to step would be seen.
    let rank = |contact: &Contact| if contact.near.leads { LOYALTY * contact.depth() } else { contact.depth() };
    contacts.sort_by(|a, b| rank(b).total_cmp(&rank(a)).then(a.near.part.cmp(&b.near.part)));
    let mut groups: Vec<Vec<Contact>> = Vec::new();
    for contact in contacts {
        match groups
            .iter_mut()
            .find(|group| group.iter().any(|member| member.touches(&contact, parts)) && group[0].along(&contact))
        {
            Some(group) => group.push(contact),
            None => groups.push(vec![contact]),
        }
    }
    groups.iter().map(|group| joined(body, parts, group)).collect()
}

/// One contact of several; the first leads. The way out is the mean of all, the deeper ones counting more.
fn joined(body: &ElasticBody, parts: &[ObstaclePart], group: &[Contact]) -> Contact {
    let mean: Vec3 = group.iter().map(|contact| contact.near.normal * contact.depth()).sum();
    let near = Proximity { normal: mean.normalize_or(group[0].near.normal), ..group[0].near };
    let mut whole = Contact { near, points: Vec::new(), ..group[0].clone() };
    group.iter().for_each(|member| whole.absorb(body, parts, member));
    Contact::new(body, near, whole.points)
}

/// How many times deeper another part must be to lead a group in the place of the one that led it before.
const LOYALTY: f32 = 1.5;

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
            let counts = if part.contains(x) { 1.0 } else { part.through(x, near.normal, depth) * faces(facing) };
            vertices.push(Penetration { point: SkinPoint::vertex(vertex), part: near.part, depth, counts });
        }
    }
    vertices
}

/// The triangles of one segment that a tip or an edge of the part pierces between their corners.
fn find_pierced(
    body: &ElasticBody,
    points: &SegmentPoints,
    part: &ObstaclePart,
    near: &Proximity,
    tolerance: f32,
) -> Vec<Penetration> {
    let skin = &body.skins()[usize::from(near.segment)];
    let margin = skin.longest_edge * STRETCHED;
    let around = part.aabb.loosened(margin);
    let mut found = Vec::new();
    if !around.intersects(&points.bounds) {
        return found;
    }
    let positions = body.positions();
    let mut heights: Vec<Option<Height>> = vec![None; positions.len()];
    let mut any = false;
    for &v in &skin.vertices {
        let x = positions[v as usize];
        if around.contains_local_point(x) {
            let height = part.placed.signed_distance(x);
            any |= height.0 < margin;
            heights[v as usize] = Some(height);
        }
    }
    if !any {
        return found;
    }
    for &t in &skin.triangles {
        let vertices = body.rig().mesh.triangles[t as usize];
        let [Some(a), Some(b), Some(c)] = vertices.map(|v| heights[v as usize]) else { continue };
        let corners = vertices.map(|v| positions[v as usize]);
        if let Some((point, depth)) = pierced(&part.placed, vertices, corners, [a, b, c], tolerance) {
            found.push(Penetration { point, part: near.part, depth, counts: 1.0 });
        }
    }
    found
}

/// Edges are taken for at most this many times as long as at rest.
pub(super) const STRETCHED: f32 = 2.0;
