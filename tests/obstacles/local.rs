//! Large obstacles cost what lies near a body, and their parts keep their names.

use std::collections::BTreeMap;

use fastrand::Rng;
use pliant::coupling::{LocalPart, PartCache, PartSource, convex_parts};
use pliant::field::PlacedPart;
use pliant::math::{Pose, Vec3};
use rapier3d::geometry::{Array2, Collider, ColliderBuilder, ColliderHandle, SharedShape};
use rapier3d::math::IVector;
use rapier3d::parry::bounding_volume::Aabb;

use crate::kinds;
use crate::random::{in_cube, pose};

fn everything() -> Aabb {
    Aabb::new(Vec3::NEG_INFINITY, Vec3::INFINITY)
}

fn all_parts(source: &PartSource, region: &Aabb, thickness: f32) -> BTreeMap<u32, LocalPart> {
    let mut cells = Vec::new();
    source.cells_near(region, thickness, &mut cells);
    let parts: Vec<(u32, LocalPart)> = cells.iter().flat_map(|&cell| source.expand(cell, thickness)).collect();
    let count = parts.len();
    let by_number: BTreeMap<u32, LocalPart> = parts.into_iter().collect();
    assert_eq!(by_number.len(), count, "two parts have one number");
    by_number
}

fn near(cache: &mut PartCache, collider: &Collider, region: &Aabb, thickness: f32) -> Vec<(u32, LocalPart)> {
    let mut found = Vec::new();
    cache.parts_near(ColliderHandle::invalid(), collider, region, thickness, &mut found).expect("parts");
    found
}

/// True where a point is in one of the parts.
fn holds(parts: &BTreeMap<u32, LocalPart>, at: Pose, x: Vec3) -> bool {
    parts.values().any(|part| PlacedPart::new(part.part.clone(), at * part.pose).distance(x).0 == 0.0)
}

#[test]
fn what_is_expanded_near_a_region_is_all_that_meets_it_under_the_same_names() {
    let mut rng = Rng::with_seed(21);
    for kind in kinds::all() {
        let source = PartSource::new(&kind.shape).expect("parts");
        let full = all_parts(&source, &everything(), 0.5);
        for _ in 0..40 {
            let centre = in_cube(&mut rng, 1.5);
            let half = Vec3::splat(0.02) + in_cube(&mut rng, 0.4).abs();
            let region = Aabb::new(centre - half, centre + half);
            let local = all_parts(&source, &region, 0.5);
            for _ in 0..100 {
                let x = centre + half * in_cube(&mut rng, 1.0);
                assert!(!holds(&full, Pose::IDENTITY, x) || holds(&local, Pose::IDENTITY, x), "{}: {x}", kind.name);
            }
            for (number, part) in &local {
                let same = full.get(number).is_some_and(|other| other.pose == part.pose && other.part == part.part);
                assert!(same, "{}: part {number} is another than in the whole", kind.name);
            }
        }
    }
}

#[test]
fn a_moved_collider_has_the_parts_of_a_full_expansion_that_meet_the_region_again_and_again() {
    let mut rng = Rng::with_seed(22);
    for kind in kinds::all() {
        let at = pose(&mut rng, 3.0);
        let collider = ColliderBuilder::new(kind.shape.clone()).position(at).build();
        let full = all_parts(&PartSource::new(&kind.shape).expect("parts"), &everything(), 0.5);
        let mut cache = PartCache::default();
        for _ in 0..10 {
            let centre = at.transform_point(in_cube(&mut rng, 1.0));
            let region = Aabb::new(centre - 0.3, centre + 0.3);
            let mut again = Vec::new();
            for _ in 0..2 {
                let found = near(&mut cache, &collider, &region, 0.4);
                let numbers: Vec<u32> = found.iter().map(|(number, _)| *number).collect();
                let local: BTreeMap<u32, LocalPart> = found.iter().cloned().collect();
                for _ in 0..100 {
                    let x = centre + in_cube(&mut rng, 0.3);
                    assert!(!holds(&full, at, x) || holds(&local, at, x), "{}: {x}", kind.name);
                }
                assert!(found.iter().all(|(number, part)| full[number].part == part.part), "{}", kind.name);
                assert!(again.is_empty() || again == numbers, "{}", kind.name);
                again = numbers;
            }
        }
    }
}

