//! Restitution: how fast a contact may open.
//!
//! A contact that closed at the speed `a` lets go at `e a`. Its damping alone would not see to that: gravity pulls
//! while it opens, and a soft spring under a heavy body would never let go. So the damping takes energy only as long as more is
//! left than the contact has to give back. Contacts begin and end between two steps, and what the spring makes of
//! the first and the last depth is a little too much or too little: the opening speed is limited in every step, and in the
//! one in which the contact ends it is set. Together this is Newton's law of impact, spread over the time that the
//! spring takes.

use rapier3d::dynamics::RigidBodySet;

use super::approach::{Pull, closing};
use super::sampled_spring::SampledSpring;
use super::{ContactMaterial, FoundationContact, StepSize};

/// How fast a contact may open in the next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Largest mean speed over the step, in m/s.
    pub limit: f32,
    /// True where the contact is to let go at that speed.
    pub bounces: bool,
    /// Spring and damper for this step.
    pub spring: SampledSpring,
}

impl Rebound {
    /// The rebound of a contact. `drift` is the part of a step's gravity that the mean speed has.
    pub fn new(
        contact: &FoundationContact,
        material: &ContactMaterial,
        step: &StepSize,
        drift: f32,
        bodies: &RigidBodySet,
    ) -> Self {
        let pull = Pull::of(contact, step.gravity, bodies);
        let bounces = contact.approach > RESTING * pull.largest * step.dt;
        let leaving = if bounces { material.restitution * contact.approach } else { 0.0 };
        let depth = contact.depth();
        // Squares of speeds stand for energies: what it must have now, to be that fast at the surface.
        let needed = (leaving * leaving + 2.0 * pull.relative * depth).max(0.0);
        let bounces = leaving > 0.0;
        let mut damped = *material;
        if bounces {
            let undamped = ContactMaterial { damping_ratio: 0.0, ..*material }.sampled(step.dt);
            let load = contact.mean_depth();
            let push = undamped.push / material.mass * load;
            // Impulses come in steps: half of the one that is due belongs to the velocity at this moment.
            let opening = 0.5 * push - closing(contact, bodies);
            let surplus = opening * opening + push * load / step.dt - needed;
            let fully = material.sampled(step.dt);
            // What full damping would take: v² before, and after the drag.
            let left = 1.0 / (1.0 + fully.drag / material.mass);
            let taken = opening * opening * (1.0 - left * left);
            damped.damping_ratio *= if taken > 0.0 { (surplus / taken).clamp(0.0, 1.0) } else { 1.0 };
        } else {
            damped.damping_ratio = damped.damping_ratio.max(RESTING_DAMPING);
        }
        let limit = needed.sqrt() - drift * pull.relative * step.dt;
        let limit = limit.max(depth * RECOVERY.min(0.5 / step.dt));
        Self { limit, bounces, spring: damped.sampled(step.dt) }
    }
}

/// What closes no faster than so many steps of gravity make it, comes to rest instead of bouncing.
const RESTING: f32 = 2.5;

/// Least damping ratio of what does not bounce: it comes to rest before long.
const RESTING_DAMPING: f32 = 0.3;

/// Rate, in 1/s, at which a body that appeared inside an obstacle is let out: it is not shot out.
const RECOVERY: f32 = 6.0;

/// The spring's own opening speed is raised by at most this factor where a contact ends: what it lacks because the contact
/// began and ended between two steps, and no more. Where the speed went elsewhere, it is gone.
pub const BOOST: f32 = 1.5;
