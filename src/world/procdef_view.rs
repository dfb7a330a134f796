//! Rapier's sets as the bodies that move by themselves need them, borrowed for one step.

use rapier3d::dynamics::{RigidBodySet, SoftBodySet};
use rapier3d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase};
use rapier3d::pipeline::PhysicsWorld;

use crate::math::Vec3;

/// What [`super::ProcDefWorld::step_with`] needs of rapier.
pub struct ProcDefView<'a> {
    /// The soft bodies; the velocities of their particles are changed.
    pub soft_bodies: &'a mut SoftBodySet,
    /// The rigid bodies; what vertices push is changed.
    pub bodies: &'a mut RigidBodySet,
    /// The colliders.
    pub colliders: &'a ColliderSet,
    /// The broad phase, as rapier's last step left it.
    pub broad_phase: &'a BroadPhaseBvh,
    /// The narrow phase, as rapier's last step left it.
    pub narrow_phase: &'a NarrowPhase,
    /// Gravity in m/s².
    pub gravity: Vec3,
    /// Length of a step in seconds.
    pub dt: f32,
    /// Rapier's substeps (`num_solver_iterations` of its integration parameters).
    pub substeps: usize,
}

impl<'a> From<&'a mut PhysicsWorld> for ProcDefView<'a> {
    fn from(world: &'a mut PhysicsWorld) -> Self {
        Self {
            soft_bodies: &mut world.soft_bodies,
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
