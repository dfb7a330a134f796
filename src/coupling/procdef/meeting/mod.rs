//! Contacts of vertices and edges, found and solved here instead of in rapier.
//!
//! Rapier's contacts of deformable surfaces are general and dear: a heap of a hundred worms spends 95 % of its step in them. Here
//! vertices meet the triangles of other bodies, edges the edges, and vertices rigid colliders, small ones also the points between
//! vertices, once a step: no substeps, no warm starts.
//!
//! The velocities that bodies want to go on with are changed so that rapier's next step, which moves the particles, ends without
//! overlaps: sequential impulses (Catto, *Iterative Dynamics with Temporal Coherence*, 2005) between vertices and
//! rigid bodies. What they leave undone is held back ([`hold`]): bodies that are apart stay apart. Rapier keeps everything else.

mod boxes;
mod detect;
mod edges;
mod encounters;
mod frames;
mod hold;
mod lanes;
mod near;
mod rigid;
mod solve;
mod surface;
mod tangles;
mod triangles;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier3d::geometry::{ColliderSet, InteractionGroups};
use rapier3d::pipeline::QueryPipeline;

use super::{GroundContact, GroundDirections};
use crate::coupling::PartCache;
use crate::math::Vec3;
use crate::procdef::ProcDefBody;

use encounters::Encounters;
use rigid::{Copies, Surroundings};
pub use rigid::{Refused, RigidCopy};
use solve::solve;
pub use surface::ContactSurface;
pub use tangles::KnownApart;

/// Each body keeps this part of a boundary edge free around itself, as rapier's contact skin does.
pub const SKIN: f32 = 0.1;

/// The directed friction of a body on fixed ground.
#[derive(Clone, Copy, Debug)]
pub struct GroundFriction<'a> {
    /// The directions and coefficients.
    pub directions: &'a GroundDirections,
    /// Whether ahead and back change places.
    pub turned: bool,
}

/// A body that meets others.
pub struct MeetingBody<'a> {
    /// What it is called from step to step, as by its handle: different for each.
    pub name: (u32, u32),
    /// Positions now, and the velocities that it wants to go on with, which are changed.
    pub body: &'a mut ProcDefBody,
    /// Its boundary.
    pub surface: &'a ContactSurface,
    /// What it collides with.
    pub groups: InteractionGroups,
    /// Coulomb coefficient.
    pub friction: f32,
    /// Directed friction on fixed ground.
    pub ground: Option<GroundFriction<'a>>,
    /// Rigid bodies that it is attached to: they do not touch.
    pub attached: &'a [RigidBodyHandle],
    /// Whether fixed bodies pushed it in the last step.
    pub stood: bool,
    /// Whether its contacts are made here; else by rapier, but for those with bodies whose contacts are made here.
    pub own_contacts: bool,
}

/// What meeting did to a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meeting {
    /// Impulse on each vertex from what is not fixed, in N s; empty where there was none.
    pub felt: Vec<Vec3>,
    /// The vertices that fixed bodies push, ascending.
    pub ground: Vec<GroundContact>,
    /// How deep the deepest of its vertices was in something, with the gaps that are kept, in metres.
    pub deepest: f32,
    /// How many of its vertices were held back, because contacts alone would have let them into another body.
    pub held: usize,
}

/// What is remembered from step to step.
#[derive(Default)]
pub struct MeetingMemory {
    /// The convex parts of colliders.
    pub parts: PartCache,
    /// The bodies that are near each other and apart.
    pub apart: KnownApart,
}

/// The step in which bodies meet.
#[derive(Clone, Copy, Debug)]
pub struct MeetingStep {
    /// Gravity in m/s².
    pub gravity: Vec3,
    /// Length in seconds.
    pub dt: f32,
    /// Rapier's substeps: it moves bodies after each, so that they see only a part of the step's gravity in the mean.
    pub substeps: usize,
}

/// Changes the velocities of bodies so that rapier's next step ends without overlaps, and the velocities of rigid bodies by the
/// opposite impulses. One entry a body. The result does not depend on the number of threads.
pub fn meet(
    bodies: &mut [MeetingBody<'_>],
    step: &MeetingStep,
    query: QueryPipeline<'_>,
    (rigid_bodies, colliders): (&RigidBodySet, &ColliderSet),
    memory: &mut MeetingMemory,
    refused: &mut Refused,
) -> (Vec<Meeting>, Vec<RigidCopy>) {
    let h = step.dt;
    let mut stands: Vec<bool> = bodies.iter().map(|body| body.stood).collect();
    let found = Encounters::find(bodies, step, &stands, &mut memory.apart);

    let around = Surroundings { query, bodies: rigid_bodies, colliders, drift: step.drift(), h };
    let mut copies = Copies::default();
    let mut contacts = Vec::new();
    // The last sweep runs backwards: of contacts, what is rigid has the last word.
    let touched = found.add_rigid(bodies, &around, (&mut copies, &mut memory.parts, refused), &mut contacts);
    found.add_soft(bodies, &mut contacts);

    let mut meetings: Vec<Meeting> = bodies.iter().map(|_| Meeting::default()).collect();
    let mut rigid = Vec::new();
    if !contacts.is_empty() {
        let mut velocities = found.velocities(bodies, step.drift());
        velocities.rigid = copies.list;
        solve(&mut contacts, &mut velocities, h);
        found.take(bodies, &velocities.vertices, step.drift());
        rigid = velocities.rigid;
        found.report(bodies, &contacts, &touched, &mut meetings);
    }
    stands.iter_mut().zip(&meetings).for_each(|(stands, meeting)| *stands = !meeting.ground.is_empty());
    found.hold_apart(bodies, step, &stands, &mut memory.apart, &mut meetings);
    (meetings, rigid)
}

impl MeetingStep {
    /// The velocity that gravity adds in the mean of the step, in m/s.
    fn drift(&self) -> Vec3 {
        let substeps = self.substeps.max(1) as f32;
        self.gravity * (self.dt * (substeps + 1.0) / (2.0 * substeps))
    }
}
