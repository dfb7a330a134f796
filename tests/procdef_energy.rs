//! Bodies that are left alone gain no energy: neither the matching nor the global solve drives a swing.

use std::path::Path;
use std::sync::Arc;

use fastrand::Rng;
use glam::DVec3;
use pliant::coupling::procdef::{WaterRegion, act_of_water};
use pliant::math::{Pose, Vec3};
use pliant::procdef::{ProcDefBody, ProcDefModel, ProcDefRig, Stiffness, load_motion_rig};

fn model(name: &str) -> ProcDefModel {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/rigs/{name}.toml"));
    ProcDefModel::from_file(&load_motion_rig(path).unwrap()).unwrap()
}

fn rig(name: &str) -> Arc<ProcDefRig> {
    model(name).rig
}

/// A push of every vertex in a random direction.
fn push(rng: &mut Rng, speed: f32) -> Vec3 {
    (Vec3::new(rng.f32(), rng.f32(), rng.f32()) - 0.5) * (2.0 * speed)
}

fn kinetic(body: &ProcDefBody) -> f64 {
    let parts = body.velocities().iter().zip(body.rig().masses());
    parts.map(|(v, m)| 0.5 * f64::from(*m) * f64::from(v.length_squared())).sum()
}

/// The greatest kinetic energy from 1.5 to 2 seconds after a random push of up to `speed` m/s on every vertex, beside that from 0.5
/// to 1; nothing is damped. Modes that the solve slows down have more of it at some times than at the start; a swing that is driven
/// grows all the time.
fn growth(rig: &Arc<ProcDefRig>, stiffness: Stiffness, h: f32, speed: f32) -> f64 {
    let mut rng = Rng::with_seed(3);
    let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
    (body.settings.stiffness, body.settings.damping) = (stiffness, 0.0);
    for v in body.velocities_mut() {
        *v = push(&mut rng, speed);
    }
    let quarter = (0.5 / h) as usize;
    let mut most = [0.0f64; 4];
    for step in 0..4 * quarter {
        body.step(&[], h, Vec3::ZERO, None);
        most[step / quarter] = most[step / quarter].max(kinetic(&body));
    }
    most[3] / most[1]
}

#[test]
fn no_body_swings_higher_than_it_was_pushed_at_any_stiffness_and_time_step() {
    for name in ["jellyfish", "small_jellyfish", "worm", "short_worm", "snail", "heart", "bowel", "bending_bar"] {
        let rig = rig(name);
        for stiffness in [0.1, 0.5, 0.7, 0.9, 1.0].map(Stiffness::Solve) {
            for h in [1.0 / 60.0, 1.0 / 240.0] {
                let growth = growth(&rig, stiffness, h, 0.01);
                assert!(growth < 1.5, "{name}, {stiffness:?}, h {h}: {growth}");
            }
        }
        for passes in [2, 6] {
            let growth = growth(&rig, Stiffness::Iterations(passes), 1.0 / 240.0, 0.01);
            assert!(growth < 1.5, "{name}, {passes} passes: {growth}");
        }
    }
}

#[test]
fn strong_pushes_do_not_drive_a_body_either() {
    for name in ["jellyfish", "worm", "heart", "bending_bar"] {
        let rig = rig(name);
        for stiffness in [0.3, 0.6, 0.9].map(Stiffness::Solve) {
            let growth = growth(&rig, stiffness, 1.0 / 120.0, 1.0);
            assert!(growth < 1.5, "{name}, {stiffness:?}: {growth}");
        }
    }
}

