//! Many passes at once.
//!
//! Passes come one after the other since each shows only then what is left over. Once that is known, the fields of all push in one pass, and what that
//! leaves over takes one or two more. Only where that leads to a shape that is alike: else the shape would depend on how many passes it takes.

use super::attempt::{Begun, attempt};
use super::cancel::{CancelReport, CancelSettings};
use super::cancel_memory::CancelMemory;
use super::coherence::{displacements, largest_change};
use super::contact::Proximity;
use super::find_contacts::find_contacts;
use super::grade::{Grade, MANY};
use super::obstacle::ObstaclePart;
use super::strength::{Way, certify};
use super::ways::{known_way, way_of};
use crate::elastic::{CollisionPass, CollisionState, ElasticBody, SegmentField};
use crate::math::Vec3;

/// Lets these fields push in one pass, and goes on from there; `report` has the contacts before them.
pub(super) fn in_one_pass(
    fields: Vec<SegmentField>,
    report: CancelReport,
    body: &mut ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    way: Way,
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let mut pass = CollisionPass { fields, steps: 1 };
    certify(&mut pass, body, settings);
    body.deform_collision(pass);
    let report = CancelReport { passes: 1, ..report };
    attempt(body, parts, near, way, size, settings, Begun::Continued(report))
}

/// The passes that have led from `start` to `end`, which is what `report` tells, as one, and what that leaves over; from the skin at `start`, which is the
/// body's. None where the shape is another.
pub(super) fn at_once(
    body: &mut ElasticBody,
    [start, end]: [&CollisionState; 2],
    report: &CancelReport,
    around: (&[ObstaclePart], &[Proximity]),
    size: f32,
    settings: &CancelSettings,
) -> Option<CancelReport> {
    let passes = &end.passes()[start.passes().len()..];
    let fields = passes.iter().flat_map(|pass| pass.fields.iter().cloned()).collect();
    let way = way_of(report.way, body, settings);
    let report = in_one_pass(fields, report.clone(), body, around, way, size, settings);
    let near = |(a, b): (&Vec3, &Vec3)| a.distance(*b) < ALIKE * size;
    body.positions().iter().zip(end.positions()).all(near).then_some(report)
}

/// The passes of the step before as one, and what that leaves over. None, with the skin as it was, where they were not many or a contact that they were for
/// has ended, or where that is not good, still takes many, or leads to another shape.
pub(super) fn with_fewer_passes(
    memory: &CancelMemory,
    body: &mut ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    size: f32,
    settings: &CancelSettings,
) -> Option<CancelReport> {
    if memory.passes.len() as u32 <= MANY || !memory.may_continue(body, settings) {
        return None;
    }
    let mut contacts = find_contacts(body, parts, near, settings.depth_tolerance * size);
    if !memory.recognise(&mut contacts, parts) {
        return None;
    }
    let start = body.collision_state();
    let fields = memory.carried_fields(1.0, body, parts);
    if fields.is_empty() {
        return None;
    }
    let way = way_of(memory.way, body, settings);
    let report = CancelReport { way: known_way(memory.way), contacts, ..CancelReport::default() };
    let report = in_one_pass(fields, report, body, (parts, near), way, size, settings);
    let pop = memory.pop(body, start.positions(), parts, &report.contacts, size, settings);
    let grade = Grade::of(&report, pop, body, &start, size, settings);
    let (_, change) = largest_change(&memory.moved, &displacements(body, start.positions()));
    if grade.is_good() && grade.passes <= MANY && change < ALIKE * size {
        return Some(report);
    }
    body.resume(&start);
    None
}

/// All vertices of shapes that are alike are nearer to each other than this part of the size. From 0.3 on the shapes in `corners` go back and forth
/// between the two, and pop.
const ALIKE: f32 = 0.15;
