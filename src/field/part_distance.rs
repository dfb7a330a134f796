//! Exact distances to convex parts. `part_distance.wgsl` is the twin of this file.

use super::convex_hull::ConvexHull;
use super::part::{ConvexPart, PartShape};
use crate::math::{Vec2, Vec3};

impl ConvexPart {
    /// Euclidean distance of `x` (in the part's frame) from the part, 0 inside, and its gradient: the unit vector away
    /// from the part, zero inside.
    #[inline]
    pub fn distance(&self, x: Vec3) -> (f32, Vec3) {
        let (distance, direction) = self.distance_before_rounding(x);
        if distance > self.rounding { (distance - self.rounding, direction) } else { (0.0, Vec3::ZERO) }
    }

    #[inline]
    pub(super) fn distance_before_rounding(&self, x: Vec3) -> (f32, Vec3) {
        match &self.shape {
            PartShape::Point => away(x),
            PartShape::Segment { a, b } => away(x - closest_on_segment(*a, *b, x)),
            PartShape::Cuboid { half_extents } => away(x - x.clamp(-*half_extents, *half_extents)),
            PartShape::Cylinder { half_height, radius } => away(outside_cylinder(x, *half_height, *radius)),
            PartShape::Cone { half_height, radius } => away(outside_cone(x, *half_height, *radius)),
            PartShape::HalfSpace { normal } => {
                let height = normal.dot(x);
                if height > 0.0 { (height, *normal) } else { (0.0, Vec3::ZERO) }
            }
            PartShape::Hull(hull) => away(outside_hull(x, hull)),
        }
    }
}

/// Length and direction of a vector, both zero for the zero vector.
#[inline]
fn away(v: Vec3) -> (f32, Vec3) {
    let length = v.length();
    if length > 0.0 { (length, v / length) } else { (0.0, Vec3::ZERO) }
}

/// The point of the segment `ab` that is nearest to `x`.
#[inline]
pub(crate) fn closest_on_segment(a: Vec3, b: Vec3, x: Vec3) -> Vec3 {
    let ab = b - a;
    let length_squared = ab.length_squared();
    if length_squared <= 0.0 {
        return a;
    }
    a + ab * ((x - a).dot(ab) / length_squared).clamp(0.0, 1.0)
}

/// `x` minus its nearest point of the cylinder.
#[inline]
fn outside_cylinder(x: Vec3, half_height: f32, radius: f32) -> Vec3 {
    let around = Vec2::new(x.x, x.z);
    let rho = around.length();
    let side = if rho > radius { around * (1.0 - radius / rho) } else { Vec2::ZERO };
    Vec3::new(side.x, x.y - x.y.clamp(-half_height, half_height), side.y)
}

/// `x` minus its nearest point of the cone: the problem is one of a triangle in the half plane through the axis.
#[inline]
fn outside_cone(x: Vec3, half_height: f32, radius: f32) -> Vec3 {
    let around = Vec2::new(x.x, x.z);
    let rho = around.length();
    let slope = Vec2::new(2.0 * half_height, radius);
    let above = slope.dot(Vec2::new(rho, x.y - half_height)) > 0.0;
    if !above && x.y >= -half_height {
        return Vec3::ZERO;
    }
    let on_base = Vec2::new(rho.min(radius), -half_height);
    let rim = Vec2::new(radius, -half_height);
    let to_apex = Vec2::new(-radius, 2.0 * half_height);
    let point = Vec2::new(rho, x.y);
    let along = ((point - rim).dot(to_apex) / to_apex.length_squared()).clamp(0.0, 1.0);
    let on_side = rim + to_apex * along;
    let nearest = if point.distance_squared(on_side) < point.distance_squared(on_base) { on_side } else { on_base };
    let radial = if rho > 0.0 { around * ((rho - nearest.x) / rho) } else { Vec2::ZERO };
    Vec3::new(radial.x, x.y - nearest.y, radial.y)
}

/// `x` minus its nearest point of the hull: the nearest of all triangles that face `x`, zero where none does.
///
/// A point on a face, or just beneath it, may by rounding seem to lie above another triangle of the same face, far from
/// its border: what is not above any plane by more than rounding counts as inside.
///
/// The search starts at the triangle with the highest plane.
#[inline]
pub(super) fn outside_hull(x: Vec3, hull: &ConvexHull) -> Vec3 {
    let height = |&(normal, offset): &(Vec3, f32)| normal.dot(x) - offset;
    let (mut first, mut highest) = (0, f32::NEG_INFINITY);
    for (i, plane) in hull.planes().iter().enumerate() {
        let height = height(plane);
        if height > highest {
            (first, highest) = (i, height);
        }
    }
    if highest <= hull.rounding_error() {
        return Vec3::ZERO;
    }
    x - hull.nearest_from(x, first)
}

/// The point of a triangle that is nearest to `x`, by the Voronoi regions of its corners and edges (Ericson, *Real-Time
/// Collision Detection*, section 5.1.5).
#[inline]
pub(crate) fn closest_on_triangle(&[a, b, c]: &[Vec3; 3], x: Vec3) -> Vec3 {
    let (ab, ac, ax) = (b - a, c - a, x - a);
    let (d1, d2) = (ab.dot(ax), ac.dot(ax));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bx = x - b;
    let (d3, d4) = (ab.dot(bx), ac.dot(bx));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cx = x - c;
    let (d5, d6) = (ab.dot(cx), ac.dot(cx));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let denominator = 1.0 / (va + vb + vc);
    a + ab * (vb * denominator) + ac * (vc * denominator)
}
