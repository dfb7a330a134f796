//! The obstacles around a body, and which of its segments is close to which of their parts.

use std::collections::BTreeMap;

use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::geometry::{Collider, ColliderHandle, InteractionGroups};
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::pipeline::QueryPipeline;

use super::common_way::share_ways_out;
use super::contact::{Proximity, moved_axis, way_out};
use super::foundation::Approach;
use super::obstacle::{ObstacleError, ObstaclePart, PartCache, PartId};
use super::penetrations::Contact;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// What is remembered of a segment close to a part from one step to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactMemory {
    /// The way out: the answer where the segment's axis itself is inside the part now.
    pub normal: Vec3,
    /// How fast the contact began to close.
    pub approach: Approach,
    /// True where the part leads a group of contacts.
    pub leads: bool,
}

/// The memory of all contacts of a body.
pub type ContactMemories = BTreeMap<(u16, PartId), ContactMemory>;

/// Collects the convex parts of all colliders near `region` that the body collides with.
///
/// Sensors, disabled colliders and the `own` bodies are left out; colliders that have no convex parts are reported in
/// `refused`. Surfaces without a volume of their own are at least `thickness` metres thick (see [`PartCache`]).
pub fn obstacles_near(
    query: &QueryPipeline<'_>,
    region: &Aabb,
    thickness: f32,
    groups: InteractionGroups,
    own: &dyn Fn(RigidBodyHandle) -> bool,
    cache: &mut PartCache,
    refused: &mut BTreeMap<(u32, u32), (ColliderHandle, ObstacleError)>,
) -> Vec<ObstaclePart> {
    let meets = |collider: &Collider| {
        !collider.is_sensor()
            && collider.is_enabled()
            && collider.collision_groups().test(groups)
            && !collider.parent().is_some_and(own)
    };
    // No thickness at all, or one that is no number, is as good as none.
    let thickness = if thickness.is_finite() { thickness.max(0.0) } else { 0.0 };
    // What went through a surface is behind the box around it, but not farther than the surface is thick.
    let wide = region.loosened(thickness);
    let mut handles: Vec<(ColliderHandle, &Collider)> =
        query.intersect_aabb_conservative(wide).filter(|(_, collider)| meets(collider)).collect();
    // The tree's order depends on its history; ours must not.
    handles.sort_by_key(|(handle, _)| handle.into_raw_parts());
    let mut parts = Vec::new();
    let mut local = Vec::new();
    for (handle, collider) in handles {
        let raw = handle.into_raw_parts();
        if let Err(error) = cache.parts_near(handle, collider, region, thickness, &mut local) {
            refused.insert(raw, (handle, error));
        }
        for (part, local) in local.drain(..) {
            let id = PartId { collider: raw, part };
            parts.push(ObstaclePart::new(id, handle, &local, *collider.position() * local.pose));
        }
    }
    parts
}

/// The segments that are close to a part, each with its way out. Renews `memories`.
pub fn proximities(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    margin: f32,
    memories: &mut ContactMemories,
) -> Vec<Proximity> {
    let mut near = Vec::new();
    let mut renewed = ContactMemories::new();
    for (segment, (skin, motion)) in body.skins().iter().zip(body.motions()).enumerate() {
        let centre = motion.transform_point(skin.centroid);
        let reach = Vec3::splat(skin.size + margin);
        let region = Aabb::new(centre - reach, centre + reach);
        let axis = moved_axis(motion, skin.axis);
        for (index, part) in parts.iter().enumerate().filter(|(_, part)| part.aabb.intersects(&region)) {
            let key = (segment as u16, part.id);
            let memory = memories.get(&key);
            let remembered = memory.map(|memory| (memory.normal, 0.5 * (axis[0] + axis[1])));
            let Some((normal, axis_point)) = way_out(part, axis).or(remembered).or_else(|| from_centre(part, centre))
            else {
                continue;
            };
            let fresh = ContactMemory { normal, approach: Approach::default(), leads: false };
            renewed.insert(key, memory.map_or(fresh, |memory| ContactMemory { normal, ..*memory }));
            let leads = memory.is_some_and(|memory| memory.leads);
            near.push(Proximity { segment: key.0, part: index, normal, axis_point, leads });
        }
    }
    share_ways_out(body, parts, &mut near);
    for proximity in &near {
        if let Some(memory) = renewed.get_mut(&(proximity.segment, parts[proximity.part].id)) {
            memory.normal = proximity.normal;
        }
    }
    *memories = renewed;
    near
}

/// Notes which parts lead groups of contacts.
pub fn remember_leaders(contacts: &[Contact], parts: &[ObstaclePart], memories: &mut ContactMemories) {
    memories.values_mut().for_each(|memory| memory.leads = false);
    for near in contacts.iter().map(|contact| &contact.near) {
        let memory = parts.get(near.part).and_then(|part| memories.get_mut(&(near.segment, part.id)));
        if let Some(memory) = memory {
            memory.leads = true;
        }
    }
}

/// The last resort for a segment that appears inside a part: away from the middle of the part.
fn from_centre(part: &ObstaclePart, centre: Vec3) -> Option<(Vec3, Vec3)> {
    Some(((centre - part.aabb.center()).try_normalize()?, centre))
}
