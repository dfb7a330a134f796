//! Which cell a point lies in, and the nearest point of the boundary.

use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;
use parry3d::query::PointQuery;
use parry3d::shape::Triangle;

/// The cell that holds a point, with its barycentric coordinates; for a point outside, the cell it is least outside of (some
/// coordinates are negative then).
pub fn cell_at(mesh: &TetrahedralMesh, point: Vec3) -> (usize, [f32; 4]) {
    let mut best = (0, [f32::NEG_INFINITY; 4]);
    let mut inside = f32::NEG_INFINITY;
    for (cell, corners) in mesh.cells.iter().enumerate() {
        let share = barycentric(corners.map(|v| mesh.positions[v as usize]), point);
        let least = share.iter().copied().fold(f32::INFINITY, f32::min);
        if least > inside {
            (inside, best) = (least, (cell, share));
        }
    }
    best
}

/// Barycentric coordinates of a point in a tetrahedron.
pub fn barycentric([a, b, c, d]: [Vec3; 4], point: Vec3) -> [f32; 4] {
    let [a, b, c, d, p] = [a, b, c, d, point].map(|v| v.as_dvec3());
    let (u, v, w, q) = (b - a, c - a, d - a, p - a);
    let volume = u.dot(v.cross(w));
    let shares = [q.dot(v.cross(w)), q.dot(w.cross(u)), q.dot(u.cross(v))].map(|s| s / volume);
    [1.0 - shares[0] - shares[1] - shares[2], shares[0], shares[1], shares[2]].map(|s| s as f32)
}

/// A place on the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryPoint {
    /// Index of the triangle in [`TetrahedralMesh::boundary`].
    pub triangle: usize,
    /// Where, in metres.
    pub point: Vec3,
    /// How far from the point that was asked for, in metres.
    pub distance: f32,
}

/// The place of the boundary nearest to a point; none without triangles.
pub fn nearest_on_boundary(mesh: &TetrahedralMesh, boundary: &[[u32; 3]], point: Vec3) -> Option<BoundaryPoint> {
    let mut best: Option<BoundaryPoint> = None;
    for (triangle, corners) in boundary.iter().enumerate() {
        let [a, b, c] = corners.map(|v| mesh.positions[v as usize]);
        let found = Triangle::new(a, b, c).project_local_point(point, false).point;
        let distance = found.distance(point);
        if best.is_none_or(|b| distance < b.distance) {
            best = Some(BoundaryPoint { triangle, point: found, distance });
        }
    }
    best
}
