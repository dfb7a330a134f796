//! A ring: a round bar bent to a circle, as a chain of capsules; and the same chain as one smooth surface.

use std::f32::consts::TAU;

use pliant::math::{Pose, Vec3};
use rapier3d::geometry::SharedShape;

/// Straight pieces of the circle: chord and arc of the bar's axis differ by 0.5 % of the radius.
const PIECES: usize = 32;
/// Points around the bar of the surface.
const AROUND: usize = 24;

/// The chain of capsules around the y axis whose opening has the inner radius `radius`; the bar's own is `thickness`.
pub fn ring(radius: f32, thickness: f32) -> SharedShape {
    let corners = corners(radius, thickness);
    let piece = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % PIECES]);
        (Pose::IDENTITY, SharedShape::capsule(a, b, thickness))
    };
    SharedShape::compound((0..PIECES).map(piece).collect())
}

/// Where the straight pieces of the bar's axis meet: their middles are as far out as leaves the opening free.
fn corners(radius: f32, thickness: f32) -> [Vec3; PIECES] {
    let out = (radius + thickness) / (0.5 * TAU / PIECES as f32).cos();
    std::array::from_fn(|i| {
        let (sin, cos) = (TAU * i as f32 / PIECES as f32).sin_cos();
        Vec3::new(out * sin, 0.0, out * cos)
    })
}

/// The chain's cylinders as one closed surface, mitred where they meet, with normals of a round ring: positions, normals
/// and triangles.
pub fn ring_surface(radius: f32, thickness: f32) -> (Vec<Vec3>, Vec<Vec3>, Vec<[u32; 3]>) {
    let mitre = 1.0 / (0.5 * TAU / PIECES as f32).cos();
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (i, corner) in corners(radius, thickness).into_iter().enumerate() {
        let out = corner.normalize_or_zero();
        for j in 0..AROUND {
            let (sin, cos) = (TAU * j as f32 / AROUND as f32).sin_cos();
            positions.push(corner + (out * (cos * mitre) + Vec3::Y * sin) * thickness);
            normals.push(out * cos + Vec3::Y * sin);
            let at = |i: usize, j: usize| ((i % PIECES) * AROUND + j % AROUND) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (positions, normals, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_opening_of_the_ring_is_as_wide_as_it_says_and_the_bar_as_thick() {
        let ring = ring(0.5, 0.1);
        let inside = |p: Vec3| ring.contains_local_point(p);
        for i in 0..64 {
            let (sin, cos) = (TAU * i as f32 / 64.0).sin_cos();
            let out = Vec3::new(sin, 0.0, cos);
            assert!(!inside(out * 0.499) && inside(out * 0.51) && inside(out * 0.695) && !inside(out * 0.71));
            assert!(inside(out * 0.6 + Vec3::Y * 0.095) && !inside(out * 0.6 + Vec3::Y * 0.101));
        }
    }

    #[test]
    fn the_surface_that_is_shown_is_that_of_the_chain_and_faces_outward() {
        let chain = ring(0.5, 0.1);
        let (positions, normals, triangles) = ring_surface(0.5, 0.1);
        let mut volume = 0.0;
        for t in triangles {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            volume += a.dot(b.cross(c)) / 6.0;
            assert!((b - a).cross(c - a).dot(normals[t[0] as usize]) > 0.0);
            let middle = (a + b + c) / 3.0;
            let apart = chain.distance_to_local_point(middle, false);
            // Flat triangles of a bar with 24 sides lie 0.9 % of its radius below it; the mitres stand out a little.
            assert!(apart.abs() < 1.5e-3, "{middle}: {apart}");
        }
        let torus = TAU * 0.6 * 0.5 * TAU * 0.01;
        assert!((volume / torus - 1.0).abs() < 0.03, "{volume} {torus}");
    }
}
