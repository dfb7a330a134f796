//! Distances through a body: along the shortest way inside it, not straight through what is outside.
//!
//! Distances are carried from cell to cell with the *source* of the wave: the three corners of a face and their distances fix
//! a point from which the wave seems to come (trilateration), and the fourth corner is as far from it as it is, if the straight
//! way passes through the face. Else the wave comes over an edge or a corner of the face, unfolded in its plane. Where the way
//! is straight this is exact; just behind a bend, where ways part, the way may be some percent too long on coarse cells. (Novotni and Klein 2002 do this on surfaces.) Labels are corrected until none changes.

use super::cell_search::cell_at;
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Faces are widened by this share, so that ways along an edge belong to one of its faces.
const MARGIN: f64 = 1.0e-4;

/// A mesh made ready for distances.
#[derive(Clone, Debug)]
pub struct GeodesicMesh {
    positions: Vec<glam::DVec3>,
    cells: Vec<[u32; 4]>,
    /// Where the list of cells of each vertex starts in `incident`.
    starts: Vec<u32>,
    incident: Vec<u32>,
}

impl GeodesicMesh {
    /// Prepares a mesh.
    pub fn new(mesh: &TetrahedralMesh) -> Self {
        let mut starts = vec![0u32; mesh.positions.len() + 1];
        mesh.cells.iter().flatten().for_each(|&v| starts[v as usize + 1] += 1);
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut next = starts.clone();
        let mut incident = vec![0u32; 4 * mesh.cells.len()];
        for (cell, corners) in (0u32..).zip(&mesh.cells) {
            for &v in corners {
                incident[next[v as usize] as usize] = cell;
                next[v as usize] += 1;
            }
        }
        let positions = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
        Self { positions, cells: mesh.cells.clone(), starts, incident }
    }

    /// Distance of each vertex from a point of the body, in metres; infinite in pieces that are not connected with it.
    /// A point outside counts as in the cell it is nearest to, by [`cell_at`].
    pub fn distances(&self, mesh: &TetrahedralMesh, source: Vec3) -> Vec<f32> {
        let mut known = vec![f64::INFINITY; self.positions.len()];
        let mut queue = BinaryHeap::new();
        if source.is_finite() && !self.cells.is_empty() {
            let (cell, _) = cell_at(mesh, source);
            for v in self.cells[cell] {
                known[v as usize] = self.positions[v as usize].distance(source.as_dvec3());
                queue.push(Reverse((Ordered(known[v as usize]), v)));
            }
        }
        let improves = |new: f64, old: f64| new < old - 1.0e-9 * old.min(1.0e9);
        // Each correction is a true improvement; the bound only guards against rounding.
        let mut budget = 200 * self.positions.len();
        while let Some(Reverse((Ordered(distance), vertex))) = queue.pop() {
            if distance > known[vertex as usize] {
                continue;
            }
            if budget == 0 {
                break;
            }
            budget -= 1;
            for &cell in
                &self.incident[self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
            {
                let corners = self.cells[cell as usize];
                for k in 0..4 {
                    let target = corners[k];
                    // A way may pass through a face with a corner that is farther than the target.
                    if target == vertex {
                        continue;
                    }
                    let face = [corners[(k + 1) % 4], corners[(k + 2) % 4], corners[(k + 3) % 4]];
                    let new = self.across(face, target, &known);
                    if improves(new, known[target as usize])
                        || (new.is_finite() && known[target as usize].is_infinite())
                    {
                        known[target as usize] = new;
                        queue.push(Reverse((Ordered(new), target)));
                    }
                }
            }
        }
        known.into_iter().map(|d| d as f32).collect()
    }

    /// The distance of `target` over a face.
    fn across(&self, face: [u32; 3], target: u32, known: &[f64]) -> f64 {
        let x = face.map(|v| self.positions[v as usize]);
        let d = face.map(|v| known[v as usize]);
        let v = self.positions[target as usize];
        if d.iter().all(|d| d.is_finite())
            && let Some(through) = through_face(x, d, v)
        {
            return through;
        }
        let mut best = f64::INFINITY;
        for [a, b] in [[0, 1], [1, 2], [2, 0]] {
            if d[a].is_finite() && d[b].is_finite() {
                best = best.min(over_edge([x[a], x[b]], [d[a], d[b]], v).unwrap_or(f64::INFINITY));
            }
        }
        (0..3).fold(best, |best, a| best.min(d[a] + x[a].distance(v)))
    }

    /// A length of the body along the ways inside it, in metres: the distance from the vertex that is farthest from the
    /// first one to the vertex that is farthest from that. Of several pieces, the longest such length.
    pub fn length(&self, mesh: &TetrahedralMesh) -> f32 {
        let mut seen = vec![false; self.positions.len()];
        let mut longest = 0.0f32;
        while let Some(start) = seen.iter().position(|seen| !seen) {
            let from = self.farthest(&self.distances(mesh, mesh.positions[start]));
            let distances = self.distances(mesh, mesh.positions[from.0]);
            longest = longest.max(self.farthest(&distances).1);
            seen[start] = true;
            distances.iter().zip(&mut seen).for_each(|(d, seen)| *seen |= d.is_finite());
        }
        longest
    }

    fn farthest(&self, distances: &[f32]) -> (usize, f32) {
        let finite = distances.iter().copied().enumerate().filter(|(_, d)| d.is_finite());
        finite.fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best })
    }
}

