//! What was done in the step before serves once more where hardly anything has moved since.
//!
//! The solve for the passes makes choices: which contacts go together, in how many passes, which way. Where things move fast
//! nobody sees that a choice changes. Where a body lies still but for a tremor the passes of the step before are
//! taken as they were, and what little is left over is corrected: then the skin hardly moves more than what it lies on.

use std::collections::{BTreeMap, BTreeSet};

use super::cancel::{CancelReport, CancelSettings, softness_of};
use super::closing::{close_gaps, left_over, push_out, remaining_gap, worth_closing};
use super::coherence::{displacements, motion_seen_from};
use super::contact::Proximity;
use super::continued::Place;
use super::find_contacts::find_contacts;
use super::obstacle::{ObstaclePart, PartId};
use super::penetrations::{Contact, SAME_WAY};
use super::strength::Way;
use crate::elastic::{CollisionPass, ElasticBody};
use crate::field::Integrator;
use crate::math::{Pose, Vec3};

/// What the cancellation of one body leaves for the next step.
#[derive(Clone, Debug, Default)]
pub struct CancelMemory {
    /// Which way was taken.
    pub way: usize,
    /// How it was done.
    pub(super) done: Option<Done>,
    /// The skin before the cancellation.
    pub(super) before: Vec<Vec3>,
    /// How far the cancellation moved each vertex, seen from its segment.
    pub(super) moved: Vec<Vec3>,
    pub(super) passes: Vec<CollisionPass>,
    /// The parts' names, in their order: fields name them by their number.
    pub(super) parts: Vec<PartId>,
    /// Where the parts were.
    pub(super) places: BTreeMap<PartId, Place>,
    /// The parts that the skin was in, whatever has led it out.
    pub(super) touched: BTreeSet<PartId>,
    pushed: Vec<Pushed>,
}

/// All that a cancellation depends on beside the skin before it and what it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Done {
    pub cancel: CancelSettings,
    pub integrator: Integrator,
    pub enabled: bool,
}

impl Done {
    pub fn of(body: &ElasticBody, settings: &CancelSettings) -> Self {
        Self { cancel: *settings, integrator: body.settings.integrator, enabled: body.settings.enabled }
    }
}

/// A contact that was pushed.
#[derive(Clone, Debug)]
struct Pushed {
    segment: u16,
    /// Its parts, and where they were.
    parts: BTreeMap<PartId, Pose>,
    normal: Vec3,
    /// How far, in metres.
    by: f32,
}

impl CancelMemory {
    /// Notes what was done in this step: `before` is the skin before the cancellation, `body` as it is after it.
    pub fn remember(
        &mut self,
        before: Vec<Vec3>,
        body: &ElasticBody,
        parts: &[ObstaclePart],
        report: &CancelReport,
        settings: &CancelSettings,
    ) {
        let pushed = |contact: &Contact| Pushed {
            segment: contact.near.segment,
            parts: contact.parts().into_iter().map(|part| (parts[part].id, *parts[part].placed.pose())).collect(),
            normal: contact.near.normal,
            by: contact.pushed,
        };
        *self = Self {
            way: report.way,
            done: Some(Done::of(body, settings)),
            moved: displacements(body, &before),
            before,
            parts: parts.iter().map(|part| part.id).collect(),
            places: parts.iter().map(|part| (part.id, Place::of(part))).collect(),
            touched: report.contacts.iter().flat_map(Contact::parts).map(|part| parts[part].id).collect(),
            passes: body.palette().passes.clone(),
            pushed: report.contacts.iter().filter(|contact| contact.held).map(pushed).collect(),
        };
    }

    /// True where there was a step before.
    pub fn knows_a_step(&self) -> bool {
        self.done.is_some()
    }

    /// Forgets the step before.
    pub fn forget(&mut self) {
        *self = Self { way: self.way, ..Self::default() };
    }

