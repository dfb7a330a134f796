//! Convex polyhedra from points, thin plates and needles included.

use std::collections::HashMap;

use glam::{DMat3, DVec3};

use super::part_distance::closest_on_triangle;
use crate::math::Vec3;

/// A convex polyhedron by its triangles, with the plane of each.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexHull {
    triangles: Vec<[Vec3; 3]>,
    planes: Vec<(Vec3, f32)>,
    /// For each triangle those that share a corner with it.
    neighbours: Vec<Vec<u32>>,
    rounding_error: f32,
}

/// Why points have no convex hull.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{points} points span no volume: a convex part needs four points that do not lie in one plane")]
pub struct HullError {
    /// How many points there were.
    pub points: usize,
}

impl ConvexHull {
    /// The convex hull of `points`.
    ///
    /// The hull is found in coordinates in which the points are about as thick as they are wide, since parry's hull of a
    /// plate that is a thousand times wider than thick leaves points outside, or turns it inside out.
    ///
    /// # Errors
    /// [`HullError`] where the points span no volume (all lie within rounding of one plane) or are not finite.
    pub fn from_points(points: &[Vec3]) -> Result<Self, HullError> {
        let error = HullError { points: points.len() };
        let frame = Frame::spanning(points).ok_or_else(|| error.clone())?;
        let even: Vec<Vec3> = points.iter().map(|p| frame.coordinates(*p)).collect();
        let (hull, indices) = parry3d::transformation::try_convex_hull(&even).map_err(|_| error.clone())?;
        // The hull's corners are copies of the points that it was given: their bits lead back to the originals.
        let bits = |p: Vec3| p.to_array().map(f32::to_bits);
        let original: HashMap<_, _> = even.iter().zip(points).map(|(even, point)| (bits(*even), *point)).collect();
        let corners = hull.iter().map(|p| original.get(&bits(*p)).copied()).collect::<Option<Vec<Vec3>>>();
        let corners = corners.ok_or_else(|| error.clone())?;
        let triangles = indices.iter().map(|t| t.map(|i| corners[i as usize]));
        let (planes, triangles): (Vec<_>, Vec<_>) = triangles.filter_map(|t| Some((plane(&t, &corners)?, t))).unzip();
        if triangles.len() < 4 {
            return Err(error);
        }
        let rounding_error = 1.0e-6 * corners.iter().map(|p| p.length()).fold(0.0, f32::max);
        let neighbours = neighbours(&triangles);
        Ok(Self { triangles, planes, neighbours, rounding_error })
    }

    /// Corners of each face triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[Vec3; 3]] {
        &self.triangles
    }

    /// Outward unit normal `n` and offset `o` of each triangle: inside is `n · x ≤ o`. No corner of the hull lies outside.
    pub fn planes(&self) -> &[(Vec3, f32)] {
        &self.planes
    }

    /// The nearest point of the hull to a point `x` above the plane of triangle `start`.
    ///
    /// The search walks from triangle to triangle that share a corner, always to one that is nearer, among those that
    /// `x` lies above. The hull is convex, so the first triangle without a nearer neighbour is the nearest of all.
    #[inline]
    pub(super) fn nearest_from(&self, x: Vec3, start: usize) -> Vec3 {
        let mut current = start;
        let mut best = closest_on_triangle(&self.triangles[start], x);
        let mut distance = x.distance_squared(best);
        loop {
            let from = current;
            for &i in &self.neighbours[from] {
                let (normal, offset) = self.planes[i as usize];
                let height = normal.dot(x) - offset;
                if height <= 0.0 || height * height >= distance {
                    continue;
                }
                let point = closest_on_triangle(&self.triangles[i as usize], x);
                let nearer = x.distance_squared(point);
                if nearer < distance {
                    (current, best, distance) = (i as usize, point, nearer);
                }
            }
            if current == from {
                return best;
            }
        }
    }

    /// A height over all planes below which a point counts as inside: what rounding makes of a height of zero.
    pub fn rounding_error(&self) -> f32 {
        self.rounding_error
    }
}

/// Plane of a triangle, moved out to the outermost corner of the hull: a sliver's own normal is uncertain, and must not
/// cut through the inside.
fn plane(triangle: &[Vec3; 3], corners: &[Vec3]) -> Option<(Vec3, f32)> {
    let [a, b, c] = triangle.map(|p| p.as_dvec3());
    let normal = (b - a).cross(c - a).try_normalize()?.as_vec3();
    let offset = corners.iter().map(|p| normal.as_dvec3().dot(p.as_dvec3())).fold(f64::NEG_INFINITY, f64::max);
    Some((normal, offset as f32))
}

fn neighbours(triangles: &[[Vec3; 3]]) -> Vec<Vec<u32>> {
    let bits = |p: &Vec3| p.to_array().map(f32::to_bits);
    let mut around: HashMap<[u32; 3], Vec<u32>> = HashMap::new();
    for (i, triangle) in triangles.iter().enumerate() {
        for corner in triangle {
            around.entry(bits(corner)).or_default().push(i as u32);
        }
    }
    let others = |(i, triangle): (usize, &[Vec3; 3])| {
        let mut all: Vec<u32> = triangle.iter().flat_map(|corner| around[&bits(corner)].iter().copied()).collect();
        all.sort_unstable();
        all.dedup();
        all.retain(|&other| other != i as u32);
        all
    };
    triangles.iter().enumerate().map(others).collect()
}

/// Affine coordinates by four of the points that span a tetrahedron as large as a greedy choice finds.
struct Frame {
    origin: DVec3,
    inverse: DMat3,
}

impl Frame {
    /// None where the points are not finite, or lie within rounding of one plane.
    fn spanning(points: &[Vec3]) -> Option<Self> {
        if points.len() < 4 || points.iter().any(|p| !p.is_finite()) {
            return None;
        }
        let farthest = |height: &dyn Fn(DVec3) -> f64| {
            points.iter().map(|p| p.as_dvec3()).max_by(|p, q| height(*p).total_cmp(&height(*q)))
        };
        let origin = farthest(&|p| p.distance_squared(points[0].as_dvec3()))?;
        let u = farthest(&|p| p.distance_squared(origin))? - origin;
        let v = farthest(&|p| u.cross(p - origin).length_squared())? - origin;
        let normal = u.cross(v).try_normalize()?;
        let w = farthest(&|p| normal.dot(p - origin).abs())? - origin;
        let largest = points.iter().map(|p| f64::from(p.abs().max_element())).fold(0.0, f64::max);
        if normal.dot(w).abs() <= 1.0e-6 * largest.max(u.length()) {
            return None;
        }
        let (u, v) = if normal.dot(w) < 0.0 { (v, u) } else { (u, v) };
        Some(Self { origin, inverse: DMat3::from_cols(u, v, w).inverse() })
    }

    fn coordinates(&self, p: Vec3) -> Vec3 {
        (self.inverse * (p.as_dvec3() - self.origin)).as_vec3()
    }
}
