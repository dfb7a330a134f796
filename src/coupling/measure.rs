//! What a penetration looked like before the cancellation and what is left of it, by parry's exact queries.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::cancel::CancelReport;
use super::obstacle::ObstaclePart;
use crate::elastic::ElasticBody;

/// Depths and gaps as fractions of the body's size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenetrationFigures {
    /// Largest depth along the way out before the cancellation.
    pub max_depth_before: f32,
    /// Largest exact depth of a vertex after it.
    pub max_depth_after: f32,
    /// Largest distance left between the skin and an obstacle that it had penetrated.
    pub max_gap: f32,
    /// Vertices deeper than [`INSIDE`] after it.
    pub vertices_inside: u32,
}

/// A vertex counts as inside from this depth on, as a fraction of the body's size.
pub const INSIDE: f32 = 1.0e-3;

/// Measures the skin of `body` against `parts`.
pub fn measure(body: &ElasticBody, parts: &[ObstaclePart], size: f32, report: &CancelReport) -> PenetrationFigures {
    let (deepest, inside) = body
        .positions()
        .par_iter()
        .with_min_len(512)
        .map(|&x| {
            let depth = parts.iter().map(|part| part.exact_depth(x)).fold(0.0, f32::max);
            (depth, u32::from(depth > INSIDE * size))
        })
        .reduce(|| (0.0, 0), |a, b| (a.0.max(b.0), a.1 + b.1));
    let max_gap = gaps(body, parts, report).into_values().fold(0.0, f32::max);
    PenetrationFigures {
        max_depth_before: report.contacts.iter().map(|c| c.depth()).fold(0.0, f32::max) / size,
        max_depth_after: deepest / size,
        max_gap: max_gap / size,
        vertices_inside: inside,
    }
}

/// For each obstacle that the skin had penetrated, how far the skin is from it now. The parts of one obstacle count
/// together: they overlap, and what leaves one of them may have to stop at the next.
fn gaps(body: &ElasticBody, parts: &[ObstaclePart], report: &CancelReport) -> BTreeMap<(u32, u32), f32> {
    let mut gaps = BTreeMap::new();
    for contact in &report.contacts {
        for p in &contact.points {
            let part = &parts[p.part];
            let gap = gaps.entry(part.collider.into_raw_parts()).or_insert(f32::INFINITY);
            let x = p.point.position(body.positions());
            *gap = gap.min(part.exact_distance(x));
        }
    }
    gaps
}
