//! What the integration tests share: a soft ball made in code.
#![allow(dead_code)] // each test file uses a part of it

pub mod icosphere;

use std::sync::Arc;

use icosphere::icosphere;
use pliant::elastic::{
    ContactSettings, ElasticRig, ElasticRigBuilder, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
};
use pliant::math::Vec3;
use pliant::mesh::TriangleMesh;
use pliant::spring::SpringCoefficients;

/// A soft ball of one segment and one mass-spring set, centred at the origin.
pub fn ball_rig(radius: f32, softness: f32, contact: SpringCoefficients) -> Arc<ElasticRig> {
    let (points, triangles) = icosphere(4);
    let mesh = TriangleMesh::from_triangles(points.into_iter().map(|p| p * radius).collect(), triangles);
    let mut rig = ElasticRigBuilder::new(mesh.expect("a sphere"));
    let segment = rig.segment(Segment {
        name: "ball".into(),
        bone: [Vec3::ZERO, Vec3::ZERO],
        shape: SegmentShape::Ball { radius },
        mass: SegmentMass::Mass(1.0),
    });
    rig.mass_spring_set(MassSpringSetRig {
        segment,
        also: Vec::new(),
        anchor: Vec3::ZERO,
        radius: 1.5 * radius,
        spring: SpringCoefficients::new(3.0, 0.2),
    });
    rig.softness(softness).contact(ContactSettings { spring: contact, friction: 0.5 });
    Arc::new(rig.build().expect("a sound rig"))
}
