//! A boundary that follows the surface: where it misses a corner, a sharp edge or a face by more than is allowed, a vertex goes
//! there, or the edge or face that is nearest is split and the new vertex put there.
//!
//! Cells at a convex edge or corner only grow by that. Everywhere the change is chosen that leaves the best cells, and none
//! that would leave a flat one is made. Between the rounds the cells are smoothed.

use std::collections::HashSet;

use parry3d::query::PointQueryWithLocation;
use parry3d::shape::TriMesh;
use rayon::prelude::*;

use super::fill_cells::{Change, Filling};
use super::fill_cracks::{fill_cracks, peel_slivers};
use super::fill_smoothing::smooth;
use super::fill_target::{Place, Target, over_triangle};
use super::fill_undo::Before;
use crate::math::Vec3;

/// Rounds at most.
const ROUNDS: u32 = 48;
/// Points are looked at in distances of so many cells.
pub(super) const SPACING: f32 = 0.25;
/// Sharp edges and corners are followed to this part of what is allowed for faces.
const FEATURE_PART: f32 = 0.3;
/// Splits of one round are at least so many cells apart.
const APART: f32 = 0.4;
/// A point is not tried within so many cells of one where no change was possible: a rod that is lost between the cells has
/// thousands of such points in each round.
const REFUSED: f32 = 0.05;
/// No change leaves a cell worse than this: dihedral angles of about 3 degrees.
const LEAST_QUALITY: f32 = 0.05;
/// Where a change leaves worse cells than this, the vertices around are moved to make room for it.
const EASY_QUALITY: f32 = 0.15;
/// So many of the changes at a place are tried with room made for them.
const TRIALS: usize = 3;
/// Rather than splitting, a vertex is moved if its cells stay at least that good.
const MOVE_QUALITY: f32 = 0.25;

/// A point that boundary and surface do not share.
struct Miss {
    distance: f32,
    /// Where the surface is, and what of it.
    goal: Vec3,
    place: Place,
    /// The triangle of the boundary.
    triangle: u32,
}

/// Refines until no point of surface and boundary is farther from the other than `tolerance`, as far as that can be.
pub(super) fn refine(filling: &mut Filling, target: &Target, cell_size: f32, tolerance: f32) {
    let samples = target.samples(SPACING * cell_size);
    mend(filling, target, cell_size);
    let mut best: Option<(f32, Filling)> = None;
    for round in 0..=ROUNDS {
        let boundary = filling.boundary();
        let mut misses = misses(filling, &boundary, target, &samples, SPACING * cell_size);
        let farthest = misses.iter().map(|m| m.distance).fold(0.0, f32::max);
        // All that is within the tolerance is as good; then the later one follows the features better.
        let farthest = farthest.max(tolerance);
        if best.as_ref().is_none_or(|(least, _)| farthest <= *least) {
            best = Some((farthest, filling.clone()));
        }
        misses.retain(|m| m.distance > if m.place == Place::Loose { tolerance } else { FEATURE_PART * tolerance });
        misses.sort_by(|a, b| b.place.cmp(&a.place).then(b.distance.total_cmp(&a.distance)));
        if round == ROUNDS || !change(filling, &boundary, &misses, target, cell_size) {
            break;
        }
        let boundary = filling.boundary();
        fill_cracks(filling, &boundary, target, 0.5 * tolerance);
        let boundary = filling.boundary();
        peel_slivers(filling, &boundary, target, FEATURE_PART * tolerance);
        let boundary = filling.boundary();
        smooth(filling, &boundary, target, 1);
        mend(filling, target, cell_size);
    }
    if let Some((_, found)) = best {
        *filling = found;
    }
}

/// Relaxes the vertices of bad cells.
fn mend(filling: &mut Filling, target: &Target, cell_size: f32) {
    for v in 0..filling.positions.len() {
        if filling.worst(v) < MOVE_QUALITY {
            filling.relax(v, target, cell_size);
        }
    }
}

