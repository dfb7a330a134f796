//! The deformation world: all elastic bodies of a rapier world, and the one verb that moves them.

mod coherence;
mod deformation_world;
mod encounter;
mod meetings;
mod procdef_meeting;
mod procdef_report;
mod procdef_stages;
mod procdef_view;
mod procdef_world;
mod report;
mod rest;
mod stages;
mod view;

pub use deformation_world::{DeformationSettings, DeformationWorld, ElasticBodyHandle, InsertError, SURFACE_THICKNESS};
pub use procdef_report::{ProcDefBodyReport, ProcDefStepReport, ProcDefTimes};
pub use procdef_view::ProcDefView;
pub use procdef_world::{ProcDefHandle, ProcDefLink, ProcDefWorld};
pub use report::{BodyReport, Frozen, StageTimes, StepReport};
pub use view::{RapierSets, RapierView};
