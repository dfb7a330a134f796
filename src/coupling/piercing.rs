//! Triangles that a tip or an edge pierces between their vertices.
//!
//! The signed distance of a convex part is a convex function, so on a triangle it has one lowest value: the deepest
//! point of the triangle in the part.

use super::skin_point::SkinPoint;
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
