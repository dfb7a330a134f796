//! The boundary of a kind of body as others meet it: its vertices, triangles and edges, neighbours beside each other.

use super::lanes::LANES;
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;

/// The boundary of a kind of body.
#[derive(Clone, Debug)]
pub struct ContactSurface {
    /// The vertices of the boundary, ascending.
    pub vertices: Vec<u32>,
    /// The triangles, those of a pack near each other; the last one is repeated until the last pack is full.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle but the repeated ones, where its corners are in `vertices`.
    places: Vec<[u32; 3]>,
    /// The edges, in the same manner.
    pub edges: Vec<[u32; 2]>,
    /// The vertices once more, in the same manner.
    pub points: Vec<[u32; 1]>,
    /// How many edges there are without the repeated ones.
    pub edge_count: usize,
    /// The mean length of an edge in metres.
    pub edge: f32,
}

impl ContactSurface {
    /// The boundary of a mesh at rest, whose edges are `edge` metres long in the mean.
    pub fn new(mesh: &TetrahedralMesh, edge: f32) -> Self {
        let (positions, triangles) = (&mesh.positions, mesh.boundary());
        let count = triangles.len();
        let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let sides = |[a, b, c]: [u32; 3]| [[a.min(b), a.max(b)], [b.min(c), b.max(c)], [c.min(a), c.max(a)]];
        let mut edges: Vec<[u32; 2]> = triangles.iter().copied().flat_map(sides).collect();
        edges.sort_unstable();
        edges.dedup();
        let edge_count = edges.len();
        let triangles = in_packs(&triangles, positions);
        let edges = in_packs(&edges, positions);
        let points = in_packs(&vertices.iter().map(|&v| [v]).collect::<Vec<_>>(), positions);
        let place = |v: u32| vertices.binary_search(&v).unwrap_or_default() as u32;
        let places = triangles[..count].iter().map(|t| t.map(place)).collect();
        Self { vertices, triangles, places, edges, points, edge_count, edge }
    }

    /// How many triangles there are without the repeated ones.
    pub fn triangle_count(&self) -> usize {
        self.places.len()
    }

    /// The outward normals of [`ContactSurface::vertices`], weighted by the areas around them; unit or zero.
    pub fn normals(&self, positions: &[Vec3]) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.vertices.len()];
        for (triangle, places) in self.triangles.iter().zip(&self.places) {
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            let normal = (b - a).cross(c - a);
            places.iter().for_each(|&p| normals[p as usize] += normal);
        }
        normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
        normals
    }
}

/// Triangles or edges in the order of their places, those of a pack near each other; the last one is repeated until the last pack
/// is full.
fn in_packs<const N: usize>(all: &[[u32; N]], positions: &[Vec3]) -> Vec<[u32; N]> {
    let middle = |t: &[u32; N]| t.iter().map(|&v| positions[v as usize]).sum::<Vec3>() / N as f32;
    let mut placed: Vec<(Vec3, [u32; N])> = all.iter().map(|t| (middle(t), *t)).collect();
    halve(&mut placed);
    let mut ordered: Vec<[u32; N]> = placed.into_iter().map(|(_, t)| t).collect();
    if let Some(&last) = ordered.last() {
        ordered.resize(ordered.len().next_multiple_of(LANES), last);
    }
    ordered
}

/// Orders places so that each run of eight lies together: halves along the longest side, at a multiple of eight.
fn halve<const N: usize>(places: &mut [(Vec3, [u32; N])]) {
    if places.len() <= LANES {
        return;
    }
    let low = places.iter().map(|p| p.0).fold(Vec3::MAX, Vec3::min);
    let sides = places.iter().map(|p| p.0).fold(Vec3::MIN, Vec3::max) - low;
    let axis = sides.max_position();
    places.sort_by(|a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let middle = (places.len() / 2).next_multiple_of(LANES).min(places.len() - 1);
    let (a, b) = places.split_at_mut(middle);
    halve(a);
    halve(b);
}
