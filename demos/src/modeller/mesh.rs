//! A triangle mesh, and what can be asked of one: closed? how large? which normals?

use std::collections::BTreeMap;

use glam::Vec3;

/// Points and triangles, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Where the vertices are.
    pub positions: Vec<Vec3>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The three corners of a triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|v| self.positions[v as usize])
    }

    /// The enclosed volume; positive if the triangles face outward.
    pub fn volume(&self) -> f32 {
        let six_times: f64 = self
            .triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = self.corners(t);
                f64::from(a.dot(b.cross(c)))
            })
            .sum();
        (six_times / 6.0) as f32
    }

    /// The surface area.
    pub fn area(&self) -> f32 {
        let twice: f64 = self
            .triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = self.corners(t);
                f64::from((b - a).cross(c - a).length())
            })
            .sum();
        (twice / 2.0) as f32
    }

    /// A unit normal per vertex, weighted by the areas of the triangles around it.
    pub fn normals(&self) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.positions.len()];
        for &t in &self.triangles {
            let [a, b, c] = self.corners(t);
            let weighted = (b - a).cross(c - a);
            for v in t {
                normals[v as usize] += weighted;
            }
        }
        normals.into_iter().map(|n| n.normalize_or(Vec3::Y)).collect()
    }

    /// Every edge once, as (smaller, larger), in order.
    pub fn edges(&self) -> Vec<(u32, u32)> {
        let mut edges: Vec<_> = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Whether every edge belongs to exactly two triangles that run along it in opposite senses.
    pub fn is_closed(&self) -> bool {
        let mut senses: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for edge in [(a, b), (b, c), (c, a)] {
                *senses.entry(edge).or_default() += 1;
            }
        }
        senses.iter().all(|(&(a, b), &count)| count == 1 && senses.get(&(b, a)) == Some(&1))
    }

    /// Vertices minus edges plus triangles: 2 for anything that could be blown up into a ball.
    pub fn euler_characteristic(&self) -> i64 {
        self.positions.len() as i64 - self.edges().len() as i64 + self.triangles.len() as i64
    }

    /// How many pieces the mesh falls into.
    pub fn component_count(&self) -> usize {
        let mut parent: Vec<u32> = (0..self.positions.len() as u32).collect();
        for (a, b) in self.edges() {
            let (a, b) = (root_of(&mut parent, a), root_of(&mut parent, b));
            parent[a.max(b) as usize] = a.min(b);
        }
        (0..parent.len()).filter(|&v| parent[v] == v as u32).count()
    }
}

/// The representative of the piece that `v` belongs to.
fn root_of(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}
