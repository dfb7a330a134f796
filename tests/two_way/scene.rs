//! A rapier world with soft balls, crates and floors.

use std::sync::Arc;

use pliant::coupling::RagdollStart;
use pliant::elastic::{
    ContactSettings, ElasticRig, ElasticRigBuilder, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
};
use pliant::math::{Pose, Vec3};
use pliant::mesh::TriangleMesh;
use pliant::spring::SpringCoefficients;
use pliant::world::{DeformationWorld, ElasticBodyHandle};
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;

use crate::common::icosphere::icosphere;

/// Radius of the soft balls.
pub const RADIUS: f32 = 0.5;

/// A soft ball of 1 kg with the given contacts, of 642 vertices.
pub fn ball_rig(contact: ContactSettings) -> Arc<ElasticRig> {
    let (points, triangles) = icosphere(3);
    let mesh = TriangleMesh::from_triangles(points.into_iter().map(|p| p * RADIUS).collect(), triangles);
    let mut rig = ElasticRigBuilder::new(mesh.expect("a sphere"));
    let segment = rig.segment(Segment {
        name: "ball".into(),
        bone: [Vec3::ZERO, Vec3::ZERO],
        shape: SegmentShape::Ball { radius: RADIUS },
        mass: SegmentMass::Mass(1.0),
    });
    rig.mass_spring_set(MassSpringSetRig {
        segment,
        also: Vec::new(),
        anchor: Vec3::ZERO,
        radius: 1.5 * RADIUS,
        spring: SpringCoefficients::new(3.0, 0.2),
    });
    rig.contact(contact);
    Arc::new(rig.build().expect("a sound rig"))
}

/// Both worlds.
pub struct Scene {
    pub physics: PhysicsWorld,
    pub deformation: DeformationWorld,
}

impl Scene {
    pub fn new() -> Self {
        let mut physics = PhysicsWorld::new();
        physics.integration_parameters.dt = 1.0 / 60.0;
        let mut deformation = DeformationWorld::new();
        deformation.settings.measure = false;
        Self { physics, deformation }
    }

    pub fn weightless() -> Self {
        let mut scene = Self::new();
        scene.physics.gravity = Vec3::ZERO;
        scene
    }

    /// A wide fixed floor whose top is at y = 0.
    pub fn floor(&mut self) {
        let body = self.physics.insert_body(RigidBodyBuilder::fixed().translation(Vec3::new(0.0, -5.0, 0.0)));
        self.physics.insert_collider(ColliderBuilder::cuboid(200.0, 5.0, 200.0), Some(body));
    }

    pub fn ball(&mut self, contact: ContactSettings, at: Vec3, velocity: Vec3) -> ElasticBodyHandle {
        self.body(&ball_rig(contact), at, velocity)
    }

    pub fn body(&mut self, rig: &Arc<ElasticRig>, at: Vec3, velocity: Vec3) -> ElasticBodyHandle {
        let start =
            RagdollStart { pose: Pose::from_translation(at), linear_velocity: velocity, ..RagdollStart::default() };
        self.deformation.insert(rig.clone(), &start, &mut self.physics)
    }

    /// A dynamic cube.
    pub fn crate_at(&mut self, half: f32, mass: f32, at: Vec3) -> RigidBodyHandle {
        let body = self.physics.insert_body(RigidBodyBuilder::dynamic().translation(at).can_sleep(true));
        self.physics.insert_collider(ColliderBuilder::cuboid(half, half, half).mass(mass), Some(body));
        body
    }

    pub fn step(&mut self) {
        self.physics.step();
        self.deformation.step(&mut self.physics);
    }

    pub fn rigid(&self, ball: ElasticBodyHandle) -> RigidBodyHandle {
        self.deformation.ragdoll(ball).expect("a ragdoll").bodies[0]
    }

    pub fn position(&self, rigid: RigidBodyHandle) -> Vec3 {
        self.physics.bodies[rigid].translation()
    }

    pub fn velocity(&self, rigid: RigidBodyHandle) -> Vec3 {
        self.physics.bodies[rigid].linvel()
    }
}

/// A soft cushion: a box with round edges, one segment.
pub fn cushion_rig(half: Vec3, mass: f32, contact: ContactSettings) -> Arc<ElasticRig> {
    let (points, triangles) = icosphere(4);
    let boxy = |p: Vec3| {
        let norm = (p.x.powi(12) + p.y.powi(12) + p.z.powi(12)).powf(1.0 / 12.0);
        p / norm * half
    };
    let mesh = TriangleMesh::from_triangles(points.into_iter().map(boxy).collect(), triangles);
    let mut rig = ElasticRigBuilder::new(mesh.expect("a box"));
    rig.segment(Segment {
        name: "cushion".into(),
        bone: [Vec3::ZERO, Vec3::ZERO],
        shape: SegmentShape::Cuboid { half_extents: half },
        mass: SegmentMass::Mass(mass),
    });
    rig.contact(contact);
    Arc::new(rig.build().expect("a sound rig"))
}
