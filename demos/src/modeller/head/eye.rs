//! The eye: socket, ball, two lids that fit around the ball, and the brow above.

use glam::Vec3;

use crate::modeller::blend::{carve, intersect, unite};
use crate::modeller::shapes::{ellipsoid, round_cone};

/// The middle of the eyeball.
pub const CENTER: Vec3 = Vec3::new(0.243, 0.012, 0.126);
/// Its radius.
const RADIUS: f32 = 0.070;
/// How much thicker the lids are.
const LID: f32 = 0.012;

/// The distance to `head` with this eye in it.
pub fn set_into(head: f32, p: Vec3) -> f32 {
    let browed = unite(head, brow(p), 0.075);
    let hollowed = carve(browed, socket(p), 0.045);
    let ball = p.distance(CENTER) - RADIUS;
    unite(unite(hollowed, lids(p), 0.016), ball, 0.004)
}

/// The ridge of the brow, rising and falling off outward.
fn brow(p: Vec3) -> f32 {
    let inner = Vec3::new(0.296, 0.100, 0.048);
    let top = Vec3::new(0.272, 0.128, 0.130);
    let outer = Vec3::new(0.185, 0.085, 0.205);
    unite(round_cone(p, inner, top, 0.034, 0.036), round_cone(p, top, outer, 0.036, 0.022), 0.02)
}

/// The hollow of the eye.
fn socket(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(0.345, 0.014, 0.126), Vec3::new(0.082, 0.064, 0.096))
}

/// Two shells over the ball, parted by the slit through which it looks.
fn lids(p: Vec3) -> f32 {
    let shell = p.distance(CENTER) - (RADIUS + LID);
    let d = p - CENTER;
    // The slit is bounded by two arches that meet in its corners, the upper one higher; the outer corner lies a little
    // higher than the inner one.
    let tilted = d.y - 0.10 * d.z;
    let upper = 0.033 - tilted - 0.58 * (d.z - 0.002).powi(2) / RADIUS;
    let lower = tilted + 0.027 - 0.48 * (d.z - 0.002).powi(2) / RADIUS;
    intersect(shell, upper.min(lower), 0.008)
}
