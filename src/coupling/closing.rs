//! What was pushed too far comes back: contacts that a later pass has carried off their obstacles.

use super::attempt::GUARD_HEIGHT;
use super::cancel::{CancelReport, CancelSettings, WORTH_CLOSING};
use super::contact::Proximity;
use super::measure::widest_held_gap;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, add_guards, add_piercings, find_contacts, find_guards, find_piercings};
use super::strength::{Way, solve_pass};
use crate::elastic::ElasticBody;

/// Takes back what contacts were pushed too far: a later pass for one contact may have carried another off its obstacle.
pub(super) fn close_gaps(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    way: Way,
    size: f32,
    settings: &CancelSettings,
    report: &mut CancelReport,
) {
    let (tolerance, close) = (settings.depth_tolerance * size, WORTH_CLOSING * settings.gap_tolerance * size);
    for _ in 0..CLOSING_PASSES {
        let watched: Vec<(Contact, f32)> =
            report.contacts.iter().filter_map(|contact| contact.watched(body, parts)).collect();
        let pulled = watched.iter().filter(|(contact, gap)| *gap > close && contact.pushed > 0.0);
        let widest = pulled.map(|(_, gap)| *gap).fold(0.0, f32::max);
        // Between the vertices the skin may touch.
        if widest <= 0.0 {
            return;
        }
        let held = widest_held_gap(body, parts, size, report);
        if held <= close {
            return;
        }
        let mut all: Vec<Contact> = watched.into_iter().map(|(contact, _)| contact).collect();
        let guards = find_guards(body, parts, near, &all, (2.0 * widest).min(GUARD_HEIGHT * size));
        add_guards(body, parts, guards, &mut all);
        let least: Vec<f32> = all.iter().map(|contact| -contact.pushed).collect();
        let (pass, strengths) = solve_pass(body, (parts, near), &all, &least, way, size, settings);
        let before = body.collision_state();
        body.deform_collision(pass);
        let mut taken = 1;
        let mut inside = left_over(body, parts, near, tolerance);
        if !inside.is_empty() {
            // What sank in a little between the points that were watched comes out again.
            let guards = find_guards(body, parts, near, &inside, widest);
            add_guards(body, parts, guards, &mut inside);
            let least = vec![0.0; inside.len()];
            let (pass, _) = solve_pass(body, (parts, near), &inside, &least, way, size, settings);
            body.deform_collision(pass);
            taken = 2;
            inside = left_over(body, parts, near, tolerance);
        }
        if !inside.is_empty() || widest_held_gap(body, parts, size, report) >= held {
            body.resume(&before);
            return;
        }
        report.passes += taken;
        for (contact, strength) in all.iter().zip(strengths).filter(|(_, strength)| *strength != 0.0) {
            report.hold(contact, strength);
        }
        // What was taken back altogether is carried by others.
        report.contacts.iter_mut().for_each(|contact| contact.held &= contact.pushed > tolerance);
    }
}

/// The widest gap between skin and parts at a contact that fields of its own have pushed, in metres.
pub(super) fn widest_gap(body: &ElasticBody, parts: &[ObstaclePart], contacts: &[Contact]) -> f32 {
    let gap = |contact: &Contact| contact.watched(body, parts).map_or(0.0, |(_, gap)| gap);
    contacts.iter().filter(|contact| contact.pushed > 0.0).map(gap).fold(0.0, f32::max)
}

/// All that is inside: vertices and pierced triangles.
pub(super) fn left_over(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    tolerance: f32,
) -> Vec<Contact> {
    let mut contacts = find_contacts(body, parts, near, tolerance);
    add_piercings(body, parts, find_piercings(body, parts, near, tolerance), &mut contacts);
    contacts
}

/// Most passes that close gaps.
const CLOSING_PASSES: u32 = 5;
