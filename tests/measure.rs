//! The measurements tell what they claim to.

mod common;

use pliant::coupling::{
    CancelMemory, CancelReport, CancelSettings, CoherenceMemory, ContactMemories, ObstaclePart, PIERCED, PartId,
    SMOOTH, SkinsMet, cancel, cancel_with_memory, convex_parts, measure, proximities,
};
use pliant::elastic::{ElasticBody, LevelOfDetail};
use pliant::math::{Pose, Quat, Vec3};
use pliant::spring::SpringCoefficients;
use rapier3d::geometry::{ColliderHandle, SharedShape};

const RADIUS: f32 = 0.5;

fn ball(pose: Pose) -> ElasticBody {
    let mut body = ElasticBody::new(common::ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.2)));
    place(&mut body, pose);
    body
}

fn place(body: &mut ElasticBody, pose: Pose) {
    body.place(&[pose]);
    body.build_palette();
    body.deform_springs();
}

fn part(shape: &SharedShape, pose: Pose) -> Vec<ObstaclePart> {
    let local = &convex_parts(shape).unwrap()[0];
    let id = PartId { collider: (0, 0), part: 0 };
    vec![ObstaclePart::new(id, ColliderHandle::from_raw_parts(0, 0), local, pose)]
}

/// A wide box whose top is at this height.
fn floor(top: f32) -> Vec<ObstaclePart> {
    part(&SharedShape::cuboid(5.0, 1.0, 5.0), Pose::from_translation(Vec3::Y * (top - 1.0)))
}

fn cancelled(body: &mut ElasticBody, parts: &[ObstaclePart]) -> CancelReport {
    let near = proximities(body, parts, 0.1, &mut ContactMemories::new());
    cancel(body, parts, &near, RADIUS, &CancelSettings::default())
}

#[test]
fn the_depth_of_an_untouched_ball_in_a_floor_is_how_far_it_reaches_in_and_it_is_not_cancelled() {
    let body = ball(Pose::IDENTITY);
    let figures = measure(&body, &floor(-0.4), RADIUS, &CancelReport::default());
    // The vertices of the sphere lie up to 0.001 of the radius above its lowest point.
    assert!((figures.max_depth_after - 0.2).abs() < 2e-3, "{figures:?}");
    assert!(figures.uncancelled && figures.vertices_inside > 100, "{figures:?}");
    assert!(figures.max_piercing >= figures.max_depth_after);
}

#[test]
fn a_tip_between_the_vertices_is_seen_though_no_vertex_is_inside() {
    let body = ball(Pose::IDENTITY);
    let rig = body.rig().clone();
    let t = rig.mesh.triangles[1234].map(|v| rig.mesh.positions[v as usize]);
    let middle = (t[0] + t[1] + t[2]) / 3.0;
    let out = (t[1] - t[0]).cross(t[2] - t[0]).normalize();
    // A slender cone, its tip 0.01 m behind the triangle.
    let tip = Pose::from_parts(middle + out * (0.2 - 0.01), Quat::from_rotation_arc(Vec3::Y, -out));
    let figures = measure(&body, &part(&SharedShape::cone(0.2, 0.005), tip), RADIUS, &CancelReport::default());
    assert_eq!(figures.max_depth_after, 0.0);
    // The deepest point of the triangle in the cone is at most half of the cone's width there.
    assert!(figures.max_piercing > 0.0, "{figures:?}");
    let wide = measure(&body, &part(&SharedShape::cuboid(0.005, 0.2, 0.005), tip), RADIUS, &CancelReport::default());
    // Half of the bar's width of 0.01 m, in radii.
    assert!((wide.max_piercing - 0.01).abs() < 1e-3 && wide.uncancelled && wide.max_piercing > PIERCED, "{wide:?}");
}

#[test]
fn a_skin_that_hangs_above_what_it_had_penetrated_has_a_gap_of_that_height() {
    let mut body = ball(Pose::IDENTITY);
    let report = cancelled(&mut body, &floor(-0.4));
    let touching = measure(&body, &floor(-0.4), RADIUS, &report);
    assert!(touching.max_gap < 5e-3 && !touching.uncancelled, "{touching:?}");
    let lowered = measure(&body, &floor(-0.42), RADIUS, &report);
    assert!((lowered.max_gap - touching.max_gap - 0.02 / RADIUS).abs() < 1e-3, "{lowered:?}");
}

#[test]
fn a_body_that_rides_on_its_obstacle_is_perfectly_coherent() {
    let mut body = ball(Pose::IDENTITY);
    let mut memory = CoherenceMemory::default();
    let settings = CancelSettings::default();
    for step in 0..4 {
        let ride = Pose::from_parts(Vec3::X * (0.3 * step as f32), Quat::from_rotation_y(0.2 * step as f32));
        place(&mut body, ride);
        let parts = part(&SharedShape::cuboid(5.0, 1.0, 5.0), ride * Pose::from_translation(Vec3::Y * -1.4));
        memory.begin(&body);
        let report = cancelled(&mut body, &parts);
        assert!(report.passes > 0);
        let coherence = memory.end(&body, &parts, SkinsMet::default(), &report, RADIUS, &settings);
        // Rounding of poses decides which vertices are just deeper than the tolerance: less than that may change.
        let small = coherence.change < settings.depth_tolerance && coherence.motion < 1e-5;
        assert!(small && coherence.ratio < SMOOTH, "{coherence:?}");
    }
}

