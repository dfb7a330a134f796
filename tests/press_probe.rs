//! probe
mod common;
use common::ball_rig;
use pliant::coupling::{CancelSettings, ContactMemories, ObstaclePart, PartId, cancel, convex_parts, proximities};
use pliant::elastic::ElasticBody;
use pliant::math::{Pose, Vec3};
use pliant::spring::SpringCoefficients;
use rapier3d::geometry::{ColliderHandle, SharedShape};

fn plate(at: Vec3, half: Vec3, index: u32) -> ObstaclePart {
    let local = convex_parts(&SharedShape::cuboid(half.x, half.y, half.z)).unwrap();
    ObstaclePart::new(
        PartId { collider: (index, 0), part: 0 },
        ColliderHandle::from_raw_parts(index, 0),
        &local[0],
        Pose::from_translation(at),
    )
}

#[test]
fn press() {
    let rig = ball_rig(0.5, 1.2, SpringCoefficients::new(3.0, 0.2));
    for depth in [0.05, 0.1, 0.15, 0.2, 0.25_f32] {
        for sides in [2, 4, 3] {
            let mut body = ElasticBody::new(rig.clone());
            let d = 0.5 - depth;
            let mut parts = vec![
                plate(Vec3::Y * (d + 1.0), Vec3::new(2.0, 1.0, 2.0), 0),
                plate(-Vec3::Y * (d + 1.0), Vec3::new(2.0, 1.0, 2.0), 1),
            ];
            if sides > 2 {
                parts.push(plate(Vec3::X * (d + 1.0), Vec3::new(1.0, 2.0, 2.0), 2));
            }
            if sides > 3 {
                parts.push(plate(-Vec3::X * (d + 1.0), Vec3::new(1.0, 2.0, 2.0), 3));
            }
            let near = proximities(&body, &parts, 0.1, &mut ContactMemories::new());
            let clock = std::time::Instant::now();
            let report = cancel(&mut body, &parts, &near, 0.5, &CancelSettings::default());
            let worst = body
                .positions()
                .iter()
                .map(|x| parts.iter().map(|p| -p.placed.signed_distance(*x).0).fold(0.0, f32::max))
                .fold(0.0, f32::max);
            let far = body.positions().iter().map(|x| x.length()).fold(0.0, f32::max);
            println!(
                "depth {:.2} of size, {sides} sides: passes {} left {:.4} worst {:.4} far {far:.2} ms {:.1}",
                depth / 0.5,
                report.passes,
                report.left / 0.5,
                worst / 0.5,
                clock.elapsed().as_secs_f32() * 1e3
            );
        }
    }
}
