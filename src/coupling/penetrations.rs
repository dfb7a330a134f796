//! A contact of a skin: points that have gone into parts, and which way and how far they must go.

use std::collections::{BTreeSet, HashMap};

use rapier3d::parry::bounding_volume::BoundingVolume;

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
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

impl Contact {
    pub(super) fn new(body: &ElasticBody, near: Proximity, points: Vec<Penetration>) -> Self {
        Self::guarding(body, near, points, 0.0)
    }

    pub(super) fn guarding(body: &ElasticBody, near: Proximity, mut points: Vec<Penetration>, guards: f32) -> Self {
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

    /// True where another contact of the segment, with a part that touches one of this one's, pushes nearly the same way.
    pub(super) fn goes_with(&self, other: &Contact, parts: &[ObstaclePart]) -> bool {
        self.along(other) && self.touches(other, parts)
    }

    /// True where another contact of the segment pushes nearly the same way.
    pub(super) fn along(&self, other: &Contact) -> bool {
        self.near.segment == other.near.segment && self.near.normal.dot(other.near.normal) > SAME_WAY
    }

    /// True where a part of this contact touches the other's.
    pub(super) fn touches(&self, other: &Contact, parts: &[ObstaclePart]) -> bool {
        self.parts().into_iter().any(|part| parts[part].aabb.intersects(&parts[other.near.part].aabb))
    }

    /// Takes over the points of another contact, with their depths along this one's direction.
    pub(super) fn absorb(&mut self, body: &ElasticBody, parts: &[ObstaclePart], other: &Contact) {
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

/// A way out is taken where it is at most this many times as long as the shortest.
pub(super) const ASKEW: f32 = 5.0;

/// Cosine between two directions that count as one.
pub(super) const SAME_WAY: f32 = 0.82;
