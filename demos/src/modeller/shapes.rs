//! The shapes everything is modelled from: each tells a point's distance to its surface,
//! negative inside. A shape is a few numbers, and a model is a function that blends shapes.

use glam::Vec3;

/// Distance to an axis-aligned ellipsoid: exact on the surface, and close to it elsewhere.
pub fn ellipsoid(p: Vec3, center: Vec3, radii: Vec3) -> f32 {
    let q = (p - center) / radii;
    let stretched = (q / radii).length();
    if stretched < 1e-6 {
        return -radii.min_element();
    }
    let unit = q.length();
    unit * (unit - 1.0) / stretched
}

/// An ellipsoid whose x axis is pitched by `angle` radians in the plane z = 0 (positive lifts +x).
pub fn pitched_ellipsoid(p: Vec3, center: Vec3, radii: Vec3, angle: f32) -> f32 {
    let (sin, cos) = angle.sin_cos();
    let d = p - center;
    let local = Vec3::new(cos * d.x + sin * d.y, cos * d.y - sin * d.x, d.z);
    ellipsoid(local, Vec3::ZERO, radii)
}

/// Distance to a tapered capsule: a ball of radius `ra` at `a` swept to a ball of radius `rb` at `b`.
pub fn round_cone(p: Vec3, a: Vec3, b: Vec3, ra: f32, rb: f32) -> f32 {
    let axis = b - a;
    let length2 = axis.length_squared();
    let taper = ra - rb;
    let slant2 = length2 - taper * taper;
    let from_a = p - a;
    let along = from_a.dot(axis);
    let beyond = along - length2;
    let across2 = (from_a * length2 - axis * along).length_squared();
    let along2 = along * along * length2;
    let beyond2 = beyond * beyond * length2;
    let lean = taper.signum() * taper * taper * across2;
    if beyond.signum() * slant2 * beyond2 > lean {
        return (across2 + beyond2).sqrt() / length2 - rb;
    }
    if along.signum() * slant2 * along2 < lean {
        return (across2 + along2).sqrt() / length2 - ra;
    }
    ((across2 * slant2 / length2).sqrt() + along * taper) / length2 - ra
}

/// Distance to a box with rounded edges; `half` includes the rounding.
pub fn rounded_box(p: Vec3, center: Vec3, half: Vec3, rounding: f32) -> f32 {
    let outside = (p - center).abs() - half + Vec3::splat(rounding);
    outside.max(Vec3::ZERO).length() + outside.max_element().min(0.0) - rounding
}

/// The same point with its z made positive: a shape modelled on the left appears on both sides.
pub fn mirrored(p: Vec3) -> Vec3 {
    Vec3::new(p.x, p.y, p.z.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipsoid_is_zero_on_its_poles_and_negative_inside() {
        let radii = Vec3::new(1.0, 2.0, 3.0);
        assert!(ellipsoid(Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO, radii).abs() < 1e-6);
        assert!(ellipsoid(Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO, radii) < 0.0);
        assert!(ellipsoid(Vec3::ZERO, Vec3::ZERO, radii) < 0.0);
        assert!(ellipsoid(Vec3::new(1.5, 0.0, 0.0), Vec3::ZERO, radii) > 0.0);
    }

    #[test]
    fn a_round_cone_touches_both_of_its_balls() {
        let (a, b) = (Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0));
        assert!(round_cone(Vec3::new(-0.5, 0.0, 0.0), a, b, 0.5, 0.2).abs() < 1e-5);
        assert!(round_cone(Vec3::new(2.2, 0.0, 0.0), a, b, 0.5, 0.2).abs() < 1e-5);
        assert!(round_cone(Vec3::new(1.0, 0.0, 0.0), a, b, 0.5, 0.2) < -0.3);
    }

    #[test]
    fn a_rounded_box_ends_at_its_half_size() {
        let half = Vec3::new(1.0, 0.5, 0.25);
        let end = rounded_box(Vec3::new(0.0, 0.5, 0.0), Vec3::ZERO, half, 0.1);
        assert!(end.abs() < 1e-6);
    }
}
