//! Vectors, rotations and poses: rapier's own types, so that nothing is converted at the border.

pub use parry3d::math::{Pose, Vector as Vec3};
/// Rotations as unit quaternions, the type inside a [`Pose`].
pub type Quat = glam::Quat;
pub use glam::{Mat2, Mat3, Vec2};
