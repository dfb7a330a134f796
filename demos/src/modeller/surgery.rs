//! Local changes of a closed mesh: split an edge, collapse an edge, flip an edge. Each keeps the
//! mesh closed and refuses whatever would fold it or pinch it.

use glam::Vec3;

use super::mesh::Mesh;

/// A mesh under the knife: it knows the triangles around every vertex.
pub struct Surgery {
    positions: Vec<Vec3>,
    triangles: Vec<Option<[u32; 3]>>,
    fans: Vec<Vec<u32>>,
}

/// An edge with its two triangles: `left` runs a → b → `above`, `right` runs b → a → `below`.
struct Wings {
    left: u32,
    right: u32,
    above: u32,
    below: u32,
}

impl Surgery {
    /// Begins to work on `mesh`.
    pub fn on(mesh: &Mesh) -> Self {
        let mut fans = vec![Vec::with_capacity(6); mesh.positions.len()];
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            for &v in triangle {
                fans[v as usize].push(index as u32);
            }
        }
        Self { positions: mesh.positions.clone(), triangles: mesh.triangles.iter().copied().map(Some).collect(), fans }
    }

    /// Ends the work: what is left, with its vertices numbered anew.
    pub fn finish(self) -> Mesh {
        let mut new_index = vec![0; self.positions.len()];
        let mut positions = Vec::with_capacity(self.positions.len());
        for (v, fan) in self.fans.iter().enumerate() {
            if !fan.is_empty() {
                new_index[v] = positions.len() as u32;
                positions.push(self.positions[v]);
            }
        }
        let triangles = self.triangles.into_iter().flatten();
        Mesh { positions, triangles: triangles.map(|t| t.map(|v| new_index[v as usize])).collect() }
    }

    /// Where a vertex is.
    pub fn position(&self, v: u32) -> Vec3 {
        self.positions[v as usize]
    }

    /// How many triangles meet at a vertex.
    pub fn valence(&self, v: u32) -> i32 {
        self.fans[v as usize].len() as i32
    }

    /// The two vertices opposite the edge, if it still exists.
    pub fn opposite(&self, a: u32, b: u32) -> Option<[u32; 2]> {
        self.wings(a, b).map(|w| [w.above, w.below])
    }

    /// Puts a vertex at `middle` into the edge. Whether the edge was there.
    pub fn split(&mut self, a: u32, b: u32, middle: Vec3) -> bool {
        let Some(w) = self.wings(a, b) else {
            return false;
        };
        let m = self.positions.len() as u32;
        self.positions.push(middle);
        self.fans.push(Vec::with_capacity(6));
        self.remove(w.left);
        self.remove(w.right);
        self.add([a, m, w.above]);
        self.add([m, b, w.above]);
        self.add([b, m, w.below]);
        self.add([m, a, w.below]);
        true
    }

    /// Merges the ends of the edge at `place`, unless that would pinch or fold the mesh or make
    /// an edge longer than `longest`. Whether it did.
    pub fn collapse(&mut self, a: u32, b: u32, place: Vec3, longest: f32) -> bool {
        let around = [self.neighbours(a), self.neighbours(b)].concat();
        let too_long = |&v: &u32| v != a && v != b && self.position(v).distance(place) > longest;
        let folds = self.folds(a, b, place) || self.folds(b, a, place);
        !folds && !around.iter().any(too_long) && self.merge(a, b, place)
    }

    /// Merges the ends of the edge at `place`, unless that would pinch the mesh. Whether it did.
    pub fn merge(&mut self, a: u32, b: u32, place: Vec3) -> bool {
        let Some(w) = self.wings(a, b) else {
            return false;
        };
        let around_b = self.neighbours(b);
        let shared = (self.neighbours(a).iter()).filter(|v| around_b.contains(v)).count();
        if shared != 2
            || self.valence(a) + self.valence(b) > 13
            || self.valence(w.above) <= 3
            || self.valence(w.below) <= 3
        {
            return false;
        }
        self.remove(w.left);
        self.remove(w.right);
        for triangle in self.fans[b as usize].clone() {
            let corners = self.triangles[triangle as usize].expect("a fan holds living triangles");
            self.remove(triangle);
            self.add(corners.map(|v| if v == b { a } else { v }));
        }
        self.positions[a as usize] = place;
        true
    }

    /// Turns the edge between its two triangles, unless that would fold the mesh. Whether it did.
    pub fn flip(&mut self, a: u32, b: u32) -> bool {
        let Some(w) = self.wings(a, b) else {
            return false;
        };
        if self.wings(w.above, w.below).is_some()
            || self.neighbours(w.above).contains(&w.below)
            || self.valence(a) <= 4
            || self.valence(b) <= 4
        {
            return false;
        }
        let before = self.facing([a, b, w.above]) + self.facing([b, a, w.below]);
        let after = [[w.above, a, w.below], [w.below, b, w.above]];
        let upright = before.normalize_or_zero();
        if after.iter().any(|&t| self.facing(t).normalize_or_zero().dot(upright) < 0.5) {
            return false;
        }
        self.remove(w.left);
        self.remove(w.right);
        for triangle in after {
            self.add(triangle);
        }
        true
    }

    /// The vertices that share an edge with `v`.
    fn neighbours(&self, v: u32) -> Vec<u32> {
        let fan = self.fans[v as usize].iter();
        fan.filter_map(|&t| self.triangles[t as usize]).map(|t| follower(t, v)).collect()
    }

    /// The triangles at the edge from `a` to `b`.
    fn wings(&self, a: u32, b: u32) -> Option<Wings> {
        let (mut left, mut right) = (None, None);
        for &index in &self.fans[a as usize] {
            let triangle = self.triangles[index as usize]?;
            let next = follower(triangle, a);
            let last = follower(triangle, next);
            if next == b {
                left = Some((index, last));
            } else if last == b {
                right = Some((index, next));
            }
        }
        let ((left, above), (right, below)) = (left?, right?);
        Some(Wings { left, right, above, below })
    }

    /// Whether a triangle at `v`, but not at `other`, would tilt too far if `v` moved to `place`.
    fn folds(&self, v: u32, other: u32, place: Vec3) -> bool {
        self.fans[v as usize].iter().any(|&index| {
            let triangle = self.triangles[index as usize].expect("a fan holds living triangles");
            if triangle.contains(&other) {
                return false;
            }
            let before = self.facing(triangle).normalize_or_zero();
            let [p, q, r] = triangle.map(|c| if c == v { place } else { self.position(c) });
            let after = (q - p).cross(r - p).normalize_or_zero();
            before.dot(after) < 0.4
        })
    }

    /// The normal of a triangle, as long as twice its area.
    fn facing(&self, triangle: [u32; 3]) -> Vec3 {
        let [a, b, c] = triangle.map(|v| self.position(v));
        (b - a).cross(c - a)
    }

    /// Adds a triangle.
    fn add(&mut self, triangle: [u32; 3]) {
        let index = self.triangles.len() as u32;
        self.triangles.push(Some(triangle));
        for v in triangle {
            self.fans[v as usize].push(index);
        }
    }

    /// Takes a triangle away.
    fn remove(&mut self, index: u32) {
        if let Some(triangle) = self.triangles[index as usize].take() {
            for v in triangle {
                self.fans[v as usize].retain(|&t| t != index);
            }
        }
    }
}

/// The corner after `v` in a triangle.
fn follower(triangle: [u32; 3], v: u32) -> u32 {
    let at = triangle.iter().position(|&c| c == v).unwrap_or(0);
    triangle[(at + 1) % 3]
}
