//! Flat discs and rings of triangles: the cross-sections that are swept.

use glam::Vec2;

/// Rings of vertices about the origin, and triangles between them, counter-clockwise.
#[derive(Clone, Debug)]
pub struct Disc {
    /// Ring of each vertex, from the inside, and its place on it as a share of the turn.
    pub places: Vec<(usize, f32)>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    rings: usize,
}

impl Disc {
    /// A disc whose rings have so many vertices; the first may be 1, the middle. Without it there is a hole.
    pub fn new(counts: &[u32]) -> Self {
        let mut places = Vec::new();
        let mut triangles = Vec::new();
        let mut start = 0;
        for (ring, &count) in counts.iter().enumerate() {
            places.extend((0..count).map(|k| (ring, k as f32 / count as f32)));
            if ring > 0 {
                zip([start - counts[ring - 1], start], [counts[ring - 1], count], &mut triangles);
            }
            start += count;
        }
        Self { places, triangles, rings: counts.len() }
    }

    /// The share of the radius of a vertex, in [0, 1].
    pub fn radius(&self, vertex: u32) -> f32 {
        self.places[vertex as usize].0 as f32 / (self.rings - 1) as f32
    }

    /// The angle of a vertex in radians.
    pub fn angle(&self, vertex: u32) -> f32 {
        self.places[vertex as usize].1 * std::f32::consts::TAU
    }

    /// The vertex on the disc of radius 1 with even rings.
    pub fn point(&self, vertex: u32) -> Vec2 {
        self.radius(vertex) * Vec2::from_angle(self.angle(vertex))
    }
}

/// The triangles between two rings, by the vertices where they begin and how many they have.
fn zip([inner, outer]: [u32; 2], [n, m]: [u32; 2], triangles: &mut Vec<[u32; 3]>) {
    let (mut i, mut j) = (0, 0);
    let steps = if n == 1 { 0 } else { n };
    while i < steps || j < m {
        let [a, b] = [inner + i % n, outer + j % m];
        // The ring whose next vertex comes first goes on.
        if i == steps || (j < m && (2 * j + 1) * n <= (2 * i + 1) * m) {
            triangles.push([a, b, outer + (j + 1) % m]);
            j += 1;
        } else {
            triangles.push([a, b, inner + (i + 1) % n]);
            i += 1;
        }
    }
}
