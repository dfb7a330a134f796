//! Welding: which render vertices are one point of the surface, found by a spatial hash.

use crate::math::Vec3;
use glam::DVec3;
use std::collections::HashMap;

/// Vertices nearer than this part of the bounding box's diagonal are one point of the topology.
pub const WELD_TOLERANCE: f64 = 1e-6;

/// Maps each vertex to the lowest vertex index at the same position: exactly equal, or nearer than
/// [`WELD_TOLERANCE`] times the diagonal of the bounding box.
///
/// Vertices are taken in order, each joins the lowest earlier point in reach or becomes a point of its own, so that the
/// result is a function of the positions alone and `welded[welded[v]] == welded[v]`. Positions must be finite; one that
/// is not stays by itself.
pub fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    for p in positions.iter().filter(|p| p.is_finite()) {
        low = low.min(p.as_dvec3());
        high = high.max(p.as_dvec3());
    }
    let diagonal = if low.x <= high.x { (high - low).length() } else { 0.0 };
    // A cell much wider than the tolerance: nearly always one cell is searched instead of 27.
    let tolerance = (WELD_TOLERANCE * diagonal).max(f64::MIN_POSITIVE);
    let cell = 16.0 * tolerance;
    let cell_of = |p: DVec3| ((p - low) / cell).floor().to_array().map(|c| c as i64);

    let mut heads: HashMap<[i64; 3], u32> = HashMap::with_capacity(positions.len());
    let mut next = vec![u32::MAX; positions.len()];
    let mut welded: Vec<u32> = (0..positions.len() as u32).collect();
    for (vertex, position) in positions.iter().enumerate() {
        if !position.is_finite() {
            continue;
        }
        let here = position.as_dvec3();
        let (first, last) = (cell_of(here - tolerance), cell_of(here + tolerance));
        let mut found = u32::MAX;
        for x in first[0]..=last[0] {
            for y in first[1]..=last[1] {
                for z in first[2]..=last[2] {
                    let mut other = heads.get(&[x, y, z]).copied().unwrap_or(u32::MAX);
                    while other != u32::MAX {
                        if positions[other as usize].as_dvec3().distance_squared(here) <= tolerance * tolerance {
                            found = found.min(other);
                        }
                        other = next[other as usize];
                    }
                }
            }
        }
        if found == u32::MAX {
            let head = heads.entry(cell_of(here)).or_insert(u32::MAX);
            next[vertex] = *head;
            *head = vertex as u32;
        } else {
            welded[vertex] = found;
        }
    }
    welded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_weld_to_the_lowest_index() {
        let p = [Vec3::ZERO, Vec3::X, Vec3::ZERO, Vec3::X, Vec3::Y];
        assert_eq!(weld(&p), [0, 1, 0, 1, 4]);
    }

    #[test]
    fn positions_within_a_millionth_of_the_diagonal_weld_and_farther_ones_do_not() {
        let p = [Vec3::ZERO, Vec3::X, Vec3::X * 5e-7, Vec3::X * 2e-6];
        assert_eq!(weld(&p), [0, 1, 0, 3]);
    }

    #[test]
    fn minus_zero_equals_zero_and_one_single_place_welds_to_one_point() {
        assert_eq!(weld(&[Vec3::ZERO, -Vec3::ZERO, Vec3::ZERO]), [0, 0, 0]);
        assert!(weld(&[]).is_empty());
    }

    #[test]
    fn a_mesh_far_from_the_origin_welds_as_well_as_one_near_it() {
        let shift = Vec3::splat(1000.0);
        assert_eq!(weld(&[shift, shift + Vec3::X, shift, shift + Vec3::Y]), [0, 1, 0, 3]);
    }
}
