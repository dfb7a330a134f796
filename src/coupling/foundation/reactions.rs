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
    /// The same of a turning impulse.
    pub held_turn: f32,
    /// The part of gravity that is taken back, from 0 to 1.
    pub carried: f32,
}

/// A body that is held altogether still gives way a little in the guess.
pub const MOST_HELD: f32 = 0.95;

/// What was done to a body in the last step.
#[derive(Clone, Copy, Debug)]
struct Action {
    written: [Vec3; 2],
    given: [Vec3; 2],
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
            let [linear, angular] = action.given;
            let reaction = body.linvel() - action.written[0] - gravity;
            let held = part_held(reaction, linear, LEAST);
            let held_turn = part_held(body.angvel() - action.written[1], angular, LEAST_TURN);
            let carried = -(reaction + linear * held).dot(gravity) / gravity.length_squared().max(f32::MIN_POSITIVE);
            let carried = if carried.is_finite() { carried.clamp(0.0, 1.0) } else { 0.0 };
            let before = action.support;
            Some(Support {
                held: lerp(before.held, held),
                held_turn: lerp(before.held_turn, held_turn),
                carried: lerp(before.carried, carried),
            })
        };
        bodies.get(handle).and_then(known).unwrap_or_default()
    }

    /// Notes what the bodies of this step were given.
    pub(super) fn note<'a>(&mut self, given: impl Iterator<Item = &'a BodyVelocity>) {
        let action = |body: &BodyVelocity| {
            let action = Action { written: body.written(), given: body.given(), support: body.support };
            (body.handle, action)
        };
        self.actions = given.filter(|body| body.is_movable()).map(action).collect();
    }
}

/// The part of a given change of velocity that a reaction takes back; changes below `least` tell nothing.
fn part_held(reaction: Vec3, given: Vec3, least: f32) -> f32 {
    let square = given.length_squared();
    if !reaction.is_finite() || square < least * least {
        return 0.0;
    }
    (-reaction.dot(given) / square).clamp(0.0, MOST_HELD)
}

/// In m/s.
const LEAST: f32 = 0.01;
/// In rad/s.
const LEAST_TURN: f32 = 0.02;

fn lerp(before: f32, now: f32) -> f32 {
    before + (now - before) * LEARNING
}

/// How fast the guess follows: rapier's answer to a single step is noisy.
const LEARNING: f32 = 0.2;
