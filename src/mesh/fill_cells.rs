//! Cells while a surface is being filled: who is at which vertex, how good a cell is, and how one is split.

use super::fill_target::{Place, Target};
use super::tetrahedral_mesh::{CELL_EDGES, CELL_FACES, Faces, cell_volume, is_flat};
use crate::math::Vec3;

/// Passes over the vertices around one that needs room.
const ROOM_PASSES: u32 = 3;

/// See the file's head.
#[derive(Clone)]
pub(super) struct Filling {
    pub positions: Vec<Vec3>,
    pub cells: Vec<[u32; 4]>,
    /// What each vertex is held by.
    pub places: Vec<Place>,
    /// Whether each vertex is on the boundary.
    pub outside: Vec<bool>,
    /// The cells at each vertex.
    pub of_vertex: Vec<Vec<u32>>,
}

/// One way to bring the boundary to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// A vertex goes there.
    Move(u32),
    /// The cells along an edge are halved there.
    SplitEdge([u32; 2]),
    /// The cell at a face of the boundary becomes three.
    SplitFace([u32; 3]),
}

impl Filling {
    pub fn new(positions: Vec<Vec3>, cells: Vec<[u32; 4]>) -> Self {
        let mut of_vertex: Vec<Vec<u32>> = vec![Vec::new(); positions.len()];
        for (c, cell) in (0u32..).zip(&cells) {
            cell.iter().for_each(|&v| of_vertex[v as usize].push(c));
        }
        let outside = vec![false; positions.len()];
        let mut filling = Self { places: vec![Place::Loose; positions.len()], outside, positions, cells, of_vertex };
        filling.find_outside();
        filling
    }

    /// Finds anew which vertices are on the boundary.
    pub fn find_outside(&mut self) {
        self.outside.fill(false);
        for v in self.boundary().into_iter().flatten() {
            self.outside[v as usize] = true;
        }
        for (place, _) in self.places.iter_mut().zip(&self.outside).filter(|(_, outside)| !**outside) {
            *place = Place::Loose;
        }
    }

    /// Whether a cell has both vertices.
    pub fn is_edge(&self, a: u32, b: u32) -> bool {
        self.of_vertex[a as usize].iter().any(|&c| self.cells[c as usize].contains(&b))
    }

    /// One more cell.
    pub fn add(&mut self, cell: [u32; 4]) {
        let name = self.cells.len() as u32;
        self.cells.push(cell);
        cell.iter().for_each(|&v| self.of_vertex[v as usize].push(name));
    }

    /// Without the cells that have no volume, as lattice cells have where a surface is too fine for them, and without the vertices
    /// that only they had. What that leaves open is boundary, and counts as such in the report.
    pub fn drop_flat(&mut self) {
        let volume = |cell: &[u32; 4]| {
            let x = cell.map(|v| self.positions[v as usize].as_dvec3());
            (cell_volume(x), is_flat(x, cell_volume(x)))
        };
        let bad = |cell: &[u32; 4]| matches!(volume(cell), (v, flat) if flat || v <= 0.0);
        let mut kept: Vec<[u32; 4]> = self.cells.iter().filter(|cell| !bad(cell)).copied().collect();
        if kept.len() == self.cells.len() {
            return;
        }
        let mut used: Vec<u32> = kept.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        for v in kept.iter_mut().flatten() {
            *v = used.partition_point(|u| u < v) as u32;
        }
        let positions = used.iter().map(|&v| self.positions[v as usize]).collect();
        let places = used.iter().map(|&v| self.places[v as usize]).collect();
        *self = Self::new(positions, kept);
        self.places = places;
    }

    /// Without these cells; all vertices are still used by others.
    pub fn remove(&mut self, cells: &[u32]) {
        let kept = (0u32..).zip(&self.cells).filter(|(c, _)| !cells.contains(c)).map(|(_, cell)| *cell).collect();
        let places = std::mem::take(&mut self.places);
        *self = Self::new(std::mem::take(&mut self.positions), kept);
        self.places = places;
    }

    /// The triangles of the boundary.
    pub fn boundary(&self) -> Vec<[u32; 3]> {
        Faces::of(&self.cells).boundary
    }

    /// The worst quality of the cells at a vertex.
    pub fn worst(&self, v: usize) -> f32 {
        let quality = |&c: &u32| quality(self.cells[c as usize].map(|v| self.positions[v as usize]));
        self.of_vertex[v].iter().map(quality).fold(f32::INFINITY, f32::min)
    }

    /// The cells that have all of these vertices.
    pub fn around(&self, vertices: &[u32]) -> Vec<u32> {
        let Some((first, others)) = vertices.split_first() else { return Vec::new() };
        let has = |c: &&u32| others.iter().all(|v| self.cells[**c as usize].contains(v));
        self.of_vertex[*first as usize].iter().filter(has).copied().collect()
    }

