//! Going on from the passes of the step before.
//!
//! A body that slides over tips and edges finds other contacts in every step, and passes that are chosen anew may lead to
//! another shape: the skin pops. Then the fields of the step before are carried along with what they lead out of, as they were or weakened a
//! little, and only what they leave over is solved for: so the skin goes over to another shape in several steps.

use std::collections::BTreeSet;

use super::at_once::in_one_pass;
use super::cancel::{CancelReport, CancelSettings};
use super::cancel_memory::{CancelMemory, Done, numbers_of};
use super::coherence::{displacements, largest_change, motion_seen_from};
use super::contact::Proximity;
use super::find_contacts::find_contacts;
use super::obstacle::{ObstaclePart, PartId};
use super::penetrations::Contact;
use super::strength::{Way, reach_of};
use crate::elastic::{CollisionField, ElasticBody, SegmentField};
use crate::field::{HuggingField, Patch, PlacedPart, Spread};
use crate::math::{Pose, Quat, Vec3};

/// Where a part was: fields that lead out of it are carried along with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
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
                Self { pose: Pose::from_parts(on_face, Quat::IDENTITY), normal: Some(face.normal) }
            }
            None => Self { pose, normal: None },
        }
    }

    /// The motion from here to where the part is `now`: exactly none for one that has not moved.
    fn motion_to(&self, now: &Self) -> Pose {
        if (self.pose, self.normal) == (now.pose, now.normal) {
            return Pose::IDENTITY;
        }
        let turn = match (self.normal, now.normal) {
            (Some(old), Some(new)) => Quat::from_rotation_arc(old, new),
            _ => Quat::IDENTITY,
        };
        Pose::from_parts(now.pose.translation, turn * now.pose.rotation) * self.pose.inverse()
    }
}

impl CancelMemory {
    /// How much the cancellation has changed since the step before, against what the skin has moved: the ratio of
    /// [`TimeCoherence`](super::coherence::TimeCoherence). `start` is the skin before the cancellation, `contacts` are those of this step.
    /// 0 where nothing is known of the step before, or settings have changed since.
    pub(super) fn pop(
        &self,
        body: &ElasticBody,
        start: &[Vec3],
        parts: &[ObstaclePart],
        contacts: &[Contact],
        size: f32,
        settings: &CancelSettings,
    ) -> f32 {
        if !self.is_of(body, settings) {
            return 0.0;
        }
        let (_, change) = largest_change(&self.moved, &displacements(body, start));
        let floor = (settings.depth_tolerance + settings.gap_tolerance) * size;
        change / (self.slide(start, parts, contacts) + floor / super::SMOOTH)
    }

    /// True where the step before was one of this body with the same settings.
    fn is_of(&self, body: &ElasticBody, settings: &CancelSettings) -> bool {
        let same = |old: &Done| Done { cancel: CancelSettings { first_way: settings.first_way, ..old.cancel }, ..*old };
        let now = Done::of(body, settings);
        self.before.len() == body.positions().len() && self.done.as_ref().is_some_and(|old| same(old) == now)
    }

    /// The farthest that the skin has moved, seen from what it touched in the step before or touches in this one, in metres. Infinite
    /// where an obstacle that it touches, or the body of another skin, was not there in the step before: nothing can be said of its motion then.
    fn slide(&self, start: &[Vec3], parts: &[ObstaclePart], contacts: &[Contact]) -> f32 {
        let now: BTreeSet<usize> = contacts.iter().flat_map(Contact::parts).collect();
        let is_new = |part: &ObstaclePart| match part.is_interface() {
            true => part.moved.is_none(),
            false => self.places.range(PartId::all_of(part.id.collider)).next().is_none(),
        };
        if now.iter().any(|&part| is_new(&parts[part])) {
            return f32::INFINITY;
        }
        let touched = parts.iter().enumerate().filter(|(i, part)| self.touched.contains(&part.id) || now.contains(i));
        let mut motions: Vec<Pose> = Vec::new();
        // The plane between two skins follows both of them: it is the other skin that this one slides along.
        let motion = |part: &ObstaclePart| if part.is_interface() { part.moved } else { self.motion_of(part) };
        for motion in touched.filter_map(|(_, part)| motion(part)) {
            // Most parts move together, or not at all.
            if !motions.contains(&motion) {
                motions.push(motion);
            }
        }
        let skins = [self.before.as_slice(), start];
        motions.iter().map(|motion| motion_seen_from([&Pose::IDENTITY, motion], skins)).fold(0.0, f32::max)
    }

    /// How a part has moved since the step before; none for one that was not there.
    fn motion_of(&self, part: &ObstaclePart) -> Option<Pose> {
        Some(self.places.get(&part.id)?.motion_to(&Place::of(part)))
    }

