//! Signed distances to convex parts: negative inside, how far the nearest point of the surface is.
//!
//! The signed distance of a convex part is a convex function. Its gradient inside leads to the nearest face.

use super::part::{ConvexPart, PartShape, PlacedPart};
use crate::math::{Vec2, Vec3};

impl ConvexPart {
    /// Signed distance of `x` (in the part's frame) and its gradient, a unit vector that leads out of the part.
    ///
    /// Where several points of the surface are equally near, the gradient leads to one of them.
    pub fn signed_distance(&self, x: Vec3) -> (f32, Vec3) {
        let (distance, direction) = self.distance_before_rounding(x);
        let (distance, direction) = if distance > 0.0 { (distance, direction) } else { self.depth_before_rounding(x) };
        (distance - self.rounding, direction)
    }

    /// The signed distance of a point inside the shape before rounding.
    fn depth_before_rounding(&self, x: Vec3) -> (f32, Vec3) {
        match &self.shape {
            PartShape::Point => (0.0, Vec3::Y),
            PartShape::Segment { a, b } => {
                (0.0, (*b - *a).try_normalize().map_or(Vec3::Y, |axis| axis.any_orthonormal_vector()))
            }
            PartShape::Cuboid { half_extents } => {
                let beyond = x.abs() - *half_extents;
                let axis = if beyond.x >= beyond.y && beyond.x >= beyond.z {
                    Vec3::X
                } else if beyond.y >= beyond.z {
                    Vec3::Y
                } else {
                    Vec3::Z
                };
                (beyond.dot(axis), axis * x.dot(axis).signum())
            }
            PartShape::Cylinder { half_height, radius } => {
                let around = Vec2::new(x.x, x.z);
                let (side, end) = (around.length() - radius, x.y.abs() - half_height);
                if side >= end {
                    let out = around.normalize_or(Vec2::X);
                    (side, Vec3::new(out.x, 0.0, out.y))
                } else {
                    (end, Vec3::Y * x.y.signum())
                }
            }
            PartShape::Cone { half_height, radius } => {
                let around = Vec2::new(x.x, x.z);
                let slope = Vec2::new(2.0 * half_height, *radius).normalize_or(Vec2::X);
                let side = slope.dot(Vec2::new(around.length(), x.y - half_height));
                let base = -half_height - x.y;
                if side >= base {
                    let out = around.normalize_or(Vec2::X) * slope.x;
                    (side, Vec3::new(out.x, slope.y, out.y))
                } else {
                    (base, -Vec3::Y)
                }
            }
            PartShape::HalfSpace { normal } => (normal.dot(x), *normal),
            PartShape::Hull(hull) => {
                let height = |&(normal, offset): &(Vec3, f32)| (normal.dot(x) - offset, normal);
                let higher = |best: (f32, Vec3), next: (f32, Vec3)| if next.0 > best.0 { next } else { best };
                let (height, normal) = hull.planes().iter().map(height).fold((f32::NEG_INFINITY, Vec3::Y), higher);
                (height.min(0.0), normal)
            }
        }
    }
}

impl PlacedPart {
    /// [`ConvexPart::signed_distance`] of the world point `x`, its gradient in the world.
    pub fn signed_distance(&self, x: Vec3) -> (f32, Vec3) {
        let (distance, direction) =
            self.part().signed_distance(self.rotation().transpose() * (x - self.pose().translation));
        (distance, *self.rotation() * direction)
    }
}