#[test]
fn a_cancellation_that_is_left_out_for_a_step_is_seen_as_a_pop() {
    let mut body = ball(Pose::IDENTITY);
    let mut memory = CoherenceMemory::default();
    let settings = CancelSettings::default();
    let parts = floor(-0.4);
    memory.begin(&body);
    let report = cancelled(&mut body, &parts);
    assert_eq!(
        memory.end(&body, &parts, SkinsMet::default(), &report, RADIUS, &settings).ratio,
        0.0,
        "there is no step before"
    );
    place(&mut body, Pose::IDENTITY);
    memory.begin(&body);
    let pop = memory.end(&body, &parts, SkinsMet::default(), &CancelReport::default(), RADIUS, &settings);
    assert!(pop.change > 0.19 && pop.motion == 0.0 && pop.ratio > 10.0 * SMOOTH, "{pop:?}");
    // Where nobody knows what was before, nothing is said.
    memory.forget();
    memory.begin(&body);
    assert_eq!(memory.end(&body, &parts, SkinsMet::default(), &CancelReport::default(), RADIUS, &settings).ratio, 0.0);
}

/// A ball between two planks that stand askew, and what was done about it.
fn between_planks(shift: Vec3, memory: &CancelMemory) -> (ElasticBody, Vec<ObstaclePart>, CancelReport, Vec<Vec3>) {
    let mut body = ball(Pose::from_translation(shift));
    let plank = SharedShape::cuboid(0.1, 2.0, 2.0);
    let mut parts = part(&plank, Pose::from_parts(Vec3::X * 0.45, Quat::from_rotation_z(0.3)));
    parts.extend(part(&plank, Pose::from_parts(Vec3::X * -0.5, Quat::from_rotation_z(-0.2))));
    parts[1].id.collider = (1, 0);
    let near = proximities(&body, &parts, 0.1, &mut ContactMemories::new());
    let before = body.positions().to_vec();
    let report = cancel_with_memory(memory, &mut body, &parts, &near, RADIUS, &CancelSettings::default());
    (body, parts, report, before)
}

#[test]
fn a_body_that_lies_still_keeps_its_passes_and_stays_out_of_the_obstacles() {
    let mut memory = CancelMemory::default();
    let (first, parts, report, before) = between_planks(Vec3::ZERO, &memory);
    assert!(report.passes > 0 && report.left == 0.0, "{report:?}");
    memory.remember(before, &first, &parts, &report, &CancelSettings::default());
    let tremor = Vec3::new(0.7, -0.5, 0.5) * (1.0e-4 * RADIUS);
    let (second, parts, again, _) = between_planks(tremor, &memory);
    // What was done is done again to the bit; a correction may follow.
    let passes = &first.palette().passes;
    assert_eq!(&second.palette().passes[..passes.len()], &passes[..]);
    let change = |(a, b): (&Vec3, &Vec3)| a.distance(*b);
    let change = first.positions().iter().zip(second.positions()).map(change).fold(0.0, f32::max);
    assert!(change < 20.0 * tremor.length(), "the skin moves by {change}");
    let figures = measure(&second, &parts, RADIUS, &again);
    assert!(figures.max_depth_after < 1e-3 && figures.max_gap < 5e-3, "{figures:?}");
}

#[test]
fn a_body_that_moves_on_is_dealt_with_anew() {
    let mut memory = CancelMemory::default();
    let (first, parts, report, before) = between_planks(Vec3::ZERO, &memory);
    memory.remember(before, &first, &parts, &report, &CancelSettings::default());
    // The lesser way is little enough to be made up for by a correction, but no tremor.
    for shift in [0.001, 0.02] {
        let shift = Vec3::new(shift, 0.0, 0.0);
        let (moved, ..) = between_planks(shift, &memory);
        let (fresh, ..) = between_planks(shift, &CancelMemory::default());
        assert_eq!(moved.positions(), fresh.positions());
    }
    // A memory that was wiped does no harm either.
    memory.forget();
    let (forgotten, ..) = between_planks(Vec3::ZERO, &memory);
    assert_eq!(forgotten.positions(), first.positions());
}

/// The passes of a body that held still were taken again although the obstacle that they were for had gone.
#[test]
fn a_dent_goes_with_the_obstacle_that_made_it() {
    let mut memory = CancelMemory::default();
    let (first, parts, report, before) = between_planks(Vec3::ZERO, &memory);
    memory.remember(before, &first, &parts, &report, &CancelSettings::default());
    let mut alone = ball(Pose::IDENTITY);
    let undented = alone.positions().to_vec();
    let report = cancel_with_memory(&memory, &mut alone, &[], &[], RADIUS, &CancelSettings::default());
    assert_eq!((report.passes, alone.positions()), (0, &undented[..]));
}

