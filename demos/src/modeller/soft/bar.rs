//! A bar along x, for bending and for signals that run along it.

use glam::Vec3;

use super::cells::Cells;

/// Length of the bar; it lies about the origin.
pub const LENGTH: f32 = 2.0;
/// Height and depth.
pub const THICKNESS: f32 = 0.4;

/// A bar of `across` by `across` by `along` cubes.
pub fn bar(across: u32, along: u32) -> Cells {
    let row = across + 1;
    let mut triangles = Vec::new();
    for i in 0..across {
        for j in 0..across {
            let v = |i: u32, j: u32| i * row + j;
            // Diagonals meet in the middle, so that the bar is the same on all sides.
            if (i < across / 2) == (j < across / 2) {
                triangles.push([v(i, j), v(i + 1, j), v(i + 1, j + 1)]);
                triangles.push([v(i, j), v(i + 1, j + 1), v(i, j + 1)]);
            } else {
                triangles.push([v(i, j), v(i + 1, j), v(i, j + 1)]);
                triangles.push([v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)]);
            }
        }
    }
    let side = |k: u32| (k as f32 / across as f32 - 0.5) * THICKNESS;
    Cells::sweep(
        &triangles,
        along as usize + 1,
        |_, _| true,
        |v, layer| Vec3::new((layer as f32 / along as f32 - 0.5) * LENGTH, side(v / row), side(v % row)),
    )
}
