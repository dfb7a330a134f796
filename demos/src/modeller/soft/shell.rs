//! The shell of the snail: a coiled, rigid thing on its back.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::modeller::mesh::Mesh;
use crate::modeller::remesh::remesh_to_count;
use crate::modeller::shapes::round_cone;
use crate::modeller::surface::mesh_of;

/// Middle of the coil, on the snail's back.
pub const CENTRE: Vec3 = Vec3::new(-0.12, 0.58, 0.0);
/// Turns of the coil.
const TURNS: f32 = 2.6;
/// How much it grows in one turn.
const GROWTH: f32 = 2.1;
/// Radius of the last winding, from the middle.
const REACH: f32 = 0.29;

/// A point of the coil and the thickness there; `t` from the innermost (0) to the mouth (1).
fn coil(t: f32) -> (Vec3, f32) {
    let turn = TURNS * (t - 1.0);
    let size = GROWTH.powf(turn);
    let angle = TAU * turn - 0.22 * TAU;
    // Inner windings stand out to the side a little.
    let side = 0.14 * (1.0 - size);
    (CENTRE + REACH * size * Vec3::new(angle.cos(), angle.sin(), 0.0) + Vec3::Z * side, 0.155 * size.powf(0.9))
}

/// Models the shell with about `count` triangles.
pub fn shell(count: usize) -> Mesh {
    const PIECES: usize = 90;
    // A plug closes the hole in the middle.
    let plug = [(CENTRE + Vec3::Z * 0.02, 0.06), (CENTRE + Vec3::Z * 0.1, 0.05)];
    let windings = (0..=PIECES).map(|i| coil(i as f32 / PIECES as f32));
    let spine: Vec<(Vec3, f32)> = plug.into_iter().chain(windings).collect();
    let distance = |p: Vec3| {
        let piece = |w: &[(Vec3, f32)]| round_cone(p, w[0].0, w[1].0, w[0].1, w[1].1);
        // A little blending fills the grooves where the mesh would pinch.
        let sum: f32 = spine.windows(2).map(|w| (-100.0 * piece(w)).exp()).sum();
        if sum > 0.0 && sum.is_finite() {
            -sum.ln() / 100.0 + 0.022
        } else {
            spine.windows(2).map(piece).fold(f32::INFINITY, f32::min)
        }
    };
    let half = Vec3::new(0.62, 0.6, 0.42);
    let nets = mesh_of(&distance, CENTRE - half, CENTRE + half, 0.025);
    remesh_to_count(nets, &distance, &|_| 1.0, count)
}
