//! Where path lines lead.

use fastrand::Rng;
use pliant::field::{Integrator, SpringField, path_line};
use pliant::math::Vec3;

use crate::random::{between, direction, in_cube};

const ALL: [Integrator; 3] = [Integrator::Euler, Integrator::Midpoint, Integrator::RungeKutta4];

fn random_spring(rng: &mut Rng) -> SpringField {
    let p = in_cube(rng, 1.0);
    let radius = between(rng, 0.3, 2.0);
    SpringField { p, q: p + direction(rng) * (radius * between(rng, 0.05, 1.5)), radius }
}

#[test]
fn one_spring_field_carries_p_to_q_with_every_integrator() {
    let mut rng = Rng::with_seed(8);
    for _ in 0..500 {
        let field = random_spring(&mut rng);
        for integrator in ALL {
            let end = path_line(field.p, integrator, integrator.default_steps(), |x, t| field.velocity(x, t));
            // The velocity at the moving centre is constant: every rule is exact there but for rounding.
            assert!(end.distance(field.q) < 2e-6, "{integrator:?}: {end} instead of {}", field.q);
        }
    }
}

#[test]
fn a_point_that_no_sphere_on_the_segment_reaches_does_not_move() {
    let mut rng = Rng::with_seed(9);
    let (mut outside, mut moved) = (0, 0);
    for _ in 0..5000 {
        let field = random_spring(&mut rng);
        let x = field.p + in_cube(&mut rng, 1.5 * field.radius);
        let along = ((x - field.p).dot(field.q - field.p) / (field.q - field.p).length_squared()).clamp(0.0, 1.0);
        let distance = x.distance(field.p + (field.q - field.p) * along);
        for integrator in ALL {
            let end = path_line(x, integrator, integrator.default_steps(), |x, t| field.velocity(x, t));
            if distance > field.radius * 1.000_01 {
                assert_eq!(end, x, "{integrator:?} {field:?}");
                outside += 1;
            } else {
                moved += u32::from(end != x);
            }
        }
        if (distance - field.radius).abs() > 1e-5 {
            assert_eq!(field.reaches(x), distance < field.radius, "{field:?} {x}");
        }
    }
    assert!(outside > 1000 && moved > 1000, "{outside} outside, {moved} moved: both cases must occur");
}

#[test]
fn every_integrator_converges_with_its_own_order() {
    let field = SpringField { p: Vec3::ZERO, q: Vec3::new(0.9, 0.3, 0.0), radius: 1.2 };
    let x = Vec3::new(0.2, 0.5, 0.3);
    let end = |integrator, steps| path_line(x, integrator, steps, |x, t| field.velocity(x, t));
    let fine = end(Integrator::RungeKutta4, 64);
    for (integrator, steps, gain) in
        [(Integrator::Euler, 32, 2.0), (Integrator::Midpoint, 8, 4.0), (Integrator::RungeKutta4, 3, 16.0)]
    {
        let ratio = end(integrator, steps).distance(fine) / end(integrator, 2 * steps).distance(fine);
        assert!(ratio > gain * 0.7 && ratio < gain * 2.0, "{integrator:?}: halving the step gains {ratio}");
    }
}
