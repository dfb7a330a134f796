//! A boundary's triangles where they are now, in packs of eight, and what is near a point.

use wide::f32x8;

use super::boxes::{Boxes, SomePacks};
use super::lanes::{LANES, dot, farthest, minus, or_none, splat, vector};
use super::surface::ContactSurface;
use crate::math::Vec3;

/// Eight triangles now: first corners, edges to the other two, and products that the nearest points need.
#[derive(Clone, Copy, Debug)]
pub struct Pack {
    corner: [f32x8; 3],
    edges: [[f32x8; 3]; 2],
    squares: [f32x8; 2],
    product: f32x8,
    /// One over the squared lengths of the three edges and over the determinant; 0 where there is no length.
    inverses: [f32x8; 4],
    normal: [f32x8; 3],
    /// How far the corners may go.
    farthest: f32x8,
}

/// A boundary now.
#[derive(Clone, Debug, Default)]
pub struct PlacedTriangles {
    packs: Vec<Pack>,
    /// The boxes of the packs.
    pub boxes: Boxes,
    /// Triangles without the repeated ones.
    count: usize,
}

/// The point of a surface that is nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The triangle in [`ContactSurface::triangles`].
    pub triangle: usize,
    /// Barycentric coordinates of the point there.
    pub weights: [f32; 3],
    /// From the point of the surface to the other point.
    pub way: Vec3,
    /// The triangle's unit normal, outward; zero where it has no area.
    pub normal: Vec3,
}

impl PlacedTriangles {
    /// Takes over the positions of the body's vertices, and how far each may go, in metres.
    pub fn place(&mut self, surface: &ContactSurface, positions: &[Vec3], moves: &[f32]) {
        self.packs.clear();
        self.count = surface.triangle_count();
        for triangles in surface.triangles.chunks_exact(LANES) {
            let corner = |k: usize| -> [f32x8; 3] {
                std::array::from_fn(|axis| {
                    f32x8::new(std::array::from_fn(|i| positions[triangles[i][k] as usize][axis]))
                })
            };
            self.packs.push(Pack::new(corner(0), corner(1), corner(2), farthest(triangles, moves)));
        }
        self.boxes.place(&surface.triangles, positions, moves);
    }

    /// The point of the surface nearest to `x`, if one is within `reach` metres; of triangles only whose normals `counts`. Where
    /// several triangles are equally near, the one that faces `x` or turns away from it most decides: its normal tells inside
    /// from outside.
    pub fn nearest(&self, x: Vec3, reach: f32, counts: impl Fn(Vec3) -> bool) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut limit = reach * reach;
        let lanes = splat(x);
        self.boxes.near(x, x, limit, |number| {
            self.packs[number].nearest(lanes, number, &counts, &mut limit, &mut best);
            limit
        });
        best
    }

    /// Of some packs all triangles within `reach` metres of `x`, and farther by as much as they may go: their nearest points,
    /// and how far that is.
    pub fn within(&self, packs: &SomePacks, x: Vec3, reach: f32, mut found: impl FnMut(Nearest, f32)) {
        let lanes = splat(x);
        packs.near(x, x, reach, |number| {
            let pack = &self.packs[number];
            let foot = pack.foot(lanes);
            let farthest = pack.farthest + f32x8::splat(reach);
            let mut near = foot.squared.simd_le(farthest * farthest).to_bitmask();
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                if number * LANES + lane < self.count {
                    found(foot.of_lane(number, lane, pack), pack.farthest.to_array()[lane]);
                }
            }
        });
    }

    /// Whether the way from `p` to `q` goes through a triangle.
    pub fn is_pierced(&self, p: Vec3, q: Vec3) -> bool {
        let [from, to] = [p, q].map(splat);
        let mut pierced = false;
        self.boxes.near(p.min(q), p.max(q), 0.0, |number| {
            pierced |= self.packs[number].is_pierced(from, to);
            0.0
        });
        pierced
    }
}

/// Squared distances within this part of each other are equally near.
const EQUAL: f32 = 1e-4;

impl Pack {
    fn new(a: [f32x8; 3], b: [f32x8; 3], c: [f32x8; 3], farthest: f32x8) -> Self {
        let (u, v) = (minus(b, a), minus(c, a));
        let (uu, vv, uv) = (dot(u, u), dot(v, v), dot(u, v));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = or_none(dot(normal, normal).sqrt());
        let third = uu + vv - uv - uv;
        Self {
            corner: a,
            edges: [u, v],
            squares: [uu, vv],
            product: uv,
            inverses: [or_none(uu), or_none(vv), or_none(third), or_none(uu * vv - uv * uv)],
            normal: normal.map(|x| x * length),
            farthest,
        }
    }

