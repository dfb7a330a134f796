//! What stiffness means: the same for any mesh and time step, and as much as many iterations.

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
fn explore() {
    for s in [0.1, 0.3, 0.5, 0.7] {
        let exact = 2.0 / (wave_speed(s) * bar(4).size());
        for n in [2, 3, 4, 6] {
            let t = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0].map(|h| period(bar(n), Stiffness::Solve(s), h));
            println!("stiffness {s} n {n}: {t:?} exact {exact}");
        }
    }
    for n in [3, 4, 6] {
        println!("N: {:?}", [1, 4, 16, 64].map(|k| period(bar(n), Stiffness::Iterations(k), 1.0 / 60.0)));
        println!("s {:?}", [0.6, 0.7, 0.8, 0.9, 1.0].map(|s| period(bar(n), Stiffness::Solve(s), 1.0 / 60.0)));
    }
}
