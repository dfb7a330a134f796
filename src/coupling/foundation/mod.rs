//! Elastic foundation: the repelling impulse in proportion to the depth of penetration (section 6.3).
//!
//! Points of skin that have gone into something are springs and dampers with Coulomb friction. Each step asks them for
//! impulses that act in rapier's next step, equal and opposite on the two bodies of a point. All points of bodies that touch
//! each other are solved together; only the change of velocity is written to rapier.
//!
//! - [`ContactMaterial`]: what flesh is like, and two of them against each other;
//! - `sampled_spring`: a spring that keeps its frequency and its energy although it acts once a step;
//! - [`skin_contacts`], [`pair_contacts`]: contacts from penetrating points;
//! - [`Approach`], `rebound`: how fast a contact closed, and how fast it may open: restitution;
//! - `solve`, `islands`: the implicit solve, island by island;
//! - `reactions`: what rapier answers: bodies that stand on something, or carry something;
//! - `sleepers`: what rapier has put to sleep stays asleep while its load stays the same.

mod approach;
mod build;
mod islands;
mod material;
mod reactions;
mod rebound;
mod sampled_spring;
mod share;
mod sleepers;
mod solve;
mod velocities;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use super::ragdoll::Ragdoll;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

pub use approach::{Approach, PairApproaches, remember_pair_contacts, remember_skin_contacts};
pub use build::{ContactKeys, PairPoint, pair_contacts, skin_contacts};
pub use islands::push_back;
pub use material::ContactMaterial;
pub use velocities::StepSize;

/// A point of skin inside something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundationPoint {
    /// The rigid body that is pushed along the normal.
    pub body: RigidBodyHandle,
    /// The rigid body that gets the opposite impulse: an obstacle's, if it has one, or that of a segment of an elastic body.
    pub other: Option<RigidBodyHandle>,
    /// Where the point is.
    pub position: Vec3,
    /// Unit direction in which `body` is pushed.
    pub normal: Vec3,
    /// Depth along the normal, in metres, positive.
    pub depth: f32,
    /// Coulomb friction coefficient.
    pub friction: f32,
}

/// An elastic body at a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticSide {
    /// Index and generation of the elastic body: its stiffness is shared among all its contacts.
    pub owner: (u32, u32),
    /// The flesh of the whole body.
    pub material: ContactMaterial,
}

impl ElasticSide {
    /// An elastic body as all its contacts see it; `factor` multiplies its stiffness.
    pub fn of(owner: (u32, u32), body: &ElasticBody, ragdoll: &Ragdoll, factor: f32, bodies: &RigidBodySet) -> Self {
        let mass: f32 = ragdoll.bodies.iter().filter_map(|&handle| bodies.get(handle)).map(|body| body.mass()).sum();
        // A body without a mass cannot be pushed; its contacts still divide by it.
        let mass = if mass > 0.0 { mass } else { 1.0 };
        Self { owner, material: ContactMaterial::new(&body.rig().contact, mass, factor) }
    }
}

/// Points of one segment that are pushed nearly the same way: they are loaded, and released, together.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundationContact {
    /// The points; at least one. All have the same `body`.
    pub points: Vec<FoundationPoint>,
    /// What yields: the elastic body of the points' `body`, and that of their `other` if it is elastic too.
    pub sides: [Option<ElasticSide>; 2],
    /// The speed at which the contact began to close, in m/s: see [`Approach`].
    pub approach: f32,
}

impl FoundationContact {
    /// Depth of the deepest point.
    pub fn depth(&self) -> f32 {
        self.points.iter().map(|point| point.depth).fold(0.0, f32::max)
    }

    /// Mean depth, weighted as the force is: what the spring is loaded with.
    pub fn mean_depth(&self) -> f32 {
        self.weights().map(|(point, weight)| point.depth * weight).sum()
    }

    /// The part of the contact's force that each point carries: as the square of its depth, so that nothing jumps when
    /// points come and go. The sum is 1.
    pub fn weights(&self) -> impl Iterator<Item = (&FoundationPoint, f32)> {
        let sum = self.square_depth();
        self.points.iter().map(move |point| (point, point.depth * point.depth / sum))
    }

    /// Sum of the squares of the depths.
    pub fn square_depth(&self) -> f32 {
        self.points.iter().map(|point| point.depth * point.depth).sum::<f32>().max(f32::MIN_POSITIVE)
    }

    /// The mean direction.
    pub fn normal(&self) -> Vec3 {
        self.weights().map(|(point, weight)| point.normal * weight).sum::<Vec3>().normalize_or_zero()
    }
}

/// What the foundation remembers from step to step.
#[derive(Clone, Debug, Default)]
pub struct FoundationMemory {
    sleepers: sleepers::Sleepers,
    reactions: reactions::Reactions,
}

/// How thoroughly the foundation is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoundationSettings {
    /// Gauss-Seidel sweeps a step.
    pub sweeps: u32,
}

impl Default for FoundationSettings {
    fn default() -> Self {
        Self { sweeps: 10 }
    }
}
