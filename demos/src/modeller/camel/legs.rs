//! The legs: forelegs straight with a knobbly knee, hind legs with a strong thigh and a bent
//! hock, and under each a broad soft foot with two toes.

use glam::Vec3;

use crate::modeller::blend::{intersect, unite};
use crate::modeller::shapes::{ellipsoid, pitched_ellipsoid, round_cone};

/// One leg: which pair it belongs to, where its foot stands.
pub struct Leg {
    hind: bool,
    side: f32,
    stride: f32,
}

/// The four legs: front, then hind; of each pair first z > 0, then z < 0.
pub fn all_four() -> [Leg; 4] {
    let leg = |hind, side, stride| Leg { hind, side, stride };
    [leg(false, 1.0, 0.13), leg(false, -1.0, -0.12), leg(true, 1.0, -0.11), leg(true, -1.0, 0.13)]
}

impl Leg {
    /// The distance to `body` with this leg grown onto it.
    pub fn grafted_onto(&self, body: f32, p: Vec3) -> f32 {
        let q = self.as_if_modelled(p);
        // Nothing of the leg is near enough to flow into the body there.
        if q.z < -0.15 || q.y > 1.8 || (q.x > 0.0) == self.hind {
            return body;
        }
        if self.hind { unite(body, hind_leg(q), 0.12) } else { unite(body, fore_leg(q), 0.08) }
    }

    /// The point on the leg as it is modelled: on the side z > 0 and without a stride.
    fn as_if_modelled(&self, p: Vec3) -> Vec3 {
        let lowered = ((1.25 - p.y) / 1.25).clamp(0.0, 1.0);
        Vec3::new(p.x - self.stride * lowered, p.y, p.z * self.side)
    }
}

/// A foreleg with its shoulder.
fn fore_leg(p: Vec3) -> f32 {
    let shoulder = pitched_ellipsoid(p, Vec3::new(0.40, 1.32, 0.135), Vec3::new(0.15, 0.27, 0.085), -0.18);
    let elbow = Vec3::new(0.36, 1.04, 0.175);
    let knee = Vec3::new(0.385, 0.615, 0.190);
    let fetlock = Vec3::new(0.375, 0.15, 0.200);
    let upper = round_cone(p, Vec3::new(0.38, 1.24, 0.155), elbow, 0.13, 0.088);
    let forearm = round_cone(p, elbow, knee, 0.090, 0.058);
    let cap = ellipsoid(p, knee + Vec3::new(0.012, 0.0, 0.0), Vec3::new(0.069, 0.105, 0.065));
    let cannon = round_cone(p, knee, fetlock, 0.052, 0.047);
    let arm = unite(shoulder, unite(upper, forearm, 0.05), 0.08);
    let shin = unite(unite(arm, cannon, 0.03), cap, 0.04);
    unite(shin, foot(p - fetlock.with_y(0.0)), 0.035)
}

/// A hind leg with its thigh.
fn hind_leg(p: Vec3) -> f32 {
    let hip = Vec3::new(-0.50, 1.36, 0.105);
    let stifle = Vec3::new(-0.40, 1.06, 0.165);
    let hock = Vec3::new(-0.60, 0.66, 0.180);
    let fetlock = Vec3::new(-0.555, 0.15, 0.195);
    let thigh = pitched_ellipsoid(p, Vec3::new(-0.49, 1.22, 0.125), Vec3::new(0.185, 0.26, 0.095), 0.12);
    let femur = round_cone(p, hip, stifle, 0.13, 0.098);
    let gaskin = round_cone(p, stifle, hock, 0.100, 0.056);
    let cap = ellipsoid(p, hock + Vec3::new(-0.008, 0.005, 0.0), Vec3::new(0.060, 0.090, 0.058));
    let point = ellipsoid(p, hock + Vec3::new(-0.045, 0.045, 0.0), Vec3::new(0.035, 0.055, 0.035));
    let cannon = round_cone(p, hock, fetlock, 0.053, 0.047);
    let ham = unite(thigh, unite(femur, gaskin, 0.06), 0.08);
    let shin = unite(unite(ham, cannon, 0.04), unite(cap, point, 0.04), 0.04);
    unite(shin, foot(p - fetlock.with_y(0.0)), 0.035)
}

/// A foot below a fetlock at the origin's height above the ground.
fn foot(p: Vec3) -> f32 {
    let pastern = round_cone(p, Vec3::new(0.0, 0.15, 0.0), Vec3::new(0.035, 0.07, 0.0), 0.056, 0.064);
    let pad = ellipsoid(p, Vec3::new(0.025, 0.030, 0.0), Vec3::new(0.118, 0.056, 0.098));
    let apart = Vec3::new(p.x, p.y, p.z.abs());
    let toe = ellipsoid(apart, Vec3::new(0.098, 0.026, 0.046), Vec3::new(0.072, 0.048, 0.046));
    let whole = unite(unite(pastern, pad, 0.06), toe, 0.022);
    intersect(whole, -p.y, 0.03)
}
