//! Voxels as few boxes.
//!
//! In each block of the grid boxes grow from voxels that no box has covered yet, through all that is filled, also beyond
//! the block and through other boxes: what is level is one box around a body, and the lower step goes on below the
//! higher one. Boxes that ended at each other would leave seams, through which skin is pushed from one into the next.

use std::collections::BTreeSet;

use glam::IVec3;
use rapier3d::parry::bounding_volume::Aabb;
use rapier3d::parry::shape::{SharedShape, Voxels};

use super::local_part::LocalPart;
use crate::field::{ConvexPart, PartShape};
use crate::math::{Pose, Vec3};

/// Voxels along each side of a block.
const BLOCK: i32 = 16;

/// Boxes grow this far beyond their block.
const MARGIN: i32 = 16;

/// Where a region has more blocks than this, they are found by the filled voxels in it.
const MANY_BLOCKS: i64 = 4096;

/// Block coordinates are packed into this many bits each.
const BITS: u32 = 21;

fn key(block: IVec3) -> u64 {
    let [x, y, z] = block.to_array().map(|c| u64::from((c + (1 << (BITS - 1))) as u32 & ((1 << BITS) - 1)));
    (x << (2 * BITS)) | (y << BITS) | z
}

fn block_of(key: u64) -> IVec3 {
    let c = |shift: u32| ((key >> shift) & ((1 << BITS) - 1)) as i32 - (1 << (BITS - 1));
    IVec3::new(c(2 * BITS), c(BITS), c(0))
}

/// See [`super::PartSource::cells_near`].
pub(super) fn cells_near(grid: &Voxels, region: &Aabb, cells: &mut Vec<u64>) {
    let [first, end] = grid.domain();
    let bounds = grid.voxel_range_aabb(first, end);
    let near = Aabb::new(region.mins.max(bounds.mins), region.maxs.min(bounds.maxs));
    if near.mins.cmpgt(near.maxs).any() {
        return;
    }
    let [low, high] = grid.voxel_range_intersecting_local_aabb(&near);
    // A region that ends on the border of a voxel meets the voxel beyond it too.
    let (low, high) = ((low - 1).max(first), (high + 1).min(end));
    let block = |voxel: IVec3| voxel.map(|c| c.div_euclid(BLOCK));
    let (from, to) = (block(low), block(high - 1));
    let count: i64 = (to - from).to_array().iter().map(|&c| i64::from(c) + 1).product();
    if count <= MANY_BLOCKS {
        for x in from.x..=to.x {
            for y in from.y..=to.y {
                cells.extend((from.z..=to.z).map(|z| key(IVec3::new(x, y, z))));
            }
        }
    } else {
        let filled: BTreeSet<u64> = grid.voxels_in_range(low, high).map(|v| key(block(v.grid_coords))).collect();
        cells.extend(filled);
    }
}

/// See [`super::PartSource::expand`]: boxes that fill a block, each with the number of the voxel that it grew from.
pub(super) fn expand(grid: &Voxels, cell: u64) -> Vec<(u32, LocalPart)> {
    let neighbourhood = Neighbourhood::new(grid, block_of(cell) * BLOCK);
    let mut covered = BTreeSet::new();
    let mut boxes = Vec::new();
    for seed in cells_of([IVec3::splat(MARGIN), IVec3::splat(MARGIN + BLOCK)]) {
        if covered.contains(&seed.to_array()) || neighbourhood.filled(seed, seed + 1) == 0 {
            continue;
        }
        let [low, high] = neighbourhood.grown(seed);
        covered.extend(
            cells_of([low.max(IVec3::splat(MARGIN)), high.min(IVec3::splat(MARGIN + BLOCK))]).map(|c| c.to_array()),
        );
        let number = grid.linear_index(neighbourhood.first + seed).map_or(0, |index| index.flat_id() as u32);
        let bounds = grid.voxel_range_aabb(neighbourhood.first + low, neighbourhood.first + high);
        boxes.push((number, cuboid(&bounds)));
    }
    boxes.sort_by_key(|(number, _)| *number);
    boxes
}

/// How many voxels are filled in the boxes around a block, by a table of sums.
struct Neighbourhood {
    /// The voxel at place 0.
    first: IVec3,
    /// Filled voxels between place 0 and each place.
    sums: Vec<u32>,
}

/// Places along each side.
const PLACES: i32 = BLOCK + 2 * MARGIN;

impl Neighbourhood {
    /// Of the block that begins at a voxel.
    fn new(grid: &Voxels, block: IVec3) -> Self {
        let first = block - MARGIN;
        let mut neighbourhood = Self { first, sums: vec![0; (PLACES as usize + 1).pow(3)] };
        for voxel in grid.voxels_in_range(first, first + PLACES) {
            let at = index(voxel.grid_coords - first + 1);
            neighbourhood.sums[at] = 1;
        }
        for axis in [IVec3::X, IVec3::Y, IVec3::Z] {
            for place in cells_of([IVec3::ONE, IVec3::splat(PLACES + 1)]) {
                neighbourhood.sums[index(place)] += neighbourhood.sums[index(place - axis)];
            }
        }
        neighbourhood
    }

    /// The number of filled voxels in the box from `low` up to `high`.
    fn filled(&self, low: IVec3, high: IVec3) -> u32 {
        let sum = |x: i32, y: i32, z: i32| self.sums[index(IVec3::new(x, y, z))];
        let upper = sum(high.x, high.y, high.z)
            + sum(low.x, low.y, high.z)
            + sum(low.x, high.y, low.z)
            + sum(high.x, low.y, low.z);
        let lower = sum(low.x, high.y, high.z)
            + sum(high.x, low.y, high.z)
            + sum(high.x, high.y, low.z)
            + sum(low.x, low.y, low.z);
        upper - lower
    }

    /// The box that a filled voxel grows to: by a layer on each side in turn, as long as all of the layer is filled.
    fn grown(&self, seed: IVec3) -> [IVec3; 2] {
        let (mut low, mut high) = (seed, seed + 1);
        let mut grown = true;
        while grown {
            grown = false;
            for axis in [IVec3::Y, IVec3::X, IVec3::Z] {
                let area = ((high - low) * (IVec3::ONE - axis) + axis).element_product() as u32;
                let along = |v: IVec3| (v * axis).element_sum();
                if along(high) < PLACES && self.filled(low * (IVec3::ONE - axis) + high * axis, high + axis) == area {
                    high += axis;
                    grown = true;
                }
                if along(low) > 0 && self.filled(low - axis, high * (IVec3::ONE - axis) + low * axis) == area {
                    low -= axis;
                    grown = true;
                }
            }
        }
        [low, high]
    }
}

fn index(place: IVec3) -> usize {
    let side = PLACES as usize + 1;
    (place.x as usize * side + place.y as usize) * side + place.z as usize
}

fn cells_of([low, high]: [IVec3; 2]) -> impl Iterator<Item = IVec3> {
    (low.x..high.x)
        .flat_map(move |x| (low.y..high.y).flat_map(move |y| (low.z..high.z).map(move |z| IVec3::new(x, y, z))))
}

fn cuboid(bounds: &Aabb) -> LocalPart {
    let half: Vec3 = bounds.half_extents();
    let shape = SharedShape::cuboid(half.x, half.y, half.z);
    LocalPart {
        pose: Pose::from_translation(bounds.center()),
        part: ConvexPart { shape: PartShape::Cuboid { half_extents: half }, rounding: 0.0 },
        exact: shape.clone(),
        shape,
        border: 0.0,
        face: None,
    }
}
