//! The certified step count keeps flows injective, and far fewer steps do not.

use fastrand::Rng;
use pliant::field::{Integrator, Lipschitz, SpringField, certified_steps, path_line};
use pliant::math::Vec3;

use crate::difference::jacobian;
use crate::random::in_cube;
use crate::samples;

const ALL: [Integrator; 3] = [Integrator::Euler, Integrator::Midpoint, Integrator::RungeKutta4];

/// The least Jacobian determinant of any single step of the numerical flow, along the path lines of random points.
///
/// A flow is injective where each of its steps is. Over all steps together the entries of the Jacobian grow with the
/// stretch, and its determinant drowns in rounding.
fn least_determinant(
    velocity: &dyn Fn(Vec3, f32) -> Vec3,
    integrator: Integrator,
    steps: u32,
    width: f32,
    points: impl Iterator<Item = Vec3>,
) -> f32 {
    let h = 1.0 / steps as f32;
    let mut least = f32::INFINITY;
    for mut x in points {
        for i in 0..steps {
            let step = |x| path_line(x, integrator, 1, |x, t| velocity(x, (i as f32 + t) * h) * h);
            least = least.min(jacobian(step, x, width / 200.0).determinant());
            x = step(x);
        }
    }
    least
}

#[test]
fn with_the_certified_count_every_step_keeps_its_orientation_everywhere() {
    let mut rng = Rng::with_seed(16);
    for sample in samples::all(&mut rng) {
        for integrator in ALL {
            let steps = certified_steps(sample.bound, 1);
            let points: Vec<Vec3> = (0..300).map(|_| sample.point(&mut rng)).collect();
            let least = least_determinant(&sample.velocity, integrator, steps, sample.width, points.into_iter());
            assert!(least > 0.0, "{integrator:?} with {steps} steps: {least} in {}", sample.name);
        }
    }
}

#[test]
fn summed_fields_with_the_certified_count_keep_their_orientation() {
    let mut rng = Rng::with_seed(17);
    for _ in 0..10 {
        let fields: Vec<SpringField> = (0..4)
            .map(|_| {
                let p = in_cube(&mut rng, 0.5);
                SpringField { p, q: p + in_cube(&mut rng, 1.0), radius: 0.8 }
            })
            .collect();
        let bound = fields.iter().map(Lipschitz::lipschitz).sum();
        let sum = move |x: Vec3, t: f32| fields.iter().fold(Vec3::ZERO, |sum, field| sum + field.velocity(x, t));
        for integrator in ALL {
            let points: Vec<Vec3> = (0..500).map(|_| in_cube(&mut rng, 1.2)).collect();
            let least = least_determinant(&sum, integrator, certified_steps(bound, 1), 0.8, points.into_iter());
            assert!(least > 0.0, "{integrator:?}: {least}");
        }
    }
}

#[test]
fn the_papers_twelve_euler_steps_fold_a_long_spring_and_the_certified_count_does_not() {
    let field = SpringField { p: Vec3::ZERO, q: Vec3::X * 16.0, radius: 1.0 };
    let velocity = move |x: Vec3, t: f32| field.velocity(x, t);
    let mut rng = Rng::with_seed(18);
    let points: Vec<Vec3> = (0..4000).map(|_| in_cube(&mut rng, 1.0)).collect();
    let certified = certified_steps(field.lipschitz(), 12);
    assert!(certified > 60, "{certified}");
    let folded = least_determinant(&velocity, Integrator::Euler, 12, 1.0, points.iter().copied());
    let whole = least_determinant(&velocity, Integrator::Euler, certified, 1.0, points.iter().copied());
    assert!(folded < 0.0 && whole > 0.0, "twelve steps: {folded}, {certified} steps: {whole}");
}

#[test]
fn one_certified_step_of_every_rule_moves_two_points_less_than_they_are_apart() {
    for i in 1..4000 {
        let bound = i as f32 * 0.017;
        let z = bound / certified_steps(bound, 1) as f32;
        // The growth of the difference of two points in one step of order four; lower orders stop the sum earlier.
        let growth = z + z * z / 2.0 + z.powi(3) / 6.0 + z.powi(4) / 24.0;
        assert!(growth < 1.0, "{bound}: {growth}");
    }
}

#[test]
fn the_count_grows_with_the_bound_without_end() {
    assert_eq!(certified_steps(0.0, 6), 6);
    assert_eq!(certified_steps(1.0e-3, 1), 1);
    assert!(certified_steps(1.0e7, 6) as f32 >= 1.0e7, "a bound that needs more than a million steps says so");
    assert_eq!(certified_steps(f32::INFINITY, 6), u32::MAX);
    assert_eq!(certified_steps(f32::NAN, 6), u32::MAX);
}
