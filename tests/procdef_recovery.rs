//! Any start recovers the rest shape and stays finite.

#[path = "common/tetrahedra.rs"]
#[allow(dead_code)] // it uses a part of it
mod tetrahedra;

use std::sync::Arc;

use fastrand::Rng;
use glam::{DMat3, DVec3, Mat3};
use pliant::math::{Pose, Quat, Vec3};
use pliant::procdef::{ProcDefBody, ProcDefRigBuilder, Stiffness, nearest_rotation};

/// The largest distance of a vertex from its place in the rest shape, laid onto the body as it lies best, in sizes.
fn residual(body: &ProcDefBody) -> f32 {
    let mesh = body.rig().mesh();
    let n = mesh.vertex_count() as f64;
    let mean = |x: &[Vec3]| x.iter().map(|x| x.as_dvec3()).sum::<DVec3>() / n;
    let (c0, c) = (mean(&mesh.positions), mean(body.positions()));
    let mut a = DMat3::ZERO;
    for (q, x) in mesh.positions.iter().zip(body.positions()) {
        let (q, x) = (q.as_dvec3() - c0, x.as_dvec3() - c);
        a += DMat3::from_cols(x * q.x, x * q.y, x * q.z);
    }
    let r = Mat3::from_quat(nearest_rotation(a.as_mat3(), Quat::IDENTITY)).as_dmat3();
    let places = mesh.positions.iter().map(|q| r * (q.as_dvec3() - c0) + c);
    let worst = places.zip(body.positions()).map(|(p, x)| p.distance(x.as_dvec3())).fold(0.0, f64::max);
    worst as f32 / body.rig().size()
}

#[derive(Clone, Copy, Debug)]
enum Start {
    Point,
    Line,
    Plane,
    Mirrored,
    Random(u64),
}

fn started(body: &mut ProcDefBody, start: Start) {
    let mut rng = Rng::with_seed(match start {
        Start::Random(seed) => seed,
        _ => 0,
    });
    for x in body.positions_mut() {
        *x = match start {
            Start::Point => Vec3::ZERO,
            Start::Line => *x * Vec3::X,
            Start::Plane => *x * Vec3::new(1.0, 0.0, 1.0),
            Start::Mirrored => *x * Vec3::new(1.0, -1.0, 1.0),
            Start::Random(_) => Vec3::new(rng.f32(), rng.f32(), rng.f32()) - 0.5,
        };
    }
}

#[test]
fn from_a_point_a_line_a_plane_inside_out_and_at_random_the_rest_shape_comes_back() {
    let meshes = [
        tetrahedra::ball(5, 0.5),
        tetrahedra::block([10, 3, 3], Vec3::new(1.0, 0.3, 0.3)),
        tetrahedra::block([20, 2, 2], Vec3::new(2.0, 0.2, 0.2)),
        tetrahedra::bell([6, 6, 2], 0.5, 0.15),
    ];
    let starts = [Start::Point, Start::Line, Start::Plane, Start::Mirrored, Start::Random(1), Start::Random(2)];
    for mesh in meshes {
        let rig = Arc::new(ProcDefRigBuilder::new(mesh).build().unwrap());
        for stiffness in
            [Stiffness::Iterations(1), Stiffness::Iterations(4), Stiffness::Solve(0.5), Stiffness::Solve(1.0)]
        {
            for start in starts {
                let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
                body.settings.stiffness = stiffness;
                started(&mut body, start);
                // Half a minute; the long worm at N = 1 untangles slowest, within 17 s.
                for _ in 0..1800 {
                    body.step(&[], 1.0 / 60.0, Vec3::ZERO, None);
                }
                let left = residual(&body);
                assert!(left < 1e-3, "{} vertices, {stiffness:?}, {start:?}: {left}", rig.mesh().vertex_count());
                assert!(rig.mesh().volumes_at(body.positions()).iter().all(|v| *v > 0.0));
            }
        }
    }
}

#[test]
fn a_hundred_thousand_steps_from_any_start_stay_finite_and_at_rest() {
    let rig = Arc::new(ProcDefRigBuilder::new(tetrahedra::block([4, 2, 2], Vec3::new(1.0, 0.4, 0.4))).build().unwrap());
    let stiffnesses = [Stiffness::Iterations(2), Stiffness::Solve(0.7), Stiffness::Solve(1.0)];
    for stiffness in stiffnesses {
        for start in [Start::Point, Start::Line, Start::Plane, Start::Mirrored, Start::Random(3)] {
            let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
            body.settings.stiffness = stiffness;
            body.settings.damping = 1.0;
            started(&mut body, start);
            for _ in 0..100_000 {
                body.step(&[], 1.0 / 60.0, Vec3::ZERO, None);
            }
            let left = residual(&body);
            assert!(left < 1e-3, "{stiffness:?}, {start:?}: {left}");
            // It started at rest as a whole. Rounding of 1e-8 m/s a step, in random directions, grows with the root of the steps.
            let fastest = body.velocities().iter().map(|v| v.length()).fold(0.0, f32::max);
            assert!(fastest < 1e-2, "{stiffness:?}, {start:?}: {fastest}");
        }
    }
}

#[test]
fn positions_that_are_not_finite_do_not_panic() {
    let rig = Arc::new(ProcDefRigBuilder::new(tetrahedra::block([2, 2, 2], Vec3::ONE)).build().unwrap());
    for stiffness in [Stiffness::Iterations(3), Stiffness::Solve(0.5), Stiffness::Solve(f32::NAN)] {
        for bad in [f32::NAN, f32::INFINITY, 1e30, 1e-30] {
            let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
            body.settings.stiffness = stiffness;
            body.positions_mut()[3].x = bad;
            for h in [1.0 / 60.0, 0.0, f32::NAN] {
                body.step(&[Mat3::NAN; 27], h, Vec3::ZERO, None);
            }
        }
    }
}