#[test]
fn what_comes_from_outside_spreads_through_a_stiff_body_and_keeps_its_momentum() {
    let rig = rig("jellyfish");
    let momenta = |body: &ProcDefBody, before: &[Vec3]| {
        let changes = body.velocities().iter().zip(before).zip(rig.masses()).zip(body.positions());
        changes.fold([DVec3::ZERO; 2], |[p, l], (((v, b), &m), x)| {
            let part = (v.as_dvec3() - b.as_dvec3()) * f64::from(m);
            [p + part, l + x.as_dvec3().cross(part)]
        })
    };
    let mut rng = Rng::with_seed(8);
    let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
    body.settings.stiffness = Stiffness::Solve(0.7);
    body.positions_mut().iter_mut().for_each(|x| *x += push(&mut rng, 0.01));
    body.drive(&[], 1.0 / 60.0);
    let before = body.velocities().to_vec();
    // One vertex alone gets something; it has to take its surroundings along.
    body.velocities_mut()[7] += Vec3::new(3.0, -1.0, 2.0);
    let wanted = momenta(&body, &before);
    body.spread_changes(&before);
    let found = momenta(&body, &before);
    assert!(found[0].distance(wanted[0]) < 1e-4 * wanted[0].length(), "{found:?} {wanted:?}");
    assert!(found[1].distance(wanted[1]) < 1e-4 * wanted[1].length(), "{found:?} {wanted:?}");
    let change = body.velocities()[7].distance(before[7]);
    assert!(change < 0.5, "{change}");
    // Passes of matching have no such inertia.
    body.settings.stiffness = Stiffness::Iterations(2);
    let before = body.velocities().to_vec();
    body.velocities_mut()[7] += Vec3::X;
    body.spread_changes(&before);
    assert_eq!(body.velocities()[7], before[7] + Vec3::X);
}

#[test]
fn water_drives_no_swing_of_a_body_of_any_stiffness() {
    let ocean = WaterRegion { min: Vec3::splat(-99.0), max: Vec3::splat(99.0), flow: Vec3::ZERO };
    for name in ["jellyfish", "small_jellyfish"] {
        let model = model(name);
        for stiffness in [0.3, 0.6, 0.9, 1.0] {
            for h in [1.0 / 60.0, 1.0 / 240.0] {
                let mut rng = Rng::with_seed(4);
                let mut body = ProcDefBody::new(model.rig.clone(), &Pose::IDENTITY);
                (body.settings.stiffness, body.settings.damping) = (Stiffness::Solve(stiffness), 0.0);
                body.velocities_mut().iter_mut().for_each(|v| *v = push(&mut rng, 0.3));
                let second = (1.0 / h) as usize;
                let mut most = [0.0f64; 4];
                for step in 0..4 * second {
                    body.step(&[], h, Vec3::ZERO, None);
                    act_of_water(&model, &[ocean], Vec3::ZERO, h, &mut body);
                    most[step / second] = most[step / second].max(kinetic(&body));
                }
                // What the solve slows down is hardly felt by the water; it must not grow.
                assert!(most[3] < 1.2 * most[1], "{name}, stiffness {stiffness}, h {h}: {most:?}");
                assert!(model.rig.mesh().volumes_at(body.positions()).iter().all(|v| *v > 0.0), "{name}, {stiffness}");
            }
        }
    }
}

#[test]
fn rounding_does_not_push_a_body_at_rest() {
    for name in ["jellyfish", "bowel"] {
        let rig = rig(name);
        for stiffness in [Stiffness::Iterations(1), Stiffness::Iterations(2), Stiffness::Solve(0.5)] {
            let mut body = ProcDefBody::new(rig.clone(), &Pose::IDENTITY);
            (body.settings.stiffness, body.settings.damping) = (stiffness, 0.0);
            for _ in 0..960 {
                body.step(&[], 1.0 / 480.0, Vec3::ZERO, None);
            }
            let momenta = body.velocities().iter().zip(rig.masses()).map(|(v, &m)| v.as_dvec3() * f64::from(m));
            let mass: f64 = rig.masses().iter().map(|&m| f64::from(m)).sum();
            let speed = momenta.sum::<DVec3>().length() / mass;
            assert!(speed < 1e-5, "{name}, {stiffness:?}: {speed} m/s");
        }
    }
}
