//! The boundary of a body as other bodies' vertices meet it: its triangles in packs of eight neighbours, and boxes around the packs.

use wide::f32x8;

use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;

/// Triangles of a pack, and packs of a group.
pub const LANES: usize = 8;

/// The boundary of a kind of body.
#[derive(Clone, Debug)]
pub struct ContactSurface {
    /// The vertices of the boundary, ascending.
    pub vertices: Vec<u32>,
    /// The triangles, those of a pack near each other; the last one is repeated until the last pack is full.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle but the repeated ones, where its corners are in `vertices`.
    places: Vec<[u32; 3]>,
    /// The mean length of an edge in metres.
    pub edge: f32,
}

impl ContactSurface {
    /// The boundary of a mesh at rest, whose edges are `edge` metres long in the mean.
    pub fn new(mesh: &TetrahedralMesh, edge: f32) -> Self {
        let (positions, triangles) = (&mesh.positions, mesh.boundary());
        let count = triangles.len();
        let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let centre = |t: &[u32; 3]| t.map(|v| positions[v as usize]).into_iter().sum::<Vec3>();
        let mut placed: Vec<(Vec3, [u32; 3])> = triangles.iter().map(|t| (centre(t), *t)).collect();
        halve(&mut placed);
        let mut triangles: Vec<[u32; 3]> = placed.into_iter().map(|(_, t)| t).collect();
        if let Some(&last) = triangles.last() {
            triangles.resize(triangles.len().next_multiple_of(LANES), last);
        }
        let place = |v: u32| vertices.binary_search(&v).unwrap_or_default() as u32;
        let places = triangles[..count].iter().map(|t| t.map(place)).collect();
        Self { vertices, triangles, places, edge }
    }

    /// The outward normals of [`ContactSurface::vertices`], weighted by the areas around them; unit or zero.
    pub fn normals(&self, positions: &[Vec3]) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.vertices.len()];
        for (triangle, places) in self.triangles.iter().zip(&self.places) {
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            let normal = (b - a).cross(c - a);
            places.iter().for_each(|&p| normals[p as usize] += normal);
        }
        normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
        normals
    }
}

/// Orders places so that each run of eight lies together: halves along the longest side, at a multiple of eight.
fn halve(places: &mut [(Vec3, [u32; 3])]) {
    if places.len() <= LANES {
        return;
    }
    let low = places.iter().map(|p| p.0).fold(Vec3::MAX, Vec3::min);
    let sides = places.iter().map(|p| p.0).fold(Vec3::MIN, Vec3::max) - low;
    let axis = sides.max_position();
    places.sort_by(|a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let middle = (places.len() / 2).next_multiple_of(LANES).min(places.len() - 1);
    let (a, b) = places.split_at_mut(middle);
    halve(a);
    halve(b);
}

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
}

/// A boundary now.
#[derive(Clone, Debug, Default)]
pub struct PlacedSurface {
    packs: Vec<Pack>,
    /// The boxes of eight packs: lowest and highest corners.
    boxes: Vec<[[f32x8; 3]; 2]>,
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

impl PlacedSurface {
    /// Takes over the positions of the body's vertices.
    pub fn place(&mut self, surface: &ContactSurface, positions: &[Vec3]) {
        self.packs.clear();
        self.boxes.clear();
        let mut bounds: [[[f32; LANES]; 3]; 2] = NO_BOXES;
        for (number, triangles) in surface.triangles.chunks_exact(LANES).enumerate() {
            let lane = number % LANES;
            let corner = |k: usize| -> [f32x8; 3] {
                std::array::from_fn(|axis| {
                    f32x8::new(std::array::from_fn(|i| positions[triangles[i][k] as usize][axis]))
                })
            };
            self.packs.push(Pack::new(corner(0), corner(1), corner(2)));
            let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
            for &v in triangles.iter().flatten() {
                (low, high) = (low.min(positions[v as usize]), high.max(positions[v as usize]));
            }
            for axis in 0..3 {
                bounds[0][axis][lane] = low[axis];
                bounds[1][axis][lane] = high[axis];
            }
            if lane + 1 == LANES || (number + 1) * LANES == surface.triangles.len() {
                self.boxes.push(std::mem::replace(&mut bounds, NO_BOXES).map(|corner| corner.map(f32x8::new)));
            }
        }
    }

    /// The point of the surface nearest to `x`, if one is within `reach` metres; of triangles only whose normals `counts`. Where several triangles are equally near, the
    /// one that faces `x` or turns away from it most decides: its normal tells inside from outside.
    pub fn nearest(&self, x: Vec3, reach: f32, counts: impl Fn(Vec3) -> bool) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut limit = reach * reach;
        let lanes = x.to_array().map(f32x8::splat);
        for (group, bounds) in self.boxes.iter().enumerate() {
            let mut squared = f32x8::ZERO;
            for axis in 0..3 {
                let beyond = (bounds[0][axis] - lanes[axis]).fast_max(lanes[axis] - bounds[1][axis]);
                let beyond = beyond.fast_max(f32x8::ZERO);
                squared += beyond * beyond;
            }
            let mut near = squared.simd_le(f32x8::splat(limit)).to_bitmask();
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                let number = group * LANES + lane;
                self.packs[number].nearest(lanes, number, &counts, &mut limit, &mut best);
            }
        }
        best
    }
}

/// No pack: far from everything.
const NO_BOXES: [[[f32; LANES]; 3]; 2] = [[[f32::MAX; LANES]; 3]; 2];

/// Squared distances within this part of each other are equally near.
const EQUAL: f32 = 1e-4;

impl Pack {
    fn new(a: [f32x8; 3], b: [f32x8; 3], c: [f32x8; 3]) -> Self {
        let (u, v) = (minus(b, a), minus(c, a));
        let (uu, vv, uv) = (dot(u, u), dot(v, v), dot(u, v));
        let or_none = |x: f32x8| x.simd_gt(f32x8::ZERO).bitselect(f32x8::ONE / x, f32x8::ZERO);
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
        }
    }

    /// The nearest points of all eight triangles: on the triangle where the foot of the perpendicular lies in it, else on the
    /// nearest of its edges.
    #[inline]
    fn nearest(
        &self,
        x: [f32x8; 3],
        number: usize,
        counts: &impl Fn(Vec3) -> bool,
        limit: &mut f32,
        best: &mut Option<Nearest>,
    ) {
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
        let mut near = squared.simd_le(f32x8::splat(*limit * (1.0 + EQUAL))).to_bitmask();
        if near == 0 {
            return;
        }
        let (squared, s, t) = (squared.to_array(), s.to_array(), t.to_array());
        let vector = |v: [f32x8; 3], lane: usize| Vec3::from(v.map(|x| x.to_array()[lane]));
        while near != 0 {
            let lane = near.trailing_zeros() as usize;
            near &= near - 1;
            // A lane before this one may have come nearer.
            if squared[lane] > *limit * (1.0 + EQUAL) {
                continue;
            }
            let candidate = Nearest {
                triangle: number * LANES + lane,
                weights: [1.0 - s[lane] - t[lane], s[lane], t[lane]],
                way: vector(way, lane),
                normal: vector(self.normal, lane),
            };
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

#[inline]
fn minus(a: [f32x8; 3], b: [f32x8; 3]) -> [f32x8; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
fn dot(a: [f32x8; 3], b: [f32x8; 3]) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
#[path = "surface_tests.rs"]
mod tests;
