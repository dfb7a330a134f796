//! Between rapier and the bodies that move by themselves: their particles, what they touch, water, ground, what holds them.

mod attachment;
mod contacts;
mod crossings;
mod grip;
mod ground;
mod meeting;
mod particles;
mod water;

pub use attachment::{attach_to, spawn_attachment};
pub use contacts::{FeltContacts, GroundContact, felt_impulses, ground_contacts};
pub use crossings::crossings;
pub use grip::Grip;
pub use ground::GroundDirections;
pub use meeting::{
    ContactSurface, GroundFriction, Meeting, MeetingBody, MeetingMemory, MeetingStep, Refused, RigidCopy, SKIN, meet,
};
pub use particles::{ParticleFault, ProcDefSets, ProcDefStart, read_particles, spawn_soft_body, write_velocities};
pub use water::{WaterRegion, act_of_water};
