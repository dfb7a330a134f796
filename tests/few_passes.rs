//! Few passes do what many do.

mod common;

use pliant::coupling::{
    CancelMemory, CancelReport, CancelSettings, ContactMemories, ObstaclePart, PartId, cancel_with_memory,
    convex_parts, measure, proximities,
};
use pliant::elastic::{CollisionField, ElasticBody};
use pliant::math::{Pose, Vec3};
use pliant::spring::SpringCoefficients;
use rapier3d::geometry::{ColliderHandle, SharedShape};

const RADIUS: f32 = 0.5;

fn ball(at: Vec3) -> ElasticBody {
    let mut body = ElasticBody::new(common::ball_rig(RADIUS, 1.2, SpringCoefficients::new(3.0, 0.2)));
    body.place(&[Pose::from_translation(at)]);
    body.build_palette();
    body.deform_springs();
    body
}

/// A wide box whose top is at this height.
fn floor(top: f32, id: PartId) -> Vec<ObstaclePart> {
    let local = &convex_parts(&SharedShape::cuboid(5.0, 1.0, 5.0)).unwrap()[0];
    let pose = Pose::from_translation(Vec3::Y * (top - 1.0));
    vec![ObstaclePart::new(id, ColliderHandle::from_raw_parts(0, 0), local, pose)]
}

const FLOOR: PartId = PartId { collider: (0, 0), part: 0 };

fn cancelled(body: &mut ElasticBody, parts: &[ObstaclePart], memory: &CancelMemory) -> CancelReport {
    let near = proximities(body, parts, 0.1, &mut ContactMemories::new());
    cancel_with_memory(memory, body, parts, &near, RADIUS, &CancelSettings::default())
}

fn largest_change(a: &[Vec3], b: &[Vec3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

/// What a ball remembers that was pressed onto the floor at -0.4 in eight passes, a little at a time; and its skin.
fn slowly_pressed() -> (CancelMemory, ElasticBody) {
    let parts = floor(-0.4, FLOOR);
    let mut quick = ball(Vec3::ZERO);
    let before = quick.positions().to_vec();
    let report = cancelled(&mut quick, &parts, &CancelMemory::default());
    let count = 8;
    let mut bit = quick.palette().passes[0].clone();
    for entry in &mut bit.fields {
        let CollisionField::Hugging(field) = &mut entry.field else { panic!("fields hug") };
        field.d /= count as f32;
    }
    let mut slow = ball(Vec3::ZERO);
    (0..count).for_each(|_| slow.deform_collision(bit.clone()));
    let mut memory = CancelMemory::default();
    memory.remember(before, &slow, &parts, &report, &CancelSettings::default());
    (memory, slow)
}

/// Bodies of a heap at rest took five to seven passes in every step, a tenth of all rows: those with which they had come to rest.
#[test]
fn a_body_at_rest_with_many_passes_goes_on_with_few_and_keeps_its_shape() {
    let (memory, slow) = slowly_pressed();
    let (settings, parts) = (CancelSettings::default(), floor(-0.4, FLOOR));
    let mut second = ball(Vec3::ZERO);
    let report = cancelled(&mut second, &parts, &memory);
    assert!(report.passes <= 4, "{} passes", report.passes);
    assert_eq!(report.passes as usize, second.palette().passes.len());
    let figures = measure(&second, &parts, RADIUS, &report);
    assert!(figures.max_depth_after < 1e-3 && figures.max_gap < 5e-3, "{figures:?}");
    let change = largest_change(second.positions(), slow.positions());
    let floor = (settings.depth_tolerance + settings.gap_tolerance) * RADIUS;
    assert!(change < floor, "the skin moves by {change}");
}

/// The plane between two skins follows both of them, and its own motion, or none where it was not there in the step before, was taken for
/// that of the other skin: what slid by quickly was held back as a jump.
#[test]
fn a_skin_knows_how_the_other_skin_moves_by() {
    let settings = CancelSettings::default();
    let press = |memory: &CancelMemory, at: Vec3, moved: Vec3, settings: &CancelSettings| {
        let mut parts = floor(-0.3, PartId::interface(0, (1, 0)));
        parts[0].moved = Some(Pose::from_translation(moved));
        let mut body = ball(at);
        let near = proximities(&body, &parts, 0.1, &mut ContactMemories::new());
        let report = cancel_with_memory(memory, &mut body, &parts, &near, RADIUS, settings);
        (body, parts, report)
    };
    // More than a tremor.
    let step = Vec3::X * (1.0e-3 * RADIUS);
    let (fresh, ..) = press(&CancelMemory::default(), step, Vec3::ZERO, &settings);
    // In the step before, the dent was made by much softer fields.
    let softer = CancelSettings { softness: Some(4.0), ..settings };
    let (soft, parts, report) = press(&CancelMemory::default(), Vec3::ZERO, Vec3::ZERO, &softer);
    let mut memory = CancelMemory::default();
    memory.remember(ball(Vec3::ZERO).positions().to_vec(), &soft, &parts, &report, &settings);
    let (quick, ..) = press(&memory, step, Vec3::X, &settings);
    assert!(quick.positions() == fresh.positions(), "nothing holds it back");
    let (slow, ..) = press(&memory, step, Vec3::ZERO, &settings);
    let (near, far) = [&soft, &fresh].map(|other| largest_change(slow.positions(), other.positions())).into();
    assert!(near < 0.5 * far, "it stays near its old shape: {near} from it, {far} from the new one");
}

/// Fields of all parts nearby were carried along, whether the skin was still in them or not: a ball that left its floor kept its dent in free air.
#[test]
fn many_passes_are_gone_with_what_they_were_for() {
    let (memory, _) = slowly_pressed();
    // The floor is still near.
    let mut second = ball(Vec3::Y * 0.12);
    let undented = second.positions().to_vec();
    let report = cancelled(&mut second, &floor(-0.4, FLOOR), &memory);
    assert_eq!(report.passes, 0);
    assert!(second.positions() == undented, "no dent is left");
}
