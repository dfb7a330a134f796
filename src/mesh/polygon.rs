//! Polygons to triangles by clipping the best ear: concave faces stay whole and every corner is used.
//!
//! Corners in line with their neighbours are kept (general triangulators drop them), because the face next door uses
//! them too and the surface would open there.

use crate::math::Vec3;
use glam::DVec2;

/// Faces with more corners are refused: clipping takes time with the square of their number and more.
pub(super) const MAX_CORNERS: usize = 4096;

/// Calls `emit` with the corner numbers of the `n - 2` triangles of a polygon of `n` corners, which turn as it does.
pub(super) fn triangulate(corners: &[Vec3], mut emit: impl FnMut([usize; 3])) {
    if corners.len() == 3 {
        return emit([0, 1, 2]);
    }
    let flat = flatten(corners);
    let mut left: Vec<usize> = (0..corners.len()).collect();
    while left.len() > 3 {
        let at = best_ear(&flat, &left);
        emit(ear(&left, at));
        left.remove(at);
    }
    if let [a, b, c] = left[..] {
        emit([a, b, c]);
    }
}

/// The polygon on the plane of its largest shadow, turned so that it runs counter-clockwise.
fn flatten(corners: &[Vec3]) -> Vec<DVec2> {
    let origin = corners[0].as_dvec3();
    let local = |i: usize| corners[i % corners.len()].as_dvec3() - origin;
    let normal: glam::DVec3 = (0..corners.len()).map(|i| local(i).cross(local(i + 1))).sum();
    let size = normal.abs();
    (0..corners.len())
        .map(|i| {
            let p = local(i);
            let (shadow, up) = if size.x >= size.y && size.x >= size.z {
                (DVec2::new(p.y, p.z), normal.x)
            } else if size.y >= size.z {
                (DVec2::new(p.z, p.x), normal.y)
            } else {
                (DVec2::new(p.x, p.y), normal.z)
            };
            if up < 0.0 { DVec2::new(shadow.y, shadow.x) } else { shadow }
        })
        .collect()
}

/// The triangle that is cut off at place `at` of what is left.
fn ear(left: &[usize], at: usize) -> [usize; 3] {
    let n = left.len();
    [left[(at + n - 1) % n], left[at], left[(at + 1) % n]]
}

/// Twice the signed area of a triangle.
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The place of the fattest triangle that can be cut off; of crossed or flat polygons the one that turns over least.
fn best_ear(flat: &[DVec2], left: &[usize]) -> usize {
    let shape = |at: usize| {
        let [a, b, c] = ear(left, at).map(|i| flat[i]);
        let edges = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
        area(a, b, c) / edges.max(f64::MIN_POSITIVE)
    };
    let mut ranked: Vec<(f64, usize)> = (0..left.len()).map(|at| (shape(at), at)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let free = ranked.iter().take_while(|r| r.0 > 0.0).find(|r| !is_blocked(flat, left, &ranked, r.1));
    free.unwrap_or(&ranked[0]).1
}

/// True when a corner that is not convex lies in the triangle at `at` or on its border. Those corners are the tail of
/// `ranked`.
fn is_blocked(flat: &[DVec2], left: &[usize], ranked: &[(f64, usize)], at: usize) -> bool {
    let [a, b, c] = ear(left, at).map(|i| flat[i]);
    ranked.iter().rev().take_while(|r| r.0 <= 1e-12).any(|r| {
        let p = flat[left[r.1]];
        let is_corner = p == a || p == b || p == c;
        !is_corner && area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn areas(corners: &[Vec3]) -> Vec<f32> {
        let mut areas = Vec::new();
        triangulate(corners, |[a, b, c]| {
            areas.push((corners[b] - corners[a]).cross(corners[c] - corners[a]).z / 2.0);
        });
        areas
    }

    fn flat(points: &[(f32, f32)]) -> Vec<Vec3> {
        points.iter().map(|&(x, y)| Vec3::new(x, y, 0.0)).collect()
    }

    #[test]
    fn a_concave_polygon_is_cut_into_triangles_that_all_turn_the_same_way() {
        // An L, whose fan from the first corner would leave the polygon.
        let l = flat(&[(2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0)]);
        let a = areas(&l);
        assert_eq!(a.len(), 4);
        assert!(a.iter().all(|a| *a > 0.0) && (a.iter().sum::<f32>() - 3.0).abs() < 1e-6, "{a:?}");
        let dart = flat(&[(0.0, 0.0), (2.0, -1.0), (1.0, 0.0), (2.0, 1.0)]);
        let a = areas(&dart);
        assert!(a.iter().all(|a| *a > 0.0) && (a.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{a:?}");
    }

    #[test]
    fn corners_in_line_are_kept_and_no_triangle_is_flat() {
        let square = flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0)]);
        let a = areas(&square);
        assert_eq!(a.len(), 4);
        assert!(a.iter().all(|a| *a > 0.1) && (a.iter().sum::<f32>() - 4.0).abs() < 1e-6, "{a:?}");
    }

    #[test]
    fn a_polygon_in_any_plane_keeps_its_turn() {
        let star: Vec<(f32, f32)> = (0..10)
            .map(|k| {
                let (r, phi) = (if k % 2 == 0 { 1.0 } else { 0.3 }, std::f32::consts::TAU * k as f32 / 10.0);
                (r * phi.cos(), r * phi.sin())
            })
            .collect();
        for axis in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z, Vec3::ONE.normalize()] {
            let turn = glam::Quat::from_rotation_arc(Vec3::Z, axis);
            let corners: Vec<Vec3> = flat(&star).iter().map(|p| turn * *p).collect();
            let mut count = 0;
            triangulate(&corners, |[a, b, c]| {
                let normal = (corners[b] - corners[a]).cross(corners[c] - corners[a]);
                assert!(normal.dot(axis) > 0.0);
                count += 1;
            });
            assert_eq!(count, 8);
        }
    }

    #[test]
    fn flat_and_crossed_polygons_still_give_all_their_triangles() {
        assert_eq!(areas(&[Vec3::ONE; 5]).len(), 3);
        assert_eq!(areas(&flat(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])).len(), 2);
    }
}
