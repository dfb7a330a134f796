//! A soft ball falls on a floor and squashes: the smallest program. `cargo run --release --example hello`
#![allow(clippy::print_stdout, reason = "what it prints is what it is for")]

use std::sync::Arc;

use pliant::coupling::RagdollStart;
use pliant::elastic::{ElasticRigBuilder, MassSpringSetRig, Segment, SegmentMass, SegmentShape};
use pliant::math::{Pose, Vec3};
use pliant::mesh::load_obj;
use pliant::spring::SpringCoefficients;
use pliant::world::DeformationWorld;
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Rapier's world, as ever: a floor whose top is at height 0.
    let mut physics = PhysicsWorld::new();
    let floor = physics.insert_body(RigidBodyBuilder::fixed().translation(Vec3::new(0.0, -5.0, 0.0)));
    physics.insert_collider(ColliderBuilder::cuboid(50.0, 5.0, 50.0), Some(floor));

    // The rig: a skin, one rigid segment in it, and one mass-spring set that lets it jiggle.
    let skin = load_obj(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/meshes/ball.obj"))?;
    let mut rig = ElasticRigBuilder::new(skin);
    let segment = rig.segment(Segment {
        name: "ball".into(),
        bone: [Vec3::ZERO, Vec3::ZERO],
        shape: SegmentShape::Ball { radius: 0.5 },
        mass: SegmentMass::Mass(1.0),
    });
    let spring = SpringCoefficients::new(3.0, 0.2);
    rig.mass_spring_set(MassSpringSetRig { segment, also: Vec::new(), anchor: Vec3::ZERO, radius: 0.75, spring });
    let rig = Arc::new(rig.build()?);

    // The ball, 1.5 m up.
    let mut deformation = DeformationWorld::new();
    let start = RagdollStart { pose: Pose::from_translation(Vec3::new(0.0, 1.5, 0.0)), ..RagdollStart::default() };
    let ball = deformation.insert(rig, &start, &mut physics);

    println!("   time  lowest  highest  height   width  volume");
    for frame in 1..=120 {
        physics.step();
        let report = deformation.step(&mut physics);
        let volume = report.body(ball).map_or(1.0, |body| body.volume_ratio);
        let Some(body) = deformation.get(ball) else { continue };
        let low = body.positions().iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = body.positions().iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let size = high - low;
        if frame % 5 == 0 {
            let time = frame as f32 / 60.0;
            println!("{time:5.2} s  {:6.3}  {:7.3}  {:6.3}  {:6.3}  {volume:6.4}", low.y, high.y, size.y, size.x);
        }
    }
    Ok(())
}
