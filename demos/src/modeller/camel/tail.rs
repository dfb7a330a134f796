//! The tail: thin, hanging free behind the rump, with a tuft at its end.

use glam::Vec3;

use crate::modeller::tube::Tube;

/// The middle of the tail.
pub const CENTER: Vec3 = Vec3::new(-0.86, 1.05, 0.0);
/// How smoothly the tail flows into the rump.
pub const REACH: f32 = 0.06;

/// The tail as a tube that swells into the tuft.
pub fn tail() -> Tube {
    Tube::through(&[
        [-0.66, 1.44, 0.0, 0.055],
        [-0.78, 1.39, 0.0, 0.038],
        [-0.84, 1.28, 0.0, 0.030],
        [-0.862, 1.10, 0.0, 0.026],
        [-0.868, 0.95, 0.0, 0.027],
        [-0.872, 0.87, 0.0, 0.042],
        [-0.876, 0.80, 0.0, 0.047],
        [-0.882, 0.73, 0.0, 0.037],
        [-0.888, 0.67, 0.0, 0.018],
    ])
}
