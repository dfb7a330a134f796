//! Meshes of cubes, each cut into six cells along its diagonal.

use std::collections::BTreeMap;

use pliant::math::Vec3;
use pliant::mesh::TetrahedralMesh;

/// The cubes of a grid that `solid` keeps, at `place` of their corners.
pub fn cubes(counts: [u32; 3], solid: impl Fn([u32; 3]) -> bool, place: impl Fn(Vec3) -> Vec3) -> TetrahedralMesh {
    let mut numbers: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let (mut positions, mut cells) = (Vec::new(), Vec::new());
    let mut vertex = |corner: [u32; 3]| {
        *numbers.entry(corner).or_insert_with(|| {
            positions.push(place(Vec3::from(corner.map(|c| c as f32))));
            positions.len() as u32 - 1
        })
    };
    for x in 0..counts[0] {
        for y in 0..counts[1] {
            for z in 0..counts[2] {
                if !solid([x, y, z]) {
                    continue;
                }
                for [a, b, c] in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
                    let mut corner = [x, y, z];
                    let mut cell = vec![vertex(corner)];
                    for axis in [a, b, c] {
                        corner[axis] += 1;
                        cell.push(vertex(corner));
                    }
                    // Odd permutations turn the cell over.
                    if (a + 1) % 3 != b {
                        cell.swap(1, 2);
                    }
                    cells.push([cell[0], cell[1], cell[2], cell[3]]);
                }
            }
        }
    }
    TetrahedralMesh::new(positions, cells).expect("cubes are sound")
}

/// A bar from the origin along x, of cubes of side `side`.
pub fn bar(counts: [u32; 3], side: f32) -> TetrahedralMesh {
    cubes(counts, |_| true, |p| p * side)
}

/// A solid cylinder about x, of the given length, of radius 1: a square prism whose cross-section is rounded.
pub fn cylinder(length: f32, along: u32, across: u32) -> TetrahedralMesh {
    let n = 2 * across;
    cubes(
        [along, n, n],
        |_| true,
        move |p| {
            let q = [p.y, p.z].map(|c| c / across as f32 - 1.0);
            let square = q[0].abs().max(q[1].abs());
            let round = (q[0] * q[0] + q[1] * q[1]).sqrt();
            let scale = if round > 0.0 { square / round } else { 0.0 };
            Vec3::new(p.x * length / along as f32, q[0] * scale, q[1] * scale)
        },
    )
}
