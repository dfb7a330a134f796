//! Penetration cancellation: passes of hugging fields that push the skin out until it touches (section 4).
//!
//! One pass: gather the contacts of the deformed skin, choose their gauge points together, solve for their strengths so
//! that each ends touching, then carry the whole skin along. Passes are concatenated until nothing is left.

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, add_guards, add_piercings, find_contacts, find_guards, find_piercings};
use super::strength::solve_pass;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// Tolerances and limits of the cancellation; lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CancelSettings {
    /// Softness `s`: fields fade out over `s` times the segment's size. `None` takes the rig's.
    pub softness: Option<f32>,
    /// Depth that may be left over.
    pub depth_tolerance: f32,
    /// Gap that may be left at a contact.
    pub gap_tolerance: f32,
    /// Most passes.
    pub max_passes: u32,
    /// Most rounds of the solve for the strengths in each pass.
    pub max_rounds: u32,
    /// Most integration steps of a pass; a field whose bound asks for more is weakened and the next pass goes on.
    pub max_steps: u32,
    /// Where the fields are placed.
    pub placement: Placement,
}

/// Where collision fields are placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placement {
    /// Fields hug the part, gauge points and strengths are solved for.
    #[default]
    Hugging,
    /// The paper's literal placement (section 4.2): bounding sphere of the part, direction along the line of centres,
    /// one pass, plain sum. For comparison.
    Literal,
}

impl Default for CancelSettings {
    fn default() -> Self {
        Self {
            softness: None,
            depth_tolerance: 5.0e-4,
            gap_tolerance: 2.0e-3,
            max_passes: 12,
            max_rounds: 10,
            max_steps: 64,
            placement: Placement::Hugging,
        }
    }
}

/// What the cancellation of one body did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CancelReport {
    /// The contacts as they were before the first pass.
    pub contacts: Vec<Contact>,
    /// Number of passes.
    pub passes: u32,
    /// Depth in metres that no pass could cancel, by the shortest way out; 0 where nothing deeper than the tolerance is left.
    pub left: f32,
}

/// Cancels the penetration of `body` into `parts`: adds passes to its palette and carries its skin along.
///
/// Each pass handles what the last left over. A body that is pinned, without room for its volume, may get worse by further
/// passes: the best state is kept, and what is left is reported. `size` is the body's size, the unit of the tolerances.
pub fn cancel(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let mut report = CancelReport::default();
    if settings.placement == Placement::Literal {
        return literal(body, parts, near, size, settings);
    }
    let tolerance = settings.depth_tolerance * size;
    let mut best = Best { worst: f32::INFINITY, positions: Vec::new(), passes: 0 };
    let before = body.palette().passes.len();
    loop {
        let mut contacts = find_contacts(body, parts, near, tolerance);
        let small = contacts.iter().all(|contact| contact.depth() < SMALL * size);
        if small {
            add_piercings(body, parts, find_piercings(body, parts, near, tolerance), &mut contacts);
        }
        report.left = contacts.iter().map(|contact| contact.shortest_depth(body, parts)).fold(0.0, f32::max);
        if report.left < best.worst {
            best = Best { worst: report.left, positions: body.positions().to_vec(), passes: report.passes };
        }
        let stuck = report.passes - best.passes >= PATIENCE;
        if contacts.is_empty() || stuck || report.passes >= settings.max_passes {
            break;
        }
        let softness = settings.softness.unwrap_or(body.rig().softness);
        let mut reach = softness.clamp(LEAST_SOFTNESS, MOST_SOFTNESS);
        if report.passes >= WIDE_PASSES && small {
            // What is left over now is small and wedged: it is pushed out on the nearest way, by narrower fields.
            reach *= 0.5;
            contacts =
                contacts.into_iter().map(|c| if c.pierced { c } else { c.by_the_nearest_way(body, parts) }).collect();
        }
        let height = contacts.iter().map(Contact::depth).fold(0.0, f32::max).min(GUARD_HEIGHT * size);
        let guards = find_guards(body, parts, near, &contacts, height);
        let mut all = contacts.clone();
        add_guards(body, parts, guards, &mut all);
        let least = vec![0.0; all.len()];
        let (pass, strengths) = solve_pass(body, (parts, near), &all, &least, reach, size, settings);
        if report.passes == 0 {
            report.contacts = contacts;
        }
        for (contact, strength) in all.iter().zip(strengths).filter(|(_, strength)| *strength > 0.0) {
            report.hold(contact, strength);
        }
        report.passes += 1;
        body.deform_collision(pass);
    }
    if report.left <= 0.0 {
        close_gaps(body, parts, near, size, settings, &mut report);
    } else if best.passes < report.passes {
        body.restore(&best.positions, before + best.passes as usize);
        (report.passes, report.left) = (best.passes, best.worst);
    }
    report
}

