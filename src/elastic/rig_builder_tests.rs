//! Tests of the builder: what only plain code can get wrong.

use super::*;
use crate::elastic::{MAX_SEGMENTS, RigPlace, SegmentMass};
use crate::mesh::{MeshError, measure::tests::sphere};

fn ball(name: &str) -> Segment {
    let shape = SegmentShape::Ball { radius: 0.5 };
    Segment { name: name.into(), bone: [Vec3::ZERO; 2], shape, mass: SegmentMass::Mass(1.0) }
}

fn builder() -> ElasticRigBuilder {
    let mut rig = ElasticRigBuilder::new(sphere(1.0, 16, 8));
    rig.segment(ball("a"));
    rig
}

fn joint(parent: usize, child: usize) -> Joint {
    Joint { parent, child, anchor: Vec3::ZERO, limit: None, spring: SpringCoefficients::new(1.0, 1.0) }
}

fn message(rig: ElasticRigBuilder) -> String {
    rig.build().map(drop).unwrap_err().to_string()
}

#[test]
fn one_ball_in_a_sphere_is_a_rig_with_rigid_weights() {
    let rig = builder().build().unwrap();
    assert!(rig.weights.iter().all(|w| w.weights[0] == 1.0));
    assert_eq!(rig.local_threshold, 0.5 * rig.mesh.size());
}

#[test]
fn indices_that_name_nothing_are_refused_with_their_place() {
    let mut rig = builder();
    rig.joint(joint(0, 3));
    let fault = rig.build().map(drop).unwrap_err();
    assert_eq!(fault.place, RigPlace { table: RigTable::Joint(0), key: "child" });
    assert_eq!(fault.to_string(), "joint 0: `child` is segment 3, but there are 1");
    let mut rig = builder();
    let spring = SpringCoefficients::new(1.0, 0.1);
    rig.mass_spring_set(MassSpringSetRig { segment: 9, also: Vec::new(), anchor: Vec3::ZERO, radius: 1.0, spring });
    assert!(message(rig).contains("mass-spring set 0: `segment` is segment 9"));
}

#[test]
fn weights_that_are_given_are_checked() {
    let good = builder().build().unwrap().weights;
    let given = |change: &dyn Fn(&mut Vec<SkinWeights>)| {
        let mut rig = builder();
        let mut weights = good.clone();
        change(&mut weights);
        rig.weights(weights);
        rig.build().map(drop)
    };
    assert!(given(&|_| {}).is_ok());
    let error = |change: &dyn Fn(&mut Vec<SkinWeights>)| given(change).unwrap_err().to_string();
    assert!(error(&|w| w.truncate(5)).contains("entries for"));
    assert!(error(&|w| w[3].weights[0] = 0.5).contains("vertex 3 are wrong: they do not sum to 1"));
    assert!(error(&|w| w[3].weights[0] = f32::NAN).contains("vertex 3"));
    assert!(error(&|w| w[3].segments[0] = 1).contains("a segment that does not exist"));
}

#[test]
fn too_many_segments_and_a_mesh_out_of_order_are_refused() {
    let mut rig = builder();
    for k in 0..MAX_SEGMENTS {
        rig.segment(ball(&k.to_string()));
    }
    assert!(message(rig).contains("65536 segments are more than the 65535"));
    let mut rig = builder();
    rig.mesh.normals.pop();
    assert!(message(rig).contains("`normals` has"));
    let mut rig = builder();
    rig.mesh.welded[7] = 5000;
    assert!(message(rig).contains("vertex 7 is welded to vertex 5000"));
    let mut rig = builder();
    rig.mesh.positions[4] = Vec3::NAN;
    assert!(matches!(rig.build().unwrap_err().kind, RigFaultKind::Mesh(MeshError::NotFinite { vertex: 4, .. })));
    let mut rig = builder();
    rig.mesh.triangles[2][1] = 5000;
    assert!(message(rig).contains("triangle 2 uses vertex 5000"));
}