    /// The worst quality of the cells that a change makes or moves.
    pub fn quality_after(&self, change: Change, goal: Vec3) -> f32 {
        let with_goal =
            |cell: [u32; 4], at: u32| quality(cell.map(|v| if v == at { goal } else { self.positions[v as usize] }));
        let split = |vertices: &[u32]| {
            let cells = self.around(vertices);
            let new = cells.iter().flat_map(|&c| vertices.iter().map(move |&v| (self.cells[c as usize], v)));
            new.map(|(cell, v)| with_goal(cell, v)).fold(f32::INFINITY, f32::min)
        };
        match change {
            Change::Move(v) => {
                let cells = &self.of_vertex[v as usize];
                cells.iter().map(|&c| with_goal(self.cells[c as usize], v)).fold(f32::INFINITY, f32::min)
            }
            Change::SplitEdge(edge) => split(&edge),
            Change::SplitFace(face) => split(&face),
        }
    }

    /// Makes a change, and holds the vertex at the goal by what that is part of; that vertex is returned.
    pub fn apply(&mut self, change: Change, goal: Vec3, place: Place) -> u32 {
        match change {
            Change::Move(v) => {
                self.positions[v as usize] = goal;
                self.places[v as usize] = place;
                v
            }
            Change::SplitEdge(edge) => self.split(&edge, goal, place),
            Change::SplitFace(face) => self.split(&face, goal, place),
        }
    }

    /// Of each cell with these vertices one for each of them, in whose stead it has the new vertex.
    fn split(&mut self, vertices: &[u32], goal: Vec3, place: Place) -> u32 {
        let new = self.positions.len() as u32;
        self.positions.push(goal);
        self.places.push(place);
        self.outside.push(true);
        self.of_vertex.push(Vec::new());
        for c in self.around(vertices) {
            let old = self.cells[c as usize];
            for (k, &left_out) in vertices.iter().enumerate() {
                let cell = old.map(|v| if v == left_out { new } else { v });
                if k == 0 {
                    self.cells[c as usize] = cell;
                    self.of_vertex[left_out as usize].retain(|&other| other != c);
                    self.of_vertex[new as usize].push(c);
                } else {
                    self.add(cell);
                }
            }
        }
        new
    }

    /// Moves a vertex where its worst cell gets best: a few steps along the axes, back onto the surface where it is of that.
    /// True if it moved.
    pub fn relax(&mut self, v: usize, target: &Target, cell_size: f32) -> bool {
        if self.places[v] == Place::Corner {
            return false;
        }
        let start = self.positions[v];
        let mut best = (self.worst(v), start);
        for step in [0.12, 0.03].map(|part| part * cell_size) {
            let from = best.1;
            for direction in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
                let goal = from + direction * step;
                self.positions[v] = match self.places[v] {
                    Place::Loose if !self.outside[v] => goal,
                    Place::Loose => target.project(goal),
                    _ => target.on_edge(goal).unwrap_or(start),
                };
                let worst = self.worst(v);
                if worst > best.0 {
                    best = (worst, self.positions[v]);
                }
            }
        }
        self.positions[v] = best.1;
        best.1 != start
    }

    /// Relaxes all that is around a vertex but itself; returns the worst quality there, and what moved.
    pub fn make_room(&mut self, vertex: u32, target: &Target, cell_size: f32) -> (f32, Vec<u32>) {
        let mut around: Vec<u32> =
            self.of_vertex[vertex as usize].iter().flat_map(|&c| self.cells[c as usize]).collect();
        around.sort_unstable();
        around.dedup();
        let mut moved = Vec::new();
        for _ in 0..ROOM_PASSES {
            for &v in around.iter().filter(|v| **v != vertex) {
                if self.relax(v as usize, target, cell_size) {
                    moved.push(v);
                }
            }
        }
        (self.worst(vertex as usize), moved)
    }
}

/// Of a cell: 1 when it is regular, 0 when it is flat, negative when it is inside out. The least sine of its dihedral angles
/// beside their regular value.
pub(super) fn quality(x: [Vec3; 4]) -> f32 {
    let normals = CELL_FACES.map(|[a, b, c]| (x[b] - x[a]).cross(x[c] - x[a]));
    let volume = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]));
    // sin(angle at the edge of faces a and b) = |n_a x n_b| / |n_a||n_b|, and |n_a x n_b| = 6 V |edge|.
    let mut least = f32::INFINITY;
    for [a, b] in CELL_EDGES {
        // The edge that lies in both faces joins the two other corners.
        let mut others = (0..4).filter(|k| *k != a && *k != b);
        let (Some(i), Some(j)) = (others.next(), others.next()) else { continue };
        let sine = volume * x[i].distance(x[j]) / (normals[a].length() * normals[b].length()).max(f32::MIN_POSITIVE);
        least = least.min(sine);
    }
    // The regular tetrahedron's dihedral angle has the sine 0.943.
    least / 0.942_809
}
