//! Shape matching of all regions (equations 2 to 7): where each vertex should go.
//!
//! One pass finds for each region the rotation `R_r` of `A_r = Σ m̃ᵢ (xᵢ - c_r) (T_r (xᵢ⁰ - c_r⁰))ᵀ` and from it the map
//! `x ↦ R_r T_r (x - c_r⁰) + c_r`; a second one averages at each vertex the maps of the regions it belongs to (7). Both are
//! sums over contiguous rows; the rotations are found eight at a time.
//!
//! A single pass keeps linear momentum and the angular momentum `Σ m x × (g - x) = 0` exactly, because the masses of (2) and
//! the averages of (7) divide by the same `|Nᵢ|`.

use glam::Mat3;
use wide::{f32x4, f32x8};

use super::global_solve::{Factor, Stiffening};
use super::regions::Regions;
use super::rotation_wide::{LANES, WideMat3, WideQuat, nearest_rotations, times, times_transposed};
use crate::math::Quat;

/// The sums of a lane without a region.
const NO_REGION: [f32x4; 3] =
    [f32x4::new([1.0, 0.0, 0.0, 0.0]), f32x4::new([0.0, 1.0, 0.0, 0.0]), f32x4::new([0.0, 0.0, 1.0, 0.0])];

/// What matching remembers of a body from step to step, and its buffers.
#[derive(Clone, Debug)]
pub(super) struct Matching {
    /// The rotations of the regions, eight a block: the start of the next search.
    rotations: Vec<WideQuat>,
    /// The local deformations of the step, eight a block.
    local: Vec<WideMat3>,
    /// `R_r T_r | c_r - R_r T_r c_r⁰` of each region, by rows.
    maps: Vec<[f32x4; 3]>,
    /// Where each place should go, relative to the origin of the step, and at the end the way there; the fourth component is 0.
    pub goals: Vec<f32x4>,
}

impl Matching {
    pub fn new(regions: &Regions) -> Self {
        let blocks = regions.len().div_ceil(LANES);
        Self {
            rotations: vec![WideQuat::IDENTITY; blocks],
            local: vec![identity(); blocks],
            maps: vec![[f32x4::ZERO; 3]; regions.len()],
            goals: vec![f32x4::ZERO; regions.len()],
        }
    }

