//! What was pushed too far comes back: contacts that a later pass has carried off their obstacles.

use super::attempt::GUARD_HEIGHT;
use super::cancel::{CancelReport, CancelSettings, WORTH_CLOSING};
use super::contact::Proximity;
use super::find_contacts::{add_piercings, find_contacts, find_piercings};
use super::guards::{add_guards, find_guards};
use super::measure::widest_held_gap;
use super::obstacle::ObstaclePart;
use super::penetrations::Contact;
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
    let (tolerance, close) = (settings.depth_tolerance * size, worth_closing(size, settings));
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
        let watched = watched.into_iter().map(|(contact, _)| contact.with_triangles(body, parts));
        if !pull_back(body, (parts, near), watched.collect(), [widest, held], way, (size, settings), report) {
            return;
        }
        // What was taken back altogether is carried by others.
        report.contacts.iter_mut().for_each(|contact| contact.held &= contact.pushed > tolerance);
    }
}

/// Takes back what the `watched` contacts were pushed too far, and pushes out again what sinks in on the way. False, with the skin as
/// it was, where that does not make the widest gap narrower. `widest` is that gap as the points tell it, `held` as it is measured.
fn pull_back(
    body: &mut ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    mut watched: Vec<Contact>,
    [widest, held]: [f32; 2],
    way: Way,
    (size, settings): (f32, &CancelSettings),
    report: &mut CancelReport,
) -> bool {
    let tolerance = settings.depth_tolerance * size;
    let guards = find_guards(body, parts, near, &watched, (2.0 * widest).min(GUARD_HEIGHT * size));
    add_guards(body, parts, guards, &mut watched);
    let least: Vec<f32> = watched.iter().map(|contact| -contact.pushed).collect();
    let (pass, strengths) = solve_pass(body, (parts, near), &watched, &least, way, size, settings);
    let before = body.collision_state();
    body.deform_collision(pass);
    let mut taken = 1;
    let mut inside = left_over(body, parts, near, tolerance);
    if !inside.is_empty() {
        // What sank in a little between the points that were watched comes out again.
        push_out(body, (parts, near), inside, widest, way, size, settings);
        taken = 2;
        inside = left_over(body, parts, near, tolerance);
    }
    if !inside.is_empty() || widest_held_gap(body, parts, size, report) >= held {
        body.resume(&before);
        return false;
    }
    report.passes += taken;
    for (contact, strength) in watched.iter().zip(strengths).filter(|(_, strength)| *strength != 0.0) {
        report.hold(contact, strength);
    }
    true
}

/// One pass that pushes these contacts out, parts within `height` metres guarded: the contacts that pushed, and how strongly.
pub(super) fn push_out(
    body: &mut ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    mut contacts: Vec<Contact>,
    height: f32,
    way: Way,
    size: f32,
    settings: &CancelSettings,
) -> Vec<(Contact, f32)> {
    let guards = find_guards(body, parts, near, &contacts, height);
    add_guards(body, parts, guards, &mut contacts);
    let least = vec![0.0; contacts.len()];
    let (pass, strengths) = solve_pass(body, (parts, near), &contacts, &least, way, size, settings);
    body.deform_collision(pass);
    contacts.into_iter().zip(strengths).filter(|(_, strength)| *strength > 0.0).collect()
}

/// Gaps from this one on are worth closing, in metres.
pub(super) fn worth_closing(size: f32, settings: &CancelSettings) -> f32 {
    WORTH_CLOSING * settings.gap_tolerance * size
}

/// The widest gap at a contact: as the vertices tell it, and where that would be worth closing, between the vertices too.
pub(super) fn remaining_gap(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    size: f32,
    settings: &CancelSettings,
    report: &CancelReport,
) -> f32 {
    let gap = widest_gap(body, parts, &report.contacts);
    if gap > worth_closing(size, settings) { gap.min(widest_held_gap(body, parts, size, report)) } else { gap }
}

/// The widest gap between skin and parts at a contact that fields of its own have pushed, in metres.
fn widest_gap(body: &ElasticBody, parts: &[ObstaclePart], contacts: &[Contact]) -> f32 {
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
