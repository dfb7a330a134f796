//! Measures of a surface: volume, areas, centroids, bounds and the paper's size. All sums run in f64, in order.

use super::TriangleMesh;
use crate::math::Vec3;
use glam::DVec3;
use parry3d::bounding_volume::Aabb;

/// Volume and its centroid, enclosed by a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosed {
    /// Signed volume in cubic metres: positive when the triangles turn counter-clockwise seen from outside.
    pub volume: f64,
    /// Centroid of the volume; that of the vertices when there is no volume.
    pub centroid: DVec3,
}

/// The mean of the positions; zero when there are none.
pub fn vertex_centroid(positions: &[Vec3]) -> DVec3 {
    if positions.is_empty() {
        return DVec3::ZERO;
    }
    positions.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / positions.len() as f64
}

/// The corners of a triangle, none if an index is out of range.
fn corners(positions: &[Vec3], triangle: &[u32; 3]) -> Option<[DVec3; 3]> {
    let at = |k: usize| positions.get(triangle[k] as usize).map(|p| p.as_dvec3());
    Some([at(0)?, at(1)?, at(2)?])
}

/// Signed volume in cubic metres that the triangles enclose. Meaningful for a closed surface only.
///
/// Computed relative to the centroid of the vertices, so that a mesh far from the origin loses no digits. A triangle that
/// names a vertex which does not exist counts as nothing.
pub fn signed_volume(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    enclosed(positions, triangles).volume
}

/// Signed volume and the volume's centroid; see [`signed_volume`].
pub fn enclosed(positions: &[Vec3], triangles: &[[u32; 3]]) -> Enclosed {
    let origin = vertex_centroid(positions);
    let mut six_volumes = 0.0;
    let mut moment = DVec3::ZERO;
    for [a, b, c] in triangles.iter().filter_map(|t| corners(positions, t)) {
        let [a, b, c] = [a - origin, b - origin, c - origin];
        let six = a.dot(b.cross(c));
        six_volumes += six;
        moment += (a + b + c) * six;
    }
    let centroid = origin + moment / (4.0 * six_volumes);
    Enclosed { volume: six_volumes / 6.0, centroid: if centroid.is_finite() { centroid } else { origin } }
}

/// Area of each triangle in square metres; 0 where an index is out of range.
pub fn triangle_areas(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
    triangles.iter().map(|t| corners(positions, t).map_or(0.0, area)).collect()
}

/// Area of the whole surface in square metres.
pub fn surface_area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    triangle_areas(positions, triangles).iter().sum()
}

/// The smallest box along the axes that holds all positions; inverted (`mins > maxs`) when there are none.
pub fn bounding_box(positions: &[Vec3]) -> Aabb {
    let mut bounds = Aabb::new_invalid();
    for &p in positions {
        bounds.take_point(p);
    }
    bounds
}

/// The paper's size: the largest distance of a point from the mean of all points, in metres.
pub fn size(positions: &[Vec3]) -> f32 {
    let centre = vertex_centroid(positions);
    positions.iter().map(|p| p.as_dvec3().distance_squared(centre)).fold(0.0, f64::max).sqrt() as f32
}

impl TriangleMesh {
    /// The paper's size of the mesh at rest: the largest distance of a vertex from the centroid of all the vertices, in
    /// metres. Vertices at one position count once, so that texture seams do not change it.
    pub fn size(&self) -> f32 {
        let points: Vec<Vec3> = self
            .positions
            .iter()
            .zip(&self.welded)
            .enumerate()
            .filter(|(v, (_, w))| **w as usize == *v)
            .map(|(_, (p, _))| *p)
            .collect();
        size(&points)
    }

    /// Signed volume at rest in cubic metres; see [`signed_volume`].
    pub fn volume(&self) -> f64 {
        signed_volume(&self.positions, &self.triangles)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A ball of latitude rings with closed poles.
    pub(crate) fn sphere(radius: f32, around: u32, rings: u32) -> TriangleMesh {
        let mut p = vec![Vec3::Y * radius, Vec3::NEG_Y * radius];
        for r in 1..rings {
            let theta = std::f32::consts::PI * r as f32 / rings as f32;
            for k in 0..around {
                let phi = std::f32::consts::TAU * k as f32 / around as f32;
                p.push(radius * Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()));
            }
        }
        let at = |r: u32, k: u32| 2 + (r - 1) * around + k % around;
        let mut t = Vec::new();
        for k in 0..around {
            t.push([0, at(1, k + 1), at(1, k)]);
            t.push([1, at(rings - 1, k), at(rings - 1, k + 1)]);
            for r in 1..rings - 1 {
                t.push([at(r, k), at(r, k + 1), at(r + 1, k)]);
                t.push([at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)]);
            }
        }
        TriangleMesh::from_triangles(p, t).unwrap()
    }

    #[test]
    fn a_fine_sphere_has_the_measures_of_a_ball() {
        let mesh = sphere(2.0, 128, 64);
        let ball = 4.0 / 3.0 * PI * 8.0;
        assert!((mesh.volume() / ball - 1.0).abs() < 2e-3, "{} {ball}", mesh.volume());
        assert!((surface_area(&mesh.positions, &mesh.triangles) / (4.0 * PI * 4.0) - 1.0).abs() < 2e-3);
        assert!((mesh.size() - 2.0).abs() < 1e-5);
        assert_eq!(triangle_areas(&mesh.positions, &mesh.triangles).len(), mesh.triangles.len());
    }

    #[test]
    fn volume_and_centroid_survive_a_shift_far_from_the_origin() {
        let mesh = sphere(1.0, 32, 16);
        let shift = Vec3::new(512.0, -1024.0, 256.0);
        let moved: Vec<Vec3> = mesh.positions.iter().map(|p| *p + shift).collect();
        let there = enclosed(&moved, &mesh.triangles);
        assert!((there.volume / mesh.volume() - 1.0).abs() < 1e-4);
        assert!((there.centroid - shift.as_dvec3()).length() < 1e-3);
    }

    #[test]
    fn turning_the_triangles_over_turns_the_sign_of_the_volume() {
        let mesh = sphere(1.0, 16, 8);
        let inside_out: Vec<[u32; 3]> = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        assert_eq!(signed_volume(&mesh.positions, &inside_out), -mesh.volume());
    }

    #[test]
    fn nothing_has_no_size_and_no_volume() {
        assert_eq!(size(&[]), 0.0);
        assert_eq!(signed_volume(&[], &[]), 0.0);
        assert_eq!(enclosed(&[Vec3::X], &[]).centroid, DVec3::X);
        assert_eq!(signed_volume(&[Vec3::X], &[[0, 1, 2]]), 0.0);
        assert_eq!(triangle_areas(&[Vec3::X], &[[0, 1, 2]]), [0.0]);
        let bounds = bounding_box(&[Vec3::X, -Vec3::Y]);
        assert_eq!((bounds.mins, bounds.maxs), (Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 0.0, 0.0)));
    }
}
