//! The contacts of a skin: which vertices of which segment have gone into which parts, and how deep.

use std::collections::{BTreeSet, HashMap};

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::contact::{Proximity, faces, penetration};
use super::obstacle::ObstaclePart;
use super::piercing::{Height, pierced};
use super::skin_point::SkinPoint;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// A point of the skin that has gone into a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// A vertex, or the deepest point of a triangle that a tip or an edge pierces.
    pub point: SkinPoint,
    /// Index of the part in the list of obstacles around the body.
    pub part: usize,
    /// How far it must move along the contact's direction.
    pub depth: f32,
    /// How much the point counts, from 0 to 1. Skin that comes into the shadow of a thin part from the side counts nothing at
    /// first.
    pub counts: f32,
}

/// One segment's penetration of one part, or of several that touch each other and push the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Segment, deepest part and direction.
    pub near: Proximity,
    /// The penetrating points of the skin, deepest first.
    pub points: Vec<Penetration>,
    /// Depth-weighted mean of these points, moved out to the part's surface.
    pub centre: Vec3,
    /// Twice the depth-weighted standard deviation of the points from the centre: how far the contact spreads.
    pub radius: f32,
    /// True where the points lie within triangles, whose corners are outside.
    pub pierced: bool,
    /// True where the contact's own field pushes; false where the fields of others carry the skin out, and beyond.
    pub held: bool,
    /// How far the contact's own fields have pushed so far, in metres.
    pub pushed: f32,
    /// 0 for points that have gone in. A guard's points are outside still, at depths from minus this height to 0: others may
    /// push them in.
    pub guards: f32,
}

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

/// By this part longer is the way out with a segment that moves the vertex not at all taken for.
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

/// Contacts that are none yet: parts that the skin is within `height` metres of. Whoever pushes the skin elsewhere must not
/// push it into them.
pub fn find_guards(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    contacts: &[Contact],
    height: f32,
) -> Vec<Contact> {
    let touches = |near: &&Proximity| {
        let own = |contact: &Contact| contact.near.segment == near.segment && contact.parts().contains(&near.part);
        !contacts.iter().any(own)
    };
    let guard = |near: &Proximity| {
        let (part, skin) = (&parts[near.part], &body.skins()[usize::from(near.segment)]);
        let around = part.aabb.loosened(height);
        let close = |&vertex: &u32| {
            let x = body.positions()[vertex as usize];
            if !around.contains_local_point(x) {
                return None;
            }
            let (distance, out) = part.placed.signed_distance(x);
            let before = distance < height && out.dot(near.normal) > BEFORE;
            before.then_some(Penetration {
                point: SkinPoint::vertex(vertex),
                part: near.part,
                depth: -distance.max(0.0),
                counts: 1.0,
            })
        };
        let mut points: Vec<Penetration> = skin.vertices.iter().filter_map(close).collect();
        points.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.point.vertices.cmp(&b.point.vertices)));
        points.truncate(GUARDED);
        (!points.is_empty()).then(|| Contact::guarding(body, *near, points, height))
    };
    let idle: Vec<&Proximity> = near.iter().filter(touches).collect();
    idle.par_iter().map(|near| guard(near)).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// Most points that are guarded at one part.
const GUARDED: usize = 64;

/// Points lie before a part where the cosine between their way from it and the contact's is above this.
const BEFORE: f32 = 0.5;

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

/// Adds guards to contacts: those that go the same way as a contact watch over its neighbourhood, the others stand by
/// themselves.
pub fn add_guards(body: &ElasticBody, parts: &[ObstaclePart], guards: Vec<Contact>, contacts: &mut Vec<Contact>) {
    for guard in guards {
        match contacts.iter_mut().position(|contact| contact.goes_with(&guard, parts)) {
            Some(at) => {
                let height = contacts[at].guards;
                contacts[at].absorb(body, parts, &guard);
                let Contact { near, points, .. } = contacts[at].clone();
                let joined = Contact::guarding(body, near, points, height);
                contacts[at] = Contact {
                    pierced: contacts[at].pierced,
                    held: contacts[at].held,
                    pushed: contacts[at].pushed,
                    ..joined
                };
            }
            None => contacts.push(guard),
        }
    }
}

