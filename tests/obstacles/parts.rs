//! The convex parts of every kind fill the obstacle, and nothing else.

use fastrand::Rng;
use pliant::coupling::{DEFAULT_THICKNESS, ObstaclePart, PartId, convex_parts};
use pliant::math::{Pose, Vec3};
use rapier3d::geometry::{ColliderHandle, SharedShape};

use crate::kinds::{self, Kind};
use crate::random::{between, in_cube, pose};

/// The parts of a shape, placed.
pub fn placed(shape: &SharedShape, pose: Pose) -> Vec<ObstaclePart> {
    let parts = convex_parts(shape).expect("parts");
    let place = |(part, local): (usize, &pliant::coupling::LocalPart)| {
        let id = PartId { collider: (0, 0), part: part as u32 };
        ObstaclePart::new(id, ColliderHandle::invalid(), local, pose * local.pose)
    };
    parts.iter().enumerate().map(place).collect()
}

/// What the hulls' planes lose by rounding, for obstacles of some metres.
const ROUNDING: f32 = 1.0e-4;

/// Half of the thickness that sheets and wires are given, for the widest obstacle here.
const SHEET: f32 = 0.5 * 4.0 * DEFAULT_THICKNESS / 512.0;

fn samples(kind: &Kind, rng: &mut Rng) -> Vec<Vec3> {
    let bounds = kind.shape.compute_local_aabb();
    let (low, high) = (bounds.mins.max(Vec3::splat(-3.0)) - 0.1, bounds.maxs.min(Vec3::splat(3.0)) + 0.1);
    let mut points = Vec::new();
    for _ in 0..3000 {
        let x = Vec3::new(between(rng, low.x, high.x), between(rng, low.y, high.y), between(rng, low.z, high.z));
        points.push(x);
        // And near the surface, where it matters.
        let onto = kind.shape.project_local_point(x, false).point;
        points.push(onto + in_cube(rng, 1.0) * 10.0_f32.powf(between(rng, -4.0, -1.0)));
    }
    points
}

#[test]
fn parts_of_every_kind_fill_the_obstacle_and_nothing_else() {
    let mut rng = Rng::with_seed(11);
    for kind in kinds::all() {
        let at = pose(&mut rng, 2.0);
        let parts = placed(&kind.shape, at);
        let sheet = if kind.filled == 0.0 { SHEET } else { 0.0 };
        let mut inside = 0;
        for local in samples(&kind, &mut rng) {
            let x = at.transform_point(local);
            let depth = (kind.truth)(local) + sheet;
            let contained = parts.iter().any(|part| part.contains(x));
            if depth > ROUNDING && depth < kind.filled {
                assert!(contained || sheet > 0.0, "{}: {local} is {depth} deep and in no part", kind.name);
                inside += 1;
            }
            assert!(!contained || depth > -ROUNDING, "{}: {local} is {} outside and in a part", kind.name, -depth);
            let measured = parts.iter().map(|part| part.exact_depth(x)).fold(0.0, f32::max);
            assert!(contained || measured < ROUNDING, "{}: {local} is in no part, and {measured} deep", kind.name);
        }
        if sheet > 0.0 {
            // A sheet has nothing inside but its surface.
            for local in samples(&kind, &mut rng) {
                let onto = at.transform_point(kind.shape.project_local_point(local, false).point);
                assert!(parts.iter().any(|part| part.placed.distance(onto).0 < ROUNDING), "{}: {onto}", kind.name);
                inside += 1;
            }
        }
        assert!(inside > 300, "{}: only {inside} points inside", kind.name);
    }
}

#[test]
fn the_exact_depth_of_convex_obstacles_is_the_depth_below_their_surface() {
    let mut rng = Rng::with_seed(12);
    let convex = [
        "ball",
        "capsule",
        "cuboid",
        "cylinder",
        "cone",
        "round cuboid",
        "round cylinder",
        "round cone",
        "hull",
        "round hull",
        "round triangle",
        "half-space",
    ];
    for kind in kinds::all().into_iter().filter(|kind| convex.contains(&kind.name)) {
        let at = pose(&mut rng, 2.0);
        let [part] = &placed(&kind.shape, at)[..] else { panic!("{} is one part", kind.name) };
        for local in samples(&kind, &mut rng) {
            let x = at.transform_point(local);
            let depth = (kind.truth)(local);
            let (inside, outside) = (part.exact_depth(x), part.exact_distance(x));
            assert!((inside - depth.max(0.0)).abs() < ROUNDING, "{}: {local}: {inside}, truly {depth}", kind.name);
            assert!((outside - (-depth).max(0.0)).abs() < ROUNDING, "{}: {local}: {outside}, truly {depth}", kind.name);
            let way = part.way_to_surface(x);
            if depth > 2.0 * ROUNDING {
                let end = at.inverse_transform_point(x + way);
                assert!((kind.truth)(end).abs() < 2.0 * ROUNDING, "{}: {local} leads to {end}", kind.name);
            }
        }
    }
}

#[test]
fn the_way_out_along_a_direction_ends_on_the_surface() {
    let mut rng = Rng::with_seed(13);
    for kind in
        kinds::all().into_iter().filter(|kind| ["hull", "cuboid", "round cone", "round hull"].contains(&kind.name))
    {
        let at = pose(&mut rng, 2.0);
        let [part] = &placed(&kind.shape, at)[..] else { panic!("{} is one part", kind.name) };
        for local in samples(&kind, &mut rng) {
            if (kind.truth)(local) < 1.0e-3 {
                continue;
            }
            let direction = crate::random::direction(&mut rng);
            let x = at.transform_point(local);
            let exit = part.exit(x, direction, 10.0).expect("x is inside");
            let end = at.inverse_transform_point(x + direction * exit);
            assert!((kind.truth)(end).abs() < 1.0e-3, "{}: {local} comes out at {end}", kind.name);
        }
    }
}

#[test]
fn what_leads_through_a_thin_part_counts_from_nothing_at_its_side_to_all_in_its_middle() {
    let wire = SharedShape::capsule_z(1.0, 0.01);
    let part = &placed(&wire, Pose::IDENTITY)[0];
    let counts = |aside: f32| part.through(Vec3::new(aside, -0.02, 0.0), Vec3::Y, 0.03);
    assert!(counts(0.0) > 0.9 && counts(0.0099) < 0.1 && counts(0.0101) == 0.0);
    for i in 0..200 {
        let (a, b) = (counts(i as f32 * 1e-4 - 0.01), counts((i + 1) as f32 * 1e-4 - 0.01));
        // Its own width of 0.02 in two hundred steps: no step may be seen.
        assert!((a - b).abs() < 0.05, "from {a} to {b}");
    }
}
