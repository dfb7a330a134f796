//! Cracks and slivers of the boundary. A cell fills the wedge between two triangles of the boundary where their common edge lies
//! deep inside the surface; a flat cell between two triangles of the boundary is taken away.

use std::collections::{HashMap, HashSet};

use super::fill_cells::{Filling, quality};
use super::fill_target::{Place, Target};
use crate::math::Vec3;

/// A cell that fills a crack is at least that good.
const CRACK_QUALITY: f32 = 0.08;
/// A cell at the boundary that is worse than this is taken away where the surface allows it.
const SLIVER_QUALITY: f32 = 0.12;

/// The triangles at each edge of the boundary: the edge in the sense of the triangle, and the triangle's third corner.
fn sides(boundary: &[[u32; 3]]) -> HashMap<[u32; 2], u32> {
    boundary.iter().flat_map(|&[a, b, c]| [([a, b], c), ([b, c], a), ([c, a], b)]).collect()
}

/// Fills cracks whose bottom is farther from the surface than `tolerance`.
pub(super) fn fill_cracks(filling: &mut Filling, boundary: &[[u32; 3]], target: &Target, tolerance: f32) {
    let sides = sides(boundary);
    let mut touched: HashSet<u32> = HashSet::new();
    let edges = boundary.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).filter(|[u, v]| u < v);
    for [u, v] in edges {
        let (Some(&p), Some(&q)) = (sides.get(&[u, v]), sides.get(&[v, u])) else { continue };
        let cell = [u, v, p, q];
        if p == q || cell.iter().any(|c| touched.contains(c)) {
            continue;
        }
        let x = cell.map(|c| filling.positions[c as usize]);
        let bottom = 0.5 * (x[0] + x[1]);
        // A new edge that is there already would pinch the boundary.
        if quality(x) < CRACK_QUALITY
            || target.signed_distance(bottom) < tolerance
            || target.signed_distance(0.5 * (x[2] + x[3])) < -tolerance
            || filling.is_edge(p, q)
        {
            continue;
        }
        filling.add(cell);
        touched.extend(cell);
    }
    if !touched.is_empty() {
        filling.find_outside();
    }
}

/// Takes flat cells between two triangles of the boundary away where that brings the boundary no farther than `tolerance` from the surface.
pub(super) fn peel_slivers(filling: &mut Filling, boundary: &[[u32; 3]], target: &Target, tolerance: f32) {
    let sides = sides(boundary);
    let mut touched: HashSet<u32> = HashSet::new();
    let mut gone: Vec<u32> = Vec::new();
    for &[a, b, c] in boundary {
        for [u, v] in [[a, b], [b, c], [c, a]].into_iter().filter(|[u, v]| u < v) {
            let (Some(&p), Some(&q)) = (sides.get(&[u, v]), sides.get(&[v, u])) else { continue };
            let corners = [u, v, p, q];
            let [cell] = filling.around(&corners)[..] else { continue };
            let x = filling.cells[cell as usize].map(|c| filling.positions[c as usize]);
            let at = |v: u32| filling.positions[v as usize];
            let flat: [Vec3; 3] = [0.25, 0.5, 0.75].map(|t| at(p).lerp(at(q), t));
            let on_surface = |p: &Vec3| p.distance(target.project(*p)) < tolerance;
            // What is between two corners of a sharp edge is not to be cut off.
            let sharp = filling.places[u as usize] != Place::Loose && filling.places[v as usize] != Place::Loose;
            if quality(x) < SLIVER_QUALITY
                && !sharp
                && !corners.iter().any(|c| touched.contains(c))
                && flat.iter().all(on_surface)
                && !sides.contains_key(&[p, q])
                && !sides.contains_key(&[q, p])
            {
                gone.push(cell);
                touched.extend(corners);
            }
        }
    }
    if !gone.is_empty() {
        filling.remove(&gone);
    }
}
