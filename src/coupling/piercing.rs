//! Triangles that a tip or an edge pierces between their vertices.
//!
//! The signed distance of a convex part is a convex function, so on a triangle it has one lowest value: the deepest
//! point of the triangle in the part.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::obstacle::ObstaclePart;
use super::skin_point::SkinPoint;
use crate::elastic::ElasticBody;
use crate::field::PlacedPart;
use crate::math::Vec3;

/// The point of a triangle that is deepest in a part: its barycentric coordinates and its signed distance.
///
/// A bisection on the slope within a golden section search across.
pub fn deepest_on_triangle(part: &PlacedPart, [a, b, c]: [Vec3; 3]) -> ([f32; 3], f32) {
    let across = |u: f32| {
        // The line at `u` of the way from c to the edge ab.
        let (from, to) = (c.lerp(a, u), c.lerp(b, u));
        let (v, height) = deepest_on_segment(part, from, to);
        (v, height)
    };
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    let mut left = high - GOLDEN * (high - low);
    let mut right = low + GOLDEN * (high - low);
    let (mut at_left, mut at_right) = (across(left), across(right));
    let mut best = (0.0, 0.0, part.signed_distance(c).0);
    let edge = across(1.0);
    if edge.1 < best.2 {
        best = (1.0, edge.0, edge.1);
    }
    for _ in 0..SECTIONS {
        let (u, (v, height)) = if at_left.1 < at_right.1 { (left, at_left) } else { (right, at_right) };
        if height < best.2 {
            best = (u, v, height);
        }
        if at_left.1 < at_right.1 {
            high = right;
            (right, at_right) = (left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = across(left);
        } else {
            low = left;
            (left, at_left) = (right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = across(right);
        }
    }
    let (u, v, height) = best;
    ([u * (1.0 - v), u * v, 1.0 - u], height)
}

const GOLDEN: f32 = 0.618_034;
const SECTIONS: usize = 14;
const BISECTIONS: usize = 12;

/// The lowest signed distance on a segment, and where on it.
fn deepest_on_segment(part: &PlacedPart, a: Vec3, b: Vec3) -> (f32, f32) {
    let along = b - a;
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    let mut best = (0.0, f32::INFINITY);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let (height, gradient) = part.signed_distance(a + along * middle);
        if height < best.1 {
            best = (middle, height);
        }
        if gradient.dot(along) > 0.0 { high = middle } else { low = middle }
    }
    for end in [0.0, 1.0] {
        let height = part.signed_distance(a + along * end).0;
        if height < best.1 {
            best = (end, height);
        }
    }
    best
}

/// The signed distance of a vertex and its gradient.
pub type Height = (f32, Vec3);

/// The deepest point of a triangle, where it lies more than `tolerance` inside and deeper than all corners by that much.
///
/// `heights` are the signed distances at the corners: their tangent planes bound the distance from below, so that
/// triangles beside a flat face need no search.
pub fn pierced(
    part: &PlacedPart,
    vertices: [u32; 3],
    corners: [Vec3; 3],
    heights: [Height; 3],
    tolerance: f32,
) -> Option<(SkinPoint, f32)> {
    let lowest_corner = heights.iter().map(|h| h.0).fold(f32::INFINITY, f32::min);
    let below = (lowest_corner - tolerance).min(-tolerance);
    let bound = |(at, (height, gradient)): (&Vec3, &Height)| {
        corners.iter().map(|x| height + gradient.dot(*x - *at)).fold(f32::INFINITY, f32::min)
    };
    if corners.iter().zip(&heights).any(|corner| bound(corner) >= below) {
        return None;
    }
    let (weights, height) = deepest_on_triangle(part, corners);
    (height < below).then_some((SkinPoint { vertices, weights }, -height))
}

/// How deep `x` is in a part, negative outside.
pub fn signed_depth(part: &ObstaclePart, x: Vec3) -> f32 {
    -part.placed.signed_distance(x).0
}

/// The deepest point of any triangle of the skin in a part, in metres; 0 where the skin is outside.
pub fn deepest_piercing(body: &ElasticBody, part: &ObstaclePart) -> f32 {
    let x = body.positions();
    let depth = |t: &[u32; 3]| {
        let corners = t.map(|v| x[v as usize]);
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        if !part.aabb.intersects(&Aabb::new(low, high)) {
            return 0.0;
        }
        -deepest_on_triangle(&part.placed, corners).1
    };
    body.rig().mesh.triangles.par_iter().with_min_len(512).map(depth).reduce(|| 0.0, f32::max)
}
