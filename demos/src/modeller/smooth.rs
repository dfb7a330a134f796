//! Taubin smoothing: a step that shrinks and a step that swells, which together take the
//! staircase out of a mesh and leave its volume.

use glam::Vec3;

use super::mesh::Mesh;

/// The shrinking step.
const SHRINK: f32 = 0.5;
/// The swelling step, a little larger.
const SWELL: f32 = -0.53;

/// Smooths `mesh` by `rounds` pairs of steps.
pub fn smooth(mesh: &mut Mesh, rounds: usize) {
    let edges = mesh.edges();
    for _ in 0..rounds {
        for step in [SHRINK, SWELL] {
            let offsets = offsets_to_neighbours(mesh, &edges);
            for (p, offset) in mesh.positions.iter_mut().zip(offsets) {
                *p += offset * step;
            }
        }
    }
}

/// For every vertex the way to the middle of its neighbours.
fn offsets_to_neighbours(mesh: &Mesh, edges: &[(u32, u32)]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); mesh.positions.len()];
    for &(a, b) in edges {
        let (pa, pb) = (mesh.positions[a as usize], mesh.positions[b as usize]);
        sums[a as usize].0 += pb - pa;
        sums[a as usize].1 += 1.0;
        sums[b as usize].0 += pa - pb;
        sums[b as usize].1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| sum / count.max(1.0)).collect()
}
