//! Random vectors, poses and convex parts from a seeded generator.

use std::sync::Arc;

use fastrand::Rng;
use pliant::field::{ConvexHull, ConvexPart, PartShape};
use pliant::math::{Pose, Quat, Vec3};

/// A number in `[low, high)`.
pub fn between(rng: &mut Rng, low: f32, high: f32) -> f32 {
    low + (high - low) * rng.f32()
}

/// A point in the cube of half width `half`.
pub fn in_cube(rng: &mut Rng, half: f32) -> Vec3 {
    Vec3::new(between(rng, -half, half), between(rng, -half, half), between(rng, -half, half))
}

/// A unit vector, every direction alike.
pub fn direction(rng: &mut Rng) -> Vec3 {
    loop {
        let v = in_cube(rng, 1.0);
        if v.length_squared() > 0.01 && v.length_squared() < 1.0 {
            return v.normalize();
        }
    }
}

/// A rotation, every one alike.
pub fn rotation(rng: &mut Rng) -> Quat {
    Quat::from_rotation_arc(Vec3::Y, direction(rng)) * Quat::from_rotation_y(between(rng, 0.0, std::f32::consts::TAU))
}

/// A pose whose translation lies in the cube of half width `half`.
pub fn pose(rng: &mut Rng, half: f32) -> Pose {
    let translation = in_cube(rng, half);
    Pose::from_parts(translation, rotation(rng))
}

/// How many kinds of shapes [`shape`] knows.
pub const SHAPES: usize = 7;

/// A shape of the given kind, of about the size 1: all kinds of [`PartShape`] in turn.
pub fn shape(rng: &mut Rng, kind: usize) -> PartShape {
    let (half_height, radius) = (between(rng, 0.1, 0.6), between(rng, 0.1, 0.6));
    match kind % SHAPES {
        0 => PartShape::Point,
        1 => PartShape::Segment { a: in_cube(rng, 0.6), b: in_cube(rng, 0.6) },
        2 => PartShape::Cuboid { half_extents: Vec3::splat(0.1) + in_cube(rng, 0.5).abs() },
        3 => PartShape::Cylinder { half_height, radius },
        4 => PartShape::Cone { half_height, radius },
        5 => PartShape::HalfSpace { normal: direction(rng) },
        _ => {
            let points: Vec<Vec3> = (0..rng.usize(8..24)).map(|_| in_cube(rng, 0.6)).collect();
            PartShape::Hull(Arc::new(ConvexHull::from_points(&points).expect("random points span a volume")))
        }
    }
}

/// A part of the given kind; every second one is rounded, a point always.
pub fn part(rng: &mut Rng, kind: usize) -> ConvexPart {
    let rounding = if kind.is_multiple_of(SHAPES) || rng.bool() { between(rng, 0.05, 0.3) } else { 0.0 };
    ConvexPart { shape: shape(rng, kind), rounding }
}