    /// Takes over the local deformations of the step, one a vertex of the mesh; with another length, and where one is not
    /// finite, there is none.
    pub fn set_local(&mut self, regions: &Regions, local: &[Mat3]) {
        if local.len() != regions.len() {
            self.local.fill(identity());
            return;
        }
        for (block, vertices) in self.local.iter_mut().zip(regions.vertex.chunks(LANES)) {
            // Nine columns of eight lanes; lanes without a vertex repeat the first one.
            let at =
                |lane: usize| local[vertices[if lane < vertices.len() { lane } else { 0 }] as usize].to_cols_array();
            let [mut low, mut high, mut last] = [[f32x4::ZERO; LANES], [f32x4::ZERO; LANES], [f32x4::ZERO; LANES]];
            for lane in 0..LANES {
                let [a, b, c, d, e, f, g, h, i] = at(lane);
                low[lane] = f32x4::new([a, b, c, d]);
                high[lane] = f32x4::new([e, f, g, h]);
                last[lane] = f32x4::new([i, 0.0, 0.0, 0.0]);
            }
            let [xx, yx, zx, xy] = to_lanes(low);
            let [yy, zy, xz, yz] = to_lanes(high);
            let [zz, ..] = to_lanes(last);
            let rows = [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]];
            // A value times 0 is 0 only where it is finite.
            let nothing = rows.iter().flatten().fold(f32x8::ZERO, |sum, v| sum + *v * f32x8::ZERO);
            let finite = nothing.simd_eq(f32x8::ZERO);
            *block = if finite.all() {
                rows
            } else {
                let none = identity();
                std::array::from_fn(|i| std::array::from_fn(|j| finite.bitselect(rows[i][j], none[i][j])))
            };
        }
    }

    /// The maps of all regions for the shape `x`; the rotations are remembered. `weights` are those of the regions, or of the
    /// global solve, whose maps have a rotation and a deformation only.
    pub fn match_regions(&mut self, regions: &Regions, weights: &[f32x4], x: &[f32x4]) {
        for (b, maps) in self.maps.chunks_mut(LANES).enumerate() {
            // Lanes without a region hold the identity, whose rotation is found at once.
            let mut sums = [NO_REGION; LANES];
            for (lane, sum) in sums.iter_mut().enumerate().take(maps.len()) {
                *sum = region_sums(regions, weights, x, b * LANES + lane);
            }
            let rows: [[f32x8; 4]; 3] = std::array::from_fn(|i| to_lanes(sums.map(|sum| sum[i])));
            let a = rows.map(|[x, y, z, _]| [x, y, z]);
            let t = &self.local[b];
            self.rotations[b] = nearest_rotations(&times_transposed(&a, t), self.rotations[b]);
            let f = times(&self.rotations[b].matrix(), t);
            let rest = &regions.rest_centre[b];
            for i in 0..3 {
                let shift = rows[i][3] - (f[i][0] * rest[0] + f[i][1] * rest[1] + f[i][2] * rest[2]);
                let row = from_lanes([f[i][0], f[i][1], f[i][2], shift]);
                maps.iter_mut().zip(row).for_each(|(map, row)| map[i] = row);
            }
        }
    }

    /// The maps of all regions for the goals of the pass before.
    pub fn match_goals(&mut self, regions: &Regions) {
        let goals = std::mem::take(&mut self.goals);
        self.match_regions(regions, &regions.weights, &goals);
        self.goals = goals;
    }

    /// The way from the shape `x` to the goals of the global solve, into `goals`, from the maps of the last pass.
    pub fn solve(&mut self, stiffening: &Stiffening, factor: &Factor, regions: &Regions, x: &[f32x4]) {
        stiffening.ways(factor, regions, x, &self.maps, &mut self.goals);
    }

    /// The mean at each vertex of the maps of its regions (7) into `goals`.
    pub fn blend(&mut self, regions: &Regions) {
        for (p, goal) in self.goals.iter_mut().enumerate() {
            let row = regions.row(p);
            let mut sum = [f32x4::ZERO; 3];
            for &i in &regions.items[row.clone()] {
                let map = &self.maps[i as usize];
                sum = [sum[0] + map[0], sum[1] + map[1], sum[2] + map[2]];
            }
            let rest = regions.rest[p];
            let at = f32x4::new([rest.x, rest.y, rest.z, 1.0]) * f32x4::splat(1.0 / row.len() as f32);
            let [x, y, z, w] = f32x4::transpose([sum[0] * at, sum[1] * at, sum[2] * at, f32x4::ZERO]);
            *goal = (x + y) + (z + w);
        }
    }

    /// Makes of the goals the ways to them from the shape `x`.
    pub fn subtract(&mut self, x: &[f32x4]) {
        self.goals.iter_mut().zip(x).for_each(|(g, &x)| *g -= x);
    }

    /// Sets all remembered rotations, where a body is placed.
    pub fn set_rotations(&mut self, q: Quat) {
        for block in &mut self.rotations {
            (0..LANES).for_each(|lane| block.set_lane(lane, q));
        }
    }
}

fn identity() -> WideMat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { f32x8::ONE } else { f32x8::ZERO }))
}

/// `Σ m̃ᵢ (xᵢ - x_r) qᵢᵀ` by rows, divided by the region's spread, and beside them `c_r`. The sums do not depend on the point
/// that is subtracted, since the `m̃ᵢ qᵢ` add up to zero; subtracting keeps them exact far from the origin.
#[inline]
fn region_sums(regions: &Regions, weights: &[f32x4], x: &[f32x4], region: usize) -> [f32x4; 3] {
    let row = regions.row(region);
    let own = x[region];
    let mut sums = [f32x4::ZERO; 3];
    for (&i, &weight) in regions.items[row.clone()].iter().zip(&weights[row]) {
        let [a, b, c, _] = (x[i as usize] - own).to_array();
        sums[0] += weight * f32x4::splat(a);
        sums[1] += weight * f32x4::splat(b);
        sums[2] += weight * f32x4::splat(c);
    }
    let [a, b, c, _] = own.to_array();
    [sums[0] + only_last(a), sums[1] + only_last(b), sums[2] + only_last(c)]
}

fn only_last(value: f32) -> f32x4 {
    f32x4::new([0.0, 0.0, 0.0, value])
}

/// Eight vectors of four to four vectors of eight.
#[inline]
fn to_lanes(v: [f32x4; LANES]) -> [f32x8; 4] {
    let [a, b, c, d, e, f, g, h] = v;
    let (low, high) = (f32x4::transpose([a, b, c, d]), f32x4::transpose([e, f, g, h]));
    std::array::from_fn(|i| bytemuck::cast([low[i], high[i]]))
}

/// Four vectors of eight to eight vectors of four.
#[inline]
fn from_lanes(v: [f32x8; 4]) -> [f32x4; LANES] {
    let halves = v.map(bytemuck::cast::<f32x8, [f32x4; 2]>);
    let [a, b, c, d] = f32x4::transpose(halves.map(|h| h[0]));
    let [e, f, g, h] = f32x4::transpose(halves.map(|h| h[1]));
    [a, b, c, d, e, f, g, h]
}
