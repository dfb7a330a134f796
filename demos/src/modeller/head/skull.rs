//! The large forms: brain case, forehead, cheeks, jaw, chin and neck.

use glam::Vec3;

use crate::modeller::blend::{carve, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid, round_cone};

/// The distance to the head without its features.
pub fn distance(p: Vec3) -> f32 {
    let crown = unite(cranium(p), forehead(p), 0.10);
    let faced = unite(crown, face(p), 0.16);
    let jawed = unite(faced, jaw(p), 0.09);
    let chinned = unite(jawed, chin(p), 0.09);
    let cheeked = unite(chinned, cheekbone(p), 0.09);
    let fleshed = unite(cheeked, cheek(p), 0.12);
    carve(fleshed, temple(p), 0.12)
}

/// The brain case, longest behind.
fn cranium(p: Vec3) -> f32 {
    let vault = pitched_ellipsoid(p, Vec3::new(-0.06, 0.16, 0.0), Vec3::new(0.365, 0.31, 0.295), 0.10);
    let occiput = ellipsoid(p, Vec3::new(-0.19, 0.08, 0.0), Vec3::new(0.23, 0.24, 0.25));
    unite(vault, occiput, 0.12)
}

/// The forehead, rounded to both sides.
fn forehead(p: Vec3) -> f32 {
    let middle = ellipsoid(p, Vec3::new(0.07, 0.21, 0.0), Vec3::new(0.245, 0.20, 0.235));
    let eminence = ellipsoid(p, Vec3::new(0.17, 0.23, 0.10), Vec3::new(0.12, 0.12, 0.12));
    unite(middle, eminence, 0.10)
}

/// The block of the face between brow and chin.
fn face(p: Vec3) -> f32 {
    pitched_ellipsoid(p, Vec3::new(0.105, -0.14, 0.0), Vec3::new(0.215, 0.33, 0.215), 0.04)
}

/// The lower jaw: the rising branch before the ear, the angle, the body towards the chin.
fn jaw(p: Vec3) -> f32 {
    let joint = Vec3::new(-0.005, -0.06, 0.20);
    let angle = Vec3::new(0.005, -0.275, 0.165);
    let front = Vec3::new(0.235, -0.42, 0.045);
    let branch = round_cone(p, joint, angle, 0.06, 0.06);
    unite(branch, round_cone(p, angle, front, 0.062, 0.058), 0.05)
}

/// The chin.
fn chin(p: Vec3) -> f32 {
    let ball = ellipsoid(p, Vec3::new(0.272, -0.422, 0.0), Vec3::new(0.066, 0.060, 0.072));
    unite(ball, ellipsoid(p, Vec3::new(0.245, -0.43, 0.0), Vec3::new(0.07, 0.058, 0.075)), 0.04)
}

/// The cheekbone, from below the eye towards the ear.
fn cheekbone(p: Vec3) -> f32 {
    round_cone(p, Vec3::new(0.235, -0.055, 0.150), Vec3::new(0.06, -0.015, 0.225), 0.066, 0.048)
}

/// The soft cheek.
fn cheek(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(0.20, -0.19, 0.125), Vec3::new(0.09, 0.105, 0.075))
}

/// The hollow of the temple.
fn temple(p: Vec3) -> f32 {
    ellipsoid(p, Vec3::new(0.20, 0.10, 0.335), Vec3::new(0.10, 0.11, 0.08))
}

/// The neck: throat, nape and the two cords that run from behind the ears to the collar.
pub fn neck(p: Vec3) -> f32 {
    let column = round_cone(p, Vec3::new(-0.10, -0.20, 0.0), Vec3::new(-0.15, -0.80, 0.0), 0.175, 0.195);
    let throat = round_cone(p, Vec3::new(0.04, -0.36, 0.0), Vec3::new(-0.02, -0.80, 0.0), 0.085, 0.11);
    let cord = round_cone(p, Vec3::new(-0.10, -0.20, 0.165), Vec3::new(0.06, -0.80, 0.075), 0.05, 0.052);
    let apple = ellipsoid(p, Vec3::new(0.098, -0.535, 0.0), Vec3::new(0.035, 0.042, 0.032));
    let whole = unite(unite(column, throat, 0.10), cord, 0.06);
    unite(whole, apple, 0.05)
}
