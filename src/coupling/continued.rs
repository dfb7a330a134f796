//! Going on from the passes of the step before.
//!
//! A body that slides over tips and edges finds other contacts in every step, and passes that are chosen anew may lead to
//! another shape: the skin pops. Then the fields of the step before are carried along with what they lead out of, as they were or weakened a
//! little, and only what they leave over is solved for: so the skin goes over to another shape in several steps.

use super::attempt::{Begun, attempt};
use super::cancel::{CancelReport, CancelSettings};
use super::cancel_memory::CancelMemory;
use super::coherence::{displacements, largest_change, motion_seen_from};
use super::contact::Proximity;
use super::find_contacts::find_contacts;
use super::obstacle::{ObstaclePart, PartId};
use super::strength::{Way, certify, reach_of};
use crate::elastic::{CollisionField, CollisionPass, ElasticBody, SegmentField};
use crate::field::{HuggingField, Patch, PlacedPart, Spread};
use crate::math::{Pose, Quat, Vec3};

/// Where a part was: fields that lead out of it are carried along with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub id: PartId,
    pose: Pose,
    /// For the part behind an interface its outer normal.
    normal: Option<Vec3>,
}

impl Place {
    pub fn of(part: &ObstaclePart) -> Self {
        let pose = *part.placed.pose();
        match part.face.as_ref().filter(|_| part.is_interface()) {
            // The box behind an interface is as deep as the overlap: only its outer face has a place.
            Some(face) => {
                let on_face = pose.translation + face.normal * (face.offset - face.normal.dot(pose.translation));
                Self { id: part.id, pose: Pose::from_parts(on_face, Quat::IDENTITY), normal: Some(face.normal) }
            }
            None => Self { id: part.id, pose, normal: None },
        }
    }

    /// The motion from here to where the part is `now`.
    fn motion_to(&self, now: &Self) -> Pose {
        let turn = match (self.normal, now.normal) {
            (Some(old), Some(new)) => Quat::from_rotation_arc(old, new),
            _ => Quat::IDENTITY,
        };
        Pose::from_parts(now.pose.translation, turn * now.pose.rotation) * self.pose.inverse()
    }
}

impl CancelMemory {
    /// How much the cancellation has changed since the step before, against what the skin has moved: the ratio of
    /// [`TimeCoherence`](super::coherence::TimeCoherence). `start` is the skin before the cancellation. 0 where nothing is known of the step before.
    pub(super) fn pop(
        &self,
        body: &ElasticBody,
        start: &[Vec3],
        parts: &[ObstaclePart],
        size: f32,
        settings: &CancelSettings,
    ) -> f32 {
        if self.before.len() != body.positions().len() {
            return 0.0;
        }
        let (_, change) = largest_change(&self.moved, &displacements(body, start));
        let floor = (settings.depth_tolerance + settings.gap_tolerance) * size;
        change / (self.slide(start, parts) + floor / super::SMOOTH)
    }

    /// The farthest that the skin has moved, seen from what it touched, in metres.
    fn slide(&self, start: &[Vec3], parts: &[ObstaclePart]) -> f32 {
        let skins = [self.before.as_slice(), start];
        let seen_from = |part: &ObstaclePart| {
            self.pushed.iter().find(|known| known.parts.contains_key(&part.id))?;
            Some(motion_seen_from([&Pose::IDENTITY, &self.motion_of(part)?], skins))
        };
        parts.iter().filter_map(seen_from).fold(0.0, f32::max)
    }

    /// How a part has moved since the step before; none for one that was not there.
    fn motion_of(&self, part: &ObstaclePart) -> Option<Pose> {
        let old = self.places.iter().find(|place| place.id == part.id)?;
        Some(old.motion_to(&Place::of(part)))
    }

    /// Takes `keep` (0 to 1) of the passes of the step before, carried along with their parts and added up to one, and goes on from there.
    /// None where there were none.
    ///
    /// The fields are added up since otherwise each step would leave a pass more; what the sum does not do as the passes did one after
    /// the other is among what is left over.
    pub(super) fn continued(
        &self,
        keep: f32,
        body: &mut ElasticBody,
        (parts, near): (&[ObstaclePart], &[Proximity]),
        way: Way,
        size: f32,
        settings: &CancelSettings,
    ) -> Option<CancelReport> {
        if self.passes.is_empty() || settings.max_passes == 0 {
            return None;
        }
        let contacts = find_contacts(body, parts, near, settings.depth_tolerance * size);
        let mut report = CancelReport { way: self.way, contacts, ..CancelReport::default() };
        self.recognise(&mut report.contacts, parts);
        report.contacts.iter_mut().for_each(|contact| contact.pushed *= keep);
        let carried = self.passes.iter().flat_map(|pass| &pass.fields);
        let carried = carried.filter_map(|field| self.carried(field, keep, body, parts));
        let mut pass = CollisionPass { fields: carried.collect(), steps: 1 };
        if pass.fields.is_empty() {
            return None;
        }
        certify(&mut pass, body, settings);
        body.deform_collision(pass);
        report.passes = 1;
        Some(attempt(body, parts, near, way, size, settings, Begun::Continued(report)))
    }

    /// A field of the step before, carried along with its part and weakened.
    fn carried(
        &self,
        entry: &SegmentField,
        keep: f32,
        body: &ElasticBody,
        parts: &[ObstaclePart],
    ) -> Option<SegmentField> {
        let id = self.places.get(entry.owner as usize)?.id;
        let owner = parts.iter().position(|part| part.id == id)?;
        let motion = self.motion_of(&parts[owner])?;
        let CollisionField::Hugging(field) = &entry.field else { return None };
        let gauge = motion.transform_point(field.gauge);
        let field = HuggingField {
            part: PlacedPart::new(field.part.part().clone(), motion * *field.part.pose()),
            d: motion.rotation * field.d * keep,
            gauge,
            width: field.width,
            spread: Spread { along: motion.rotation * field.spread.along, share: field.spread.share },
            patch: Patch { centre: motion.transform_point(field.patch.centre), ..field.patch },
            extent: reach_of(body, gauge),
        };
        Some(SegmentField { shares: entry.shares.clone(), field: CollisionField::Hugging(field), owner: owner as u32 })
    }
}
