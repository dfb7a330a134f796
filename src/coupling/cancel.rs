//! Penetration cancellation: the skin is pushed out until it touches (section 4), in the first of several ways that leaves
//! nothing over.

use super::at_once::with_fewer_passes;
use super::cancel_memory::CancelMemory;
use super::contact::Proximity;
use super::find_contacts::find_contacts;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, SAME_WAY};
use super::ways::best_of_ways;
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
    /// Most integration steps of a pass; where the bound asks for more, all its fields are weakened and the next pass goes on.
    pub max_steps: u32,
    /// Where the fields are placed.
    pub placement: Placement,
    /// Which of the ways is tried first: 0, or the one that the last report on this body names, so that a body does not change
    /// its way from step to step.
    pub first_way: usize,
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
            first_way: 0,
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
    /// Widest gap in metres that is left between a contact's parts and the skin in that place; as the vertices tell it where it is small.
    pub gap: f32,
    /// Which way was taken.
    pub way: usize,
}

/// Cancels the penetration of `body` into `parts`: adds passes to its palette and carries its skin along.
///
/// A body that is pinned, without room for its volume, may get worse by further passes: the best state is kept, and what
/// is left is reported. Where the usual way leaves something over, others are tried from the start, and the best of all
/// counts. `size` is the body's size, the unit of the tolerances.
pub fn cancel(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    if settings.placement == Placement::Literal {
        return literal(body, parts, near, size, settings);
    }
    best_of_ways(&CancelMemory::default(), None, body, (parts, near), size, settings)
}

/// As [`cancel`], but where hardly anything has moved since the step before, with the passes of that step. Where these were more than
/// four, they are first tried all at once, carried along with their parts, whatever has moved.
///
/// A body that lies still does not change its shape because the solve came out another way. `memory` is the body's own; after
/// the step it is to be told what was done, by [`CancelMemory::remember`].
pub fn cancel_with_memory(
    memory: &CancelMemory,
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    if settings.placement == Placement::Literal {
        return literal(body, parts, near, size, settings);
    }
    if let Some(report) = with_fewer_passes(memory, body, (parts, near), size, settings) {
        return report;
    }
    let start = body.collision_state();
    if let Some(report) = memory.again(body, parts, near, size, settings) {
        return report;
    }
    body.resume(&start);
    let settings = CancelSettings { first_way: memory.way, ..*settings };
    best_of_ways(memory, None, body, (parts, near), size, &settings)
}

/// As [`cancel_with_memory`], for what the cancellation of other skins has made of this one since it was cancelled itself: `earlier` is the
/// skin before any cancellation of this step, and what was done. What was pushed before is kept where it touches; the report replaces the earlier one, but
/// its passes are those that came to it.
pub fn cancel_further(
    memory: &CancelMemory,
    earlier: (&[Vec3], &CancelReport),
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    if settings.placement == Placement::Literal {
        return literal(body, parts, near, size, settings);
    }
    let settings = CancelSettings { first_way: earlier.1.way, ..*settings };
    best_of_ways(memory, Some(earlier), body, (parts, near), size, &settings)
}

/// The softness of the collision fields, within its bounds.
pub(super) fn softness_of(body: &ElasticBody, settings: &CancelSettings) -> f32 {
    settings.softness.unwrap_or(body.rig().softness).clamp(LEAST_SOFTNESS, MOST_SOFTNESS)
}

impl CancelReport {
    /// Notes that the field of a contact pushes: of the contacts before the first pass, those of the same segment, with a part of
    /// this one's, that lead out nearly the same way.
    pub(super) fn hold(&mut self, pushing: &Contact, strength: f32) {
        let parts = pushing.parts();
        for contact in &mut self.contacts {
            let along = contact.near.normal.dot(pushing.near.normal) > SAME_WAY;
            if along && contact.near.segment == pushing.near.segment && !contact.parts().is_disjoint(&parts) {
                contact.held = true;
                contact.pushed += strength;
            }
        }
    }
}

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
    CancelReport { contacts, passes: 1, ..CancelReport::default() }
}

/// Softness outside of these bounds is taken as the bound.
const LEAST_SOFTNESS: f32 = 0.05;
const MOST_SOFTNESS: f32 = 10.0;

/// From this many tolerances on what is left over is worth another way, and gaps are worth closing.
pub(super) const WORTH_CLOSING: f32 = 2.2;
