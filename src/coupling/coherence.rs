//! Time coherence: how much the cancellation changes from one step to the next, against what the body and the obstacles
//! move.
//!
//! Let `D` be the displacement of a vertex by all passes of a step, seen in the frame of the segment that has most weight
//! there. Let `m` be the largest way that a vertex of the skin, before the cancellation, has gone since the step before,
//! seen from an obstacle, or from a segment of another skin, that the skin touches in one of the two steps. Then
//!
//! ```text
//! ratio = max |D − D of the step before| / (m + floor / 8)
//! ```
//!
//! where the floor is what the tolerances of the cancellation leave open: depth plus gap. A ratio of at most 8 says that no
//! vertex changes by more than 8 m + floor: nothing pops.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rayon::prelude::*;

use super::cancel::{CancelReport, CancelSettings};
use super::obstacle::{ObstaclePart, PartId};
use crate::elastic::{ElasticBody, SkinWeights};
use crate::math::{Pose, Vec3};

/// Largest change of the cancellation since the step before; lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimeCoherence {
    /// Change over motion, as above: at most [`SMOOTH`] where nothing pops. Zero in a body's first step.
    pub ratio: f32,
    /// Largest change of a vertex's displacement.
    pub change: f32,
    /// Largest motion of the skin relative to what it touches.
    pub motion: f32,
    /// The vertex that has changed most.
    pub vertex: u32,
}

/// Largest ratio of a cancellation that is smooth in time.
pub const SMOOTH: f32 = 8.0;

/// What is remembered of a body's cancellation from one step to the next.
#[derive(Clone, Debug, Default)]
pub struct CoherenceMemory {
    /// The skin before the cancellation of this step.
    before: Vec<Vec3>,
    last: Option<Moment>,
}

/// The elastic skins around a body in one step.
#[derive(Clone, Debug, Default)]
pub struct SkinsMet {
    /// World from rest of each segment of each body.
    pub motions: Arc<BTreeMap<(u32, u32), Vec<Pose>>>,
    /// Body and segment of each skin that this one touches.
    pub touched: BTreeSet<((u32, u32), usize)>,
}

#[derive(Clone, Debug)]
struct Moment {
    before: Vec<Vec3>,
    moved: Vec<Vec3>,
    /// Where the parts around the body are.
    parts: BTreeMap<PartId, Pose>,
    /// The colliders that the skin touches.
    touched: BTreeSet<(u32, u32)>,
    skins: SkinsMet,
}

impl CoherenceMemory {
    /// Forgets the step before: after it the body has been out of sight.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// Before the cancellation.
    pub fn begin(&mut self, body: &ElasticBody) {
        self.before.clear();
        self.before.extend_from_slice(body.positions());
    }

    /// After the cancellation: compares it with that of the step before. Contacts with anything but the `parts` are those
    /// with the skins.
    pub fn end(
        &mut self,
        body: &ElasticBody,
        parts: &[ObstaclePart],
        skins: SkinsMet,
        report: &CancelReport,
        size: f32,
        settings: &CancelSettings,
    ) -> TimeCoherence {
        let moved = displacements(body, &self.before);
        let touched = report.contacts.iter().flat_map(|contact| &contact.points);
        let touched = touched.filter_map(|p| Some(parts.get(p.part)?.id.collider)).collect();
        let places = parts.iter().map(|part| (part.id, *part.placed.pose())).collect();
        let now = Moment { before: std::mem::take(&mut self.before), moved, parts: places, touched, skins };
        let floor = (settings.depth_tolerance + settings.gap_tolerance) * size;
        let coherence = self.last.as_ref().and_then(|last| compare(last, &now, size, floor)).unwrap_or_default();
        // The allocation of the step before serves the next one.
        self.before = self.last.take().map(|last| last.before).unwrap_or_default();
        self.last = Some(now);
        coherence
    }
}

/// None where an obstacle that is touched was not there in the other step, so that nothing can be said of its motion.
fn compare(last: &Moment, now: &Moment, size: f32, floor: f32) -> Option<TimeCoherence> {
    if last.moved.len() != now.moved.len() {
        return None;
    }
    let (vertex, change) = largest_change(&last.moved, &now.moved);
    let mut motion = 0.0_f32;
    let mut see =
        |old: &Pose, new: &Pose| motion = motion.max(motion_seen_from([old, new], [&last.before, &now.before]));
    for &collider in last.touched.union(&now.touched) {
        let mut common =
            now.parts.range(PartId::all_of(collider)).filter_map(|(id, new)| Some((last.parts.get(id)?, new)));
        let (old, new) = common.next()?;
        see(old, new);
    }
    for (body, segment) in last.skins.touched.union(&now.skins.touched) {
        let motion = |skins: &SkinsMet| skins.motions.get(body)?.get(*segment).copied();
        see(&motion(&last.skins)?, &motion(&now.skins)?);
    }
    let ratio = change / (motion + floor / SMOOTH);
    Some(TimeCoherence { ratio, change: change / size, motion: motion / size, vertex: vertex as u32 })
}

/// The farthest way in metres that a point goes, from the first list to the second, as seen from what itself moves from the first pose to the
/// second.
pub(super) fn motion_seen_from([old, new]: [&Pose; 2], [before, now]: [&[Vec3]; 2]) -> f32 {
    let way =
        |(a, b): (&Vec3, &Vec3)| old.inverse_transform_point(*a).distance_squared(new.inverse_transform_point(*b));
    before.par_iter().zip(now).with_min_len(1024).map(way).reduce(|| 0.0, f32::max).sqrt()
}

/// How far each vertex of the skin is from where it was `before`, seen from the segment with most weight there.
pub(super) fn displacements(body: &ElasticBody, before: &[Vec3]) -> Vec<Vec3> {
    let displacement = |((&x, &before), weights): ((&Vec3, &Vec3), &SkinWeights)| {
        let rotation = body.motions()[heaviest_segment(weights)].rotation;
        rotation.inverse() * (x - before)
    };
    body.positions().iter().zip(before).zip(&body.rig().weights).map(displacement).collect()
}

/// The vertex whose displacement has changed most, and by how much.
pub(super) fn largest_change(last: &[Vec3], now: &[Vec3]) -> (usize, f32) {
    let changes = last.iter().zip(now).map(|(a, b)| a.distance(*b)).enumerate();
    changes.fold((0, 0.0), |best, (v, change)| if change > best.1 { (v, change) } else { best })
}

/// The segment with most weight in a vertex.
fn heaviest_segment(skin: &SkinWeights) -> usize {
    let heaviest =
        (0..skin.weights.len()).fold(0, |best, k| if skin.weights[k] > skin.weights[best] { k } else { best });
    usize::from(skin.segments[heaviest])
}
