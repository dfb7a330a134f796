//! Contacts from penetrating points: skin in obstacles, and skin in skin.

use std::collections::BTreeMap;

use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::geometry::ColliderSet;
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};

use super::{ContactMaterial, ElasticSide, FoundationContact, FoundationPoint};
use crate::coupling::contact::{Proximity, penetration};
use crate::coupling::obstacle::{ObstaclePart, PartId};
use crate::coupling::ragdoll::Ragdoll;
use crate::elastic::{ElasticBody, SkinSample};
use crate::math::Vec3;

/// Cosine between two directions that count as one.
const SAME_WAY: f32 = 0.82;

/// The segments and parts that a contact is made of.
pub type ContactKeys = Vec<(u16, PartId)>;

/// The contacts of one elastic body with the parts `near` it, each with the segments and parts that it is made of: the
/// thinned points of the skin that are inside. Parts that push a segment nearly the same way make one contact.
pub fn skin_contacts(
    side: ElasticSide,
    body: &ElasticBody,
    ragdoll: &Ragdoll,
    parts: &[ObstaclePart],
    near: &[Proximity],
    colliders: &ColliderSet,
) -> Vec<(FoundationContact, ContactKeys)> {
    let mut contacts: Vec<(Proximity, FoundationContact, ContactKeys)> = Vec::new();
    for near in near {
        let part = &parts[near.part];
        let points = points_inside(body, ragdoll, part, near, side.material, colliders);
        if points.is_empty() {
            continue;
        }
        let key = (near.segment, part.id);
        let same = |(first, ..): &&mut (Proximity, FoundationContact, ContactKeys)| {
            first.segment == near.segment && first.normal.dot(near.normal) > SAME_WAY
        };
        match contacts.iter_mut().find(same) {
            Some((_, contact, keys)) => {
                contact.points.extend(points);
                keys.push(key);
            }
            None => {
                let contact = FoundationContact { points, sides: [Some(side), None], approach: 0.0 };
                contacts.push((*near, contact, vec![key]));
            }
        }
    }
    contacts.into_iter().map(|(_, contact, keys)| (contact, keys)).collect()
}

/// The skin points of one segment that are inside one part: of as many samples as it takes to have enough.
fn points_inside(
    body: &ElasticBody,
    ragdoll: &Ragdoll,
    part: &ObstaclePart,
    near: &Proximity,
    material: ContactMaterial,
    colliders: &ColliderSet,
) -> Vec<FoundationPoint> {
    let segment = usize::from(near.segment);
    let skin = &body.skins()[segment];
    let motion = body.motions()[segment];
    let Some(collider) = colliders.get(part.collider) else { return Vec::new() };
    let friction = 0.5 * (material.friction + collider.friction());
    let inward = motion.rotation.inverse() * near.normal;
    let reach = 2.0 * skin.size;
    // Nothing outside the part's box and its shadow, on the far side from the segment, can have gone in.
    let shift = near.normal * (near.axis_point - part.aabb.center()).dot(near.normal).abs().min(reach);
    let shift = shift + near.normal * (skin.size + part.aabb.half_extents().length());
    let shadow = part.aabb.merged(&Aabb::new(part.aabb.mins - shift, part.aabb.maxs - shift));
    let inside = |sample: &SkinSample| {
        let position = motion.transform_point(sample.position);
        if !shadow.contains_local_point(position) {
            return None;
        }
        let depth = penetration(part, near, position, sample.normal.dot(inward), reach)?;
        (depth > 0.0).then_some(FoundationPoint {
            body: ragdoll.bodies[segment],
            other: collider.parent(),
            position,
            normal: near.normal,
            depth,
            friction,
        })
    };
    let mut points = Vec::new();
    let (mut from, mut to) = (0, FIRST_SAMPLES);
    while points.len() < ENOUGH && from < skin.samples.len() {
        points.extend(skin.samples[from..to.min(skin.samples.len())].iter().filter_map(inside));
        (from, to) = (to, 2 * to);
    }
    points
}

/// So many samples are looked at first, then twice as many, and so on.
const FIRST_SAMPLES: usize = 128;
/// So many points hold a crate upright and let a ball roll smoothly.
const ENOUGH: usize = 24;

/// A point at which two segments, of two elastic bodies or of one, are inside each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairPoint {
    /// Rigid bodies of the two segments.
    pub bodies: [RigidBodyHandle; 2],
    /// Where, in the world; between the two skins is best.
    pub position: Vec3,
    /// Unit direction in which the first is pushed; the second is pushed the other way.
    pub normal: Vec3,
    /// How far the two skins overlap along the normal, in metres; what is not positive is left out.
    pub depth: f32,
}

/// The contacts between two elastic bodies, or between segments of one (then both `sides` are the same).
///
/// Points of the same two rigid bodies that are pushed nearly the same way make one contact: the two materials are springs
/// in series, and each body shares its stiffness among these contacts and those with obstacles. A point must be given
/// once, not once from either side. The contacts' `approach` is 0 still.
pub fn pair_contacts(sides: [ElasticSide; 2], points: &[PairPoint]) -> Vec<FoundationContact> {
    let friction = 0.5 * (sides[0].material.friction + sides[1].material.friction);
    type Bundles = Vec<(Vec3, FoundationContact)>;
    let mut contacts: BTreeMap<[(u32, u32); 2], Bundles> = BTreeMap::new();
    for pair in points.iter().filter(|pair| pair.depth > 0.0) {
        let [body, other] = pair.bodies;
        let PairPoint { position, normal, depth, .. } = *pair;
        let point = FoundationPoint { body, other: Some(other), position, normal, depth, friction };
        let between = contacts.entry(pair.bodies.map(|body| body.into_raw_parts())).or_default();
        match between.iter_mut().find(|(first, _)| first.dot(normal) > SAME_WAY) {
            Some((_, contact)) => contact.points.push(point),
            None => {
                let contact = FoundationContact { points: vec![point], sides: sides.map(Some), approach: 0.0 };
                between.push((normal, contact));
            }
        }
    }
    contacts.into_values().flatten().map(|(_, contact)| contact).collect()
}
