//! Voxels as few boxes: in each block of the grid, filled neighbours are merged.

use std::collections::BTreeSet;

use glam::IVec3;
use rapier3d::parry::bounding_volume::Aabb;
use rapier3d::parry::shape::{SharedShape, Voxels};

use super::local_part::LocalPart;
use crate::field::{ConvexPart, PartShape};
use crate::math::{Pose, Vec3};

/// Voxels along each side of a block.
const BLOCK: i32 = 16;

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

/// See [`super::PartSource::expand`]: the boxes of a block, each with the number of its first voxel.
pub(super) fn expand(grid: &Voxels, cell: u64) -> Vec<(u32, LocalPart)> {
    let first = block_of(cell) * BLOCK;
    let mut filled: BTreeSet<[i32; 3]> =
        grid.voxels_in_range(first, first + BLOCK).map(|voxel| voxel.grid_coords.to_array()).collect();
    let mut boxes = Vec::new();
    while let Some(&corner) = filled.first() {
        let mut end = corner.map(|c| c + 1);
        // As far along z as it goes, then that row along y, then that layer along x.
        for axis in [2, 1, 0] {
            loop {
                let mut layer = [corner, end];
                (layer[0][axis], layer[1][axis]) = (end[axis], end[axis] + 1);
                if end[axis] >= first[axis] + BLOCK || !cells_of(layer).all(|voxel| filled.contains(&voxel)) {
                    break;
                }
                end[axis] += 1;
            }
        }
        for voxel in cells_of([corner, end]) {
            filled.remove(&voxel);
        }
        let number = grid.linear_index(IVec3::from(corner)).map_or(0, |index| index.flat_id() as u32);
        boxes.push((number, cuboid(&grid.voxel_range_aabb(IVec3::from(corner), IVec3::from(end)))));
    }
    boxes.sort_by_key(|(number, _)| *number);
    boxes
}

fn cells_of([low, high]: [[i32; 3]; 2]) -> impl Iterator<Item = [i32; 3]> {
    (low[0]..high[0]).flat_map(move |x| (low[1]..high[1]).flat_map(move |y| (low[2]..high[2]).map(move |z| [x, y, z])))
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