impl CancelReport {
    /// Notes that a contact's own field pushes.
    fn hold(&mut self, pushing: &Contact, strength: f32) {
        let parts = pushing.parts();
        for contact in &mut self.contacts {
            if contact.near.segment == pushing.near.segment && !contact.parts().is_disjoint(&parts) {
                contact.held = true;
                contact.pushed += strength;
            }
        }
    }
}

/// Takes back what contacts were pushed too far: a later pass for one contact may have carried another off its obstacle.
fn close_gaps(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
    report: &mut CancelReport,
) {
    let (tolerance, close) = (settings.depth_tolerance * size, WORTH_CLOSING * settings.gap_tolerance * size);
    let softness = settings.softness.unwrap_or(body.rig().softness).clamp(LEAST_SOFTNESS, MOST_SOFTNESS);
    for _ in 0..CLOSING_PASSES {
        let watched: Vec<(Contact, f32)> =
            report.contacts.iter().filter_map(|contact| contact.watched(body, parts)).collect();
        let pulled = watched.iter().filter(|(contact, gap)| *gap > close && contact.pushed > 0.0);
        let widest = pulled.map(|(_, gap)| *gap).fold(0.0, f32::max);
        if widest <= 0.0 {
            return;
        }
        let mut all: Vec<Contact> = watched.into_iter().map(|(contact, _)| contact).collect();
        let guards = find_guards(body, parts, near, &all, (2.0 * widest).min(GUARD_HEIGHT * size));
        add_guards(body, parts, guards, &mut all);
        let least: Vec<f32> = all.iter().map(|contact| -contact.pushed).collect();
        let (pass, strengths) = solve_pass(body, (parts, near), &all, &least, softness, size, settings);
        let (before, passes) = (body.positions().to_vec(), body.palette().passes.len());
        body.deform_collision(pass);
        let mut taken = 1;
        let mut inside = left_over(body, parts, near, tolerance);
        if !inside.is_empty() {
            // What sank in a little between the points that were watched comes out again.
            let guards = find_guards(body, parts, near, &inside, widest);
            add_guards(body, parts, guards, &mut inside);
            let least = vec![0.0; inside.len()];
            let (pass, _) = solve_pass(body, (parts, near), &inside, &least, softness, size, settings);
            body.deform_collision(pass);
            taken = 2;
            inside = left_over(body, parts, near, tolerance);
        }
        let gap = |contact: &Contact| contact.watched(body, parts).map_or(0.0, |(_, gap)| gap);
        let left = report.contacts.iter().filter(|contact| contact.pushed > 0.0).map(gap).fold(0.0, f32::max);
        if !inside.is_empty() || left >= widest {
            body.restore(&before, passes);
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

/// All that is inside: vertices and pierced triangles.
fn left_over(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], tolerance: f32) -> Vec<Contact> {
    let mut contacts = find_contacts(body, parts, near, tolerance);
    add_piercings(body, parts, find_piercings(body, parts, near, tolerance), &mut contacts);
    contacts
}

/// Gaps are closed from this many tolerances on.
const WORTH_CLOSING: f32 = 2.0;

/// Most passes that close gaps.
const CLOSING_PASSES: u32 = 2;

/// The best state so far.
struct Best {
    worst: f32,
    positions: Vec<Vec3>,
    passes: u32,
}

/// Passes that may go by without any gain.
const PATIENCE: u32 = 2;

/// One pass with the paper's placement.
fn literal(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let contacts = find_contacts(body, parts, near, settings.depth_tolerance * size);
    if contacts.is_empty() {
        return CancelReport::default();
    }
    let pass = super::literal::place(body, parts, near, settings.softness.unwrap_or(body.rig().softness));
    body.deform_collision(pass);
    let contacts = contacts.into_iter().map(|contact| Contact { held: true, ..contact }).collect();
    CancelReport { contacts, passes: 1, left: 0.0 }
}

/// Softness outside of these bounds is taken as the bound.
const LEAST_SOFTNESS: f32 = 0.05;
const MOST_SOFTNESS: f32 = 10.0;

/// Parts within this part of the size are guarded while others push.
const GUARD_HEIGHT: f32 = 0.15;

/// Depths below this part of the size are small: then triangles are looked at too, and the shortest way out is the best.
const SMALL: f32 = 0.04;

/// Passes with fields of full width.
const WIDE_PASSES: u32 = 2;
