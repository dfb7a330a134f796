//! Convex hulls: what has none, and that those which exist hold their points and nothing else.

use std::sync::Arc;

use fastrand::Rng;
use pliant::field::{ConvexHull, ConvexPart, HullError, PartShape};
use pliant::math::{Pose, Vec3};

use crate::random::{between, in_cube, pose};

fn cloud(rng: &mut Rng, place: Pose, half: Vec3) -> Vec<Vec3> {
    (0..30).map(|_| place.transform_point(in_cube(rng, 1.0) * half)).collect()
}

#[test]
fn points_in_a_plane_or_not_finite_have_no_hull() {
    let flat: Vec<Vec3> = (0..8).map(|i| Vec3::new((i % 3) as f32, (i / 3) as f32, 0.5)).collect();
    assert_eq!(ConvexHull::from_points(&flat), Err(HullError { points: 8 }));
    assert!(ConvexHull::from_points(&[Vec3::ZERO; 20]).is_err());
    let mut corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    assert!(ConvexHull::from_points(&corners).is_ok());
    corners[3].z = f32::NAN;
    assert!(ConvexHull::from_points(&corners).is_err());
}

#[test]
fn a_tilted_plane_has_no_hull() {
    let mut rng = Rng::with_seed(20);
    for _ in 0..200 {
        let place = pose(&mut rng, 3.0);
        assert!(ConvexHull::from_points(&cloud(&mut rng, place, Vec3::new(1.0, 1.0, 0.0))).is_err());
        assert!(ConvexHull::from_points(&cloud(&mut rng, place, Vec3::new(1.0, 0.0, 0.0))).is_err());
    }
}

#[test]
fn hulls_of_lumps_plates_and_needles_are_closed_hold_all_points_and_have_a_volume() {
    let mut rng = Rng::with_seed(21);
    for half in [1.0, 1e-2, 1e-3, 1e-4].map(|thin| [Vec3::new(1.0, 1.0, thin), Vec3::new(1.0, thin, thin)]).concat() {
        for _ in 0..100 {
            let place = pose(&mut rng, 1.0);
            let points = cloud(&mut rng, place, half);
            let hull = ConvexHull::from_points(&points).expect("a volume");
            for (normal, offset) in hull.planes() {
                let outermost = points.iter().map(|p| normal.dot(*p) - offset).fold(f32::NEG_INFINITY, f32::max);
                assert!(outermost < 2e-6, "a point is {outermost} outside of a hull of {half}");
            }
            let mut volume = 0.0;
            let mut borders = 0.0_f64;
            for [a, b, c] in hull.triangles().iter().map(|t| t.map(|p| (p - points[0]).as_dvec3())) {
                volume += a.dot(b.cross(c)) / 6.0;
                borders += [a, b, c].iter().zip([b, c, a]).map(|(p, q)| (q.x - p.x) * (q.y + p.y)).sum::<f64>();
            }
            // Thirty random points fill about half of their box, whose volume is eight times the product.
            let filled = volume / (8.0 * f64::from(half.x * half.y * half.z));
            assert!(filled > 0.15 && filled < 1.0, "{filled} of a box of {half}");
            assert!(borders.abs() < 1e-6, "the surface has a border: {borders}");
        }
    }
}

#[test]
fn points_on_and_just_beneath_a_face_of_many_triangles_lie_at_no_distance() {
    let mut rng = Rng::with_seed(22);
    for _ in 0..20 {
        let half = Vec3::splat(0.3) + in_cube(&mut rng, 0.7).abs();
        let place = pose(&mut rng, 1.0);
        // A grid on each face: all triangles of a face lie in one plane but for rounding.
        let grid = |i: i32| Vec3::new((i % 4) as f32, (i / 4 % 4) as f32, (i / 16) as f32) * (2.0 / 3.0) - Vec3::ONE;
        let points: Vec<Vec3> = (0..64).map(|i| place.transform_point(grid(i) * half)).collect();
        let hull = ConvexHull::from_points(&points).expect("a box");
        let part = ConvexPart { shape: PartShape::Hull(Arc::new(hull)), rounding: 0.0 };
        for _ in 0..2000 {
            let mut x = in_cube(&mut rng, 1.0);
            let axis = rng.usize(0..3);
            x[axis] = 1.0;
            let height = between(&mut rng, -4e-7, 4e-7);
            let on_face = place.transform_point(x * half + Vec3::AXES[axis] * height);
            let (distance, _) = part.distance(on_face);
            assert!(distance < 3e-6, "{distance} at the height {height}");
        }
    }
}
