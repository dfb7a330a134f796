//! Elastic bodies: shared rest data and the deformation of the skin.

mod body;
mod body_draggers;
mod body_normals;
mod collision_state;
mod deform;
mod deform_wide;
mod drag_stage;
mod dragger;
mod palette;
mod rest;
mod rig;
mod rig_builder;
mod rig_checks;
mod rig_fault;
mod rig_file;
mod rig_raw;
mod skin_order;
mod tangent_normals;
mod weight_regions;
mod weights;

pub use crate::files::{MAX_TOML_BYTES, TomlError, TomlKey, TomlText, did_you_mean};
pub use body::{DeformSettings, ElasticBody, LevelOfDetail};
pub use body_normals::Normals;
pub use collision_state::CollisionState;
pub use drag_stage::{DragField, DragStage, NO_SEGMENT};
pub use dragger::{DEFAULT_RELEASE, Dragger, DraggerError, DraggerHandle, DraggerStart, Grip};
pub use palette::{CollisionField, CollisionPass, Palette, SegmentEntry, SegmentField, SpringStage};
pub use rest::{SegmentSkin, SkinSample};
pub use rig::{
    ContactSettings, ElasticRig, Joint, MAX_INFLUENCES, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
pub use rig_builder::{DEFAULT_LOCAL_THRESHOLD, DEFAULT_SOFTNESS, ElasticRigBuilder, rest_pose};
pub use rig_fault::{RigFault, RigFaultKind, RigPlace, RigTable};
pub use rig_file::{RigError, load_rig};
pub use tangent_normals::{TANGENT_STEP, tangent_epsilon};
pub use weights::{MAX_SEGMENTS, WeightOptions, WeightsError, compute_weights};
