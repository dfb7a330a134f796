//! Sleep: rapier puts bodies to sleep one by one, and knows nothing of the foundation that carries them.
//!
//! A sleeping body is held, as a fixed one is, while the load on it stays what it was when it fell asleep: so a stack on an
//! elastic body comes to rest although its members fall asleep at different times. A load that changes, or is gone, wakes it.

use std::collections::BTreeMap;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use super::sampled_spring::SampledSpring;
use super::{FoundationContact, StepSize};
use crate::math::Vec3;

/// What a body does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rest {
    /// It is asleep.
    Asleep,
    /// It cannot move by itself and does not move.
    Still,
    /// It moves, or may.
    Moves,
}

impl Rest {
    pub(super) fn of(handle: RigidBodyHandle, bodies: &RigidBodySet) -> Self {
        match bodies.get(handle) {
            None => Self::Still,
            Some(body) if body.is_dynamic() && body.is_sleeping() => Self::Asleep,
            Some(body) if body.is_dynamic() || body.is_moving() => Self::Moves,
            Some(_) => Self::Still,
        }
    }
}

/// The loads on all bodies in contact, from step to step.
#[derive(Clone, Debug, Default)]
pub struct Sleepers {
    /// Impulse of the springs on each body in its last waking step, in N s.
    loads: BTreeMap<(u32, u32), Vec3>,
}

impl Sleepers {
    /// Wakes the sleepers whose load has changed, and those that something runs into.
    pub(super) fn wake(
        &mut self,
        contacts: &[FoundationContact],
        springs: &[SampledSpring],
        step: &StepSize,
        bodies: &mut RigidBodySet,
    ) {
        let mut loads: BTreeMap<(u32, u32), Vec3> = BTreeMap::new();
        let mut disturbed: Vec<RigidBodyHandle> = Vec::new();
        for (contact, spring) in contacts.iter().zip(springs) {
            let push = spring.push * contact.mean_depth();
            for (point, weight) in contact.weights() {
                let impulse = point.normal * (push * weight);
                *loads.entry(point.body.into_raw_parts()).or_default() += impulse;
                if let Some(other) = point.other {
                    *loads.entry(other.into_raw_parts()).or_default() -= impulse;
                }
                if runs_in(point, bodies) {
                    disturbed.extend([Some(point.body), point.other].into_iter().flatten());
                }
            }
        }
        for handle in disturbed {
            wake(handle, bodies);
        }
        for (&raw, &before) in &self.loads {
            let handle = RigidBodyHandle::from_raw_parts(raw.0, raw.1);
            let Some(body) = bodies.get(handle).filter(|body| body.is_dynamic() && body.is_sleeping()) else {
                continue;
            };
            let now = loads.get(&raw).copied().unwrap_or_default();
            let least = body.mass() * (TREMOR + NOTICED * step.gravity.length() * step.dt);
            if now.distance(before) > least + NOTICED * before.length() {
                wake(handle, bodies);
            } else {
                loads.insert(raw, before);
            }
        }
        self.loads = loads;
    }
}

fn wake(handle: RigidBodyHandle, bodies: &mut RigidBodySet) {
    // Looked at first: whoever asks for a body mutably marks it as changed.
    if bodies.get(handle).is_some_and(|body| body.is_dynamic() && body.is_sleeping())
        && let Some(body) = bodies.get_mut(handle)
    {
        body.wake_up(true);
    }
}

/// True where a moving obstacle of the user's, or a body faster than what falls asleep, is at a sleeper.
fn runs_in(point: &super::FoundationPoint, bodies: &RigidBodySet) -> bool {
    let pair = [Some(point.body), point.other];
    if !pair.iter().flatten().any(|&handle| Rest::of(handle, bodies) == Rest::Asleep) {
        return false;
    }
    pair.into_iter().flatten().filter_map(|handle| bodies.get(handle)).any(|body| {
        let speed = body.velocity_at_point(point.position).length();
        if body.is_dynamic() { speed > ROUSING } else { speed > 0.0 }
    })
}

/// Speed in m/s that wakes: above what a resting body reads between two steps of gravity.
const ROUSING: f32 = 0.5;
/// The part of a load that may change unnoticed.
const NOTICED: f32 = 0.2;
/// Change of velocity, in m/s, that goes unnoticed without gravity.
const TREMOR: f32 = 0.005;