/// The distances of both ways at all points that are looked at.
fn misses(
    filling: &Filling,
    boundary: &[[u32; 3]],
    target: &Target,
    samples: &[(Vec3, Place)],
    spacing: f32,
) -> Vec<Miss> {
    let Ok(own) = TriMesh::new(filling.positions.clone(), boundary.to_vec()) else { return Vec::new() };
    let there = samples.par_iter().map(|&(goal, place)| {
        let (projection, (triangle, _)) = own.project_local_point_and_get_location(goal, false);
        Miss { distance: goal.distance(projection.point), goal, place, triangle }
    });
    let back = (0..boundary.len() as u32).into_par_iter().flat_map_iter(|triangle| {
        let corners = boundary[triangle as usize].map(|v| filling.positions[v as usize]);
        over_triangle(corners, spacing).into_iter().map(move |p| {
            let goal = target.project(p);
            Miss { distance: p.distance(goal), goal, place: Place::Loose, triangle }
        })
    });
    there.chain(back).collect()
}

/// Changes the cells for the misses in their order; true if there was something to change.
fn change(filling: &mut Filling, boundary: &[[u32; 3]], misses: &[Miss], target: &Target, cell_size: f32) -> bool {
    let apart = APART * cell_size;
    // What a triangle of the boundary must not have to be still as it was.
    let (mut moved, mut split): (HashSet<u32>, HashSet<[u32; 2]>) = Default::default();
    let mut goals: Vec<Vec3> = Vec::new();
    // Where no change was good enough; a point that is next to one is not tried in this round.
    let mut refused: Vec<Vec3> = Vec::new();
    for miss in misses {
        let t = boundary[miss.triangle as usize];
        let edges = [[t[1], t[2]], [t[2], t[0]], [t[0], t[1]]].map(|[a, b]| [a.min(b), a.max(b)]);
        if t.iter().any(|v| moved.contains(v)) || edges.iter().any(|e| split.contains(e)) {
            continue;
        }
        let reach = if miss.place == Place::Loose { apart } else { 0.5 * apart };
        let near = |points: &[Vec3], reach: f32| points.iter().any(|p| p.distance(miss.goal) < reach);
        if near(&goals, reach) || near(&refused, REFUSED * cell_size) {
            continue;
        }
        let held = |v: u32| filling.places[v as usize];
        let free = t.into_iter().filter(|&v| held(v) == Place::Loose || held(v) < miss.place).map(Change::Move);
        let splits = edges.into_iter().map(Change::SplitEdge).chain([Change::SplitFace(t)]);
        let mut rated: Vec<(f32, Change)> =
            free.chain(splits).map(|c| (filling.quality_after(c, miss.goal), c)).collect();
        let first = |(quality, change): &(f32, Change)| matches!(change, Change::Move(_)) && *quality > MOVE_QUALITY;
        rated.sort_by(|a, b| first(b).cmp(&first(a)).then(b.0.total_cmp(&a.0)));
        let easy = rated.first().filter(|(quality, _)| *quality > EASY_QUALITY).map(|(_, change)| {
            filling.apply(*change, miss.goal, miss.place);
            (*change, Vec::new())
        });
        let done = easy.or_else(|| {
            rated.iter().take(TRIALS).find_map(|(_, change)| {
                let before = Before::of(*change, filling);
                let vertex = filling.apply(*change, miss.goal, miss.place);
                let (quality, touched) = filling.make_room(vertex, target, cell_size);
                if quality > LEAST_QUALITY {
                    return Some((*change, touched));
                }
                before.restore(filling);
                None
            })
        });
        let Some((change, touched)) = done else {
            refused.push(miss.goal);
            continue;
        };
        goals.push(miss.goal);
        moved.extend(touched);
        match change {
            Change::Move(v) => _ = moved.insert(v),
            Change::SplitEdge(edge) => _ = split.insert(edge),
            Change::SplitFace(_) => split.extend(edges),
        }
    }
    !goals.is_empty()
}

/// The Hausdorff distance of the surface and the cells' boundary, at points all over both.
pub(super) fn hausdorff(filling: &Filling, boundary: &[[u32; 3]], target: &Target, spacing: f32) -> f32 {
    let misses = misses(filling, boundary, target, &target.samples(spacing), spacing);
    misses.iter().map(|miss| miss.distance).fold(0.0, f32::max)
}
