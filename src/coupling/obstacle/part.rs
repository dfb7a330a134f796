//! A convex part in the world, and the exact questions about it.

use std::ops::RangeInclusive;

use rapier3d::geometry::ColliderHandle;
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::shape::SharedShape;

use super::local_part::LocalPart;
use super::outer_face::OuterFace;
use crate::field::{ConvexHull, ConvexPart, PartShape, PlacedPart};
use crate::math::{Pose, Vec3};

/// Names a convex part of a collider for as long as the collider keeps its shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartId {
    /// The collider, by index and generation.
    pub collider: (u32, u32),
    /// The part in it.
    pub part: u32,
}

/// A convex part in the world.
#[derive(Clone)]
pub struct ObstaclePart {
    /// Its name.
    pub id: PartId,
    /// Its collider.
    pub collider: ColliderHandle,
    /// As the fields see it.
    pub placed: PlacedPart,
    /// As parry sees it.
    pub shape: SharedShape,
    /// The part without `border`, for parry's exact point queries.
    pub exact: SharedShape,
    /// Radius in metres by which the part reaches farther than `exact`.
    pub border: f32,
    /// The face that leads out, in the world, where the part is a piece of a surface.
    pub face: Option<OuterFace>,
    /// Bounding box in the world.
    pub aabb: Aabb,
    /// How far the part is there, from 0 to 1: less than 1 for one that is only just coming into being. It pushes all the same;
    /// what it makes others do comes with it gradually.
    pub presence: f32,
    /// For the part behind an interface how the segment whose skin it stands for has moved in the world since the step before, where that is
    /// known; none for all other parts.
    pub moved: Option<Pose>,
    /// A box around a part of many faces, in the part's own frame.
    pub simpler: Option<PlacedPart>,
}

/// A hull with more triangles than this is given a simpler stand-in.
const MANY_TRIANGLES: usize = 32;

/// A part counts as small where the diagonal of its box is below this many widths of the field.
const SMALL: f32 = 2.0;

impl PartId {
    /// No collider has this index: it stands for the interfaces between skins.
    const INTERFACE: u32 = u32::MAX;

    /// The name of the part that keeps a segment out of the other one's skin, among the parts around its body: `other` is the
    /// index of the other body and its segment.
    pub fn interface(segment: u16, other: (u32, u16)) -> Self {
        Self { collider: (Self::INTERFACE, other.0), part: u32::from(segment) << 16 | u32::from(other.1) }
    }

    /// All names that parts of a collider can have, in their order.
    pub fn all_of(collider: (u32, u32)) -> RangeInclusive<Self> {
        Self { collider, part: 0 }..=Self { collider, part: u32::MAX }
    }
}

impl ObstaclePart {
    /// A convex part of a collider, in the world.
    pub fn new(id: PartId, collider: ColliderHandle, local: &LocalPart, pose: Pose) -> Self {
        let placed = PlacedPart::new(local.part.clone(), pose);
        let face = local.face.as_ref().map(|face| face.moved(&pose));
        let simpler = match &local.part.shape {
            PartShape::Hull(hull) if hull.triangles().len() > MANY_TRIANGLES => {
                let bounds = local.shape.compute_local_aabb();
                let shape = PartShape::Cuboid { half_extents: bounds.half_extents() };
                let centre = pose * Pose::from_translation(bounds.center());
                Some(PlacedPart::new(ConvexPart { shape, rounding: 0.0 }, centre))
            }
            _ => None,
        };
        let aabb = local.shape.compute_aabb(&pose);
        let LocalPart { shape, exact, border, .. } = local.clone();
        Self { id, collider, placed, shape, exact, border, face, aabb, presence: 1.0, moved: None, simpler }
    }

    /// The region of constant velocity of a field of this width: the part itself, or, for a small part of many faces,
    /// the box around it.
    ///
    /// The region need only contain the part for the field to carry the skin out of it. Next to a wide field a box
    /// hugs a small part well enough, at a small part of the cost.
    pub fn region(&self, width: f32) -> &PlacedPart {
        match &self.simpler {
            Some(region) if (self.aabb.maxs - self.aabb.mins).length() < SMALL * width => region,
            _ => &self.placed,
        }
    }

    /// The way out of the obstacle nearest to `direction` (unit): of a piece of a surface nothing leaves through the
    /// sides that its neighbours touch.
    pub fn way_out(&self, direction: Vec3) -> Vec3 {
        self.face.as_ref().map_or(direction, |face| face.way_out(direction))
    }

