//! How well the flows keep the volume of a closed mesh, against figures that were computed in f64.

use pliant::field::{Integrator, SpringField, path_line};
use pliant::math::Vec3;

use crate::icosphere::icosphere;

/// Signed volume of a closed mesh.
pub fn volume(points: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let corner = |i: u32| points[i as usize].as_dvec3();
    triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
}

#[test]
fn the_flow_of_a_spring_field_keeps_the_volume_of_a_sphere_as_well_as_its_integrator_can() {
    let (points, triangles) = icosphere(4);
    assert_eq!(points.len(), 2562);
    let before = volume(&points, &triangles);
    // |a| / r_o, then for Euler 12, midpoint 6 and RK4 4: volume drift in percent and largest error of a position.
    let table = [
        (0.25, [(0.12, 3.6e-3), (-0.005, 1.2e-4), (-0.007, 5e-7)]),
        (0.5, [(0.44, 1.1e-2), (-0.041, 1.0e-3), (-0.036, 1.2e-5)]),
        (1.0, [(1.0, 3.1e-2), (-0.24, 7.8e-3), (-0.13, 3.5e-4)]),
    ];
    for (stretch, rows) in table {
        let field = SpringField { p: Vec3::ZERO, q: Vec3::X * (1.5 * stretch), radius: 1.5 };
        let flow = |x, integrator, steps| path_line(x, integrator, steps, |x, t| field.velocity(x, t));
        let integrators = [Integrator::Euler, Integrator::Midpoint, Integrator::RungeKutta4];
        for (integrator, (percent, error)) in integrators.into_iter().zip(rows) {
            let moved: Vec<Vec3> = points.iter().map(|&x| flow(x, integrator, integrator.default_steps())).collect();
            let drift = 100.0 * (volume(&moved, &triangles) / before - 1.0);
            let case = format!("{integrator:?} at {stretch}: {drift} %");
            assert!(drift * percent > 0.0 && drift.abs() < 1.3 * f64::abs(percent) + 5e-4, "{case}");
            let worst = points.iter().zip(&moved).map(|(&x, y)| y.distance(flow(x, Integrator::RungeKutta4, 64)));
            let worst = worst.fold(0.0, f32::max);
            // In f32 a dozen evaluations round to about 1e-6 by themselves.
            assert!(worst < 1.3 * error + 1.5e-6, "{case}: position error {worst:e}");
        }
    }
}
