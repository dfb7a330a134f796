//! Between rapier and the elastic bodies: ragdolls, obstacles, repelling impulses, penetration cancellation.
//!
//! Rapier's sets are borrowed for a call; nothing of them is kept.

mod cancel;
mod contact;
mod gauge;
mod literal;
mod magnitude;
mod obstacle;
mod penetrations;
mod probes;
mod strength;

pub use cancel::{CancelReport, CancelSettings, Placement, cancel};
pub use contact::{Proximity, moved_axis, penetration, way_out};
pub use gauge::gauge_point;
pub use magnitude::complementarity;
pub use obstacle::{LocalPart, ObstacleError, ObstaclePart, PartCache, PartId, convex_parts, decompose};
pub use penetrations::{Contact, Penetration, find_contacts};
mod foundation;
mod measure;
mod ragdoll;

pub use foundation::{
    Approach, ContactKeys, ContactMaterial, ElasticSide, FoundationContact, FoundationMemory, FoundationPoint,
    FoundationSettings, PairApproaches, PairPoint, StepSize, pair_contacts, push_back, remember_pair_contacts,
    remember_skin_contacts, skin_contacts,
};
pub use measure::{INSIDE, PenetrationFigures, measure};
pub use ragdoll::{CORE_FRACTION, Ragdoll, RagdollStart, core_shape, elastic_joint, segment_shape};
mod surroundings;
pub use surroundings::{ContactMemories, ContactMemory, obstacles_near, proximities};
