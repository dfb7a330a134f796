//! Painting on a body: the tools that place constraint points (section 4.1).

use super::cell_search::{cell_at, nearest_on_boundary};
use crate::math::Vec3;
use crate::mesh::{CELL_EDGES, TetrahedralMesh};
use std::collections::HashMap;

/// A tool and where it was used; lengths in metres in the frame of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Brush {
    /// One triangle of the boundary ([`TetrahedralMesh::boundary`]): its three corners.
    Face(u32),
    /// The near-flat part of the boundary around a point: triangles that are reached across edges with no more than so
    /// many radians between the normals.
    Region {
        /// A point on the boundary or near it.
        seed: Vec3,
        /// Largest angle between the normals of neighbouring triangles, in radians.
        angle: f32,
    },
    /// A line drawn on the surface; it is moved onto the boundary.
    Stroke(Vec<Vec3>),
    /// A plane that cuts the body. The whole cross-section, or with a stroke only what is drawn on it.
    Section {
        /// A point of the plane.
        origin: Vec3,
        /// Normal of the plane; any length.
        normal: Vec3,
        /// The line on the cross-section; empty for all of it.
        stroke: Vec<Vec3>,
    },
}

/// Why a tool paints nothing.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PaintError {
    /// No such triangle.
    #[error("is triangle {face} of the boundary, but there are {count}, counted from 0")]
    Face {
        /// The index.
        face: u32,
        /// Number of triangles of the boundary.
        count: usize,
    },
    /// A point away from what is painted.
    #[error("has point {point} at {at:?}, which is {distance} m away from the {what}")]
    Away {
        /// Index of the point in the stroke, from 0; 0 for a seed.
        point: usize,
        /// Where it is.
        at: [f32; 3],
        /// How far away.
        distance: f32,
        /// `"surface"` or `"body"`.
        what: &'static str,
    },
    /// The plane does not cut the body.
    #[error("does not cut the body: all vertices lie on one side of the plane")]
    Misses,
    /// The plane has no normal.
    #[error("has a normal of no length")]
    NoNormal,
    /// A stroke without points, or for a direction without length.
    #[error("needs at least {least} different points and has {points}")]
    Short {
        /// How many it needs.
        least: usize,
        /// How many there are.
        points: usize,
    },
    /// An angle out of range.
    #[error("has an angle of {0}; it must be from 0 to 180 degrees")]
    Angle(f32),
    /// A number that is none.
    #[error("has point {0} that is not finite")]
    NotFinite(usize),
}

/// Points of strokes may be so far from the body, in sizes of it.
pub const STROKE_REACH: f32 = 0.1;

/// A body that can be painted on.
#[derive(Clone, Debug)]
pub struct Canvas<'a> {
    mesh: &'a TetrahedralMesh,
    boundary: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
    size: f32,
    /// Distance of sampled points of strokes: half the mean edge of the boundary.
    spacing: f32,
}

