//! Distances to convex parts against parry's, and their gradients against differences.

use fastrand::Rng;
use parry3d::query::PointQuery;
use parry3d::shape::{Ball, Capsule, Cone, ConvexPolyhedron, Cuboid, Cylinder, HalfSpace, Triangle};
use pliant::field::{ConvexPart, PartShape, PlacedPart};
use pliant::math::Vec3;

use crate::random::{SHAPES, in_cube, part, pose, shape};

/// The shape of parry that a shape with rounding is, and the rounding that is not in it.
fn twin(part: &ConvexPart) -> (Box<dyn PointQuery>, f32) {
    let rounding = part.rounding;
    match &part.shape {
        PartShape::Point => (Box::new(Ball::new(rounding)), 0.0),
        PartShape::Segment { a, b } => (Box::new(Capsule::new(*a, *b, rounding)), 0.0),
        PartShape::Cuboid { half_extents } => (Box::new(Cuboid::new(*half_extents)), rounding),
        PartShape::Cylinder { half_height, radius } => (Box::new(Cylinder::new(*half_height, *radius)), rounding),
        PartShape::Cone { half_height, radius } => (Box::new(Cone::new(*half_height, *radius)), rounding),
        PartShape::HalfSpace { normal } => (Box::new(HalfSpace::new(*normal)), rounding),
        PartShape::Hull(hull) => {
            let points: Vec<Vec3> = hull.triangles().iter().flatten().copied().collect();
            (Box::new(ConvexPolyhedron::from_convex_hull(&points).expect("a hull")), rounding)
        }
    }
}

#[test]
fn distances_are_those_of_parry() {
    let mut rng = Rng::with_seed(12);
    for kind in 0..12 * SHAPES {
        let part = part(&mut rng, kind);
        let (other, rounding) = twin(&part);
        let mut inside = 0;
        for _ in 0..500 {
            let x = in_cube(&mut rng, 1.5);
            let (distance, direction) = part.distance(x);
            let expected = (other.distance_to_local_point(x, true) - rounding).max(0.0);
            // parry finds the distance from a polyhedron by iteration, to about 3e-4; from a triangle it is exact.
            let tolerance = if matches!(part.shape, PartShape::Hull(_)) { 1e-3 } else { 2e-6 };
            assert!((distance - expected).abs() < tolerance, "{distance} {expected} at {x} of {part:?}");
            let length = direction.length();
            assert!(if distance > 0.0 { (length - 1.0).abs() < 1e-5 } else { length == 0.0 }, "{direction}");
            inside += u32::from(distance == 0.0);
        }
        assert!(inside < 500, "all points inside of {part:?}");
    }
}

#[test]
fn the_distance_from_a_hull_is_that_from_its_nearest_triangle() {
    let mut rng = Rng::with_seed(19);
    for _ in 0..30 {
        let PartShape::Hull(hull) = shape(&mut rng, 6) else { panic!("the sixth kind is the hull") };
        let part = ConvexPart { shape: PartShape::Hull(hull.clone()), rounding: 0.0 };
        let triangles: Vec<Triangle> = hull.triangles().iter().map(|&[a, b, c]| Triangle::new(a, b, c)).collect();
        let mut outside = 0;
        for _ in 0..500 {
            let x = in_cube(&mut rng, 1.0);
            let nearest = triangles.iter().map(|t| t.distance_to_local_point(x, true)).fold(f32::INFINITY, f32::min);
            let inside = hull.planes().iter().all(|(normal, offset)| normal.dot(x) <= *offset);
            let expected = if inside { 0.0 } else { nearest };
            assert!((part.distance(x).0 - expected).abs() < 2e-6, "{x} of {hull:?}");
            outside += u32::from(!inside);
        }
        assert!(outside > 100);
    }
}

#[test]
fn the_direction_leads_back_to_the_surface() {
    let mut rng = Rng::with_seed(13);
    for kind in 0..12 * SHAPES {
        let placed = PlacedPart::new(part(&mut rng, kind), pose(&mut rng, 2.0));
        for _ in 0..300 {
            let x = placed.pose().translation + in_cube(&mut rng, 1.5);
            let (distance, direction) = placed.distance(x);
            let back = x - direction * distance;
            assert!(placed.distance(back).0 < 2e-6, "{back} is off the surface of {:?}", placed.part());
            let halfway = x - direction * (0.5 * distance);
            assert!((placed.distance(halfway).0 - 0.5 * distance).abs() < 2e-6, "{:?}", placed.part());
        }
    }
}

#[test]
fn the_direction_is_the_gradient_of_the_distance() {
    let mut rng = Rng::with_seed(14);
    let h = 4e-3;
    for kind in 0..12 * SHAPES {
        let placed = PlacedPart::new(part(&mut rng, kind), pose(&mut rng, 1.0));
        for _ in 0..300 {
            let x = placed.pose().translation + in_cube(&mut rng, 1.5);
            let (distance, direction) = placed.distance(x);
            // Close to the part the distance curves by 1 / distance, and ends at the surface.
            if distance < 0.1 {
                continue;
            }
            let slope = |axis: Vec3| (placed.distance(x + axis * h).0 - placed.distance(x - axis * h).0) / (2.0 * h);
            let gradient = Vec3::new(slope(Vec3::X), slope(Vec3::Y), slope(Vec3::Z));
            // Over a kink of the curvature the difference is off by h / (2 distance), 2 % at the least distance.
            assert!(
                gradient.distance(direction) < 0.6 * h / distance + 5e-4,
                "{gradient} {direction} {:?}",
                placed.part()
            );
        }
    }
}

#[test]
fn rounding_takes_its_radius_off_the_distance() {
    let mut rng = Rng::with_seed(15);
    for kind in 0..2 * SHAPES {
        let sharp = ConvexPart { shape: shape(&mut rng, kind), rounding: 0.0 };
        let round = ConvexPart { rounding: 0.2, ..sharp.clone() };
        for _ in 0..200 {
            let x = in_cube(&mut rng, 1.5);
            let (distance, rounded) = (sharp.distance(x).0, round.distance(x).0);
            assert!((rounded - (distance - 0.2).max(0.0)).abs() < 1e-6);
        }
    }
}
