//! The nose: bridge, tip, wings and nostrils.

use glam::Vec3;

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid, round_cone};

/// The distance to `head` with the nose on it.
pub fn grown_onto(head: f32, p: Vec3) -> f32 {
    let bridge = round_cone(p, Vec3::new(0.285, 0.080, 0.0), Vec3::new(0.388, -0.095, 0.0), 0.030, 0.042);
    let tip = ellipsoid(p, Vec3::new(0.398, -0.112, 0.0), Vec3::new(0.050, 0.046, 0.050));
    let wing = pitched_ellipsoid(p, Vec3::new(0.352, -0.125, 0.058), Vec3::new(0.052, 0.038, 0.034), -0.10);
    let side = round_cone(p, Vec3::new(0.290, 0.00, 0.022), Vec3::new(0.325, -0.115, 0.045), 0.030, 0.040);
    let whole = unite(unite(unite(bridge, side, 0.05), tip, 0.03), wing, 0.024);
    let grown = unite(head, whole, 0.045);
    carve(grown, nostril(p), 0.012)
}

/// The nostril, opening downward.
fn nostril(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(0.372, -0.168, 0.032), Vec3::new(0.030, 0.024, 0.0165), 0.25)
}
