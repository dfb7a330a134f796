//! Normals that are smooth over gentle bends and sharp over creases.

use std::collections::HashMap;

use glam::Vec3;

use crate::render::MeshData;

/// A mesh whose vertices are split where the faces around them turn by more than `degrees`.
pub fn creased(positions: &[Vec3], triangles: &[[u32; 3]], degrees: f32) -> MeshData {
    let corner = |t: &[u32; 3]| t.map(|i| positions[i as usize]);
    let areas: Vec<Vec3> = triangles.iter().map(corner).map(|[a, b, c]| (b - a).cross(c - a)).collect();
    let units: Vec<Vec3> = areas.iter().map(|n| n.normalize_or_zero()).collect();
    let mut around: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    let key = |p: Vec3| (p + 0.0).to_array().map(f32::to_bits);
    for (face, t) in triangles.iter().enumerate() {
        for p in corner(t) {
            around.entry(key(p)).or_default().push(face);
        }
    }
    let limit = degrees.to_radians().cos();
    let mut mesh = MeshData::default();
    for (face, t) in triangles.iter().enumerate() {
        for p in corner(t) {
            let near = around[&key(p)].iter().filter(|&&other| units[other].dot(units[face]) > limit);
            let normal: Vec3 = near.map(|&other| areas[other]).sum();
            mesh.indices.push(mesh.positions.len() as u32);
            mesh.positions.push(p);
            mesh.normals.push(normal.normalize_or(units[face]));
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_angle_stays_sharp_and_a_gentle_bend_is_smooth() {
        let bent = |rise: f32| {
            let p = [Vec3::ZERO, Vec3::Z, Vec3::X, Vec3::new(-1.0, rise, 0.0)];
            creased(&p, &[[0, 1, 2], [0, 3, 1]], 40.0).normals
        };
        assert!(bent(0.2)[0].x.abs() > 1e-3 && bent(0.2)[0] == bent(0.2)[3]);
        assert_eq!(bent(3.0)[0], Vec3::Y);
    }
}
