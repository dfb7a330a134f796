//! The same again: where hardly anything has moved since the step before, what was done then serves once more.
//!
//! The solve for the passes makes choices: which contacts go together, in how many passes, which way. Where things move fast
//! nobody sees that a choice changes. Where a body lies still but for a tremor the passes of the step before are
//! taken as they were, and what little is left over is corrected: then the skin moves no more than what it lies on.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::cancel::{CancelReport, CancelSettings, WORTH_CLOSING, softness_of};
use super::closing::{close_gaps, left_over, widest_gap};
use super::contact::Proximity;
use super::measure::widest_held_gap;
use super::obstacle::{ObstaclePart, PartId};
use super::penetrations::{Contact, SAME_WAY, add_guards, find_contacts, find_guards};
use super::strength::{Way, solve_pass};
use crate::elastic::{CollisionPass, DeformSettings, ElasticBody};
use crate::math::{Pose, Vec3};

/// What the cancellation of one body leaves for the next step.
#[derive(Clone, Debug, Default)]
pub struct CancelMemory {
    /// Which way was taken.
    pub way: usize,
    /// How it was done.
    settings: Option<(CancelSettings, DeformSettings)>,
    /// The skin before the cancellation.
    before: Vec<Vec3>,
    /// Where the parts around the body were.
    places: BTreeMap<PartId, Pose>,
    passes: Vec<CollisionPass>,
    pushed: Vec<Pushed>,
}

/// A contact that was pushed.
#[derive(Clone, Debug)]
struct Pushed {
    segment: u16,
    parts: BTreeSet<PartId>,
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
        self.way = report.way;
        self.settings = Some((*settings, body.settings));
        self.before = before;
        self.places = parts.iter().map(|part| (part.id, *part.placed.pose())).collect();
        self.passes = body.palette().passes.clone();
        let ids = |contact: &Contact| contact.parts().into_iter().map(|part| parts[part].id).collect();
        let pushed = |contact: &Contact| Pushed {
            segment: contact.near.segment,
            parts: ids(contact),
            normal: contact.near.normal,
            by: contact.pushed,
        };
        self.pushed = report.contacts.iter().filter(|contact| contact.held).map(pushed).collect();
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
        if self.settings != Some((*settings, body.settings)) {
            return None;
        }
        if self.passes.is_empty() || self.passes.len() as u32 > MOST_PASSES || self.motion(body, parts) > TREMOR * size
        {
            return None;
        }
        let tolerance = settings.depth_tolerance * size;
        let mut report = CancelReport { way: self.way, ..CancelReport::default() };
        report.contacts = find_contacts(body, parts, near, tolerance);
        if !self.recognise(&mut report.contacts, parts) {
            return None;
        }
        for pass in &self.passes {
            body.deform_collision(pass.clone());
            report.passes += 1;
        }
        let way = Way { softness: softness_of(body, settings), stride: 1.0 };
        let mut inside = left_over(body, parts, near, tolerance);
        if !inside.is_empty() {
            let height = inside.iter().map(Contact::depth).fold(0.0, f32::max);
            if height > SMALL * size {
                return None;
            }
            let guards = find_guards(body, parts, near, &inside, height);
            add_guards(body, parts, guards, &mut inside);
            let least = vec![0.0; inside.len()];
            let (pass, strengths) = solve_pass(body, (parts, near), &inside, &least, way, size, settings);
            body.deform_collision(pass);
            report.passes += 1;
            for (contact, strength) in inside.iter().zip(strengths).filter(|(_, strength)| *strength > 0.0) {
                report.hold(contact, strength);
            }
            inside = left_over(body, parts, near, tolerance);
        }
        if !inside.is_empty() {
            return None;
        }
        close_gaps(body, parts, near, way, size, settings, &mut report);
        report.gap = widest_gap(body, parts, &report.contacts);
        if report.gap > WORTH_CLOSING * settings.gap_tolerance * size {
            // Between the vertices the skin may touch.
            report.gap = report.gap.min(widest_held_gap(body, parts, size, &report));
        }
        (report.gap <= WORTH_CLOSING * settings.gap_tolerance * size).then_some(report)
    }

    /// Contacts that were pushed in the step before are those that are now. False where one of an obstacle is there no more: what
    /// was pushed for it must go.
    fn recognise(&self, contacts: &mut [Contact], parts: &[ObstaclePart]) -> bool {
        let mut seen = BTreeSet::new();
        for contact in contacts {
            let ids: BTreeSet<PartId> = contact.parts().into_iter().map(|part| parts[part].id).collect();
            let same = |known: &&Pushed| {
                known.segment == contact.near.segment
                    && known.normal.dot(contact.near.normal) > SAME_WAY
                    && !known.parts.is_disjoint(&ids)
            };
            let pushed = self.pushed.iter().filter(same).map(|known| known.by).fold(0.0, f32::max);
            seen.extend(self.pushed.iter().enumerate().filter(|(_, known)| same(known)).map(|(i, _)| i));
            (contact.held, contact.pushed) = (pushed > 0.0, pushed);
        }
        !self.pushed.is_empty() && seen.len() == self.pushed.len()
    }

    /// The farthest that the skin or a part that it touched has moved, in metres.
    fn motion(&self, body: &ElasticBody, parts: &[ObstaclePart]) -> f32 {
        if self.before.len() != body.positions().len() {
            return f32::INFINITY;
        }
        let way = |(old, new): (&Vec3, &Vec3)| old.distance_squared(*new);
        let skin = self.before.par_iter().zip(body.positions()).with_min_len(1024).map(way).reduce(|| 0.0, f32::max);
        let of_part = |part: &ObstaclePart| {
            let (old, new) = (self.places.get(&part.id)?, part.placed.pose());
            let corner = part.aabb.maxs.min(Vec3::splat(FAR));
            let ends = [part.aabb.mins.max(Vec3::splat(-FAR)), corner];
            let moved = |x: Vec3| (*old * new.inverse_transform_point(x)).distance(x);
            Some(ends.into_iter().map(moved).fold(0.0, f32::max))
        };
        // Whatever comes near without having been touched yet is found by the contacts.
        let touched = |part: &&ObstaclePart| {
            part.id.collider.0 != u32::MAX && self.pushed.iter().any(|known| known.parts.contains(&part.id))
        };
        parts.iter().filter(touched).filter_map(of_part).fold(skin.sqrt(), f32::max)
    }
}

/// What moves by less than this part of the size in a step lies still.
const TREMOR: f32 = 5.0e-4;

/// More than this many passes are solved for anew.
const MOST_PASSES: u32 = 8;

/// What is left over is corrected up to this part of the size.
const SMALL: f32 = 5.0e-3;

/// Boxes without end are looked at within this many metres.
const FAR: f32 = 1.0e3;
