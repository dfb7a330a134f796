//! Loop's subdivision: each triangle becomes four, and the surface becomes smooth (Loop 1987, with the weights of Warren 1995).

use std::collections::BTreeMap;

use glam::Vec3;

use super::mesh::Mesh;

/// A closed mesh, finer and smoother.
pub fn subdivided(mesh: &Mesh) -> Mesh {
    let x = |v: u32| mesh.positions[v as usize];
    // The corners across each edge, and the neighbours of each vertex.
    let mut across: BTreeMap<(u32, u32), Vec3> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (p, q, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
            *across.entry((p.min(q), p.max(q))).or_default() += x(opposite);
        }
    }
    let mut around = vec![(Vec3::ZERO, 0u32); mesh.positions.len()];
    for &(a, b) in across.keys() {
        for (v, other) in [(a, b), (b, a)] {
            around[v as usize].0 += x(other);
            around[v as usize].1 += 1;
        }
    }
    let moved = |(position, (sum, count)): (&Vec3, &(Vec3, u32))| {
        let beta = if *count == 3 { 3.0 / 16.0 } else { 3.0 / (8.0 * *count as f32) };
        *position * (1.0 - beta * *count as f32) + *sum * beta
    };
    let mut positions: Vec<Vec3> = mesh.positions.iter().zip(&around).map(moved).collect();
    let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for (&(a, b), opposite) in &across {
        middles.insert((a, b), positions.len() as u32);
        positions.push(0.375 * (x(a) + x(b)) + 0.125 * *opposite);
    }
    let middle = |a: u32, b: u32| middles[&(a.min(b), a.max(b))];
    let four = |&[a, b, c]: &[u32; 3]| {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    let triangles = mesh.triangles.iter().flat_map(four).collect();
    Mesh { positions, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octahedron_becomes_rounder_and_stays_closed() {
        let positions = vec![Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
        let mut triangles = Vec::new();
        for (x, y, z) in (0..8).map(|i| (i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2))) {
            let turned = (x + (y - 2) + (z - 4)) % 2 == 1;
            triangles.push(if turned { [x, z, y] } else { [x, y, z] });
        }
        let mesh = Mesh { positions, triangles };
        let fine = subdivided(&subdivided(&subdivided(&mesh)));
        assert_eq!(fine.triangles.len(), 8 * 64);
        assert!(fine.is_closed() && fine.euler_characteristic() == 2);
        let radii: Vec<f32> = fine.positions.iter().map(|p| p.length()).collect();
        let (low, high) = radii.iter().fold((f32::MAX, 0.0f32), |(l, h), r| (l.min(*r), h.max(*r)));
        // The octahedron itself goes from 0.58 to 1.
        assert!(low / high > 0.8, "{low} {high}");
        assert!(fine.volume() > 0.0 && fine.volume() < mesh.volume());
    }
}
