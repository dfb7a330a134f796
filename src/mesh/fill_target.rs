//! The surface that is to be filled: the nearest point of it, its sharp edges, and the corners where they meet.

use parry3d::query::{PointQuery, PointQueryWithLocation};
use parry3d::shape::{Polyline, TriMesh, TriMeshFlags};

use super::{TetrahedralError, TriangleMesh};
use crate::math::Vec3;

/// Two triangles meet sharply where their normals differ by more than this, in degrees.
const SHARP_DEGREES: f32 = 40.0;
/// A vertex without sharp edges is a tip where two normals at it differ by more than this, in degrees.
const TIP_DEGREES: f32 = 70.0;

/// What a point of the surface is part of, and with it how far a vertex there may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    /// A face, or the inside.
    Loose,
    /// A sharp edge.
    Edge,
    /// A corner or a tip.
    Corner,
}

/// See the file's head.
pub(super) struct Target {
    /// The surface with its seams welded.
    pub shape: TriMesh,
    edges: Option<Polyline>,
    corners: Vec<Vec3>,
}

impl Target {
    /// # Errors
    /// The surface has no triangles.
    pub fn of(surface: &TriangleMesh) -> Result<Self, TetrahedralError> {
        let welded = |t: &[u32; 3]| t.map(|v| surface.welded[v as usize]);
        let triangles: Vec<[u32; 3]> =
            surface.triangles.iter().map(welded).filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let (edges, corners) = features(&surface.positions, &triangles);
        let shape = TriMesh::with_flags(surface.positions.clone(), triangles, TriMeshFlags::ORIENTED)
            .map_err(|_| TetrahedralError::Surface("it has no triangles"))?;
        let edges = (!edges.is_empty()).then(|| Polyline::new(surface.positions.clone(), Some(edges)));
        Ok(Self { shape, edges, corners })
    }

    /// Distance to the surface, positive inside.
    pub fn signed_distance(&self, p: Vec3) -> f32 {
        let (projection, _) = self.shape.project_local_point_and_get_location(p, false);
        let distance = p.distance(projection.point);
        if projection.is_inside { distance } else { -distance }
    }

    /// The nearest point of the surface.
    pub fn project(&self, p: Vec3) -> Vec3 {
        self.shape.project_local_point(p, false).point
    }

    /// The nearest point of a sharp edge.
    pub fn on_edge(&self, p: Vec3) -> Option<Vec3> {
        self.edges.as_ref().map(|edges| edges.project_local_point(p, false).point)
    }

    /// The nearest corner within reach; otherwise the nearest point of a sharp edge.
    pub fn feature(&self, p: Vec3, reach: f32) -> Option<(Vec3, Place)> {
        let nearer = |a: &Vec3, b: &Vec3| a.distance_squared(p).total_cmp(&b.distance_squared(p));
        let corner = self.corners.iter().copied().min_by(nearer).map(|c| (c, Place::Corner));
        let near = |found: &(Vec3, Place)| found.0.distance(p) < reach;
        corner.filter(near).or_else(|| self.on_edge(p).map(|e| (e, Place::Edge)).filter(near))
    }

    /// Points all over the surface, no farther from each other than this: corners, sharp edges, faces.
    pub fn samples(&self, spacing: f32) -> Vec<(Vec3, Place)> {
        let mut samples: Vec<(Vec3, Place)> = self.corners.iter().map(|c| (*c, Place::Corner)).collect();
        for edge in self.edges.iter().flat_map(Polyline::segments) {
            let parts = parts(edge.a.distance(edge.b), spacing);
            samples.extend((0..=parts).map(|k| (edge.a.lerp(edge.b, k as f32 / parts as f32), Place::Edge)));
        }
        for t in self.shape.indices() {
            let corners = t.map(|v| self.shape.vertices()[v as usize]);
            samples.extend(over_triangle(corners, spacing).into_iter().map(|p| (p, Place::Loose)));
        }
        samples
    }
}

/// Points of a triangle no farther from each other than this, its corners included.
pub(super) fn over_triangle([a, b, c]: [Vec3; 3], spacing: f32) -> Vec<Vec3> {
    let parts = parts(a.distance(b).max(b.distance(c)).max(c.distance(a)), spacing);
    let mut points = Vec::new();
    for i in 0..=parts {
        for j in 0..=parts - i {
            let [u, v] = [i, j].map(|k| k as f32 / parts as f32);
            let w = (parts - i - j) as f32 / parts as f32;
            points.push(a * u + b * v + c * w);
        }
    }
    points
}

/// Into how many parts a length is cut; at least two, so that middles are looked at.
fn parts(length: f32, spacing: f32) -> u32 {
    (length / spacing).ceil().clamp(2.0, 1000.0) as u32
}

/// Sharp edges and corners of a welded surface.
fn features(positions: &[Vec3], triangles: &[[u32; 3]]) -> (Vec<[u32; 2]>, Vec<Vec3>) {
    let mut sides: Vec<([u32; 2], Vec3)> = Vec::new();
    let mut normals: Vec<Vec<Vec3>> = vec![Vec::new(); positions.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        sides.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[u, v]| ([u.min(v), u.max(v)], normal)));
        if normal != Vec3::ZERO {
            t.iter().for_each(|&v| normals[v as usize].push(normal));
        }
    }
    sides.sort_by_key(|s| s.0);
    let limit = SHARP_DEGREES.to_radians().cos();
    let mut at_vertex: Vec<Vec<Vec3>> = vec![Vec::new(); positions.len()];
    let mut edges = Vec::new();
    for same in sides.chunk_by(|a, b| a.0 == b.0) {
        if same.len() == 2 && same[0].1.dot(same[1].1) < limit {
            let [a, b] = same[0].0;
            let along = (positions[b as usize] - positions[a as usize]).normalize_or_zero();
            at_vertex[a as usize].push(along);
            at_vertex[b as usize].push(-along);
            edges.push([a, b]);
        }
    }
    let tip = TIP_DEGREES.to_radians().cos();
    let is_corner = |v: usize| match at_vertex[v][..] {
        [] => normals[v].iter().any(|n| n.dot(normals[v][0]) < tip),
        // Where one sharp edge goes straight on there is no corner.
        [a, b] => a.dot(b) > -limit,
        _ => true,
    };
    let corners = (0..positions.len()).filter(|v| is_corner(*v)).map(|v| positions[v]).collect();
    (edges, corners)
}
