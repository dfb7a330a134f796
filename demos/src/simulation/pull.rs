//! Pulling a rigid body at one of its points by a critically damped spring, implicit in time.

use std::f32::consts::TAU;

use pliant::math::{Quat, Vec3};
use pliant::world::DeformationWorld;
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::pipeline::PhysicsWorld;

/// A pull that lasts until its owner gives up.
#[derive(Clone, Copy, Debug)]
pub struct Pull {
    /// The rigid body.
    pub body: RigidBodyHandle,
    /// Where it is held, in its frame.
    pub local: Vec3,
    /// Where that point is wanted.
    pub goal: Vec3,
    /// Natural frequency in hertz.
    pub frequency: f32,
    /// The rotation that it is held in, if it is.
    pub rotation: Option<Quat>,
}

impl Pull {
    /// The held point where it is now.
    pub fn point(&self, physics: &PhysicsWorld) -> Option<Vec3> {
        physics.bodies.get(self.body).map(|body| body.position().transform_point(self.local))
    }

    /// Gives the body the change of velocity of one step, strong enough for the whole ragdoll that it belongs to.
    pub fn apply(&self, physics: &mut PhysicsWorld, deformation: &DeformationWorld) {
        let mass = deformation.owner(self.body).and_then(|owner| deformation.ragdoll(owner)).map(|ragdoll| {
            ragdoll.bodies.iter().filter_map(|&body| physics.bodies.get(body)).map(|body| body.mass()).sum::<f32>()
        });
        let h = physics.integration_parameters.dt;
        let omega = TAU * self.frequency;
        let Some(body) = physics.bodies.get_mut(self.body) else { return };
        let point = body.position().transform_point(self.local);
        let mass = mass.unwrap_or_else(|| body.mass());
        let softened = 1.0 + h * omega * (2.0 + h * omega);
        let accelerated =
            |away: Vec3, velocity: Vec3| (away - velocity * h) * (omega * omega) - velocity * (2.0 * omega);
        if let Some(rotation) = self.rotation {
            let mut left = rotation * body.position().rotation.inverse();
            if left.w < 0.0 {
                left = -left;
            }
            let turning = body.angvel();
            body.set_angvel(turning + accelerated(left.to_scaled_axis(), turning) * (h / softened), true);
        }
        let velocity = body.velocity_at_point(point);
        let impulse = accelerated(self.goal - point, velocity) * (mass * h / softened);
        match self.rotation {
            // Held against turning, it is not turned by the pull either.
            Some(_) => body.apply_impulse(impulse, true),
            None => body.apply_impulse_at_point(impulse, point, true),
        }
    }
}
