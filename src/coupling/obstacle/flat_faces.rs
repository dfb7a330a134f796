//! Triangles that lie in one plane, merged into few convex faces.
//!
//! A face grows by a neighbour where the two lie in one plane, share one unbroken run of edges and are convex together.
//! Every face grows as far as it can, and again, until none grows any more: the rows of a grid become strips, and the
//! strips a square.

use std::collections::HashMap;

use crate::math::Vec3;

/// A flat convex face of a triangle mesh.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Corners in turn, counter-clockwise seen from outside. Some may lie on the straight line between others.
    pub corners: Vec<u32>,
    /// The triangles it is made of, ascending.
    pub triangles: Vec<u32>,
    /// Unit normal.
    pub normal: Vec3,
    /// The normal of the neighbour beyond the edge from each corner to the next, if there is one.
    pub neighbours: Vec<Option<Vec3>>,
    /// Twice its area in m².
    pub area: f32,
}

/// A face with more corners than this grows no further: it keeps the search linear.
const MOST_CORNERS: usize = 128;

/// The limit in the first round; it doubles from round to round, so that squares grow rather than strips.
const FEW_CORNERS: usize = 8;

/// Faces whose normals have a smaller cosine are not in one plane, whatever the distances.
const PARALLEL: f32 = 0.9999;

/// The flat convex faces of triangles. Triangles without an area are in none.
///
/// `tolerance` is the distance in metres within which points count as lying in one plane, or on one line.
pub(super) fn flat_faces(points: &[Vec3], triangles: &[[u32; 3]], tolerance: f32) -> Vec<Face> {
    let mut growing =
        Growing { points, tolerance, faces: Vec::new(), owner: HashMap::with_capacity(3 * triangles.len()) };
    for (triangle, corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|i| points[i as usize]);
        let cross = (b - a).cross(c - a);
        let Some(normal) = cross.try_normalize() else { continue };
        let face = Face {
            corners: corners.to_vec(),
            triangles: vec![triangle as u32],
            normal,
            neighbours: Vec::new(),
            area: cross.length(),
        };
        let index = growing.faces.len();
        growing.own(index, &face.corners);
        growing.faces.push(Some(face));
    }
    let mut most_corners = FEW_CORNERS;
    let mut open: Vec<usize> = (0..growing.faces.len()).filter(|&index| growing.may_grow(index)).collect();
    while growing.round(&mut open, most_corners) || most_corners < MOST_CORNERS {
        most_corners = (2 * most_corners).min(MOST_CORNERS);
    }
    let neighbours: Vec<Vec<Option<Vec3>>> = growing.faces.iter().flatten().map(|f| growing.neighbours(f)).collect();
    let mut faces: Vec<Face> = growing.faces.into_iter().flatten().collect();
    faces.iter_mut().zip(neighbours).for_each(|(face, neighbours)| face.neighbours = neighbours);
    faces.iter_mut().for_each(|face| face.triangles.sort_unstable());
    faces.sort_by_key(|face| face.triangles.first().copied());
    faces
}

struct Growing<'a> {
    points: &'a [Vec3],
    tolerance: f32,
    faces: Vec<Option<Face>>,
    /// The face of each directed edge; where several faces claim it, the last.
    owner: HashMap<[u32; 2], usize>,
}

impl Growing<'_> {
    fn own(&mut self, index: usize, corners: &[u32]) {
        for (i, &from) in corners.iter().enumerate() {
            self.owner.insert([from, corners[(i + 1) % corners.len()]], index);
        }
    }

    /// Lets each of the `open` faces grow as far as it can. False where none did. What is absorbed is open no more.
    fn round(&mut self, open: &mut Vec<usize>, most_corners: usize) -> bool {
        let mut grown = false;
        for &index in open.iter() {
            while let Some((other, corners)) = self.next_neighbour(index, most_corners) {
                let Some(absorbed) = self.faces[other].take() else { break };
                let Some(face) = &mut self.faces[index] else { break };
                if absorbed.area > face.area {
                    face.normal = absorbed.normal;
                }
                face.area += absorbed.area;
                face.triangles.extend(absorbed.triangles);
                face.corners.clone_from(&corners);
                self.own(index, &corners);
                grown = true;
            }
        }
        open.retain(|&index| self.faces[index].is_some());
        grown
    }

    /// True where a neighbour lies in the plane of a face. Most faces of a round mesh have none, and never will.
    fn may_grow(&self, index: usize) -> bool {
        let Some(face) = &self.faces[index] else { return false };
        let mut edges = (0..face.corners.len()).map(|i| [face.corners[(i + 1) % face.corners.len()], face.corners[i]]);
        edges.any(|edge| {
            let other = self.owner.get(&edge).filter(|&&other| other != index);
            other.and_then(|&other| self.faces[other].as_ref()).is_some_and(|other| self.lie_in_one_plane(face, other))
        })
    }

    fn lie_in_one_plane(&self, face: &Face, other: &Face) -> bool {
        if face.normal.dot(other.normal) < PARALLEL {
            return false;
        }
        let (larger, smaller) = if face.area >= other.area { (face, other) } else { (other, face) };
        let origin = self.points[larger.corners[0] as usize];
        let height = |&i: &u32| (self.points[i as usize] - origin).dot(larger.normal).abs();
        smaller.corners.iter().all(|corner| height(corner) <= self.tolerance)
    }

    /// The normals beyond the edges of a face.
    fn neighbours(&self, face: &Face) -> Vec<Option<Vec3>> {
        let beyond = |(i, &from): (usize, &u32)| {
            let to = face.corners[(i + 1) % face.corners.len()];
            let other = self.owner.get(&[to, from]).and_then(|&other| self.faces[other].as_ref());
            other.map(|other| other.normal)
        };
        face.corners.iter().enumerate().map(beyond).collect()
    }

    /// A neighbour that a face can grow by, and the corners of both together.
    fn next_neighbour(&self, index: usize, most_corners: usize) -> Option<(usize, Vec<u32>)> {
        let face = self.faces[index].as_ref()?;
        let mut tried = usize::MAX;
        for (i, &from) in face.corners.iter().enumerate() {
            let to = face.corners[(i + 1) % face.corners.len()];
            let Some(&other) = self.owner.get(&[to, from]) else { continue };
            if other == index || other == tried {
                continue;
            }
            tried = other;
            if let Some(corners) = self.faces[other].as_ref().and_then(|other| self.joined(face, other, most_corners)) {
                return Some((other, corners));
            }
        }
        None
    }

    fn joined(&self, face: &Face, other: &Face, most_corners: usize) -> Option<Vec<u32>> {
        if !self.lie_in_one_plane(face, other) {
            return None;
        }
        let normal = if face.area >= other.area { face.normal } else { other.normal };
        let corners = outline(&face.corners, &other.corners).filter(|corners| corners.len() <= most_corners)?;
        let convex = (0..corners.len()).all(|i| {
            let [before, at, after] =
                [i + corners.len() - 1, i, i + 1].map(|k| self.points[corners[k % corners.len()] as usize]);
            // Twice the area of the corner's triangle, over its base: how far the corner is dented in.
            let base = (after - before).length().max(f32::MIN_POSITIVE);
            (at - before).cross(after - at).dot(normal) / base >= -self.tolerance
        });
        convex.then_some(corners)
    }
}

