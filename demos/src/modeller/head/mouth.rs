//! The mouth: the round of the teeth, two lips that follow it, and the groove above them.

use glam::Vec3;

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid};

/// The middle of the mouth.
pub const CENTER: Vec3 = Vec3::new(0.335, -0.262, 0.0);

/// How far the lips fall back to the sides, per metre squared.
const BEND: f32 = 3.6;

/// The distance to `head` with the mouth on it.
pub fn grown_onto(head: f32, p: Vec3) -> f32 {
    let teeth = ellipsoid(p, Vec3::new(0.225, -0.255, 0.0), Vec3::new(0.112, 0.115, 0.125));
    let muzzled = unite(head, teeth, 0.09);
    let lipped = unite(muzzled, lips(p), 0.016);
    let parted = carve(lipped, line(p), 0.014);
    carve(parted, groove(p), 0.022)
}

/// The point as seen by straight lips.
fn straightened(p: Vec3) -> Vec3 {
    Vec3::new(p.x + BEND * p.z * p.z, p.y, p.z)
}

/// The upper lip with its bow, and the fuller lower lip.
fn lips(p: Vec3) -> f32 {
    let q = straightened(p);
    let bow = pitched_ellipsoid(q, Vec3::new(0.342, -0.236, 0.022), Vec3::new(0.034, 0.025, 0.056), 0.35);
    let corner = ellipsoid(q, Vec3::new(0.332, -0.250, 0.060), Vec3::new(0.030, 0.016, 0.056));
    let lower = pitched_ellipsoid(q, Vec3::new(0.333, -0.290, 0.0), Vec3::new(0.036, 0.030, 0.086), -0.25);
    unite(unite(bow, corner, 0.016), lower, 0.006)
}

/// The line between the lips, falling a little towards the corners.
fn line(p: Vec3) -> f32 {
    let q = straightened(p);
    let y = q.y + 0.262 - 0.9 * (q.z - 0.02).max(0.0).powi(2);
    ellipsoid(Vec3::new(q.x, y, q.z), Vec3::new(0.386, 0.0, 0.0), Vec3::new(0.034, 0.008, 0.115))
}

/// The groove from the nose to the upper lip.
fn groove(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(0.362, -0.198, 0.0), Vec3::new(0.020, 0.028, 0.014))
}