#[test]
fn a_flat_heightfield_is_one_part_and_a_flat_mesh_few() {
    let flat = SharedShape::heightfield(Array2::repeat(101, 101, 0.3), Vec3::new(50.0, 1.0, 50.0));
    assert_eq!(convex_parts(&flat).expect("parts").len(), 1);
    // A slope is flat too; one bump costs the squares around it only.
    let slope = |i: usize| 0.01 * (i % 101) as f32 + 0.02 * (i / 101) as f32;
    let mut heights: Vec<f32> = (0..101 * 101).map(slope).collect();
    let field =
        |heights: &[f32]| SharedShape::heightfield(Array2::new(101, 101, heights.to_vec()), Vec3::new(50.0, 1.0, 50.0));
    assert_eq!(convex_parts(&field(&heights)).expect("parts").len(), 1);
    heights[50 * 101 + 37] += 0.1;
    let parts = convex_parts(&field(&heights)).expect("parts").len();
    assert!((5..70).contains(&parts), "{parts} parts");
    let (points, triangles) = kinds::sheet(100, 50.0);
    let mesh = SharedShape::trimesh(points, triangles).expect("a mesh");
    let parts = convex_parts(&mesh).expect("parts").len();
    assert!(parts <= 100, "{parts} parts of 20,000 flat triangles");
}

#[test]
fn few_boxes_hold_all_filled_voxels_and_no_empty_one() {
    let hole = [7, 9];
    let is_filled =
        |v: IVector| (0..40).contains(&v.x) && (0..40).contains(&v.z) && (0..3).contains(&v.y) && [v.x, v.z] != hole;
    let around = || (-1..41).flat_map(|x| (-1..41).flat_map(move |z| (-1..4).map(move |y| IVector::new(x, y, z))));
    let voxels: Vec<IVector> = around().filter(|v| is_filled(*v)).collect();
    let size = Vec3::new(0.1, 0.2, 0.1);
    let source = PartSource::new(&SharedShape::voxels(size, &voxels)).expect("parts");
    let parts = all_parts(&source, &everything(), 1.0);
    assert!(parts.len() <= 24, "{} boxes for a plate with a hole", parts.len());
    for voxel in around() {
        let centre = (voxel.as_vec3() + 0.5) * size;
        assert_eq!(holds(&parts, Pose::IDENTITY, centre), is_filled(voxel), "{voxel}");
    }
}

#[test]
fn a_large_terrain_costs_what_lies_near_and_is_forgotten_behind() {
    let cells = 600;
    let terrain = SharedShape::heightfield(kinds::hills(cells, 300.0), Vec3::new(300.0, 1.0, 300.0));
    let collider = ColliderBuilder::new(terrain).build();
    let mut cache = PartCache::default();
    let region = |x: f32| Aabb::new(Vec3::new(x - 1.0, -1.0, -1.0), Vec3::new(x + 1.0, 1.0, 1.0));
    let first = near(&mut cache, &collider, &region(0.0), 1.0).len();
    assert!((16..=72).contains(&first), "{first} parts around a body of four squares by four");
    for step in 0..1000 {
        cache.retain(|_| true);
        near(&mut cache, &collider, &region(0.1 * step as f32), 1.0);
        // At most 240 steps of a tenth of a metre are remembered: 52 squares by 6, two parts each.
        assert!(cache.kept_cells() <= 700, "{} cells are kept", cache.kept_cells());
    }
}

#[test]
fn a_stand_in_takes_the_place_of_a_collider_until_it_is_removed() {
    let collider = ColliderBuilder::ball(1.0).translation(Vec3::X).build();
    let mut cache = PartCache::default();
    let around = Aabb::new(Vec3::splat(-5.0), Vec3::splat(5.0));
    let handle = ColliderHandle::invalid();
    let count = |cache: &mut PartCache| near(cache, &collider, &around, 1.0).len();
    assert_eq!(count(&mut cache), 1);
    let two = vec![(Pose::IDENTITY, SharedShape::ball(0.5)), (Pose::from_translation(Vec3::X), SharedShape::ball(0.5))];
    cache.stand_in(handle, Some(SharedShape::compound(two)));
    assert_eq!(count(&mut cache), 2);
    cache.stand_in(handle, None);
    assert_eq!(count(&mut cache), 1);
}

#[test]
fn obstacles_without_anything_to_touch_are_refused() {
    let empty = SharedShape::voxels(Vec3::ONE, &[]);
    let flat = SharedShape::trimesh(vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0], vec![[0, 1, 2]]).expect("a mesh");
    let infinite = SharedShape::heightfield(Array2::new(2, 2, vec![0.0, f32::NAN, 0.0, 0.0]), Vec3::ONE);
    let narrow = SharedShape::heightfield(Array2::repeat(2, 2, 0.0), Vec3::new(0.0, 1.0, 1.0));
    let point = SharedShape::triangle(Vec3::ONE, Vec3::ONE, Vec3::ONE);
    for shape in [empty, flat, infinite, narrow, point] {
        assert!(PartSource::new(&shape).is_err(), "{:?}", shape.shape_type());
    }
}
