//! The tail: thin, hanging free behind the rump, with a tuft at its end.

use glam::Vec3;

use crate::modeller::blend::unite;
use crate::modeller::shapes::ellipsoid;
use crate::modeller::tube::Tube;

/// The middle of the tail.
pub const CENTER: Vec3 = Vec3::new(-0.86, 1.05, 0.0);
/// How smoothly the tail flows into the rump.
pub const REACH: f32 = 0.06;

/// The tail without its tuft.
pub fn tail() -> Tube {
    Tube::through(&[
        [-0.66, 1.44, 0.0, 0.055],
        [-0.78, 1.40, 0.0, 0.042],
        [-0.845, 1.28, 0.0, 0.034],
        [-0.86, 1.10, 0.0, 0.030],
        [-0.86, 0.92, 0.0, 0.028],
    ])
}

/// The distance to the tail and its tuft.
pub fn distance(tail: &Tube, p: Vec3) -> f32 {
    let tuft = ellipsoid(p, Vec3::new(-0.865, 0.86, 0.0), Vec3::new(0.042, 0.13, 0.042));
    unite(tail.distance(p), tuft, 0.04)
}
