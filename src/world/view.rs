//! Rapier's sets, borrowed for one call.

use rapier3d::dynamics::{ImpulseJointSet, RigidBodySet};
use rapier3d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase};
use rapier3d::pipeline::PhysicsWorld;

use crate::coupling::StepSize;
use crate::math::Vec3;

/// What [`super::DeformationWorld::step_with`] needs of rapier.
pub struct RapierView<'a> {
    /// The rigid bodies; velocities of elastic bodies and of what they push are changed.
    pub bodies: &'a mut RigidBodySet,
    /// The colliders.
    pub colliders: &'a ColliderSet,
    /// The broad phase, as rapier's last step left it.
    pub broad_phase: &'a BroadPhaseBvh,
    /// The narrow phase: its query dispatcher is used.
    pub narrow_phase: &'a NarrowPhase,
    /// Gravity in m/s².
    pub gravity: Vec3,
    /// Length of a step in seconds.
    pub dt: f32,
    /// Rapier's substeps (`num_solver_iterations` of its integration parameters).
    pub substeps: usize,
}

impl RapierView<'_> {
    /// The step that the repelling impulses are made for.
    pub fn step_size(&self) -> StepSize {
        StepSize { dt: self.dt, gravity: self.gravity, substeps: self.substeps }
    }
}

impl<'a> From<&'a mut PhysicsWorld> for RapierView<'a> {
    fn from(world: &'a mut PhysicsWorld) -> Self {
        Self {
            bodies: &mut world.bodies,
            colliders: &world.colliders,
            broad_phase: &world.broad_phase,
            narrow_phase: &world.narrow_phase,
            gravity: world.gravity,
            dt: world.integration_parameters.dt,
            substeps: world.integration_parameters.num_solver_iterations,
        }
    }
}

/// What building and removing a ragdoll needs of rapier.
pub struct RapierSets<'a> {
    /// The rigid bodies.
    pub bodies: &'a mut RigidBodySet,
    /// The colliders.
    pub colliders: &'a mut ColliderSet,
    /// The joints.
    pub joints: &'a mut ImpulseJointSet,
}

impl<'a> From<&'a mut PhysicsWorld> for RapierSets<'a> {
    fn from(world: &'a mut PhysicsWorld) -> Self {
        Self { bodies: &mut world.bodies, colliders: &mut world.colliders, joints: &mut world.impulse_joints }
    }
}
