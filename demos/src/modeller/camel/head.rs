//! The head, carried level: skull, long muzzle, split upper lip, hanging lower lip, heavy brows
//! over the eyes, small ears. Modelled for z > 0 and mirrored.

use glam::Vec3;

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid, round_cone};

/// The middle of the head.
pub const CENTER: Vec3 = Vec3::new(1.48, 1.99, 0.0);
/// How smoothly the head flows into the neck.
pub const REACH: f32 = 0.07;

/// The distance to the head, for a point with z mirrored to be positive.
pub fn distance(p: Vec3) -> f32 {
    let bones = unite(unite(skull(p), muzzle(p), 0.07), jaw(p), 0.035);
    let lipped = unite(unite(bones, upper_lip(p), 0.04), lower_lip(p), 0.03);
    let browed = unite(unite(lipped, brow(p), 0.025), cheek(p), 0.05);
    let socketed = carve(browed, eye_socket(p), 0.02);
    let eyed = unite(socketed, eye(p), 0.006);
    let nosed = carve(eyed, nostril(p), 0.012);
    let mouthed = carve(nosed, mouth(p), 0.014);
    unite(mouthed, ear(p), 0.025)
}

/// The brain case.
fn skull(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.355, 2.005, 0.0), Vec3::new(0.135, 0.098, 0.088), -0.15)
}

/// The bridge of the nose, slightly arched.
fn muzzle(p: Vec3) -> f32 {
    let bridge = round_cone(p, Vec3::new(1.42, 2.0, 0.0), Vec3::new(1.655, 1.945, 0.0), 0.078, 0.054);
    let arch = ellipsoid(p, Vec3::new(1.55, 2.0, 0.0), Vec3::new(0.10, 0.04, 0.04));
    unite(bridge, arch, 0.05)
}

/// The lower jaw.
fn jaw(p: Vec3) -> f32 {
    round_cone(p, Vec3::new(1.37, 1.935, 0.0), Vec3::new(1.63, 1.872, 0.0), 0.066, 0.037)
}

/// The round of the cheek.
fn cheek(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.40, 1.94, 0.045), Vec3::new(0.07, 0.055, 0.035))
}

/// The upper lip: two halves that hang over the lower one.
fn upper_lip(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.69, 1.925, 0.022), Vec3::new(0.052, 0.055, 0.036), -0.5)
}

/// The lower lip, drooping.
fn lower_lip(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.67, 1.853, 0.0), Vec3::new(0.045, 0.030, 0.038), -0.35)
}

/// The bony brow.
fn brow(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.405, 2.062, 0.066), Vec3::new(0.058, 0.024, 0.030), -0.2)
}

/// The hollow around the eye.
fn eye_socket(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.425, 2.022, 0.104), Vec3::new(0.046, 0.030, 0.026))
}

/// The eye, half covered.
fn eye(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.425, 2.020, 0.074), Vec3::new(0.027, 0.022, 0.020))
}

/// The slit of the nostril.
fn nostril(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.695, 1.962, 0.046), Vec3::new(0.030, 0.010, 0.020), 0.6)
}

/// The line of the mouth, along the side of the muzzle.
fn mouth(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.64, 1.888, 0.070), Vec3::new(0.12, 0.008, 0.040), -0.25)
}

/// A small ear, set far back.
fn ear(p: Vec3) -> f32 {
    let shell = round_cone(p, Vec3::new(1.285, 2.06, 0.062), Vec3::new(1.245, 2.135, 0.098), 0.026, 0.017);
    let hollow = ellipsoid(p, Vec3::new(1.285, 2.115, 0.098), Vec3::new(0.014, 0.030, 0.014));
    carve(shell, hollow, 0.01)
}
