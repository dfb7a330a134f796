//! The deformation world: all elastic bodies of a rapier world, and the one verb that moves them.

mod coherence;
mod deformation_world;
mod encounter;
mod meetings;
mod report;
mod rest;
mod stages;
mod view;

pub use deformation_world::{DeformationSettings, DeformationWorld, ElasticBodyHandle, InsertError, SURFACE_THICKNESS};
pub use report::{BodyReport, Frozen, StageTimes, StepReport};
pub use view::{RapierSets, RapierView};
