//! Elastic bodies: shared rest data and the deformation of the skin.

mod rig;
pub use rig::{
    ContactSettings, ElasticRig, Joint, MAX_INFLUENCES, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