/// The distance of `v` from the source that the corners of a face fix, if the straight way passes through the face.
fn through_face([a, b, c]: [glam::DVec3; 3], d: [f64; 3], v: glam::DVec3) -> Option<f64> {
    let (e1, e2, ev) = (b - a, c - a, v - a);
    let (g11, g12, g22) = (e1.dot(e1), e1.dot(e2), e2.dot(e2));
    let determinant = g11 * g22 - g12 * g12;
    if determinant <= 0.0 {
        return None;
    }
    // Coordinates in the face of a vector with the products p, q with its edges.
    let flat = |p: f64, q: f64| ((p * g22 - q * g12) / determinant, (q * g11 - p * g12) / determinant);
    let (s1, s2) = flat(0.5 * (d[0] * d[0] - d[1] * d[1] + g11), 0.5 * (d[0] * d[0] - d[2] * d[2] + g22));
    let foot = e1 * s1 + e2 * s2;
    let height2 = d[0] * d[0] - foot.length_squared();
    // Distances along a bent way fix no point: rounding aside, there is none.
    if height2 < -1.0e-9 * (g11 + g22) {
        return None;
    }
    let height = height2.max(0.0).sqrt();
    let (v1, v2) = flat(ev.dot(e1), ev.dot(e2));
    let foot_v = e1 * v1 + e2 * v2;
    let height_v = (ev - foot_v).length();
    let share = height / (height + height_v);
    let (q1, q2) = (s1 + share * (v1 - s1), s2 + share * (v2 - s2));
    let inside = q1 >= -MARGIN && q2 >= -MARGIN && q1 + q2 <= 1.0 + MARGIN;
    inside.then(|| ((height + height_v).powi(2) + (foot_v - foot).length_squared()).sqrt())
}

/// The same over an edge, in the plane of the edge and `v`.
fn over_edge([a, b]: [glam::DVec3; 2], d: [f64; 2], v: glam::DVec3) -> Option<f64> {
    let length = a.distance(b);
    let along = (b - a) / length;
    let s = (d[0] * d[0] - d[1] * d[1] + length * length) / (2.0 * length);
    let height2 = d[0] * d[0] - s * s;
    if height2 < -1.0e-9 * length * length {
        return None;
    }
    let height = height2.max(0.0).sqrt();
    let v1 = (v - a).dot(along);
    let height_v = (v - a - along * v1).length();
    let crossing = s + height / (height + height_v) * (v1 - s);
    let inside = (-MARGIN * length..=(1.0 + MARGIN) * length).contains(&crossing);
    inside.then(|| ((height + height_v).powi(2) + (v1 - s).powi(2)).sqrt())
}

/// A finite number that can be sorted.
#[derive(Clone, Copy, PartialEq)]
struct Ordered(f64);

impl Eq for Ordered {}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
