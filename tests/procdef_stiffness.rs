//! What stiffness means: the same for any mesh and time step, and as much as many passes.

#[path = "common/tetrahedra.rs"]
#[allow(dead_code)] // it uses a part of it
mod tetrahedra;

use std::sync::Arc;

use pliant::math::{Pose, Vec3};
use pliant::mesh::TetrahedralMesh;
use pliant::procdef::{ProcDefBody, ProcDefRigBuilder, Stiffness, wave_speed};

/// A bar that is stretched along x by `strain` and let go: the time of one swing in seconds.
fn period(mesh: TetrahedralMesh, stiffness: Stiffness, h: f32) -> f32 {
    let rig = Arc::new(ProcDefRigBuilder::new(mesh).build().unwrap());
    let rest = rig.mesh().positions.clone();
    let ends = [f32::total_cmp, |a: &f32, b: &f32| b.total_cmp(a)]
        .map(|order| (0..rest.len()).min_by(|&a, &b| order(&rest[a].x, &rest[b].x)).unwrap());
    let mut body = ProcDefBody::new(rig, &Pose::IDENTITY);
    body.settings.stiffness = stiffness;
    body.settings.damping = 0.0;
    // The lowest mode of a free bar.
    for (x, q) in body.positions_mut().iter_mut().zip(&rest) {
        x.x += 0.02 * (std::f32::consts::PI * q.x).sin();
    }
    let length = |body: &ProcDefBody| body.positions()[ends[1]].x - body.positions()[ends[0]].x - 1.0;
    let mut crossings = Vec::new();
    let mut before = length(&body);
    for step in 1..(20.0 / h) as usize {
        body.step(&[], h, Vec3::ZERO, None);
        let now = length(&body);
        if before > 0.0 && now <= 0.0 {
            crossings.push((step as f32 - 1.0 + before / (before - now)) * h);
            if crossings.len() == 4 {
                break;
            }
        }
        before = now;
    }
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f32
}

fn bar(n: u32) -> TetrahedralMesh {
    tetrahedra::block([4 * n, n, n], Vec3::new(1.0, 0.25, 0.25))
}

#[test]
fn a_stiffness_swings_at_the_speed_of_its_waves_whatever_the_mesh_and_the_time_step() {
    for s in [0.1, 0.3, 0.5, 0.7] {
        // A free bar of length 1: half a wave.
        let exact = 2.0 / (wave_speed(s) * bar(4).size());
        for n in [2, 3, 4, 6] {
            for h in [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0] {
                // Below six steps nothing swings.
                if exact > 6.5 * h {
                    let found = period(bar(n), Stiffness::Solve(s), h);
                    // A mode of a coarse mesh is a little off its continuum's: 2 % were measured at n = 2.
                    assert!((found / exact - 1.0).abs() < 0.03, "stiffness {s}, n {n}, h {h}: {found} {exact}");
                }
            }
        }
    }
}

#[test]
fn the_global_solve_is_as_stiff_as_64_passes_of_matching() {
    for n in [3, 4, 6] {
        let h = 1.0 / 60.0;
        let passes = period(bar(n), Stiffness::Iterations(64), h);
        assert!(period(bar(n), Stiffness::Solve(0.8), h) <= passes);
        // And what the passes mean depends on the mesh: half as long edges, twice the period.
        assert!(period(bar(2 * n), Stiffness::Iterations(4), h) > 1.7 * period(bar(n), Stiffness::Iterations(4), h));
    }
}
