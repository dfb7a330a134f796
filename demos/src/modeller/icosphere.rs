//! A ball: an icosahedron whose triangles are split in four again and again and whose vertices
//! are lifted onto the sphere.

use std::collections::BTreeMap;

use glam::Vec3;

use super::mesh::Mesh;

/// A ball around the origin, split `times` times (four times give 2,562 vertices).
pub fn icosphere(radius: f32, times: usize) -> Mesh {
    let mut mesh = icosahedron();
    for _ in 0..times {
        mesh = split_in_four(&mesh);
    }
    for p in &mut mesh.positions {
        *p = p.normalize() * radius;
    }
    mesh
}

/// The regular solid of twenty triangles.
fn icosahedron() -> Mesh {
    let golden = (1.0 + 5.0f32.sqrt()) / 2.0;
    let mut positions = Vec::with_capacity(12);
    for (long, short) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let (g, s) = (golden * long, short);
        positions.extend([Vec3::new(0.0, s, g), Vec3::new(s, g, 0.0), Vec3::new(g, 0.0, s)]);
    }
    let near = |a: u32, b: u32| {
        let squared = positions[a as usize].distance_squared(positions[b as usize]);
        (squared - 4.0).abs() < 1e-3
    };
    let mut triangles = Vec::with_capacity(20);
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    triangles.push(outward(&positions, [a, b, c]));
                }
            }
        }
    }
    Mesh { positions, triangles }
}

/// The triangle turned so that it faces away from the origin.
fn outward(positions: &[Vec3], [a, b, c]: [u32; 3]) -> [u32; 3] {
    let [pa, pb, pc] = [a, b, c].map(|v| positions[v as usize]);
    if pa.dot(pb.cross(pc)) > 0.0 { [a, b, c] } else { [a, c, b] }
}

/// Every triangle becomes four, by a vertex in the middle of every edge, lifted onto the unit sphere.
fn split_in_four(mesh: &Mesh) -> Mesh {
    let mut positions = mesh.positions.clone();
    let mut middles = BTreeMap::new();
    let mut triangles = Vec::with_capacity(mesh.triangles.len() * 4);
    for &[a, b, c] in &mesh.triangles {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to)| {
            *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                let [start, end] = [from, to].map(|v| positions[v as usize].normalize());
                positions.push((start + end).normalize());
                positions.len() as u32 - 1
            })
        });
        triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    Mesh { positions, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ball_is_closed_and_faces_outward() {
        let ball = icosphere(0.5, 4);
        assert_eq!(ball.positions.len(), 2562);
        assert_eq!(ball.triangles.len(), 5120);
        assert!(ball.is_closed());
        assert_eq!(ball.euler_characteristic(), 2);
        assert!((ball.volume() - 0.522).abs() < 0.002, "{}", ball.volume());
    }
}
