//! Elastic bodies: shared rest data and the deformation of the skin.

mod deform;
mod palette;
mod rig;
mod tangent_normals;

pub use palette::{CollisionField, CollisionPass, Palette, SegmentEntry, SegmentField, SpringStage};
pub use rig::{
    ContactSettings, ElasticRig, Joint, MAX_INFLUENCES, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
pub use tangent_normals::{TANGENT_STEP, tangent_epsilon};