impl<'a> Canvas<'a> {
    /// Prepares a mesh for painting.
    pub fn new(mesh: &'a TetrahedralMesh) -> Self {
        let boundary = mesh.boundary();
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
        let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).normalize_or_zero();
        let normals = boundary.iter().map(|t| normal(corners(t))).collect();
        let edges: f32 =
            boundary.iter().map(corners).map(|[a, b, c]| a.distance(b) + b.distance(c) + c.distance(a)).sum();
        let spacing = 0.5 * edges / (3 * boundary.len().max(1)) as f32;
        Self { mesh, boundary, normals, size: mesh.size(), spacing }
    }

    /// The mesh.
    pub fn mesh(&self) -> &'a TetrahedralMesh {
        self.mesh
    }

    /// The constraint points of a tool.
    ///
    /// # Errors
    /// A triangle that does not exist, a plane that misses the body, points that are not finite or too far away
    /// ([`STROKE_REACH`]).
    pub fn points(&self, brush: &Brush) -> Result<Vec<Vec3>, PaintError> {
        match brush {
            Brush::Face(face) => {
                let count = self.boundary.len();
                let corners = self.boundary.get(*face as usize).ok_or(PaintError::Face { face: *face, count })?;
                Ok(corners.map(|v| self.mesh.positions[v as usize]).to_vec())
            }
            Brush::Region { seed, angle } => self.region(*seed, *angle),
            Brush::Stroke(line) => {
                finite(line)?;
                self.sampled(line)?.into_iter().map(|(k, p)| self.on_boundary(k, p)).collect()
            }
            Brush::Section { origin, normal, stroke } => self.section(*origin, *normal, stroke),
        }
    }

    fn on_boundary(&self, point: usize, p: Vec3) -> Result<Vec3, PaintError> {
        let found = nearest_on_boundary(self.mesh, &self.boundary, p);
        let near = found.filter(|f| f.distance <= STROKE_REACH * self.size);
        let distance = found.map_or(f32::INFINITY, |f| f.distance);
        near.map(|f| f.point).ok_or(PaintError::Away { point, at: p.to_array(), distance, what: "surface" })
    }

    /// Flood fill over the boundary, across edges whose triangles turn by no more than `angle`.
    fn region(&self, seed: Vec3, angle: f32) -> Result<Vec<Vec3>, PaintError> {
        finite(&[seed])?;
        if !(0.0..=std::f32::consts::PI).contains(&angle) {
            return Err(PaintError::Angle(angle.to_degrees()));
        }
        self.on_boundary(0, seed)?;
        let Some(start) = nearest_on_boundary(self.mesh, &self.boundary, seed) else { return Ok(Vec::new()) };
        let mut across: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
        let edges = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]].map(|[a, b]| [a.min(b), a.max(b)]);
        for (triangle, corners) in self.boundary.iter().enumerate() {
            edges(corners).into_iter().for_each(|e| across.entry(e).or_default().push(triangle));
        }
        // Triangles that are flat in exact numbers are not after rounding.
        let least = (angle + 1.0e-3).min(std::f32::consts::PI).cos();
        let mut reached = vec![false; self.boundary.len()];
        let mut open = vec![start.triangle];
        reached[start.triangle] = true;
        while let Some(triangle) = open.pop() {
            for edge in edges(&self.boundary[triangle]) {
                for &other in &across[&edge] {
                    if !reached[other] && self.normals[triangle].dot(self.normals[other]) >= least {
                        reached[other] = true;
                        open.push(other);
                    }
                }
            }
        }
        let inside = self.boundary.iter().zip(&reached).filter(|(_, reached)| **reached);
        let mut vertices: Vec<u32> = inside.flat_map(|(t, _)| *t).collect();
        vertices.sort_unstable();
        vertices.dedup();
        Ok(vertices.into_iter().map(|v| self.mesh.positions[v as usize]).collect())
    }

    fn section(&self, origin: Vec3, normal: Vec3, stroke: &[Vec3]) -> Result<Vec<Vec3>, PaintError> {
        finite(&[origin, normal])?;
        let normal = normal.try_normalize().ok_or(PaintError::NoNormal)?;
        let height = |p: Vec3| (p - origin).dot(normal);
        let mut cut = Vec::new();
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(6 * self.mesh.cells.len());
        for cell in &self.mesh.cells {
            edges.extend(CELL_EDGES.map(|[a, b]| [cell[a].min(cell[b]), cell[a].max(cell[b])]));
        }
        edges.sort_unstable();
        edges.dedup();
        for edge in edges {
            let [a, b] = edge.map(|v| self.mesh.positions[v as usize]);
            let (ha, hb) = (height(a), height(b));
            if ha * hb <= 0.0 && ha != hb {
                cut.push(a + (b - a) * (ha / (ha - hb)));
            }
        }
        if cut.is_empty() {
            return Err(PaintError::Misses);
        }
        if stroke.is_empty() {
            return Ok(cut);
        }
        finite(stroke)?;
        let flat: Vec<Vec3> = stroke.iter().map(|p| *p - normal * height(*p)).collect();
        self.sampled(&flat)?.into_iter().map(|(k, p)| self.inside(k, p)).collect()
    }

    /// The point itself if it is in the body, else the nearest of the boundary.
    pub(super) fn inside(&self, point: usize, p: Vec3) -> Result<Vec3, PaintError> {
        let (_, share) = cell_at(self.mesh, p);
        if share.iter().all(|s| *s >= -1.0e-4) {
            return Ok(p);
        }
        self.on_boundary(point, p).map_err(|e| match e {
            PaintError::Away { point, at, distance, .. } => PaintError::Away { point, at, distance, what: "body" },
            e => e,
        })
    }

    /// Points along a line at even distances, each with the index of the point of the line before it.
    pub(super) fn sampled(&self, line: &[Vec3]) -> Result<Vec<(usize, Vec3)>, PaintError> {
        if line.is_empty() {
            return Err(PaintError::Short { least: 1, points: 0 });
        }
        let length: f32 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
        let spacing = self.spacing.max(length / 500.0);
        let mut samples = vec![(0, line[0])];
        for (k, ends) in line.windows(2).enumerate() {
            let pieces = (ends[0].distance(ends[1]) / spacing).ceil().max(1.0) as usize;
            for piece in 1..=pieces {
                let u = piece as f32 / pieces as f32;
                samples.push((if piece == pieces { k + 1 } else { k }, ends[0].lerp(ends[1], u)));
            }
        }
        Ok(samples)
    }
}

/// Checks the points of a line.
pub(super) fn finite(line: &[Vec3]) -> Result<(), PaintError> {
    line.iter().position(|p| !p.is_finite()).map_or(Ok(()), |k| Err(PaintError::NotFinite(k)))
}
