//! Elastic bodies: shared rest data and the deformation of the skin.

mod body;
mod deform;
mod palette;
mod rest;
mod rig;

pub use body::{DeformSettings, ElasticBody, LevelOfDetail};
pub use palette::{CollisionField, CollisionPass, Palette, SegmentEntry, SegmentField, SpringStage};
pub use rest::{SegmentSkin, SkinSample};
pub use rig::{
    ContactSettings, ElasticRig, Joint, MAX_INFLUENCES, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