    /// Takes `keep` (0 to 1) of the passes of the step before, carried along with their parts and added up to one, and goes on from there.
    /// None where there were none, or settings have changed since.
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
        if !self.may_continue(body, settings) {
            return None;
        }
        let mut contacts = find_contacts(body, parts, near, settings.depth_tolerance * size);
        self.recognise(&mut contacts, parts);
        contacts.iter_mut().for_each(|contact| contact.pushed *= keep);
        let fields = self.carried_fields(keep, body, parts);
        let report = CancelReport { way: self.way, contacts, ..CancelReport::default() };
        (!fields.is_empty()).then(|| in_one_pass(fields, report, body, (parts, near), way, size, settings))
    }

    /// True where there are passes to go on from, and settings are what they were.
    pub(super) fn may_continue(&self, body: &ElasticBody, settings: &CancelSettings) -> bool {
        !self.passes.is_empty() && settings.max_passes > 0 && self.is_of(body, settings)
    }

    /// `keep` (0 to 1) of the fields of all passes of the step before, carried along with the parts that are still there.
    pub(super) fn carried_fields(&self, keep: f32, body: &ElasticBody, parts: &[ObstaclePart]) -> Vec<SegmentField> {
        let numbers = numbers_of(parts);
        let carry = |entry: &SegmentField| {
            let owner = self.number_now(entry.owner, &numbers)?;
            let motion = self.motion_of(&parts[owner])?;
            carried(entry, &motion, keep, body, owner as u32)
        };
        self.passes.iter().flat_map(|pass| &pass.fields).filter_map(carry).collect()
    }
}

/// A field of the step before, carried along with the `motion` of its part and weakened.
fn carried(entry: &SegmentField, motion: &Pose, keep: f32, body: &ElasticBody, owner: u32) -> Option<SegmentField> {
    let CollisionField::Hugging(field) = &entry.field else { return None };
    let gauge = motion.transform_point(field.gauge);
    let field = HuggingField {
        part: PlacedPart::new(field.part.part().clone(), *motion * *field.part.pose()),
        d: motion.rotation * field.d * keep,
        gauge,
        width: field.width,
        spread: Spread { along: motion.rotation * field.spread.along, share: field.spread.share },
        patch: Patch { centre: motion.transform_point(field.patch.centre), ..field.patch },
        extent: reach_of(body, gauge),
    };
    Some(SegmentField { shares: entry.shares.clone(), field: CollisionField::Hugging(field), owner })
}

#[cfg(test)]
mod tests {
    use rapier3d::geometry::{ColliderHandle, SharedShape};

    use super::*;
    use crate::coupling::obstacle::{OuterFace, convex_parts};

    fn part(id: PartId, pose: Pose) -> ObstaclePart {
        let parts = convex_parts(&SharedShape::cuboid(0.2, 0.3, 0.4)).expect("a box");
        ObstaclePart::new(id, ColliderHandle::invalid(), &parts[0], pose)
    }

    fn pose(angle: f32, at: Vec3) -> Pose {
        Pose::from_parts(at, Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), angle))
    }

    #[test]
    fn what_leads_out_of_a_part_is_carried_along_with_it() {
        let id = PartId { collider: (3, 1), part: 2 };
        let (old, new) = (pose(0.3, Vec3::new(1.0, 2.0, 3.0)), pose(1.1, Vec3::new(-1.0, 0.5, 2.0)));
        let motion = Place::of(&part(id, old)).motion_to(&Place::of(&part(id, new)));
        for local in [Vec3::ZERO, Vec3::X, Vec3::new(0.1, -0.7, 0.4)] {
            let there = motion.transform_point(old.transform_point(local));
            assert!(there.distance(new.transform_point(local)) < 1e-5, "{there}");
        }
        let still = Place::of(&part(id, old)).motion_to(&Place::of(&part(id, old)));
        assert_eq!(still, Pose::IDENTITY);
    }

    #[test]
    fn what_leads_out_of_another_skin_is_carried_along_with_the_plane_between_them_and_not_with_the_depth_of_the_box_behind_it()
     {
        let plane = |normal: Vec3, offset: f32, depth: f32| {
            let id = PartId::interface(0, (1, 0));
            let turn = Quat::from_rotation_arc(Vec3::Z, normal);
            let mut part = part(id, Pose::from_parts(normal * (offset - depth), turn));
            part.face = Some(OuterFace { normal, offset, area: 1.0, two_sided: false, edges: Vec::new() });
            part
        };
        // The skins overlap more deeply, at the same place.
        let motion = Place::of(&plane(Vec3::Y, 0.5, 0.1)).motion_to(&Place::of(&plane(Vec3::Y, 0.5, 0.3)));
        assert!(motion.translation.length() < 1e-6, "{motion:?}");
        // The plane has moved and turned.
        let normal = Vec3::new(0.6, 0.8, 0.0);
        let motion = Place::of(&plane(Vec3::Y, 0.5, 0.1)).motion_to(&Place::of(&plane(normal, 0.7, 0.2)));
        assert!((motion.rotation * Vec3::Y).distance(normal) < 1e-5);
        assert!(motion.transform_point(Vec3::Y * 0.5).distance(normal * 0.7) < 1e-5);
    }
}
