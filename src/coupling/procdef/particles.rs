//! A body as rapier's soft body: particles without elements, whose collider is the boundary. Rapier moves them, lets them touch
//! and holds them by attachments; what drives them is written to their velocities.

use rapier3d::dynamics::{ImpulseJointSet, RigidBodySet, SoftBody, SoftBodyBuilder, SoftBodyHandle, SoftBodySet};
use rapier3d::geometry::{ColliderBuilder, ColliderSet, InteractionGroups};
use rapier3d::parry::shape::TriMeshFlags;
use rapier3d::pipeline::PhysicsWorld;
use rapier3d::prelude::CoefficientCombineRule;

use super::meeting::SKIN;
use crate::math::{Pose, Vec3};
use crate::procdef::{ContactKind, ProcDefBody, ProcDefModel};

/// What inserting a body needs of rapier.
pub struct ProcDefSets<'a> {
    /// The soft bodies.
    pub soft_bodies: &'a mut SoftBodySet,
    /// The rigid bodies.
    pub bodies: &'a mut RigidBodySet,
    /// The colliders.
    pub colliders: &'a mut ColliderSet,
    /// The joints: they switch off contacts between a body and its attachments.
    pub joints: &'a mut ImpulseJointSet,
}

impl<'a> From<&'a mut PhysicsWorld> for ProcDefSets<'a> {
    fn from(world: &'a mut PhysicsWorld) -> Self {
        Self {
            soft_bodies: &mut world.soft_bodies,
            bodies: &mut world.bodies,
            colliders: &mut world.colliders,
            joints: &mut world.impulse_joints,
        }
    }
}

/// How a body starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcDefStart {
    /// Pose of the mesh's frame.
    pub pose: Pose,
    /// Velocity in m/s.
    pub velocity: Vec3,
    /// What it collides with.
    pub groups: InteractionGroups,
    /// Seconds at which its own clock starts.
    pub clock: f64,
}

impl Default for ProcDefStart {
    fn default() -> Self {
        Self { pose: Pose::IDENTITY, velocity: Vec3::ZERO, groups: InteractionGroups::all(), clock: 0.0 }
    }
}

/// Why a body's particles cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticleFault {
    /// The soft body is gone.
    Removed,
    /// It is disabled; rapier does so itself with particles that are not finite.
    Disabled,
    /// It has another number of particles, as after a tear.
    Changed,
    /// A position or velocity is not finite.
    NotFinite,
}

/// Inserts the particles of a body. They never sleep: who sleeps does not move by itself.
pub fn spawn_soft_body(model: &ProcDefModel, start: &ProcDefStart, sets: &mut ProcDefSets<'_>) -> SoftBodyHandle {
    let positions = model.rig.mesh().positions.iter().map(|&x| start.pose * x).collect();
    let friction = model.ground.map_or(model.friction, |g| g.least());
    let own_contacts = model.contacts == ContactKind::Vertices;
    let groups = if own_contacts { InteractionGroups::none() } else { start.groups };
    let mut collider = ColliderBuilder::ball(1.0).friction(friction).collision_groups(groups);
    if model.ground.is_some() {
        // The least friction of all directions is rapier's, the rest is added where the ground is fixed.
        collider = collider.friction_combine_rule(CoefficientCombineRule::Min);
    }
    let builder = SoftBodyBuilder::new(positions)
        .masses(model.rig.masses().to_vec())
        .surface(model.boundary.clone())
        .surface_collider(collider)
        .self_contacts(model.self_contact && !own_contacts)
        .particle_radius(SKIN * model.boundary_edge())
        .can_sleep(false);
    let handle = sets.soft_bodies.insert(builder, sets.bodies, sets.colliders);
    if own_contacts && let Some(soft) = sets.soft_bodies.get(handle) {
        // Which side of a triangle is out is asked for by contacts alone; rapier need not find the normals in each step.
        for mesh in soft.meshes() {
            let shape = sets.colliders.get_mut(mesh.collider()).map(|collider| collider.shape_mut());
            if let Some(surface) = shape.and_then(|shape| shape.as_trimesh_mut()) {
                let flags = surface.flags() & !TriMeshFlags::ORIENTED;
                // Without the flag the shape asks for less than before: there is nothing that could fail.
                let _ = surface.set_flags(flags);
            }
        }
    }
    if let Some(soft) = sets.soft_bodies.get_mut(handle) {
        (0..soft.num_particles()).for_each(|i| soft.set_particle_velocity(i, start.velocity));
    }
    handle
}

/// Copies the state of the particles into the body.
///
/// # Errors
/// [`ParticleFault`]; the body is then as it was.
pub fn read_particles(soft: Option<&SoftBody>, body: &mut ProcDefBody) -> Result<(), ParticleFault> {
    let soft = soft.ok_or(ParticleFault::Removed)?;
    let particles = soft.particles();
    if !soft.is_enabled() {
        return Err(ParticleFault::Disabled);
    }
    if particles.len() != body.positions().len() {
        return Err(ParticleFault::Changed);
    }
    if particles.iter().any(|p| !(p.position().is_finite() && p.velocity().is_finite())) {
        return Err(ParticleFault::NotFinite);
    }
    body.positions_mut().iter_mut().zip(particles).for_each(|(x, p)| *x = p.position());
    body.velocities_mut().iter_mut().zip(particles).for_each(|(v, p)| *v = p.velocity());
    Ok(())
}

/// Gives the particles the body's velocities, for rapier's next step. Velocities that are not finite are left out.
pub fn write_velocities(body: &ProcDefBody, soft: &mut SoftBody) {
    for (i, &v) in body.velocities().iter().enumerate().take(soft.num_particles()) {
        if v.is_finite() {
            soft.set_particle_velocity(i, v);
        }
    }
}
