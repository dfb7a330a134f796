//! What a step did to the bodies that move by themselves.

use rapier3d::geometry::ColliderHandle;

use super::ProcDefHandle;
use crate::coupling::ObstacleError;
use crate::coupling::procdef::ParticleFault;
use crate::math::Vec3;

/// What the last step did to one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProcDefBodyReport {
    /// Set where the body was left to rapier alone. It goes on by itself once the reason is gone.
    pub frozen: Option<ParticleFault>,
    /// Impulse of contacts with what is not fixed, in N s: the sum over its vertices of what rapier's last step did.
    pub felt: f32,
    /// Where a contact was a stimulus, in the frame of the mesh at rest.
    pub touched: Option<Vec3>,
    /// How deep its deepest vertex was in something, with the gaps that are kept, in metres: of bodies whose contacts are those
    /// of vertices, and what these bodies meet.
    pub deepest: f32,
    /// How many of its vertices were held back, because contacts alone would have let them into another body.
    pub held: usize,
    /// How many vertices touch fixed bodies. Counted only where the body has a trigger or directed friction.
    pub on_ground: usize,
}

/// Milliseconds that the stages of the last step took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProcDefTimes {
    /// Reading and writing rapier's particles.
    pub exchange: f32,
    /// Contacts felt, ground found, and contacts of vertices.
    pub contact: f32,
    /// Charts, local transformations, matching, water, ground friction and grips, on all cores.
    pub drive: f32,
}

/// What the last step did.
#[derive(Clone, Debug, Default)]
pub struct ProcDefStepReport {
    /// One entry a body, in the order of the handles.
    pub bodies: Vec<(ProcDefHandle, ProcDefBodyReport)>,
    /// Colliders that vertices cannot meet, and why.
    pub refused: Vec<(ColliderHandle, ObstacleError)>,
    /// Time taken.
    pub times: ProcDefTimes,
}

impl ProcDefStepReport {
    /// The entry of one body.
    pub fn body(&self, handle: ProcDefHandle) -> Option<&ProcDefBodyReport> {
        self.bodies.iter().find(|(h, _)| *h == handle).map(|(_, report)| report)
    }
}
