//! Ragdolls: the rigid bodies and elastic joints of a rig in the user's own rapier sets.

use rapier3d::dynamics::{
    CoefficientCombineRule, GenericJoint, GenericJointBuilder, ImpulseJointHandle, ImpulseJointSet, JointAxesMask,
    JointAxis, MassProperties, MotorModel, RigidBodyBuilder, RigidBodyHandle, RigidBodySet,
};
use rapier3d::geometry::{ColliderBuilder, ColliderSet, InteractionGroups, SharedShape};

use crate::elastic::{ElasticRig, Joint, Segment, SegmentMass, SegmentShape};
use crate::math::{Pose, Vec3};

/// The solid core of a segment is this fraction of its shape: rapier's normal contacts and continuous collision
/// detection keep it out of obstacles, so that nothing tunnels; the flesh around it is elastic.
pub const CORE_FRACTION: f32 = 0.5;

/// Where and how a ragdoll starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RagdollStart {
    /// World from rest of the whole body.
    pub pose: Pose,
    /// Velocity of every point without the rotation, in m/s.
    pub linear_velocity: Vec3,
    /// Angular velocity about the body's origin, in rad/s.
    pub angular_velocity: Vec3,
    /// Collision groups of the solid cores, and of the skin.
    pub groups: InteractionGroups,
}

impl Default for RagdollStart {
    fn default() -> Self {
        Self {
            pose: Pose::IDENTITY,
            linear_velocity: Vec3::ZERO,
            angular_velocity: Vec3::ZERO,
            groups: InteractionGroups::all(),
        }
    }
}

/// Handles of what a rig became in rapier: one body a segment, one joint a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ragdoll {
    /// Rigid bodies, in the order of the segments.
    pub bodies: Vec<RigidBodyHandle>,
    /// Joints, in the order of the rig.
    pub joints: Vec<ImpulseJointHandle>,
}

impl Ragdoll {
    /// Builds the bodies, core colliders and joints of `rig`.
    pub fn spawn(
        rig: &ElasticRig,
        start: &RagdollStart,
        bodies: &mut RigidBodySet,
        colliders: &mut ColliderSet,
        joints: &mut ImpulseJointSet,
    ) -> Self {
        let mut ragdoll = Self::default();
        for (segment, rest) in rig.segments.iter().zip(&rig.rest_poses) {
            let pose = start.pose * *rest;
            let arm = pose.translation - start.pose.translation;
            let body = RigidBodyBuilder::dynamic()
                .pose(pose)
                .linvel(start.linear_velocity + start.angular_velocity.cross(arm))
                .angvel(start.angular_velocity)
                .additional_mass_properties(mass_properties(segment))
                .ccd_enabled(true);
            let handle = bodies.insert(body);
            let core = ColliderBuilder::new(core_shape(segment))
                .density(0.0)
                .friction(rig.contact.friction)
                .restitution(rig.contact.restitution())
                .restitution_combine_rule(CoefficientCombineRule::Max)
                .collision_groups(start.groups);
            colliders.insert_with_parent(core, handle, bodies);
            ragdoll.bodies.push(handle);
        }
        for joint in &rig.joints {
            let (parent, child) = (ragdoll.bodies[joint.parent], ragdoll.bodies[joint.child]);
            ragdoll.joints.push(joints.insert(parent, child, elastic_joint(rig, joint), true));
        }
        ragdoll
    }
}

/// The full rigid shape of a segment in its own frame (z along the bone).
pub fn segment_shape(segment: &Segment) -> SharedShape {
    sized_shape(segment, 1.0)
}

/// The solid core: the same axis, half as thick.
pub fn core_shape(segment: &Segment) -> SharedShape {
    sized_shape(segment, CORE_FRACTION)
}

fn sized_shape(segment: &Segment, fraction: f32) -> SharedShape {
    let length = segment.bone[0].distance(segment.bone[1]);
    match segment.shape {
        SegmentShape::Ball { radius } => SharedShape::ball(radius * fraction),
        SegmentShape::Capsule { radius } => SharedShape::capsule_z((0.5 * length - radius).max(0.0), radius * fraction),
        SegmentShape::Cuboid { half_extents: h } => SharedShape::cuboid(h.x * fraction, h.y * fraction, h.z * fraction),
    }
}

fn mass_properties(segment: &Segment) -> MassProperties {
    let shape = segment_shape(segment);
    let unit = shape.mass_properties(1.0);
    match segment.mass {
        SegmentMass::Density(density) => shape.mass_properties(density),
        SegmentMass::Mass(mass) => shape.mass_properties(mass / unit.mass()),
    }
}

/// A ball joint whose motors pull the segments back to the rest pose, as springs of the given frequency and damping.
pub fn elastic_joint(rig: &ElasticRig, joint: &Joint) -> GenericJoint {
    let anchor = Pose::from_translation(joint.anchor);
    let frame = |segment: usize| rig.rest_poses[segment].inverse() * anchor;
    let omega = joint.spring.angular_frequency();
    let (stiffness, damping) = (omega * omega, 2.0 * joint.spring.damping_ratio * omega);
    let mut builder = GenericJointBuilder::new(JointAxesMask::LOCKED_SPHERICAL_AXES)
        .local_frame1(frame(joint.parent))
        .local_frame2(frame(joint.child))
        .contacts_enabled(false);
    for axis in [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ] {
        builder =
            builder.motor_model(axis, MotorModel::AccelerationBased).motor_position(axis, 0.0, stiffness, damping);
        if let Some(limit) = joint.limit {
            builder = builder.limits(axis, [-limit, limit]);
        }
    }
    builder.build()
}
