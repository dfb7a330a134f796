//! What matching keeps and where it leads: momentum, rigid motion, local deformations that agree.

#[path = "common/tetrahedra.rs"]
#[allow(dead_code)] // it uses a part of it
mod tetrahedra;

use std::sync::Arc;

use fastrand::Rng;
use glam::{DMat3, DVec3, Mat3};
use pliant::math::{Pose, Quat, Vec3};
use pliant::procdef::{ProcDefBody, ProcDefRig, ProcDefRigBuilder, Stiffness, nearest_rotation};

const H: f32 = 1.0 / 60.0;
const ALL: [Stiffness; 6] = [
    Stiffness::Iterations(1),
    Stiffness::Iterations(2),
    Stiffness::Iterations(6),
    Stiffness::Solve(0.1),
    Stiffness::Solve(0.7),
    Stiffness::Solve(1.0),
];

fn rigs() -> Vec<Arc<ProcDefRig>> {
    let meshes = [
        tetrahedra::ball(5, 0.5),
        tetrahedra::block([10, 3, 2], Vec3::new(1.0, 0.3, 0.2)),
        tetrahedra::bell([6, 6, 2], 0.5, 0.15),
    ];
    let mut rigs: Vec<_> =
        meshes.iter().map(|m| Arc::new(ProcDefRigBuilder::new(m.clone()).build().unwrap())).collect();
    // Masses that differ by a factor of ten.
    let mut rng = Rng::with_seed(9);
    let masses = (0..meshes[0].vertex_count()).map(|_| 0.1 + 0.9 * rng.f32()).collect();
    rigs.push(Arc::new(ProcDefRigBuilder::new(meshes[0].clone()).masses(masses).build().unwrap()));
    rigs
}

fn between(rng: &mut Rng, low: f32, high: f32) -> f32 {
    low + (high - low) * rng.f32()
}

fn in_cube(rng: &mut Rng, half: f32) -> Vec3 {
    Vec3::new(between(rng, -half, half), between(rng, -half, half), between(rng, -half, half))
}

fn pose(rng: &mut Rng, half: f32) -> Pose {
    let q = Quat::from_xyzw(between(rng, -1.0, 1.0), between(rng, -1.0, 1.0), between(rng, -1.0, 1.0), 0.3);
    Pose::from_parts(in_cube(rng, half), q.normalize())
}

/// A symmetric deformation with factors between 1/2 and 2.
fn deformation(rng: &mut Rng) -> Mat3 {
    let d = Mat3::from_quat(pose(rng, 1.0).rotation);
    let factors = in_cube(rng, 1.0).exp2();
    d * Mat3::from_diagonal(factors) * d.transpose()
}

#[test]
fn matching_keeps_linear_and_angular_momentum_over_random_bodies_and_states() {
    let mut rng = Rng::with_seed(1);
    for rig in rigs() {
        let n = rig.mesh().vertex_count();
        for stiffness in ALL {
            for disorder in [0.02, 0.2, 1.0] {
                let start = pose(&mut rng, 2.0);
                let mut body = ProcDefBody::new(rig.clone(), &start);
                body.settings.stiffness = stiffness;
                body.positions_mut().iter_mut().for_each(|x| *x += in_cube(&mut rng, disorder));
                let local: Vec<Mat3> = (0..n).map(|_| deformation(&mut rng)).collect();
                let pulls = body.pulls(&local, H).to_vec();
                let masses = rig.masses().iter().map(|&m| f64::from(m));
                let centre = masses.clone().zip(body.positions()).map(|(m, x)| x.as_dvec3() * m).sum::<DVec3>()
                    / masses.clone().sum::<f64>();
                let (mut linear, mut angular, mut ways, mut turns) = (DVec3::ZERO, DVec3::ZERO, 0.0, 0.0);
                for ((m, x), pull) in masses.zip(body.positions()).zip(&pulls) {
                    let (r, d) = (x.as_dvec3() - centre, pull.as_dvec3());
                    linear += d * m;
                    angular += r.cross(d) * m;
                    ways += m * d.length();
                    turns += m * r.length() * d.length();
                }
                assert!(linear.length() < 1e-5 * ways, "{stiffness:?} {disorder}: {:e}", linear.length() / ways);
                assert!(angular.length() < 1e-5 * turns, "{stiffness:?} {disorder}: {:e}", angular.length() / turns);
            }
        }
    }
}

#[test]
fn a_body_that_is_only_moved_and_turned_stays_where_it_is() {
    let mut rng = Rng::with_seed(2);
    for rig in rigs() {
        for stiffness in ALL {
            let start = pose(&mut rng, 1.0);
            let mut body = ProcDefBody::new(rig.clone(), &start);
            body.settings.stiffness = stiffness;
            // The rotations are remembered from elsewhere.
            let other = pose(&mut rng, 1.0);
            for (x, &q) in body.positions_mut().iter_mut().zip(&rig.mesh().positions) {
                *x = other * q;
            }
            let local = vec![Mat3::IDENTITY; rig.mesh().vertex_count()];
            for pull in body.pulls(&local, H) {
                // Rounding of coordinates up to 2 m.
                assert!(pull.length() < 3e-6, "{stiffness:?}: {:e}", pull.length());
            }
        }
    }
}

