//! Eight points at once move as one point does.

use std::sync::Arc;

use crate::samples::{patch, spread};
use pliant::field::{ConvexHull, ConvexPart, HuggingField, LANES, PartShape, PlacedPart, SpringField, WideVec};
use pliant::math::{Pose, Vec3};

fn random(rng: &mut fastrand::Rng, size: f32) -> Vec3 {
    Vec3::new(rng.f32() - 0.5, rng.f32() - 0.5, rng.f32() - 0.5) * (2.0 * size)
}

fn shapes(rng: &mut fastrand::Rng) -> Vec<PartShape> {
    let points: Vec<Vec3> = (0..60).map(|_| random(rng, 0.6)).collect();
    vec![
        PartShape::Point,
        PartShape::Segment { a: Vec3::new(0.0, -0.5, 0.0), b: Vec3::new(0.1, 0.5, 0.0) },
        PartShape::Cuboid { half_extents: Vec3::new(0.5, 0.2, 0.7) },
        PartShape::Cylinder { half_height: 0.4, radius: 0.3 },
        PartShape::Cone { half_height: 0.4, radius: 0.3 },
        PartShape::HalfSpace { normal: Vec3::new(0.6, 0.8, 0.0) },
        PartShape::Hull(Arc::new(ConvexHull::from_points(&points).expect("a hull"))),
    ]
}

#[test]
fn eight_points_in_a_collision_field_of_any_shape_move_as_each_alone() {
    let mut rng = fastrand::Rng::with_seed(3);
    for shape in shapes(&mut rng) {
        for rounding in [0.0, 0.15] {
            let turn = random(&mut rng, 1.5);
            let pose = Pose::new(random(&mut rng, 1.0), turn);
            let gauge = random(&mut rng, 1.0);
            let d = random(&mut rng, 0.2);
            let field = HuggingField {
                part: PlacedPart::new(ConvexPart { shape: shape.clone(), rounding }, pose),
                d,
                spread: spread(&mut rng, d),
                gauge,
                width: 0.8,
                patch: patch(&mut rng, gauge),
                extent: 2.0,
            };
            for _ in 0..200 {
                let x: [Vec3; LANES] = std::array::from_fn(|_| pose.translation + random(&mut rng, 1.2));
                let t = rng.f32();
                let wide = field.velocity_wide(WideVec::from_lanes(x), t).to_lanes();
                for (x, wide) in x.into_iter().zip(wide) {
                    let alone = field.velocity(x, t);
                    assert!((alone - wide).length() < 2e-5, "{shape:?} at {x}: {alone} and {wide}");
                }
            }
        }
    }
}

#[test]
fn eight_points_in_a_spring_field_move_as_each_alone() {
    let mut rng = fastrand::Rng::with_seed(4);
    for _ in 0..200 {
        let p = random(&mut rng, 1.0);
        let field = SpringField { p, q: p + random(&mut rng, 0.3), radius: 0.4 + rng.f32() };
        let x: [Vec3; LANES] = std::array::from_fn(|_| p + random(&mut rng, 1.0));
        let t = rng.f32();
        let wide = field.velocity_wide(WideVec::from_lanes(x), t).to_lanes();
        for (x, wide) in x.into_iter().zip(wide) {
            assert!((field.velocity(x, t) - wide).length() < 1e-5, "{x}");
        }
    }
}
