//! Mending folds: a triangle that looks into the body instead of out of it loses its shortest
//! edge, and its surroundings are evened until nothing is folded any more.

use glam::Vec3;

use super::field::Field;
use super::mesh::Mesh;
use super::surgery::Surgery;

/// How often a fold is worked on before it is left as it is.
const ATTEMPTS: usize = 8;
/// How often the surroundings of a fold are evened before the fold is cut.
const EVENING_ROUNDS: usize = 6;
/// How many edges the surroundings reach.
const RINGS: usize = 2;
/// Triangles whose normal has less than this cosine to the field's gradient are folded.
const UPRIGHT: f32 = 0.15;

/// Takes the folds out of `mesh`.
pub fn mend(mesh: Mesh, field: &impl Field, wished: &impl Fn(Vec3) -> f32) -> Mesh {
    let mut mesh = mesh;
    for _ in 0..ATTEMPTS {
        let folded = folded_triangles(&mesh, field);
        if folded.is_empty() {
            break;
        }
        even_out(&mut mesh, field, wished, &folded);
        mesh = without_shortest_edges(&mesh, &folded_triangles(&mesh, field));
    }
    mesh
}

/// The triangles that look the wrong way.
pub fn folded_triangles(mesh: &Mesh, field: &impl Field) -> Vec<[u32; 3]> {
    let folded = |t: &&[u32; 3]| {
        let [a, b, c] = mesh.corners(**t);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let outward = field.gradient((a + b + c) / 3.0).normalize_or_zero();
        normal.dot(outward) < UPRIGHT
    };
    mesh.triangles.iter().filter(folded).copied().collect()
}

/// Merges the ends of the shortest edge of each of the triangles.
fn without_shortest_edges(mesh: &Mesh, triangles: &[[u32; 3]]) -> Mesh {
    let mut surgery = Surgery::on(mesh);
    for &[a, b, c] in triangles {
        let length = |&(p, q): &(u32, u32)| surgery.position(p).distance(surgery.position(q));
        let shortest = [(a, b), (b, c), (c, a)].into_iter().min_by(|p, q| length(p).total_cmp(&length(q)));
        if let Some((p, q)) = shortest {
            let middle = (surgery.position(p) + surgery.position(q)) * 0.5;
            surgery.merge(p, q, middle);
        }
    }
    surgery.finish()
}

/// Moves everything around the triangles to the middle of its neighbours and onto the surface.
fn even_out(mesh: &mut Mesh, field: &impl Field, wished: &impl Fn(Vec3) -> f32, triangles: &[[u32; 3]]) {
    let edges = mesh.edges();
    let region = region_around(mesh, &edges, triangles);
    for _ in 0..EVENING_ROUNDS {
        let mut sums = vec![(Vec3::ZERO, 0.0f32); mesh.positions.len()];
        for &(a, b) in &edges {
            for (v, other) in [(a, b), (b, a)] {
                sums[v as usize].0 += mesh.positions[other as usize];
                sums[v as usize].1 += 1.0;
            }
        }
        for &v in &region {
            let middle = sums[v].0 / sums[v].1;
            mesh.positions[v] = field.onto_surface(middle, wished(middle) * 0.5);
        }
    }
}

/// The corners of the triangles and the vertices a few edges around them.
fn region_around(mesh: &Mesh, edges: &[(u32, u32)], triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut inside = vec![false; mesh.positions.len()];
    for &v in triangles.iter().flatten() {
        inside[v as usize] = true;
    }
    for _ in 0..RINGS {
        let before = inside.clone();
        for &(a, b) in edges {
            inside[a as usize] |= before[b as usize];
            inside[b as usize] |= before[a as usize];
        }
    }
    (0..inside.len()).filter(|&v| inside[v]).collect()
}