#[test]
fn a_flight_with_spin_is_not_slowed_by_damping() {
    let rig = &rigs()[1];
    let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
    body.settings.damping = 50.0;
    let spin = Vec3::new(0.0, 0.0, 0.5);
    let positions = body.positions().to_vec();
    for (v, x) in body.velocities_mut().iter_mut().zip(&positions) {
        *v = Vec3::X + spin.cross(*x);
    }
    let momentum = |body: &ProcDefBody| {
        let all = || rig.masses().iter().map(|&m| f64::from(m)).zip(body.positions()).zip(body.velocities());
        let total: f64 = all().map(|((m, _), _)| m).sum();
        let centre = all().map(|((m, x), _)| x.as_dvec3() * m).sum::<DVec3>() / total;
        all().fold((DVec3::ZERO, DVec3::ZERO), |(p, l), ((m, x), v)| {
            let part = v.as_dvec3() * m;
            (p + part, l + (x.as_dvec3() - centre).cross(part))
        })
    };
    let before = momentum(&body);
    for _ in 0..600 {
        body.step(&[], H, Vec3::ZERO, None);
    }
    let after = momentum(&body);
    // Rounding of positions up to 10 m, 600 times.
    assert!(after.0.distance(before.0) < 1e-4 * before.0.length(), "{} {}", after.0, before.0);
    assert!(after.1.distance(before.1) < 1e-3 * before.1.length(), "{} {}", after.1, before.1);
}

#[test]
fn one_deformation_for_all_regions_becomes_that_of_the_whole_body() {
    let mut rng = Rng::with_seed(4);
    for rig in rigs() {
        for stiffness in ALL {
            let mut body = ProcDefBody::new(rig.clone(), &pose(&mut rng, 0.1));
            body.settings.stiffness = stiffness;
            let t = deformation(&mut rng);
            let local = vec![t; rig.mesh().vertex_count()];
            // The softest bell creeps longest, for 45 s.
            for _ in 0..4000 {
                body.step(&local, H, Vec3::ZERO, None);
            }
            // What moves as a whole goes on moving: only the shape counts.
            let off = distance_from(&body, |q| t * q);
            assert!(off < 1e-4 * rig.size(), "{stiffness:?}: {:e} of {}", off, rig.size());
        }
    }
}

/// The largest distance of a vertex from its place in the deformed rest shape, laid onto the body as it lies best.
fn distance_from(body: &ProcDefBody, shape: impl Fn(Vec3) -> Vec3) -> f32 {
    let n = body.positions().len() as f64;
    let shape: Vec<DVec3> = body.rig().mesh().positions.iter().map(|&q| shape(q).as_dvec3()).collect();
    let c0 = shape.iter().sum::<DVec3>() / n;
    let c = body.positions().iter().map(|x| x.as_dvec3()).sum::<DVec3>() / n;
    let mut a = DMat3::ZERO;
    for (q, x) in shape.iter().zip(body.positions()) {
        let (q, x) = (*q - c0, x.as_dvec3() - c);
        a += DMat3::from_cols(x * q.x, x * q.y, x * q.z);
    }
    let r = Mat3::from_quat(nearest_rotation(a.as_mat3(), Quat::IDENTITY)).as_dmat3();
    let off = shape.iter().zip(body.positions()).map(|(q, x)| (r * (*q - c0) + c).distance(x.as_dvec3()));
    off.fold(0.0, f64::max) as f32
}

#[test]
fn what_the_regions_remember_does_not_decide_where_they_go() {
    // From any remembered rotations the same goals come out, because the best rotation is unique.
    let mut rng = Rng::with_seed(5);
    let rig = &rigs()[0];
    let mut goals = Vec::new();
    let jitter: Vec<Vec3> = (0..rig.mesh().vertex_count()).map(|_| in_cube(&mut rng, 0.02)).collect();
    for start in [Pose::IDENTITY, pose(&mut rng, 1.0), pose(&mut rng, 1.0)] {
        let mut body = ProcDefBody::new(rig.clone(), &start);
        for ((x, &q), &j) in body.positions_mut().iter_mut().zip(&rig.mesh().positions).zip(&jitter) {
            *x = q + j;
        }
        goals.push(body.pulls(&[], H).to_vec());
    }
    for (a, b) in goals[0].iter().zip(goals[1].iter().chain(&goals[2])) {
        assert!(a.distance(*b) < 2e-6);
    }
}

#[test]
fn a_crowd_has_the_same_bits_for_any_number_of_threads() {
    use rayon::prelude::*;
    let rig = &rigs()[1];
    let crowd = |threads: usize| {
        let mut rng = Rng::with_seed(6);
        let mut bodies: Vec<ProcDefBody> =
            (0..9).map(|_| ProcDefBody::new(rig.clone(), &pose(&mut rng, 1.0))).collect();
        for (body, stiffness) in bodies.iter_mut().zip(ALL.into_iter().cycle()) {
            body.settings.stiffness = stiffness;
            body.settings.keep_volume = true;
            body.positions_mut().iter_mut().for_each(|x| *x += in_cube(&mut rng, 0.05));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            bodies.par_iter_mut().for_each(|body| (0..20).for_each(|_| body.step(&[], H, Vec3::NEG_Y, None)));
        });
        bodies.iter().flat_map(|b| b.positions().iter().map(|x| x.to_array().map(f32::to_bits))).collect::<Vec<_>>()
    };
    assert_eq!(crowd(1), crowd(3));
}

#[test]
fn bad_masses_and_densities_are_refused() {
    let mesh = tetrahedra::block([1, 1, 1], Vec3::ONE);
    let message = |b: &mut ProcDefRigBuilder| b.build().unwrap_err().to_string();
    let new = || ProcDefRigBuilder::new(mesh.clone());
    assert!(message(new().density(0.0)).contains("density"));
    assert!(message(new().density(f32::NAN)).contains("density"));
    assert!(message(new().masses(vec![1.0])).contains("1 masses were given for a mesh of 8"));
    assert!(message(new().masses(vec![1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0])).contains("vertex 2"));
    let tiny = tetrahedra::block([1, 1, 1], Vec3::splat(1e-8));
    assert!(message(&mut ProcDefRigBuilder::new(tiny)).contains("size"));
}
