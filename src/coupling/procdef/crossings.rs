//! Whether bodies are in each other: edges of one that go through triangles of another, counted in 64 bits, for measuring.
//!
//! An edge that goes exactly through a side or a corner of triangles counts in none of them, and what is wholly inside another body
//! crosses nothing. The step does not ask this; it holds bodies apart by other means.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use crate::math::Vec3;

/// How many edges of each body go through a triangle of another. A body is the positions of its vertices and the triangles of its
/// boundary; triangles of vertices that are not finite, or not there, cross nothing.
pub fn crossings(bodies: &[(&[Vec3], &[[u32; 3]])]) -> Vec<usize> {
    let placed: Vec<(Aabb, Vec<[Vec3; 3]>)> = bodies
        .iter()
        .map(|(positions, triangles)| {
            let at = |v: u32| positions.get(v as usize).copied().unwrap_or(Vec3::NAN);
            let corners: Vec<[Vec3; 3]> = triangles.iter().map(|t| t.map(at)).collect();
            (around(corners.iter().flatten()), corners)
        })
        .collect();
    let of_body = |i: usize| {
        let (bounds, triangles) = &placed[i];
        // An edge belongs to two triangles: it counts in the direction in which its ends ascend.
        let edges = |k: usize| {
            let [a, b, c] = bodies[i].1[k];
            let [p, q, r] = triangles[k];
            [(a, b, p, q), (b, c, q, r), (c, a, r, p)].into_iter().filter(|(a, b, ..)| a < b).map(|(.., p, q)| [p, q])
        };
        let mut count = 0;
        for (other, others) in
            placed.iter().enumerate().filter(|(j, (b, _))| *j != i && b.intersects(bounds)).map(|(_, s)| s)
        {
            let near: Vec<_> =
                others.iter().map(|t| (around(t.iter()), t)).filter(|(own, _)| own.intersects(bounds)).collect();
            for [p, q] in (0..triangles.len()).flat_map(edges) {
                let own = around([p, q].iter());
                if own.intersects(other) {
                    count += usize::from(near.iter().any(|(b, t)| b.intersects(&own) && goes_through(p, q, t)));
                }
            }
        }
        count
    };
    (0..bodies.len()).into_par_iter().map(of_body).collect()
}

fn around<'a>(points: impl Iterator<Item = &'a Vec3>) -> Aabb {
    let mut bounds = Aabb::new_invalid();
    points.for_each(|&x| bounds.take_point(x));
    bounds
}

/// Whether the way from `p` to `q` goes through a triangle: by the signs of five volumes, in 64 bits.
fn goes_through(p: Vec3, q: Vec3, triangle: &[Vec3; 3]) -> bool {
    let [a, b, c] = triangle.map(|x| x.as_dvec3());
    let (p, q) = (p.as_dvec3(), q.as_dvec3());
    let volume = |a: glam::DVec3, b: glam::DVec3, c: glam::DVec3, d: glam::DVec3| (b - a).cross(c - a).dot(d - a);
    let sides = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    let one_way = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
    one_way && volume(a, b, c, p) * volume(a, b, c, q) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_through_triangles_of_others_are_counted_and_those_beside_are_not() {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let at = |shift: Vec3| [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|x| x + shift);
        let (first, inside, beside) = (at(Vec3::ZERO), at(Vec3::new(0.2, 0.1, 0.15)), at(Vec3::splat(0.4)));
        // The three edges from the second's first corner leave the first through its slanted face.
        let count = |other: &[Vec3; 4]| crossings(&[(&first, &tetrahedron), (other, &tetrahedron)]);
        assert_eq!(count(&inside), [0, 3]);
        assert_eq!(count(&beside), [0, 0]);
        assert_eq!(count(&[Vec3::NAN; 4]), [0, 0]);
    }
}
