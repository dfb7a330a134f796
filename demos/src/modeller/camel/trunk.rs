//! The trunk: a deep barrel, a tucked belly, a sloping rump, the hump and the pad on the chest.

use glam::Vec3;

use crate::modeller::blend::unite;
use crate::modeller::shapes::{ellipsoid, mirrored, pitched_ellipsoid};

/// The distance to the trunk.
pub fn distance(p: Vec3) -> f32 {
    let barrel = unite(ribs(p), chest(p), 0.12);
    let whole = unite(unite(barrel, loins(p), 0.18), rump(p), 0.12);
    let humped = unite(whole, hump(p), 0.14);
    unite(humped, chest_pad(p), 0.05)
}

/// The rib cage, deepest just behind the forelegs.
fn ribs(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(0.16, 1.335, 0.0), Vec3::new(0.50, 0.335, 0.275), -0.10)
}

/// The front of the chest, between the shoulders.
fn chest(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(0.44, 1.32, 0.0), Vec3::new(0.27, 0.31, 0.21), -0.25)
}

/// The loins above the tucked belly.
fn loins(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(-0.26, 1.40, 0.0), Vec3::new(0.42, 0.235, 0.21), -0.12)
}

/// The rump, falling towards the tail, with the points of the hips.
fn rump(p: Vec3) -> f32 {
    let croup = pitched_ellipsoid(p, Vec3::new(-0.52, 1.42, 0.0), Vec3::new(0.25, 0.19, 0.18), 0.35);
    let hip = ellipsoid(mirrored(p), Vec3::new(-0.42, 1.52, 0.11), Vec3::new(0.12, 0.08, 0.07));
    unite(croup, hip, 0.08)
}

/// The hump: one, tall, leaning back a little.
fn hump(p: Vec3) -> f32 {
    let foot = ellipsoid(p, Vec3::new(-0.06, 1.62, 0.0), Vec3::new(0.36, 0.20, 0.17));
    let top = pitched_ellipsoid(p, Vec3::new(-0.09, 1.78, 0.0), Vec3::new(0.19, 0.235, 0.115), 0.1);
    unite(foot, top, 0.14)
}

/// The horny pad that the camel lies on.
fn chest_pad(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(0.40, 1.00, 0.0), Vec3::new(0.105, 0.055, 0.085))
}
