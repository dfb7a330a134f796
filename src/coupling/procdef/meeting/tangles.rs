//! Whether two bodies are apart.
//!
//! Bodies that were apart and are held apart stay so: they are looked at only when they come near each other, and now and then,
//! since what holds them does not know of attachments, of rounding, or of hands that move particles.

use rapier3d::parry::bounding_volume::BoundingVolume;
use rayon::prelude::*;

use super::near::Side;

/// Edges of two bodies that stay near each other are looked at every so many steps.
const LOOKED_AT: u64 = 16;
/// And whether one is inside the other, which takes longer and needs a hand that puts it there.
const INSIDE_LOOKED_AT: u64 = 128;

/// The pairs of bodies that were near each other and apart in the last step.
#[derive(Clone, Debug, Default)]
pub struct KnownApart {
    known: Vec<[(u32, u32); 2]>,
    step: u64,
}

impl KnownApart {
    /// Which of the pairs are tangled: a triangle of one is pierced by an edge of the other, or one is inside the other.
    pub fn tangled(&mut self, pairs: &[(Side<'_>, Side<'_>)]) -> Vec<bool> {
        self.step += 1;
        let name = |(a, b): &(Side<'_>, Side<'_>)| [a.body.name, b.body.name];
        let known = |key: &[(u32, u32); 2]| self.known.binary_search(key).is_ok();
        let tangled: Vec<bool> = pairs
            .par_iter()
            .map(|pair| {
                let new = !known(&name(pair));
                let [(a, _), (b, _)] = name(pair);
                let turn = self.step + u64::from(a) + 7 * u64::from(b);
                let due = |every: u64| new || turn.is_multiple_of(every);
                let (a, b) = pair;
                a.sight.bounds.intersects(&b.sight.bounds)
                    && (due(LOOKED_AT) && (pierces(a, b) || pierces(b, a))
                        || due(INSIDE_LOOKED_AT) && (starts_inside(a, b) || starts_inside(b, a)))
            })
            .collect();
        let apart = pairs.iter().zip(&tangled).filter(|(_, tangled)| !**tangled);
        self.known = apart.map(|(pair, _)| name(pair)).collect();
        self.known.sort_unstable();
        tangled
    }
}

/// Whether an edge of `a` goes through a triangle of `b`.
fn pierces(a: &Side<'_>, b: &Side<'_>) -> bool {
    let x = a.body.body.positions();
    let bounds = &b.sight.bounds;
    a.body.surface.edges[..a.body.surface.edge_count].iter().any(|edge| {
        let [p, q] = edge.map(|v| x[v as usize]);
        p.max(q).cmpge(bounds.mins).all() && p.min(q).cmple(bounds.maxs).all() && b.placed.triangles.is_pierced(p, q)
    })
}

/// Whether the first vertex of `a` is inside `b`: its surface goes around it (van Oosterom and Strackee's solid angles).
fn starts_inside(a: &Side<'_>, b: &Side<'_>) -> bool {
    let Some(&first) = a.body.surface.vertices.first() else { return false };
    let x = a.body.body.positions()[first as usize];
    if !b.sight.bounds.contains_local_point(x) {
        return false;
    }
    let y = b.body.body.positions();
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| y[v as usize] - x);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        2.0 * a.dot(b.cross(c)).atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    let triangles = &b.body.surface.triangles[..b.body.surface.triangle_count()];
    triangles.iter().map(angle).sum::<f32>() > 2.0 * std::f32::consts::PI
}
