//! One way out for the pieces of one surface.
//!
//! The pieces of ground under a body are not obstacles of their own: each by itself would push its own way, across a ridge
//! apart and in a hollow together. What a segment meets of one surface leads it out one way, the mean of the pieces'
//! normals, the nearer ones counting more: it turns smoothly while the body moves over the surface.

use std::collections::BTreeMap;

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// Gives all pieces of one surface that are close to one segment the same way out, as far as it leads out of them.
pub fn share_ways_out(body: &ElasticBody, parts: &[ObstaclePart], near: &mut [Proximity]) {
    let mut sums: BTreeMap<(u16, (u32, u32)), Vec3> = BTreeMap::new();
    for proximity in near.iter() {
        let part = &parts[proximity.part];
        let Some(face) = part.face.as_ref().filter(|face| !face.two_sided) else { continue };
        let reach = REACH * body.skins()[usize::from(proximity.segment)].size;
        let closeness = (1.0 - part.placed.distance(proximity.axis_point).0 / reach).max(0.0);
        let weight = closeness * closeness * face.area.min(reach * reach);
        *sums.entry((proximity.segment, part.id.collider)).or_default() += proximity.normal * weight;
    }
    for proximity in near {
        let part = &parts[proximity.part];
        let Some(face) = part.face.as_ref().filter(|face| !face.two_sided) else { continue };
        let common = sums.get(&(proximity.segment, part.id.collider)).and_then(|sum| sum.try_normalize());
        if let Some(common) = common.filter(|common| common.dot(face.normal) > LEADS_OUT) {
            proximity.normal = common;
        }
    }
}

/// How far from a segment's axis the pieces of a surface count, in sizes of its skin.
const REACH: f32 = 1.25;

/// Least cosine between the common way and the normal of a piece that it leads out of.
const LEADS_OUT: f32 = 0.5;
