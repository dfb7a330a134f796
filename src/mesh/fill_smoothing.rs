//! Better cells: vertices are moved where that makes the worst of their cells better, those of the boundary on the surface, those
//! of sharp edges along them.

use super::fill_cells::Filling;
use super::fill_target::{Place, Target};
use crate::math::Vec3;

/// A vertex goes onto a sharp edge or corner if none of its cells gets worse than this.
const SHARP_QUALITY: f32 = 0.12;

/// Moves vertices of the boundary onto sharp edges and corners within reach where the cells allow it.
pub(super) fn catch_features(filling: &mut Filling, boundary: &[[u32; 3]], target: &Target, reach: f32) {
    let mut vertices: Vec<u32> = boundary.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    for v in vertices.into_iter().map(|v| v as usize) {
        if filling.places[v] != Place::Loose {
            continue;
        }
        let before = filling.positions[v];
        let Some((goal, place)) = target.feature(before, reach) else { continue };
        let old = filling.worst(v);
        filling.positions[v] = goal;
        if filling.worst(v) > SHARP_QUALITY.min(0.9 * old) {
            filling.places[v] = place;
        } else {
            filling.positions[v] = before;
        }
    }
}

/// Moves the vertices in so many passes. The boundary is that of the cells.
pub(super) fn smooth(filling: &mut Filling, boundary: &[[u32; 3]], target: &Target, passes: u32) {
    let mut surface: Vec<Vec<u32>> = vec![Vec::new(); filling.positions.len()];
    for t in boundary {
        for k in 0..3 {
            surface[t[k] as usize].extend([t[(k + 1) % 3], t[(k + 2) % 3]]);
        }
    }
    for _ in 0..passes {
        for v in (0..filling.positions.len()).filter(|&v| filling.places[v] != Place::Corner) {
            let (before, place) = (filling.positions[v], filling.places[v]);
            let (mut sum, mut count) = (Vec3::ZERO, 0.0);
            let mut add = |n: u32| {
                sum += filling.positions[n as usize];
                count += 1.0;
            };
            if surface[v].is_empty() {
                let cells = filling.of_vertex[v].iter().flat_map(|&c| filling.cells[c as usize]);
                cells.filter(|&n| n as usize != v).for_each(&mut add);
            } else {
                surface[v].iter().copied().filter(|&n| filling.places[n as usize] >= place).for_each(&mut add);
            }
            if count == 0.0 {
                continue;
            }
            let old = filling.worst(v);
            for part in [1.0, 0.5, 0.2] {
                let goal = before.lerp(sum / count, part);
                filling.positions[v] = match place {
                    Place::Loose if surface[v].is_empty() => goal,
                    Place::Loose => target.project(goal),
                    _ => target.on_edge(goal).unwrap_or(before),
                };
                if filling.worst(v) > old {
                    break;
                }
                filling.positions[v] = before;
            }
        }
    }
}
