//! Tetrahedral meshes made in code: blocks, tubes and balls.

use pliant::math::Vec3;
use pliant::mesh::TetrahedralMesh;

/// The cells of a block of `n` cubes, each cut in six about a diagonal.
fn block_cells(n: [u32; 3]) -> Vec<[u32; 4]> {
    let at = |x: u32, y: u32, z: u32| x + (n[0] + 1) * (y + (n[1] + 1) * z);
    let mut cells = Vec::new();
    for z in 0..n[2] {
        for y in 0..n[1] {
            for x in 0..n[0] {
                let v = |c: u32| at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
                let round = [1, 3, 2, 6, 4, 5];
                for k in 0..6 {
                    cells.push([v(0), v(round[k]), v(round[(k + 1) % 6]), v(7)]);
                }
            }
        }
    }
    cells
}

/// The corners of a block of `n` cubes, in [0, 1]³.
fn block_points(n: [u32; 3]) -> impl Iterator<Item = Vec3> {
    let [nx, ny, nz] = n;
    (0..=nz).flat_map(move |z| {
        (0..=ny).flat_map(move |y| {
            (0..=nx).map(move |x| Vec3::new(x as f32 / nx as f32, y as f32 / ny as f32, z as f32 / nz as f32))
        })
    })
}

/// A block of `n` cubes along each axis and this size, its middle at the origin.
pub fn block(n: [u32; 3], size: Vec3) -> TetrahedralMesh {
    let points = block_points(n).map(|p| (p - 0.5) * size).collect();
    TetrahedralMesh::new(points, block_cells(n)).expect("a block")
}

/// A ball of `(n + 1)³` vertices: a block whose shells are rounded.
pub fn ball(n: u32, radius: f32) -> TetrahedralMesh {
    let round = |p: Vec3| {
        let p = (p - 0.5) * 2.0;
        let [x, y, z] = (p * p).to_array();
        // The cube's surface onto the sphere without corners that are flat.
        radius
            * p
            * Vec3::new(
                (1.0 - y / 2.0 - z / 2.0 + y * z / 3.0).sqrt(),
                (1.0 - z / 2.0 - x / 2.0 + z * x / 3.0).sqrt(),
                (1.0 - x / 2.0 - y / 2.0 + x * y / 3.0).sqrt(),
            )
    };
    TetrahedralMesh::new(block_points([n; 3]).map(round).collect(), block_cells([n; 3])).expect("a ball")
}

/// A bent wall: a block bent round to part of a bell of this radius, as thick as `n[2]` cells.
pub fn bell(n: [u32; 3], radius: f32, thickness: f32) -> TetrahedralMesh {
    let bend = |p: Vec3| {
        let (a, b) = ((p.x - 0.5) * 2.5, (p.y - 0.5) * 2.5);
        let r = radius - thickness * (1.0 - p.z);
        let d = Vec3::new(a.tan().clamp(-3.0, 3.0), 1.0, b.tan().clamp(-3.0, 3.0)).normalize();
        d * r
    };
    let points = block_points(n).map(bend).collect();
    let mut cells = block_cells(n);
    cells.iter_mut().for_each(|c| c.swap(1, 2));
    TetrahedralMesh::new(points, cells).expect("a bell")
}