    /// Takes the passes of the step before once more, and corrects what is left over. None where more has moved than a
    /// tremor, or settings have changed, or where that does not do; then the body's skin is not what it was before.
    pub(super) fn again(
        &self,
        body: &mut ElasticBody,
        parts: &[ObstaclePart],
        near: &[Proximity],
        size: f32,
        settings: &CancelSettings,
    ) -> Option<CancelReport> {
        let most_passes = MOST_PASSES.min(settings.max_passes);
        let known = self.done == Some(Done::of(body, settings));
        if !known || self.pushed.is_empty() || self.passes.len() as u32 > most_passes {
            return None;
        }
        if self.motion(body, parts) > TREMOR * size {
            return None;
        }
        let tolerance = settings.depth_tolerance * size;
        let contacts = find_contacts(body, parts, near, tolerance);
        let mut report = CancelReport { way: self.way, contacts, ..CancelReport::default() };
        if !self.recognise(&mut report.contacts, parts) {
            return None;
        }
        let numbers = numbers_of(parts);
        for mut pass in self.passes.iter().cloned() {
            self.rename_owners(&mut pass, &numbers);
            body.deform_collision(pass);
            report.passes += 1;
        }
        let way = Way { softness: softness_of(body, settings), stride: 1.0, tips: false };
        let inside = left_over(body, parts, near, tolerance);
        let height = inside.iter().map(Contact::depth).fold(0.0, f32::max);
        if height > SMALL * size {
            return None;
        }
        // What creeps would need another small pass every few steps, and too many are solved for anew with a jump.
        if height > SLACK * tolerance {
            for (contact, strength) in push_out(body, (parts, near), inside, height, way, size, settings) {
                report.hold(&contact, strength);
            }
            report.passes += 1;
            if !left_over(body, parts, near, tolerance).is_empty() {
                return None;
            }
        }
        close_gaps(body, parts, near, way, size, settings, &mut report);
        report.gap = remaining_gap(body, parts, size, settings, &report);
        (report.gap <= worth_closing(size, settings) && report.passes <= settings.max_passes).then_some(report)
    }

    /// Fields of the step before name their parts by numbers in its list; now by those in this one. A part that is gone has no number.
    fn rename_owners(&self, pass: &mut CollisionPass, numbers: &BTreeMap<PartId, usize>) {
        for entry in &mut pass.fields {
            entry.owner = self.number_now(entry.owner, numbers).map_or(u32::MAX, |now| now as u32);
        }
    }

    /// The number in this step's list of the part with this number in the list of the step before; none for one that is gone.
    pub(super) fn number_now(&self, owner: u32, numbers: &BTreeMap<PartId, usize>) -> Option<usize> {
        numbers.get(self.parts.get(owner as usize)?).copied()
    }

    /// Contacts that were pushed in the step before are those that are now. False where the contact of one is there no more: what
    /// was pushed for it must go.
    pub(super) fn recognise(&self, contacts: &mut [Contact], parts: &[ObstaclePart]) -> bool {
        let mut seen = vec![false; self.pushed.len()];
        for contact in contacts {
            for (known, seen) in self.pushed.iter().zip(&mut seen) {
                if known.is(contact, parts) {
                    *seen = true;
                    contact.held = true;
                    contact.pushed = contact.pushed.max(known.by);
                }
            }
        }
        !seen.contains(&false)
    }

    /// The farthest that the skin has moved, in the world and as seen from each part that it touched, in metres.
    fn motion(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> f32 {
        if self.before.len() != body.positions().len() {
            return f32::INFINITY;
        }
        let skins = [self.before.as_slice(), body.positions()];
        let seen_from = |part: &ObstaclePart| {
            // Interfaces follow the skins, and come and go with them.
            let old =
                self.pushed.iter().filter(|_| !part.is_interface()).find_map(|known| known.parts.get(&part.id))?;
            let new = part.placed.pose();
            (old != new).then(|| motion_seen_from([old, new], skins))
        };
        // Whatever comes near without having been touched yet is found by the contacts.
        let in_the_world = motion_seen_from([&Pose::IDENTITY; 2], skins);
        parts.iter().filter_map(seen_from).fold(in_the_world, f32::max)
    }
}

/// The numbers of parts in their list.
pub(super) fn numbers_of(parts: &[ObstaclePart]) -> BTreeMap<PartId, usize> {
    parts.iter().enumerate().map(|(i, part)| (part.id, i)).collect()
}

impl Pushed {
    /// True for the contact of the same segment, with a part of this one's, that leads out nearly the same way.
    fn is(&self, contact: &Contact, parts: &[ObstaclePart]) -> bool {
        self.segment == contact.near.segment
            && self.normal.dot(contact.near.normal) > SAME_WAY
            && contact.parts().into_iter().any(|part| self.parts.contains_key(&parts[part].id))
    }
}

/// What moves by less than this part of the size in a step lies still.
const TREMOR: f32 = 5.0e-4;

/// More than this many passes are solved for anew, where they cannot be done all at once.
const MOST_PASSES: u32 = 8;

/// What is inside by more than this many tolerances is corrected, then as far as one tolerance. With the usual tolerance that is
/// still less than what may be seen ([`super::INSIDE`]).
const SLACK: f32 = 1.6;

/// What is left over is corrected up to this part of the size.
const SMALL: f32 = 5.0e-3;