/// The numbers of the parts were kept that they had in the step before: the dent was then carried along with another part.
#[test]
fn a_dent_belongs_to_the_same_part_where_others_come_into_the_list_before_it() {
    let mut memory = CancelMemory::default();
    let (first, parts, report, before) = between_planks(Vec3::ZERO, &memory);
    memory.remember(before, &first, &parts, &report, &CancelSettings::default());
    let mut more = part(&SharedShape::ball(0.1), Pose::from_translation(Vec3::Y * 5.0));
    more[0].id.collider = (7, 0);
    more.extend(parts.iter().cloned());
    let mut second = ball(Pose::from_translation(Vec3::X * (5.0e-5 * RADIUS)));
    let near = proximities(&second, &more, 0.1, &mut ContactMemories::new());
    cancel_with_memory(&memory, &mut second, &more, &near, RADIUS, &CancelSettings::default());
    let owners = |body: &ElasticBody, parts: &[ObstaclePart]| {
        let fields = body.palette().passes.iter().flat_map(|pass| &pass.fields);
        fields.map(|entry| parts[entry.owner as usize].id).collect::<Vec<_>>()
    };
    let known = owners(&first, &parts);
    assert_eq!(owners(&second, &more)[..known.len()], known[..]);
}

/// A ball at `x` is pressed onto a floor: how far its skin is moved, and what was done.
fn pressed_at(x: f32, memory: &mut CancelMemory, settings: &CancelSettings) -> (Vec<Vec3>, CancelReport) {
    let mut body = ball(Pose::from_translation(Vec3::X * x));
    let (parts, before) = (floor(-0.3), body.positions().to_vec());
    let near = proximities(&body, &parts, 0.1, &mut ContactMemories::new());
    let report = cancel_with_memory(memory, &mut body, &parts, &near, RADIUS, settings);
    let moved = body.positions().iter().zip(&before).map(|(now, before)| now - before).collect();
    memory.remember(before, &body, &parts, &report, &CancelSettings::default());
    (moved, report)
}

fn largest_change(a: &[Vec3], b: &[Vec3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

#[test]
fn a_skin_that_would_jump_to_another_shape_does_not_jump_while_it_slides_on() {
    let (step, settings) = (1.0e-3 * RADIUS, CancelSettings::default());
    // In the step before, the dent was made by much softer fields.
    let mut memory = CancelMemory::default();
    let softer = CancelSettings { softness: Some(4.0), ..settings };
    let (mut last, _) = pressed_at(0.0, &mut memory, &softer);
    let floor = (settings.depth_tolerance + settings.gap_tolerance) * RADIUS;
    let calm = SMOOTH * step + floor;
    let jump = largest_change(&pressed_at(step, &mut CancelMemory::default(), &settings).0, &last);
    assert!(jump > 10.0 * calm, "else there is nothing to see: {jump} and {calm}");
    for number in 1..=60 {
        let (moved, report) = pressed_at(step * number as f32, &mut memory, &settings);
        let change = largest_change(&moved, &last);
        assert!(change < calm && report.left == 0.0, "step {number}: {change} of {calm}");
        last = moved;
    }
}

/// Its motion was taken for none, and whatever led out of it for a jump: the softest way was taken, or the one that did least.
#[test]
fn an_obstacle_that_was_not_there_in_the_step_before_is_dealt_with_as_in_a_first_step() {
    let mut memory = CancelMemory::default();
    let alone = ball(Pose::IDENTITY);
    memory.remember(alone.positions().to_vec(), &alone, &[], &CancelReport::default(), &CancelSettings::default());
    let (body, _, report, _) = between_planks(Vec3::X * 0.01, &memory);
    let (fresh, _, first, _) = between_planks(Vec3::X * 0.01, &CancelMemory::default());
    assert_eq!((report.way, report.passes), (first.way, first.passes));
    assert_eq!(body.positions(), fresh.positions());
}

/// All of the body's settings were compared, the place of the viewer among them.
#[test]
fn a_viewer_that_moves_does_not_make_a_body_forget_its_passes() {
    let mut memory = CancelMemory::default();
    let (first, parts, report, before) = between_planks(Vec3::ZERO, &memory);
    memory.remember(before, &first, &parts, &report, &CancelSettings::default());
    let mut second = ball(Pose::IDENTITY);
    second.settings.level_of_detail = Some(LevelOfDetail { viewer: Vec3::Z, threshold: 0.0 });
    place(&mut second, Pose::from_translation(Vec3::X * (5.0e-5 * RADIUS)));
    let near = proximities(&second, &parts, 0.1, &mut ContactMemories::new());
    cancel_with_memory(&memory, &mut second, &parts, &near, RADIUS, &CancelSettings::default());
    let passes = &first.palette().passes;
    assert_eq!(second.palette().passes[..passes.len()], passes[..]);
}
