//! A boundary's edges where they are now, in packs of eight, and what is near another edge.

use wide::f32x8;

use super::boxes::{Boxes, SomePacks};
use super::lanes::{LANES, dot, farthest, minus, or_none, splat, vector};
use super::surface::ContactSurface;
use crate::math::Vec3;

/// Eight edges now: starts, ways to the ends, squared lengths and one over them; 0 where there is no length.
#[derive(Clone, Copy, Debug)]
struct Pack {
    start: [f32x8; 3],
    way: [f32x8; 3],
    square: f32x8,
    inverse: f32x8,
    /// How far the ends may go.
    farthest: f32x8,
}

/// A boundary's edges now.
#[derive(Clone, Debug, Default)]
pub struct PlacedEdges {
    packs: Vec<Pack>,
    /// The boxes of the packs.
    pub boxes: Boxes,
    /// Edges without the repeated ones.
    count: usize,
}

/// The nearest points of two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearEdge {
    /// The edge in [`ContactSurface::edges`].
    pub edge: usize,
    /// How far along the other edge its point is, and how far along this one, from 0 to 1.
    pub at: [f32; 2],
    /// From this edge to the other.
    pub way: Vec3,
}

impl PlacedEdges {
    /// Takes over the positions of the body's vertices, and how far each may go, in metres.
    pub fn place(&mut self, surface: &ContactSurface, positions: &[Vec3], moves: &[f32]) {
        self.packs.clear();
        self.count = surface.edge_count;
        for edges in surface.edges.chunks_exact(LANES) {
            let end = |k: usize| -> [f32x8; 3] {
                std::array::from_fn(|axis| f32x8::new(std::array::from_fn(|i| positions[edges[i][k] as usize][axis])))
            };
            let start = end(0);
            let way = minus(end(1), start);
            let square = dot(way, way);
            self.packs.push(Pack { start, way, square, inverse: or_none(square), farthest: farthest(edges, moves) });
        }
        self.boxes.place(&surface.edges, positions, moves);
    }

    /// Of some packs all edges within `reach` metres of the edge from `p` to `q`, and farther by as much as they may go, and how
    /// far that is.
    pub fn within(&self, packs: &SomePacks, [p, q]: [Vec3; 2], reach: f32, mut found: impl FnMut(NearEdge, f32)) {
        let (start, way) = (splat(p), splat(q - p));
        let square = f32x8::splat(p.distance_squared(q));
        packs.near(p.min(q), p.max(q), reach, |number| {
            let pack = &self.packs[number];
            let [s, t] = pack.nearest(start, way, square);
            let apart: [f32x8; 3] = std::array::from_fn(|k| start[k] - pack.start[k] + way[k] * s - pack.way[k] * t);
            let farthest = pack.farthest + f32x8::splat(reach);
            let mut near = dot(apart, apart).simd_le(farthest * farthest).to_bitmask();
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                let edge = number * LANES + lane;
                if edge < self.count {
                    let at = [s, t].map(|x| x.to_array()[lane]);
                    found(NearEdge { edge, at, way: vector(apart, lane) }, pack.farthest.to_array()[lane]);
                }
            }
        });
    }
}

impl Pack {
    /// Where the edge from `start` along `way` and each of the eight are nearest to each other, from 0 to 1 along both
    /// (Ericson, *Real-Time Collision Detection*, 5.1.9).
    #[inline]
    fn nearest(&self, start: [f32x8; 3], way: [f32x8; 3], a: f32x8) -> [f32x8; 2] {
        let clamp = |t: f32x8| t.fast_max(f32x8::ZERO).fast_min(f32x8::ONE);
        let r = minus(start, self.start);
        let e = self.square;
        let (b, c, f) = (dot(way, self.way), dot(way, r), dot(self.way, r));
        let s = clamp((b * f - c * e) * or_none(a * e - b * b));
        let t = clamp((b * s + f) * self.inverse);
        // The best of the other edge for that point, then of this one: exact, since the distance is convex.
        let s = clamp((b * t - c) * or_none(a));
        [s, t]
    }
}

#[cfg(test)]
#[path = "edges_tests.rs"]
mod tests;
