//! What rapier answers to the foundation's impulses.
//!
//! The solve knows nothing of rapier's own contacts and joints. A crate on a rigid floor does not give way to a push, though
//! its mass says so; the lowest crate of a stack carries the others. Both show in the step after: `c` is the change of velocity
//! that a body was given, `r` what rapier added to it beyond gravity. The part `held = −r·c / |c|²` of the impulse was
//! taken back: such a body counts as heavier by `1 / (1 − held)`. What then is left of `r` and works against gravity
//! carries the body.
//!
//! This only improves the guess of how bodies will move, which dampers and friction go by; impulses stay equal and
//! opposite whatever the guess.

use std::collections::HashMap;

use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet};

use super::StepSize;
use super::velocities::BodyVelocity;
use crate::math::Vec3;

/// How a body is supported by rapier's contacts and joints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// The part of an impulse that is taken back, from 0 to [`MOST_HELD`].
    pub held: f32,
    /// The part of gravity that is taken back, from 0 to 1.
    pub carried: f32,
}

/// A body that is held altogether still gives way a little in the guess.
pub const MOST_HELD: f32 = 0.95;

/// What was done to a body in the last step.
#[derive(Clone, Copy, Debug)]
struct Action {
    written: Vec3,
    change: Vec3,
    support: Support,
}

/// The actions of the last step, by body.
#[derive(Clone, Debug, Default)]
pub struct Reactions {
    actions: HashMap<RigidBodyHandle, Action>,
}

impl Reactions {
    /// The support of a body, as far as its last step tells.
    pub(super) fn support(&self, handle: RigidBodyHandle, step: &StepSize, bodies: &RigidBodySet) -> Support {
        let known = |body: &RigidBody| {
            let action = self.actions.get(&handle)?;
            let gravity = step.gravity * (body.gravity_scale() * step.dt);
            let reaction = body.linvel() - action.written - gravity;
            let square = action.change.length_squared();
            if !reaction.is_finite() || square < LEAST * LEAST {
                return Some(Support::default());
            }
            let held = (-reaction.dot(action.change) / square).clamp(0.0, MOST_HELD);
            let rest = reaction + action.change * held;
            let carried = -rest.dot(gravity) / gravity.length_squared().max(f32::MIN_POSITIVE);
            Some(Support {
                held: 0.5 * (held + action.support.held),
                carried: 0.5 * (carried.clamp(0.0, 1.0) + action.support.carried),
            })
        };
        bodies.get(handle).and_then(known).unwrap_or_default()
    }

    /// Notes what the bodies of this step were given.
    pub(super) fn note<'a>(&mut self, given: impl Iterator<Item = &'a BodyVelocity>) {
        let action = |body: &BodyVelocity| {
            let action = Action { written: body.written(), change: body.given(), support: body.support };
            (body.handle, action)
        };
        self.actions = given.filter(|body| body.is_movable()).map(action).collect();
    }
}

/// Changes of velocity below this, in m/s, tell nothing.
const LEAST: f32 = 0.01;
