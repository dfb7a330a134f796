//! The collision field that hugs a part keeps everything out of it, and squashes what meets a floor.

use fastrand::Rng;
use pliant::field::{
    ConvexPart, HuggingField, Integrator, Lipschitz, PartShape, Patch, PlacedPart, Spread, certified_steps, path_line,
};
use pliant::math::{Pose, Vec3};

use crate::icosphere::icosphere;
use crate::random::{SHAPES, in_cube};
use crate::samples::hugging_field;
use crate::volume::volume;

#[test]
fn nothing_that_starts_outside_the_shifted_part_ends_inside_the_part() {
    let mut rng = Rng::with_seed(12);
    let mut swept_by_all = 0;
    for kind in 0..8 * SHAPES {
        let mut field = hugging_field(&mut rng, kind);
        field.extent = 4.0;
        // Beside a patch the field does not carry anything out of the part.
        field.patch = Patch::EVERYWHERE;
        let (mut pushed, mut swept) = (0, 0);
        for integrator in [Integrator::Euler, Integrator::Midpoint, Integrator::RungeKutta4] {
            let steps = certified_steps(field.lipschitz(), integrator.default_steps());
            for _ in 0..1000 {
                let x = field.gauge + in_cube(&mut rng, 1.2);
                let start = field.part.distance(x + field.d).0;
                // Coordinates of a few metres and some dozen steps round to about 1e-5.
                if start < 1e-4 {
                    continue;
                }
                let end = path_line(x, integrator, steps, |x, t| field.velocity(x, t));
                assert!(field.part.distance(end).0 > 0.0, "{x} started {start} outside of {:?}", field.part.part());
                pushed += u32::from(start < field.width);
                swept += u32::from(field.part.distance(x).0 == 0.0);
            }
        }
        assert!(pushed > 100, "{pushed} points near {:?}", field.part.part());
        swept_by_all += swept;
    }
    assert!(swept_by_all > 1000, "{swept_by_all} points were in the way of a part");
}

#[test]
fn the_part_itself_moves_rigidly_within_the_patch() {
    let mut rng = Rng::with_seed(11);
    for kind in 0..3 * SHAPES {
        let field = hugging_field(&mut rng, kind);
        for _ in 0..300 {
            let x = field.gauge + in_cube(&mut rng, 1.2);
            let beside = (x + field.d).distance(field.patch.centre) > field.patch.radius;
            if field.part.distance(x + field.d).0 == 0.0 && !beside {
                let end = path_line(x, Integrator::Midpoint, 6, |x, t| field.velocity(x, t));
                assert!(end.distance(x + field.d) < 3e-6, "{end} {}", x + field.d);
            }
        }
    }
}

/// What a floor does to the unit sphere that it penetrates by `depth`: how deep a vertex is left in the floor, the width
/// of the sphere and its change of volume in percent.
fn pressed(depth: f32, width: f32) -> (f32, f32, f64) {
    let (points, triangles) = icosphere(4);
    let top = depth - 1.0;
    let part = ConvexPart { shape: PartShape::HalfSpace { normal: Vec3::Y }, rounding: 0.0 };
    let part = PlacedPart::new(part, Pose::from_translation(Vec3::Y * top));
    // The gauge point lies on the exit face, over the depth-weighted mean of the vertices in the floor.
    let field = HuggingField {
        part,
        d: Vec3::Y * depth,
        gauge: Vec3::Y * top,
        width,
        spread: Spread::EVEN,
        patch: Patch::EVERYWHERE,
        extent: 2.0,
    };
    let moved: Vec<Vec3> =
        points.iter().map(|&x| path_line(x, Integrator::Midpoint, 12, |x, t| field.velocity(x, t))).collect();
    let lowest = moved.iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
    let (left, right) = moved.iter().fold((0.0_f32, 0.0_f32), |(a, b), x| (a.min(x.x), b.max(x.x)));
    let change = 100.0 * (volume(&moved, &triangles) / volume(&points, &triangles) - 1.0);
    ((top - lowest).max(0.0), right - left, change)
}

#[test]
fn a_floor_squashes_the_unit_sphere_and_leaves_it_its_volume() {
    // The fade-out width is 1.2 times the radius: the softness s = 1.2 with the radius as the body's size.
    for (depth, width, volume_error) in [(0.1, 2.10, 0.005), (0.3, 2.48, 0.025), (0.5, 2.93, 0.045)] {
        let (residual, measured, change) = pressed(depth, 1.2);
        assert!(residual < 1e-6, "{residual} left at the depth {depth}");
        assert!((measured - width).abs() < 0.012, "{measured} wide at the depth {depth}");
        assert!(change.abs() < volume_error, "{change} % at the depth {depth}");
    }
}
