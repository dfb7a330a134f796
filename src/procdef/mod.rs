//! Bodies that move by themselves: local deformations, prescribed in space and time, that add up to motions of the whole.
//!
//! The method is that of Ijiri, Takayama, Yokota and Igarashi, *ProcDef: Local-to-global Deformation for Skeleton-free
//! Character Animation* (2009); section and equation numbers are that paper's.

mod body;
mod embedded_skin;
mod global_solve;
mod matching;
mod ordering;
mod regions;
mod rig;
mod rig_error;
mod rigid;
mod rotation;
mod rotation_wide;
mod settings;
mod volume;

pub use body::ProcDefBody;
pub use embedded_skin::{DeformedSkin, EmbeddedSkin, EmbeddingReport, SkinBinding};
pub use rig::{ProcDefRig, ProcDefRigBuilder};
pub use rig_error::ProcDefRigError;
pub use rotation::nearest_rotation;
pub use settings::{GroundPlane, ProcDefSettings, Stiffness, wave_speed};