    /// Whether the way from `p` to `q` goes through one of the triangles.
    #[inline]
    fn is_pierced(&self, p: [f32x8; 3], q: [f32x8; 3]) -> bool {
        let zero = f32x8::ZERO;
        let (p, q) = (minus(p, self.corner), minus(q, self.corner));
        let (before, after) = (dot(p, self.normal), dot(q, self.normal));
        let part = before / (before - after);
        let x: [f32x8; 3] = std::array::from_fn(|k| p[k] + (q[k] - p[k]) * part);
        let [u, v] = self.edges;
        let [uu, vv] = self.squares;
        let (xu, xv) = (dot(x, u), dot(x, v));
        let idet = self.inverses[3];
        let (s, t) = ((vv * xu - self.product * xv) * idet, (uu * xv - self.product * xu) * idet);
        let inside = s.simd_ge(zero) & t.simd_ge(zero) & (s + t).simd_le(f32x8::ONE) & idet.simd_gt(zero);
        ((before * after).simd_lt(zero) & inside).to_bitmask() != 0
    }

    /// The nearest points of all eight triangles: on the triangle where the foot of the perpendicular lies in it, else on the
    /// nearest of its edges.
    #[inline]
    fn foot(&self, x: [f32x8; 3]) -> Foot {
        let (zero, one) = (f32x8::ZERO, f32x8::ONE);
        let p = minus(x, self.corner);
        let [u, v] = self.edges;
        let [uu, vv] = self.squares;
        let uv = self.product;
        let (pu, pv) = (dot(p, u), dot(p, v));
        let [iu, iv, iw, idet] = self.inverses;
        let clamp = |t: f32x8| t.fast_max(zero).fast_min(one);
        let from = |s: f32x8, t: f32x8| -> [f32x8; 3] { std::array::from_fn(|k| p[k] - u[k] * s - v[k] * t) };
        let (s, t) = ((vv * pu - uv * pv) * idet, (uu * pv - uv * pu) * idet);
        let inside = s.simd_ge(zero) & t.simd_ge(zero) & (s + t).simd_le(one) & idet.simd_gt(zero);
        let along = clamp((pv - pu + uu - uv) * iw);
        let mut way = from(s, t);
        let mut squared = inside.bitselect(dot(way, way), f32x8::splat(f32::INFINITY));
        let (mut s, mut t) = (s, t);
        for (es, et) in [(clamp(pu * iu), zero), (zero, clamp(pv * iv)), (one - along, along)] {
            let other = from(es, et);
            let distance = dot(other, other);
            let nearer = distance.simd_lt(squared);
            squared = nearer.bitselect(distance, squared);
            (s, t) = (nearer.bitselect(es, s), nearer.bitselect(et, t));
            way = std::array::from_fn(|k| nearer.bitselect(other[k], way[k]));
        }
        Foot { squared, s, t, way }
    }

    #[inline]
    fn nearest(
        &self,
        x: [f32x8; 3],
        number: usize,
        counts: &impl Fn(Vec3) -> bool,
        limit: &mut f32,
        best: &mut Option<Nearest>,
    ) {
        let foot = self.foot(x);
        let mut near = foot.squared.simd_le(f32x8::splat(*limit * (1.0 + EQUAL))).to_bitmask();
        if near == 0 {
            return;
        }
        let squared = foot.squared.to_array();
        while near != 0 {
            let lane = near.trailing_zeros() as usize;
            near &= near - 1;
            // A lane before this one may have come nearer.
            if squared[lane] > *limit * (1.0 + EQUAL) {
                continue;
            }
            let candidate = foot.of_lane(number, lane, self);
            if !counts(candidate.normal) {
                continue;
            }
            let decided = |n: &Nearest| n.normal.dot(n.way).abs();
            let better = match best {
                Some(old) if squared[lane] >= *limit * (1.0 - EQUAL) => decided(&candidate) > decided(old),
                _ => squared[lane] <= *limit,
            };
            if better {
                *limit = limit.min(squared[lane]);
                *best = Some(candidate);
            }
        }
    }
}

/// The nearest points of eight triangles.
struct Foot {
    squared: f32x8,
    s: f32x8,
    t: f32x8,
    way: [f32x8; 3],
}

impl Foot {
    #[inline]
    fn of_lane(&self, number: usize, lane: usize, pack: &Pack) -> Nearest {
        let [s, t] = [self.s, self.t].map(|x| x.to_array()[lane]);
        Nearest {
            triangle: number * LANES + lane,
            weights: [1.0 - s - t, s, t],
            way: vector(self.way, lane),
            normal: vector(pack.normal, lane),
        }
    }
}

#[cfg(test)]
#[path = "triangles_tests.rs"]
mod tests;
