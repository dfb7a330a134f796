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

#[test]
fn four() {
    use pliant::coupling::Proximity;
    let rig = ball_rig(0.5, 1.2, SpringCoefficients::new(3.0, 0.2));
    for swing in [
        Vec3::ZERO,
        Vec3::new(0.0, 0.1, 0.0),
        Vec3::new(0.0, 0.2, 0.05),
        Vec3::new(0.05, -0.2, 0.1),
        Vec3::new(0.0, 0.3, 0.1),
    ] {
        let mut body = ElasticBody::new(rig.clone());
        body.place(&[Pose::from_translation(swing)]);
        body.move_springs(&[Pose::IDENTITY], 1e-5);
        body.build_palette();
        body.deform_springs();
        let mut parts = vec![plate(Vec3::Y * -1.33, Vec3::new(5.0, 1.0, 5.0), 0)];
        let mut near = proximities(&body, &parts, 0.1, &mut ContactMemories::new());
        for (i, (n, d, r, h)) in [
            (Vec3::new(-0.09, -0.97, 0.23), 0.366, 0.5, 0.11),
            (Vec3::new(-1.0, -0.04, 0.0), 0.568, 0.516, 0.095),
            (Vec3::new(-0.09, -0.08, -0.99), 0.472, 0.521, 0.129),
        ]
        .into_iter()
        .enumerate()
        {
            let n = n.normalize();
            let local = convex_parts(&SharedShape::cylinder(h, r)).unwrap();
            let mut part = ObstaclePart::new(
                PartId { collider: (9, i as u32), part: 0 },
                ColliderHandle::invalid(),
                &local[0],
                Pose::from_parts(-n * (d + h), glam::Quat::from_rotation_arc(Vec3::Y, n)),
            );
            part.face = Some(pliant::coupling::OuterFace {
                normal: n,
                offset: -d,
                area: 0.8,
                middle: -n * d,
                thickness: 2.0 * h,
                two_sided: false,
                edges: Vec::new(),
            });
            near.push(Proximity { segment: 0, part: parts.len(), normal: n, axis_point: Vec3::ZERO });
            parts.push(part);
        }
        let clock = std::time::Instant::now();
        let report = cancel(&mut body, &parts, &near, 0.5, &CancelSettings::default());
        let far = body.positions().iter().map(|x| x.length()).fold(0.0, f32::max);
        println!(
            "depth swing {swing}: passes {} left {:.4} far {far:.2} ms {:.1}",
            report.passes,
            report.left / 0.5,
            clock.elapsed().as_secs_f32() * 1e3
        );
    }
}
