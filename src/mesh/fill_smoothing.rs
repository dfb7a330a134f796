//! Better cells: vertices are moved where that makes the worst of their cells better, those of the boundary on the surface.

use super::tetrahedral_mesh::{CELL_EDGES, CELL_FACES};
use crate::math::Vec3;

/// Passes over all vertices.
const PASSES: u32 = 12;
/// A vertex goes onto a sharp edge or corner if none of its cells gets worse than this.
const SHARP_QUALITY: f32 = 0.12;

/// Moves the vertices. `project` gives the nearest point of the surface, `sharp` the nearest sharp feature within reach.
pub(super) fn smooth(
    positions: &mut [Vec3],
    cells: &[[u32; 4]],
    boundary: &[[u32; 3]],
    project: impl Fn(Vec3) -> Vec3,
    sharp: impl Fn(Vec3) -> Option<Vec3>,
) {
    let mut of_vertex: Vec<Vec<u32>> = vec![Vec::new(); positions.len()];
    for (c, cell) in (0u32..).zip(cells) {
        cell.iter().for_each(|&v| of_vertex[v as usize].push(c));
    }
    let mut surface: Vec<Vec<u32>> = vec![Vec::new(); positions.len()];
    for t in boundary {
        for k in 0..3 {
            surface[t[k] as usize].extend([t[(k + 1) % 3], t[(k + 2) % 3]]);
        }
    }
    let worst = |positions: &[Vec3], v: usize| {
        of_vertex[v].iter().map(|&c| quality(positions, &cells[c as usize])).fold(f32::INFINITY, f32::min)
    };
    let mut fixed = vec![false; positions.len()];
    for pass in 0..PASSES {
        // First the cells get better, then features are caught, then the rest follows.
        if pass % 4 == 2 {
            for v in (0..positions.len()).filter(|&v| !surface[v].is_empty()) {
                let before = positions[v];
                if let Some(target) = sharp(before).filter(|_| !fixed[v]) {
                    let old = worst(positions, v);
                    positions[v] = target;
                    fixed[v] = worst(positions, v) > SHARP_QUALITY.min(0.9 * old);
                    if !fixed[v] {
                        positions[v] = before;
                    }
                }
            }
        }
        for v in (0..positions.len()).filter(|&v| !fixed[v]) {
            let before = positions[v];
            let (mut sum, mut count) = (Vec3::ZERO, 0.0);
            let mut add = |n: u32| {
                sum += positions[n as usize];
                count += 1.0;
            };
            if surface[v].is_empty() {
                of_vertex[v].iter().flat_map(|&c| cells[c as usize]).filter(|&n| n as usize != v).for_each(&mut add);
            } else {
                surface[v].iter().copied().for_each(&mut add);
            }
            let old = worst(positions, v);
            for part in [1.0, 0.5, 0.2] {
                let target = before.lerp(sum / count, part);
                positions[v] = if surface[v].is_empty() { target } else { project(target) };
                if worst(positions, v) > old {
                    break;
                }
                positions[v] = before;
            }
        }
    }
}

/// Of a cell: 1 when it is regular, 0 when it is flat, negative when it is inside out. The least sine of its dihedral angles
/// beside their regular value.
fn quality(positions: &[Vec3], cell: &[u32; 4]) -> f32 {
    let x = cell.map(|v| positions[v as usize]);
    let normals = CELL_FACES.map(|[a, b, c]| (x[b] - x[a]).cross(x[c] - x[a]));
    let volume = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]));
    // sin(angle at the edge of faces a and b) = |n_a x n_b| / |n_a||n_b|, and |n_a x n_b| = 6 V |edge|.
    let mut least = f32::INFINITY;
    for [a, b] in CELL_EDGES {
        // The edge that lies in both faces joins the two other corners.
        let mut others = (0..4).filter(|k| *k != a && *k != b);
        let (Some(i), Some(j)) = (others.next(), others.next()) else { continue };
        let sine = volume * x[i].distance(x[j]) / (normals[a].length() * normals[b].length()).max(f32::MIN_POSITIVE);
        least = least.min(sine);
    }
    // The regular tetrahedron's dihedral angle has the sine 0.943.
    least / 0.942_809
}
