//! Boxes around packs of eight triangles, edges or vertices, and which of them are near a place.

use wide::f32x8;

use super::lanes::{LANES, splat};
use crate::math::Vec3;

/// Boxes around packs, eight packs together: lowest and highest corners.
#[derive(Clone, Debug, Default)]
pub struct Boxes {
    groups: Vec<[[f32x8; 3]; 2]>,
    corners: Vec<[Vec3; 2]>,
}

/// No pack: far from everything.
const NO_BOXES: [[[f32; LANES]; 3]; 2] = [[[f32::MAX; LANES]; 3]; 2];

impl Boxes {
    /// The boxes around triangles or edges, in packs of eight; their number is a multiple of eight. They are loosened by how far
    /// the vertices may go, in metres; by nothing where `moves` is empty.
    pub fn place<const N: usize>(&mut self, things: &[[u32; N]], positions: &[Vec3], moves: &[f32]) {
        self.groups.clear();
        self.corners.clear();
        let mut bounds = NO_BOXES;
        for (number, pack) in things.chunks_exact(LANES).enumerate() {
            let lane = number % LANES;
            let (mut low, mut high, mut farthest) = (Vec3::MAX, Vec3::MIN, 0.0f32);
            for &v in pack.iter().flatten() {
                (low, high) = (low.min(positions[v as usize]), high.max(positions[v as usize]));
                farthest = farthest.max(moves.get(v as usize).copied().unwrap_or(0.0));
            }
            let (low, high) = (low - farthest, high + farthest);
            self.corners.push([low, high]);
            for axis in 0..3 {
                bounds[0][axis][lane] = low[axis];
                bounds[1][axis][lane] = high[axis];
            }
            if lane + 1 == LANES || (number + 1) * LANES == things.len() {
                self.groups.push(std::mem::replace(&mut bounds, NO_BOXES).map(|corner| corner.map(f32x8::new)));
            }
        }
    }

    /// The lowest and highest corner of each pack's box.
    pub fn corners(&self) -> &[[Vec3; 2]] {
        &self.corners
    }

    /// The packs whose boxes are within `reach` metres of the box between two corners.
    pub fn select(&self, [low, high]: [Vec3; 2], reach: f32, some: &mut SomePacks) {
        some.numbers.clear();
        some.groups.clear();
        let limit = reach * reach;
        self.near(low, high, limit, |number| {
            some.numbers.push(number);
            limit
        });
        for numbers in some.numbers.chunks(LANES) {
            let mut bounds = NO_BOXES;
            for (lane, &number) in numbers.iter().enumerate() {
                for (corner, from) in bounds.iter_mut().zip(self.corners[number]) {
                    (0..3).for_each(|axis| corner[axis][lane] = from[axis]);
                }
            }
            some.groups.push(bounds.map(|corner| corner.map(f32x8::new)));
        }
    }

    /// Visits the packs in order whose boxes are within a squared distance of the box between `low` and `high`; the visitor
    /// returns the squared distance from then on.
    #[inline]
    pub fn near(&self, low: Vec3, high: Vec3, limit: f32, visit: impl FnMut(usize) -> f32) {
        boxes_near(&self.groups, low, high, limit, visit);
    }
}

/// Some packs of a body, and their boxes.
#[derive(Default)]
pub struct SomePacks {
    numbers: Vec<usize>,
    groups: Vec<[[f32x8; 3]; 2]>,
}

impl SomePacks {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// Visits those of them whose boxes are within `reach` metres of the box between `low` and `high`.
    #[inline]
    pub fn near(&self, low: Vec3, high: Vec3, reach: f32, mut visit: impl FnMut(usize)) {
        let limit = reach * reach;
        boxes_near(&self.groups, low, high, limit, |k| {
            visit(self.numbers[k]);
            limit
        });
    }
}

#[inline]
fn boxes_near(groups: &[[[f32x8; 3]; 2]], low: Vec3, high: Vec3, mut limit: f32, mut visit: impl FnMut(usize) -> f32) {
    let (low, high) = (splat(low), splat(high));
    for (group, bounds) in groups.iter().enumerate() {
        let mut squared = f32x8::ZERO;
        for axis in 0..3 {
            let beyond = (bounds[0][axis] - high[axis]).fast_max(low[axis] - bounds[1][axis]);
            let beyond = beyond.fast_max(f32x8::ZERO);
            squared += beyond * beyond;
        }
        let mut near = squared.simd_le(f32x8::splat(limit)).to_bitmask();
        while near != 0 {
            let lane = near.trailing_zeros() as usize;
            near &= near - 1;
            limit = visit(group * LANES + lane);
        }
    }
}

/// Whether two boxes are within `reach` metres of each other along each axis.
#[inline]
pub fn are_near([low, high]: [Vec3; 2], [lowest, highest]: [Vec3; 2], reach: f32) -> bool {
    high.cmpge(lowest - reach).all() && low.cmple(highest + reach).all()
}
