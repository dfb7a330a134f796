//! The head, carried level: skull, long muzzle, split upper lip, hanging lower lip, heavy brows
//! over the eyes, small ears. Modelled for z > 0 and mirrored.

use glam::Vec3;

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid, round_cone};

/// The middle of the head.
pub const CENTER: Vec3 = Vec3::new(1.50, 1.99, 0.0);
/// How smoothly the head flows into the neck.
pub const REACH: f32 = 0.07;

/// Where the head turns on the neck; it grows from here.
const POLL: Vec3 = Vec3::new(1.30, 1.98, 0.0);
/// How much larger the head is than it is modelled below.
const GROWTH: f32 = 1.08;

/// A ball of this radius holds the head.
const SIZE: f32 = 0.36;
/// From this distance on, the ball stands for the head.
const FAR: f32 = 0.2;

/// The distance to the head, for a point with z mirrored to be positive.
pub fn distance(p: Vec3) -> f32 {
    let to_ball = p.distance(CENTER) - SIZE;
    if to_ball > FAR {
        return to_ball;
    }
    GROWTH * modelled_distance(POLL + (p - POLL) / GROWTH)
}

/// The distance to the head at the size it is modelled.
fn modelled_distance(p: Vec3) -> f32 {
    let upper = unite(unite(skull(p), muzzle(p), 0.07), upper_lip(p), 0.04);
    let lower = unite(jaw(p), lower_lip(p), 0.035);
    // The jaw grows into the cheek behind, and is parted from the muzzle in front: the mouth.
    let parted = ((p.x - 1.46) / 0.10).clamp(0.0, 1.0);
    let bones = unite(upper, lower, 0.06 - 0.040 * parted);
    let browed = unite(unite(bones, cheek(p), 0.05), brow(p), 0.03);
    let socketed = carve(browed, eye_socket(p), 0.03);
    let eyed = unite(socketed, eye(p), 0.008);
    let nosed = carve(eyed, nostril(p), 0.015);
    unite(nosed, ear(p), 0.02)
}

/// The brain case, domed.
fn skull(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.355, 2.005, 0.0), Vec3::new(0.130, 0.100, 0.088), -0.10)
}

/// The bridge of the nose and the muzzle, narrowest in its middle.
fn muzzle(p: Vec3) -> f32 {
    let bridge = round_cone(p, Vec3::new(1.42, 2.005, 0.0), Vec3::new(1.57, 1.978, 0.0), 0.078, 0.056);
    let nose = round_cone(p, Vec3::new(1.57, 1.976, 0.0), Vec3::new(1.66, 1.957, 0.0), 0.055, 0.049);
    unite(bridge, nose, 0.04)
}

/// The lower jaw, deep behind and shallow in front.
fn jaw(p: Vec3) -> f32 {
    let behind = round_cone(p, Vec3::new(1.365, 1.940, 0.0), Vec3::new(1.50, 1.908, 0.0), 0.068, 0.047);
    let front = round_cone(p, Vec3::new(1.50, 1.908, 0.0), Vec3::new(1.635, 1.882, 0.0), 0.047, 0.034);
    behind.min(front)
}

/// The round of the cheek.
fn cheek(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.40, 1.945, 0.045), Vec3::new(0.07, 0.055, 0.036))
}

/// The upper lip: two halves that hang over the lower one.
fn upper_lip(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.690, 1.924, 0.022), Vec3::new(0.040, 0.056, 0.034), 0.40)
}

/// The lower lip, drooping.
fn lower_lip(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.672, 1.858, 0.0), Vec3::new(0.046, 0.029, 0.040), -0.40)
}

/// The bony brow.
fn brow(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.410, 2.066, 0.064), Vec3::new(0.060, 0.024, 0.034), -0.15)
}

/// The hollow around the eye.
fn eye_socket(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.432, 2.016, 0.114), Vec3::new(0.060, 0.042, 0.036))
}

/// The eye, prominent under its brow.
fn eye(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(1.427, 2.022, 0.066), Vec3::new(0.034, 0.029, 0.034))
}

/// The slit of the nostril, slanting.
fn nostril(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(1.688, 1.970, 0.054), Vec3::new(0.036, 0.014, 0.026), 0.6)
}

/// A small leaf of an ear, set far back and pointing outward.
fn ear(p: Vec3) -> f32 {
    let root = Vec3::new(1.285, 2.050, 0.060);
    let middle = Vec3::new(1.262, 2.086, 0.092);
    let tip = Vec3::new(1.248, 2.114, 0.112);
    let lower = round_cone(p, root, middle, 0.020, 0.026);
    let leaf = unite(lower, round_cone(p, middle, tip, 0.026, 0.013), 0.01);
    let hollow = ellipsoid(p, Vec3::new(1.290, 2.090, 0.104), Vec3::new(0.018, 0.030, 0.016));
    carve(leaf, hollow, 0.014)
}