/// A way out is taken where it is at most this many times as long as the shortest.
pub(super) const ASKEW: f32 = 5.0;

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

/// Skin of a cancelled contact is watched that is farther off than the nearest by at most this part of the size.
const WATCHED: f32 = 0.03;

/// Cosine between two directions that count as one.
pub(super) const SAME_WAY: f32 = 0.82;

impl Contact {
    fn new(body: &ElasticBody, near: Proximity, points: Vec<Penetration>) -> Self {
        Self::guarding(body, near, points, 0.0)
    }

    fn guarding(body: &ElasticBody, near: Proximity, mut points: Vec<Penetration>, guards: f32) -> Self {
        points.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.point.vertices.cmp(&b.point.vertices)));
        let out = |p: &Penetration| p.point.position(body.positions()) + near.normal * p.depth;
        let weigh = |p: &Penetration| (p.depth * p.counts + guards).max(f32::MIN_POSITIVE);
        let weight: f32 = points.iter().map(weigh).sum();
        let centre = points.iter().map(|p| out(p) * weigh(p)).sum::<Vec3>() / weight;
        let spread: f32 = points.iter().map(|p| out(p).distance_squared(centre) * weigh(p)).sum();
        let pierced = points.iter().all(|p| !p.point.is_vertex());
        Self { near, points, centre, radius: 2.0 * (spread / weight).sqrt(), pierced, held: false, pushed: 0.0, guards }
    }

    /// Depth of the deepest point, 0 for a guard.
    pub fn depth(&self) -> f32 {
        self.points.first().map_or(0.0, |p| p.depth.max(0.0))
    }

    /// 1 for skin that is in the part or touches it, falling to 0 for a guard's at its height above it.
    pub fn closeness(&self) -> f32 {
        let gap = self.points.first().map_or(0.0, |p| -p.depth).max(0.0);
        if self.guards > 0.0 { (1.0 - gap / self.guards).max(0.0) } else { 1.0 }
    }

    /// The deepest point by the shortest way out, in metres.
    pub fn shortest_depth(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> f32 {
        let depth = |p: &Penetration| parts[p.part].way_to_surface(p.point.position(body.positions())).length();
        // What has gone through a thin part is not in it any more, and is as deep as the way back is long.
        let through = |p: &Penetration, depth: f32| if depth > 0.0 { depth.min(p.depth) } else { p.depth };
        self.points.iter().map(|p| through(p, depth(p))).fold(0.0, f32::max)
    }

    /// The parts that the points are in, each once.
    pub fn parts(&self) -> BTreeSet<usize> {
        self.points.iter().map(|p| p.part).collect()
    }

    /// The same contact with the direction in which its points are nearest to the surface, on the whole.
    ///
    /// The way towards the segment's axis is right for all of a contact; what it leaves over, wedged between segments that
    /// are pushed different ways, gets out on the shortest way. A direction that leads to the far side of a thin part is
    /// not taken.
    pub fn by_the_nearest_way(self, body: &ElasticBody, parts: &[ObstaclePart]) -> Self {
        let mut sum = Vec3::ZERO;
        for p in &self.points {
            sum += parts[p.part].way_to_surface(p.point.position(body.positions()));
        }
        let Some(normal) = sum.try_normalize().filter(|n| n.dot(self.near.normal) > 0.0) else { return self };
        let near = Proximity { normal, ..self.near };
        let reach = 2.0 * body.skins()[usize::from(near.segment)].size;
        let along = |p: &Penetration| {
            let depth = parts[p.part].exit(p.point.position(body.positions()), normal, reach)?;
            Some(Penetration { depth, ..*p })
        };
        let points: Vec<Penetration> = self.points.iter().filter_map(along).collect();
        if points.is_empty() { self } else { Self::new(body, near, points) }
    }

    /// The contact after it was cancelled, as a guard of the skin that is nearest to its parts now, and how far that is from
    /// them. None for a contact that no field of its own has pushed.
    pub fn watched(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> Option<(Self, f32)> {
        if !self.held {
            return None;
        }
        let distance = |p: &Penetration| parts[p.part].placed.distance(p.point.position(body.positions())).0;
        let mut points: Vec<Penetration> =
            self.points.iter().map(|p| Penetration { depth: -distance(p), ..*p }).collect();
        points.extend(self.beside(body, parts));
        let gap = points.iter().map(|p| -p.depth).fold(f32::INFINITY, f32::min);
        let height = gap + WATCHED * body.skins()[usize::from(self.near.segment)].size;
        let points: Vec<Penetration> = points.into_iter().filter(|p| -p.depth < height).collect();
        let near = self.nearest_of(&points);
        let guard = Self::guarding(body, near, points, height);
        Some((Self { held: true, pushed: self.pushed, ..guard }, gap))
    }

    /// The skin that is at the place of the contact now: what went in has slid along the part, as far as it was pushed at most,
    /// and other skin has come.
    pub fn beside(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> Vec<Penetration> {
        let around = self.radius + self.depth().max(self.pushed);
        let own: BTreeSet<u32> = self.points.iter().map(|p| p.point.vertices[0]).collect();
        let touched = self.parts();
        let here = |&vertex: &u32| {
            let x = body.positions()[vertex as usize];
            if x.distance(self.centre) > around || own.contains(&vertex) {
                return None;
            }
            let distances = touched.iter().map(|&part| (parts[part].placed.distance(x).0, part));
            let (distance, part) = distances.min_by(|a, b| a.0.total_cmp(&b.0))?;
            Some(Penetration { point: SkinPoint::vertex(vertex), part, depth: -distance, counts: 1.0 })
        };
        body.skins()[usize::from(self.near.segment)].vertices.iter().filter_map(here).collect()
    }

    /// The proximity with the part of the nearest of these points.
    fn nearest_of(&self, points: &[Penetration]) -> Proximity {
        let nearest = points.iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
        Proximity { part: nearest.map_or(self.near.part, |p| p.part), ..self.near }
    }

    /// True where another contact of the segment, with a part that touches one of this one's, pushes nearly the same way.
    fn goes_with(&self, other: &Contact, parts: &[ObstaclePart]) -> bool {
        self.along(other) && self.touches(other, parts)
    }

    /// True where another contact of the segment pushes nearly the same way.
    fn along(&self, other: &Contact) -> bool {
        self.near.segment == other.near.segment && self.near.normal.dot(other.near.normal) > SAME_WAY
    }

    /// True where a part of this contact touches the other's.
    fn touches(&self, other: &Contact, parts: &[ObstaclePart]) -> bool {
        self.parts().into_iter().any(|part| parts[part].aabb.intersects(&parts[other.near.part].aabb))
    }

    /// Takes over the points of another contact, with their depths along this one's direction.
    fn absorb(&mut self, body: &ElasticBody, parts: &[ObstaclePart], other: &Contact) {
        let reach = 2.0 * body.skins()[usize::from(self.near.segment)].size;
        let places: HashMap<[u32; 3], usize> =
            self.points.iter().enumerate().map(|(i, p)| (p.point.vertices, i)).collect();
        for p in &other.points {
            let x = p.point.position(body.positions());
            // Beside a flank the common way may be long: then the point's own depth tells how much is asked of it.
            let reach = if p.point.is_vertex() { reach } else { ASKEW * p.depth };
            let depth =
                parts[p.part].exit(x, self.near.normal, reach).filter(|depth| *depth < reach).unwrap_or(p.depth);
            match places.get(&p.point.vertices).map(|&i| &mut self.points[i]) {
                Some(own) if own.depth >= depth => {}
                Some(own) => *own = Penetration { depth, ..*p },
                None => self.points.push(Penetration { depth, ..*p }),
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