    /// How far `x` must move along `direction` (unit) to leave the part, if the part meets the segment from `x` to
    /// `x + reach · direction`: positive both where `x` is inside the part and where the part lies before it.
    pub fn exit(&self, x: Vec3, direction: Vec3, reach: f32) -> Option<f32> {
        if let Some(face) = &self.face
            && let Some(exit) = face.exit(x, direction)
            && self.contains(x)
        {
            return Some(exit.min(reach));
        }
        let end = x + direction * reach;
        if !self.aabb.intersects(&Aabb::new(x.min(end), x.max(end))) {
            return None;
        }
        let hit = match &self.placed.part().shape {
            PartShape::Hull(hull) if self.border <= 0.0 => {
                let pose = self.placed.pose();
                let origin = pose.inverse_transform_point(end);
                entry(hull, origin, pose.rotation.inverse() * -direction, reach)?
            }
            _ => entry_by_distance(&self.placed, end, -direction, reach)?,
        };
        Some(reach - hit)
    }

    /// How well a way from `x` along `direction` (unit) leads through the part, from 0, where it only touches it, to 1, where it
    /// is inside by a quarter of its length somewhere. It changes without jumps with `x`.
    ///
    /// The signed distance from a convex part is convex along the way, so its least value is found by bisection on its slope.
    pub fn through(&self, x: Vec3, direction: Vec3, length: f32) -> f32 {
        let at = |along: f32| self.placed.signed_distance(x + direction * along);
        let (mut low, mut high) = (0.0, length);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if at(middle).1.dot(direction) > 0.0 { high = middle } else { low = middle }
        }
        let deepest = -at(0.5 * (low + high)).0;
        (4.0 * deepest / length.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
    }

    /// True for the part behind an interface between two skins.
    pub fn is_interface(&self) -> bool {
        self.id.collider.0 == PartId::INTERFACE
    }

    /// True for a piece of a surface with a solid side.
    pub fn is_piece(&self) -> bool {
        self.face.as_ref().is_some_and(|face| !face.two_sided)
    }

    /// True where `x` is inside the part.
    pub fn contains(&self, x: Vec3) -> bool {
        self.aabb.contains_local_point(x) && self.placed.distance(x).0 == 0.0
    }

    /// From `x` to the nearest point of the part's surface where `x` is inside, zero outside.
    pub fn way_to_surface(&self, x: Vec3) -> Vec3 {
        if let Some(way) = self.face.as_ref().and_then(|face| face.way_to_surface(x)) {
            return if self.contains(x) { way } else { Vec3::ZERO };
        }
        let projection = self.exact.project_point(self.placed.pose(), x, false);
        let way = projection.point - x;
        if projection.is_inside {
            return way + way.normalize_or_zero() * self.border;
        }
        let distance = way.length();
        if distance < self.border { way * (1.0 - self.border / distance.max(f32::MIN_POSITIVE)) } else { Vec3::ZERO }
    }

    /// Exact depth of `x` below the part's surface by parry's point projection, 0 outside.
    pub fn exact_depth(&self, x: Vec3) -> f32 {
        if !self.aabb.contains_local_point(x) {
            return 0.0;
        }
        self.way_to_surface(x).length()
    }

    /// Exact distance of `x` from the part by parry's point projection, 0 inside.
    pub fn exact_distance(&self, x: Vec3) -> f32 {
        let projection = self.exact.project_point(self.placed.pose(), x, true);
        if projection.is_inside { 0.0 } else { (projection.point.distance(x) - self.border).max(0.0) }
    }
}

/// A way through a part is halved this often: to a 4096th of its length.
const BISECTIONS: usize = 12;

/// How far along a ray (unit `direction`) a hull begins, 0 where the ray starts inside; none where it is not within
/// `reach`. Exact, where parry's search along a ray ends somewhere near the surface.
fn entry(hull: &ConvexHull, origin: Vec3, direction: Vec3, reach: f32) -> Option<f32> {
    let (mut enter, mut leave) = (0.0_f32, reach);
    for &(normal, offset) in hull.planes() {
        let (height, rate) = (normal.dot(origin) - offset, normal.dot(direction));
        if rate < 0.0 {
            enter = enter.max(-height / rate);
        } else if rate > 0.0 {
            leave = leave.min(-height / rate);
        } else if height > 0.0 {
            return None;
        }
        if enter > leave {
            return None;
        }
    }
    Some(enter)
}

/// How far along a ray (unit `direction`) a part begins, by Newton's method on the distance from it: a convex function,
/// so that no step goes too far, and a plane is reached in one. 0 where the ray starts inside, none where the part is not
/// within `reach`.
fn entry_by_distance(part: &PlacedPart, origin: Vec3, direction: Vec3, reach: f32) -> Option<f32> {
    let mut way = 0.0;
    for _ in 0..NEWTON_STEPS {
        let (distance, away) = part.distance(origin + direction * way);
        let rate = -away.dot(direction);
        if distance <= CLOSE * reach {
            break;
        }
        // A ray that closes in by less than this grazes the part at best.
        if rate <= CLOSE {
            return None;
        }
        way += distance / rate;
        if way > reach {
            return None;
        }
    }
    Some(way)
}

/// Newton's method ends this near, as a part of the reach.
const CLOSE: f32 = 1.0e-6;

/// A ray that touches a round part tangentially closes in slowly: by half in each step.
const NEWTON_STEPS: usize = 32;
