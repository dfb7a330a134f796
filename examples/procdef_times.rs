//! What matching alone costs a step, for bodies of the sizes of the paper's Table 1: `cargo run --release --example
//! procdef_times`.
#![allow(clippy::print_stdout)] // it prints a table

#[path = "../tests/common/tetrahedra.rs"]
#[allow(dead_code)] // it uses a part of it
mod tetrahedra;

use std::sync::Arc;
use std::time::Instant;

use glam::Mat3;
use pliant::math::{Pose, Vec3};
use pliant::mesh::TetrahedralMesh;
use pliant::procdef::{ProcDefBody, ProcDefRigBuilder, Stiffness};
use rayon::prelude::*;
use tetrahedra::{bell, block};

/// The best of many steps, in milliseconds; the bodies move, so that the rotations do.
fn milliseconds(mesh: TetrahedralMesh, count: usize, stiffness: Stiffness, threads: bool) -> f64 {
    let n = mesh.vertex_count();
    let rig = Arc::new(ProcDefRigBuilder::new(mesh).build().expect("a rig"));
    let mut bodies: Vec<ProcDefBody> = (0..count).map(|_| ProcDefBody::new(rig.clone(), &Pose::IDENTITY)).collect();
    for body in &mut bodies {
        body.settings.stiffness = stiffness;
    }
    let mut best = f64::INFINITY;
    for step in 0..300 {
        let phase = step as f32 * 0.1;
        let local: Vec<Mat3> = (0..n)
            .map(|v| {
                let c = 1.0 + 0.3 * (phase + v as f32 * 0.01).sin();
                Mat3::from_diagonal(Vec3::new(c, 1.0 / c.sqrt(), 1.0 / c.sqrt()))
            })
            .collect();
        let start = Instant::now();
        if threads {
            bodies.par_iter_mut().for_each(|body| {
                body.pulls(&local, 1.0 / 60.0);
            });
        } else {
            bodies.iter_mut().for_each(|body| {
                body.pulls(&local, 1.0 / 60.0);
            });
        }
        best = best.min(start.elapsed().as_secs_f64());
        for body in &mut bodies {
            body.step(&local, 1.0 / 60.0, Vec3::ZERO, None);
        }
    }
    best * 1e3
}

fn main() {
    let jellyfish = || bell([11, 11, 5], 1.0, 0.3);
    let worm = || block([46, 2, 2], Vec3::new(4.6, 0.2, 0.2));
    let small = || bell([8, 8, 3], 1.0, 0.3);
    let short = || block([7, 2, 2], Vec3::new(0.7, 0.2, 0.2));
    let heart = || bell([17, 17, 3], 1.0, 0.3);
    let bowel = || block([174, 2, 2], Vec3::new(17.4, 0.2, 0.2));
    type Make<'a> = &'a dyn Fn() -> TetrahedralMesh;
    let rows: [(&str, Make, usize, u32); 6] = [
        ("jellyfish", &jellyfish, 1, 2),
        ("worm", &worm, 1, 6),
        ("jellyfishes", &small, 31, 1),
        ("worms", &short, 101, 1),
        ("heart", &heart, 1, 6),
        ("bowel", &bowel, 1, 6),
    ];
    println!("body, vertices, bodies, N: ms for N, ms for N = 1, ms for the global solve, ms for N with all cores");
    for (name, mesh, count, n) in rows {
        let times = [Stiffness::Iterations(n), Stiffness::Iterations(1), Stiffness::Solve(0.8)]
            .map(|stiffness| milliseconds(mesh(), count, stiffness, false));
        let parallel = milliseconds(mesh(), count, Stiffness::Iterations(n), true);
        println!(
            "{name:12} {:5} {count:4} {n:2}: {:.3} {:.3} {:.3} {parallel:.3}",
            mesh().vertex_count(),
            times[0],
            times[1],
            times[2]
        );
    }
}
