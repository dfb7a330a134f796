//! Elastic bodies: shared rest data and the deformation of the skin.

mod deform;
mod palette;
mod rig;

pub use palette::{CollisionField, CollisionPass, Palette, SegmentEntry, SegmentField, SpringStage};
pub use rig::{
    ContactSettings, ElasticRig, Joint, MAX_INFLUENCES, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
