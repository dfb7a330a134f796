//! The ear: a shell that stands off the head, its rim, the hollow, the small flap before it and the lobe.

use glam::{Quat, Vec3};

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, round_cone};

/// The middle of the ear.
pub const CENTER: Vec3 = Vec3::new(-0.085, -0.015, 0.285);
/// How far the ear's back stands off the head, in radians.
const STAND: f32 = 0.42;
/// How far its top leans backward.
const LEAN: f32 = 0.20;
/// From this distance on, a ball stands for the ear.
const FAR: f32 = 0.10;

/// The distance to `head` with this ear on it.
pub fn grown_onto(head: f32, p: Vec3) -> f32 {
    let to_ball = p.distance(CENTER) - 0.20;
    if to_ball > FAR {
        return head;
    }
    let turn = Quat::from_rotation_y(STAND) * Quat::from_rotation_z(LEAN);
    let q = turn.inverse() * (p - CENTER);
    unite(head, pinna(q), 0.03)
}

/// The ear in its own frame: x forward, y up, z out.
fn pinna(q: Vec3) -> f32 {
    let shell = ellipsoid(q, Vec3::new(-0.012, 0.025, 0.0), Vec3::new(0.092, 0.130, 0.038));
    let lobe = ellipsoid(q, Vec3::new(0.022, -0.105, 0.0), Vec3::new(0.036, 0.042, 0.022));
    let outline = unite(shell, lobe, 0.05);
    let hollow = ellipsoid(q, Vec3::new(-0.004, 0.030, 0.046), Vec3::new(0.066, 0.098, 0.042));
    let bowl = ellipsoid(q, Vec3::new(0.014, -0.022, 0.034), Vec3::new(0.038, 0.048, 0.052));
    let hollowed = carve(carve(outline, hollow, 0.012), bowl, 0.014);
    let fold = round_cone(q, Vec3::new(-0.045, -0.040, 0.012), Vec3::new(-0.028, 0.072, 0.014), 0.015, 0.014);
    let flap = round_cone(q, Vec3::new(0.056, -0.040, 0.016), Vec3::new(0.060, -0.010, 0.014), 0.015, 0.013);
    unite(unite(hollowed, fold, 0.010), flap, 0.02)
}
