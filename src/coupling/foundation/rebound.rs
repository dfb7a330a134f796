//! Restitution: how fast a contact may open.
//!
//! A contact that closed at the speed `a` lets go at `e a`. The sampled spring alone comes near it: contacts begin and end
//! between two steps, and what it makes of the first and the last depth is too much or too little. So the opening speed is
//! limited in every step, and in the step in which the contact ends it is set: Newton's law of impact, spread over
//! the time that the spring takes.

use rapier3d::dynamics::RigidBodySet;

use super::approach::Pull;
use super::{FoundationContact, StepSize};

/// How fast a contact may open in the next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Largest mean speed over the step, in m/s.
    pub limit: f32,
    /// True where the contact is to let go at that speed.
    pub bounces: bool,
}

impl Rebound {
    /// The rebound of a contact with the given restitution. `drift` is the part of a step's gravity that the mean speed has.
    pub fn new(
        contact: &FoundationContact,
        restitution: f32,
        step: &StepSize,
        drift: f32,
        bodies: &RigidBodySet,
    ) -> Self {
        let pull = Pull::of(contact, step.gravity, bodies);
        let bounces = contact.approach > RESTING * pull.largest * step.dt;
        let leaving = if bounces { restitution * contact.approach } else { 0.0 };
        let depth = contact.depth();
        // As fast as it must be now, to be that fast at the surface.
        let now = (leaving * leaving + 2.0 * pull.relative * depth).max(0.0).sqrt() - drift * pull.relative * step.dt;
        Self { limit: now.max(depth * RECOVERY.min(0.5 / step.dt)), bounces: leaving > 0.0 }
    }
}

/// What closes no faster than so many steps of gravity make it, comes to rest instead of bouncing.
const RESTING: f32 = 2.5;

/// Rate, in 1/s, at which a body that appeared inside an obstacle is let out: it is not shot out.
const RECOVERY: f32 = 6.0;

/// The spring's own opening speed is raised by at most this factor where a contact ends: what it lacks because the contact
/// began and ended between two steps, and no more. Where the speed went elsewhere, it is gone.
pub const BOOST: f32 = 1.5;
