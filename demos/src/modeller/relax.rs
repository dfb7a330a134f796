//! Tangential relaxation: every vertex moves along the surface to the middle of the triangles
//! around it, and then back onto the surface, which evens the triangles and keeps the shape.

use glam::Vec3;

use super::field::Field;
use super::mesh::Mesh;

/// How far a vertex goes towards the middle in one round.
const EAGERNESS: f32 = 0.7;
/// The cosine by which a triangle may turn in one round.
const STEADINESS: f32 = 0.4;

/// Relaxes `mesh` on the surface of `field` for `rounds` rounds.
///
/// Triangles weigh by their area over the square of the `wished` edge length there, so that a
/// mesh that is meant to be finer in one place stays so.
pub fn relax(mesh: &mut Mesh, field: &impl Field, wished: &impl Fn(Vec3) -> f32, rounds: usize) {
    for _ in 0..rounds {
        let middles = middles_around(mesh, wished);
        let normals = mesh.normals();
        let moved = |((&p, middle), normal): ((&Vec3, Vec3), Vec3)| {
            let offset = middle - p;
            let along = offset - normal * offset.dot(normal);
            field.onto_surface(p + along * EAGERNESS, wished(p) * 0.5)
        };
        let moved: Vec<Vec3> = (mesh.positions.iter().zip(middles).zip(normals)).map(moved).collect();
        move_unless_folding(mesh, moved);
    }
}

/// Moves the vertices, except those of triangles that would turn over.
fn move_unless_folding(mesh: &mut Mesh, mut moved: Vec<Vec3>) {
    let facing = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    for _ in 0..3 {
        for &t in &mesh.triangles {
            let before = facing(mesh.corners(t));
            let after = facing(t.map(|v| moved[v as usize]));
            if before.dot(after) < STEADINESS {
                for v in t {
                    moved[v as usize] = mesh.positions[v as usize];
                }
            }
        }
    }
    mesh.positions = moved;
}

/// The weighted middle of the triangles around every vertex.
fn middles_around(mesh: &Mesh, wished: &impl Fn(Vec3) -> f32) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); mesh.positions.len()];
    for &t in &mesh.triangles {
        let [a, b, c] = mesh.corners(t);
        let middle = (a + b + c) / 3.0;
        let weight = (b - a).cross(c - a).length() / wished(middle).powi(2);
        for v in t {
            sums[v as usize].0 += middle * weight;
            sums[v as usize].1 += weight;
        }
    }
    sums.iter().zip(&mesh.positions).map(|(&(sum, weight), &p)| if weight > 0.0 { sum / weight } else { p }).collect()
}