/// The corners around two loops that share one unbroken run of edges, passed in opposite directions.
fn outline(a: &[u32], b: &[u32]) -> Option<Vec<u32>> {
    let edges_of_b: HashMap<[u32; 2], usize> =
        b.iter().enumerate().map(|(i, &from)| ([from, b[(i + 1) % b.len()]], i)).collect();
    let shared: Vec<bool> = (0..a.len()).map(|i| edges_of_b.contains_key(&[a[(i + 1) % a.len()], a[i]])).collect();
    let count = shared.iter().filter(|s| **s).count();
    let starts: Vec<usize> = (0..a.len()).filter(|&i| shared[i] && !shared[(i + a.len() - 1) % a.len()]).collect();
    let &[start] = &starts[..] else { return None };
    // From the end of the run around a to its beginning, then around b.
    let end = a[(start + count) % a.len()];
    let mut corners: Vec<u32> = (0..=a.len() - count).map(|k| a[(start + count + k) % a.len()]).collect();
    let from = b.iter().position(|&c| c == a[start])?;
    let way = (1..b.len()).map(|k| b[(from + k) % b.len()]).take_while(|&c| c != end);
    corners.extend(way);
    let mut unique = corners.clone();
    unique.sort_unstable();
    unique.dedup();
    (unique.len() == corners.len() && corners.len() + 2 * count == a.len() + b.len()).then_some(corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_grid_becomes_a_single_square() {
        let n = 8;
        let points: Vec<Vec3> =
            (0..=n).flat_map(|j| (0..=n).map(move |i| Vec3::new(i as f32, j as f32, 0.0))).collect();
        let mut triangles = Vec::new();
        for j in 0..n {
            for i in 0..n {
                let at = |i: u32, j: u32| j * (n + 1) + i;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        let faces = flat_faces(&points, &triangles, 1e-6);
        assert_eq!(faces.len(), 1);
        assert_eq!(faces[0].triangles.len(), triangles.len());
        assert_eq!(faces[0].corners.len(), 4 * n as usize);
    }

    #[test]
    fn a_hole_and_a_notch_are_kept() {
        // A plus sign of five squares: it cannot be one convex face, nor lose any of its area.
        let mut points = Vec::new();
        let mut triangles = Vec::new();
        for (x, y) in [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2)] {
            let corner = |dx: i32, dy: i32| Vec3::new((x + dx) as f32, (y + dy) as f32, 0.0);
            let index = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)].map(|p| {
                points.iter().position(|q| *q == p).unwrap_or_else(|| {
                    points.push(p);
                    points.len() - 1
                }) as u32
            });
            triangles.extend([[index[0], index[1], index[2]], [index[0], index[2], index[3]]]);
        }
        let faces = flat_faces(&points, &triangles, 1e-6);
        assert!((2..=5).contains(&faces.len()), "{faces:?}");
        let area: f32 = faces
            .iter()
            .map(|face| {
                let p = |i: usize| points[face.corners[i % face.corners.len()] as usize];
                let fan = (1..face.corners.len() - 1).map(|i| (p(i) - p(0)).cross(p(i + 1) - p(0)).z);
                0.5 * fan.sum::<f32>()
            })
            .sum();
        assert!((area - 5.0).abs() < 1e-5, "{area}");
    }
}
