//! Soft toys for heaps and funnels: a die with rounded edges and a bean.

use glam::Vec3;

use super::blend::carve;
use super::mesh::Mesh;
use super::remesh::remesh_to_count;
use super::shapes::rounded_box;
use super::smooth::smooth;
use super::surface::mesh_of;
use super::tube::Tube;

/// Triangles of each toy.
const TRIANGLES: usize = 3_000;

/// A die 0.8 m wide, its sides a little hollow.
pub fn die() -> Mesh {
    let die = |p: Vec3| {
        let whole = rounded_box(p, Vec3::ZERO, Vec3::splat(0.40), 0.14);
        let hollow = |q: Vec3| q.distance(Vec3::X * 1.98) - 1.6;
        let a = p.abs();
        [a, Vec3::new(a.y, a.z, a.x), Vec3::new(a.z, a.x, a.y)].iter().fold(whole, |d, &q| carve(d, hollow(q), 0.08))
    };
    toy(&die, Vec3::splat(0.5))
}

/// A bean 1.3 m long, lying along x and bent upward.
pub fn bean() -> Mesh {
    let tube = Tube::through(&[
        [-0.42, 0.12, 0.0, 0.23],
        [-0.22, -0.02, 0.0, 0.24],
        [0.0, -0.06, 0.0, 0.22],
        [0.22, -0.02, 0.0, 0.24],
        [0.42, 0.12, 0.0, 0.23],
    ]);
    toy(&|p: Vec3| tube.distance(p), Vec3::new(0.80, 0.50, 0.40))
}

/// Meshes a toy that lies within `half` around the origin.
fn toy(distance: &impl Fn(Vec3) -> f32, half: Vec3) -> Mesh {
    let mut mesh = mesh_of(distance, -half, half, 0.03);
    smooth(&mut mesh, 2);
    remesh_to_count(mesh, distance, &|_| 1.0, TRIANGLES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modeller::quality::Quality;

    #[test]
    fn the_toys_are_closed_pieces_of_even_triangles_that_face_outward() {
        // A cube of 0.8 m without its edges and dents; a round tube of 0.23 m, 0.9 m along its bend, with round ends.
        for (toy, volume) in [(die(), 0.42), (bean(), 0.21)] {
            assert!(toy.is_closed() && toy.component_count() == 1 && toy.euler_characteristic() == 2);
            assert!((toy.volume() / volume - 1.0).abs() < 0.1, "{}", toy.volume());
            assert!(toy.triangles.len().abs_diff(TRIANGLES) <= 80, "{}", toy.triangles.len());
            assert!(Quality::of(&toy).smallest_angle > 25.0, "{:?}", Quality::of(&toy));
        }
    }
}
