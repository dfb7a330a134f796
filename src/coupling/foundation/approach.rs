//! How fast contacts close, and the memory of it.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use super::build::ContactKeys;
use super::{ElasticSide, FoundationContact, FoundationPoint, StepSize};
use crate::coupling::obstacle::PartId;
use crate::coupling::surroundings::ContactMemories;
use crate::math::Vec3;

/// The speed at which a contact began to close, remembered while it lasts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Approach {
    /// Speed in m/s: what gravity has added inside the contact is taken off.
    pub speed: f32,
    /// Seconds since it was measured.
    pub age: f32,
}

impl Approach {
    /// Takes this step's speed into account; what is older than `period` seconds is forgotten.
    pub fn remember(&mut self, speed: f32, dt: f32, period: f32) {
        self.age += dt;
        if speed >= self.speed || self.age > period {
            *self = Self { speed, age: 0.0 };
        }
    }

    /// The faster of two.
    fn faster(self, other: Self) -> Self {
        if other.speed > self.speed { other } else { self }
    }

    /// The speed at which a contact closes now, as if no gravity had acted since the surfaces met:
    /// `a² = v² − 2 g d`.
    pub fn speed_now(contact: &FoundationContact, gravity: Vec3, bodies: &RigidBodySet) -> f32 {
        let closing = closing(contact, bodies);
        if closing <= 0.0 {
            return 0.0;
        }
        let pull = Pull::of(contact, gravity, bodies).relative;
        (closing * closing - 2.0 * pull * contact.depth()).max(0.0).sqrt()
    }
}

/// The speed at which the contact closes at its centre: there a rolling body neither closes nor opens it.
pub(super) fn closing(contact: &FoundationContact, bodies: &RigidBodySet) -> f32 {
    let velocity = |handle: RigidBodyHandle, x| bodies.get(handle).map_or(Vec3::ZERO, |body| body.velocity_at_point(x));
    let speed = |(point, weight): (&FoundationPoint, f32)| {
        let other = point.other.map_or(Vec3::ZERO, |other| velocity(other, point.position));
        -weight * (velocity(point.body, point.position) - other).dot(point.normal)
    };
    contact.weights().map(speed).sum()
}

/// Gravity along a contact's normal.
pub(super) struct Pull {
    /// How it closes the contact, in m/s².
    pub relative: f32,
    /// The larger of the two bodies' own.
    pub largest: f32,
}

impl Pull {
    pub fn of(contact: &FoundationContact, gravity: Vec3, bodies: &RigidBodySet) -> Self {
        let along = |handle: Option<RigidBodyHandle>, normal: Vec3| {
            let body = handle.and_then(|handle| bodies.get(handle)).filter(|body| body.is_dynamic());
            body.map_or(0.0, |body| -body.gravity_scale() * gravity.dot(normal))
        };
        let mut pull = Self { relative: 0.0, largest: 0.0 };
        for (point, weight) in contact.weights() {
            let (own, other) = (along(Some(point.body), point.normal), along(point.other, point.normal));
            pull.relative += weight * (own - other);
            pull.largest = pull.largest.max(own.abs()).max(other.abs());
        }
        pull
    }
}

/// Tells a body's contacts with obstacles how fast they closed, and remembers it with each segment and part.
pub fn remember_skin_contacts(
    contacts: Vec<(FoundationContact, ContactKeys)>,
    memories: &mut ContactMemories,
    step: &StepSize,
    bodies: &RigidBodySet,
) -> Vec<FoundationContact> {
    let touching: BTreeSet<(u16, PartId)> = contacts.iter().flat_map(|(_, keys)| keys).copied().collect();
    for (_, memory) in memories.iter_mut().filter(|(key, _)| !touching.contains(key)) {
        // The contact is over: the next one begins anew, however soon.
        memory.approach = Approach::default();
    }
    let remember = |(mut contact, keys): (FoundationContact, ContactKeys)| {
        let now = Approach::speed_now(&contact, step.gravity, bodies);
        let period = period(&contact, step.dt);
        contact.approach = now;
        for key in keys {
            if let Some(memory) = memories.get_mut(&key) {
                memory.approach.remember(now, step.dt, period);
                contact.approach = contact.approach.max(memory.approach.speed);
            }
        }
        contact
    };
    contacts.into_iter().map(remember).collect()
}

/// Memory of the contacts between elastic bodies, by the rigid bodies of their segments.
pub type PairApproaches = BTreeMap<[(u32, u32); 2], Approach>;

/// Tells the contacts between elastic bodies how fast they closed, and renews their memory. To be called once a step with
/// all of them.
pub fn remember_pair_contacts(
    contacts: &mut [FoundationContact],
    approaches: &mut PairApproaches,
    step: &StepSize,
    bodies: &RigidBodySet,
) {
    let mut renewed = PairApproaches::new();
    for contact in contacts {
        let Some(FoundationPoint { body, other: Some(other), .. }) = contact.points.first() else { continue };
        let key = [body.into_raw_parts(), other.into_raw_parts()];
        let mut approach = approaches.get(&key).copied().unwrap_or_default();
        approach.remember(Approach::speed_now(contact, step.gravity, bodies), step.dt, period(contact, step.dt));
        contact.approach = approach.speed;
        renewed.entry(key).and_modify(|known| *known = known.faster(approach)).or_insert(approach);
    }
    *approaches = renewed;
}

/// How long an approach is remembered, in seconds: a period of the softest side, or a few steps.
fn period(contact: &FoundationContact, dt: f32) -> f32 {
    let period = |side: &ElasticSide| 1.0 / side.material.natural_frequency();
    contact.sides.iter().flatten().map(period).fold(LEAST_STEPS * dt, f32::max)
}

/// The stiffest spring's period in steps: see [`super::sampled_spring::STIFFEST`].
const LEAST_STEPS: f32 = 6.0;
