//! Passes of hugging fields, one after the other, until the skin touches.
//!
//! One pass: gather the contacts of the deformed skin, choose their gauge points together, solve for their strengths so
//! that each ends touching, then carry the whole skin along.

use super::cancel::{CancelReport, CancelSettings};
use super::closing::{close_gaps, remaining_gap};
use super::contact::Proximity;
use super::find_contacts::{add_piercings, find_contacts, find_piercings};
use super::guards::{add_guards, find_guards};
use super::obstacle::ObstaclePart;
use super::penetrations::Contact;
use super::strength::{Way, solve_pass};
use crate::elastic::{CollisionState, ElasticBody};

/// Adds passes to the palette of `body` until nothing is left or nothing is gained any more; each handles what the last left
/// over. The best state is kept.
pub(super) fn attempt(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    way: Way,
    size: f32,
    settings: &CancelSettings,
    begun: Begun,
) -> CancelReport {
    let (mut known, mut report) = match begun {
        Begun::Anew { earlier } => (false, CancelReport { contacts: earlier, ..CancelReport::default() }),
        Begun::Continued(report) => (true, report),
    };
    let first = report.passes;
    let tolerance = settings.depth_tolerance * size;
    let mut stride = way.stride;
    let nothing = (f32::INFINITY, f32::INFINITY);
    let mut best = Best { worst: nothing, left: f32::INFINITY, state: body.collision_state(), passes: first };
    loop {
        let mut contacts = find_contacts(body, parts, near, tolerance);
        let small = contacts.iter().all(|contact| contact.depth() < SMALL * size);
        if small || way.tips {
            add_piercings(body, parts, find_piercings(body, parts, near, tolerance), &mut contacts);
        }
        report.left = contacts.iter().map(|contact| contact.shortest_depth(body, parts)).fold(0.0, f32::max);
        // Where triangles were not looked at they may be pierced deeper.
        let worst = if small { report.left } else { report.left.max(SMALL * size) };
        let deepest = contacts.iter().map(Contact::depth).fold(0.0, f32::max);
        if (worst, deepest) < best.worst {
            let state = body.collision_state();
            best = Best { worst: (worst, deepest), left: report.left, state, passes: report.passes };
        }
        let stuck = report.passes - best.passes >= PATIENCE;
        if contacts.is_empty() || stuck || report.passes >= settings.max_passes {
            break;
        }
        if report.passes == first {
            stride = stride.max(deepest / (STRIDES * size));
        }
        let mut pace = Way { stride, ..way };
        if report.passes - first >= WIDE_PASSES && small {
            // What is left over now is small and wedged: it is pushed out on the nearest way, by narrower fields.
            pace.softness *= 0.5;
            contacts =
                contacts.into_iter().map(|c| if c.pierced { c } else { c.by_the_nearest_way(body, parts) }).collect();
        }
        let height = contacts.iter().map(Contact::depth).fold(0.0, f32::max).min(GUARD_HEIGHT * size);
        let guards = find_guards(body, parts, near, &contacts, height);
        let mut all = contacts.clone();
        add_guards(body, parts, guards, &mut all);
        let least = vec![0.0; all.len()];
        let (pass, strengths) = solve_pass(body, (parts, near), &all, &least, pace, size, settings);
        if !known {
            report.contacts.extend(contacts);
            known = true;
        }
        for (contact, strength) in all.iter().zip(strengths).filter(|(_, strength)| *strength > 0.0) {
            report.hold(contact, strength);
        }
        report.passes += 1;
        body.deform_collision(pass);
    }
    if report.left <= 0.0 {
        close_gaps(body, parts, near, way, size, settings, &mut report);
    } else if best.passes < report.passes {
        body.resume(&best.state);
        (report.passes, report.left) = (best.passes, best.left);
    }
    report.gap = remaining_gap(body, parts, size, settings, &report);
    report
}

/// Where an attempt begins.
pub(super) enum Begun {
    /// With the skin as it is. `earlier` are contacts that were pushed out of parts earlier in the step: where the passes carry
    /// them off, they come back.
    Anew { earlier: Vec<Contact> },
    /// With passes of the step before, which are in the palette already; the contacts are those before them.
    Continued(CancelReport),
}

/// The best state so far.
struct Best {
    /// What is left over by the shortest ways out, and by the contacts' own.
    worst: (f32, f32),
    left: f32,
    state: CollisionState,
    passes: u32,
}

/// What pushes against each other is out in about this many passes: each goes at least the depth at first over it.
const STRIDES: f32 = 3.0;

/// Passes that may go by without any gain.
const PATIENCE: u32 = 2;

/// Parts within this part of the size are guarded while others push.
pub(super) const GUARD_HEIGHT: f32 = 0.15;

/// Depths below this part of the size are small: then triangles are looked at too, and the shortest way out is the best.
const SMALL: f32 = 0.04;

/// Passes with fields of full width.
const WIDE_PASSES: u32 = 2;
