//! Private copies of rapier's velocities: what an implicit solve works on before anything is written back.

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::math::{Mat3, Vec3};

/// Velocity and inverse inertia of one rigid body, in world space.
#[derive(Clone, Copy, Debug)]
pub struct BodyVelocity {
    handle: RigidBodyHandle,
    start: (Vec3, Vec3),
    /// Velocity of the centre of mass.
    pub linear: Vec3,
    /// Angular velocity.
    pub angular: Vec3,
    /// Centre of mass.
    pub centre: Vec3,
    /// Inverse mass; zero for what cannot be pushed.
    pub inverse_mass: Vec3,
    /// Inverse inertia; zero for what cannot be turned.
    pub inverse_inertia: Mat3,
    gravity_scale: f32,
}

impl BodyVelocity {
    fn read(handle: RigidBodyHandle, bodies: &RigidBodySet) -> Option<Self> {
        let body = bodies.get(handle)?;
        let properties = body.mass_properties();
        let movable = body.is_dynamic() && body.is_enabled();
        let inertia = properties.effective_world_inv_inertia;
        let column = |axis: Vec3| inertia * axis;
        Some(Self {
            handle,
            start: (body.linvel(), body.angvel()),
            linear: body.linvel(),
            angular: body.angvel(),
            centre: body.center_of_mass(),
            inverse_mass: if movable { properties.effective_inv_mass } else { Vec3::ZERO },
            inverse_inertia: if movable {
                Mat3::from_cols(column(Vec3::X), column(Vec3::Y), column(Vec3::Z))
            } else {
                Mat3::ZERO
            },
            gravity_scale: if movable { body.gravity_scale() } else { 0.0 },
        })
    }

    /// Velocity of the material point at `x`.
    #[inline]
    pub fn at(&self, x: Vec3) -> Vec3 {
        self.linear + self.angular.cross(x - self.centre)
    }

    /// Applies an impulse at `x`.
    #[inline]
    pub fn push(&mut self, x: Vec3, impulse: Vec3) {
        self.linear += self.inverse_mass * impulse;
        self.angular += self.inverse_inertia * (x - self.centre).cross(impulse);
    }

    /// How much a unit impulse along `n` at `x` changes the velocity along `n` there.
    #[inline]
    pub fn response(&self, x: Vec3, n: Vec3) -> f32 {
        let turn = (x - self.centre).cross(n);
        n.dot(self.inverse_mass * n) + turn.dot(self.inverse_inertia * turn)
    }
}

/// All bodies that take part, each once.
#[derive(Default)]
pub struct Velocities {
    entries: Vec<BodyVelocity>,
}

impl Velocities {
    /// The index of a body, read from rapier the first time it is asked for.
    pub fn index(&mut self, handle: RigidBodyHandle, bodies: &RigidBodySet) -> Option<usize> {
        if let Some(index) = self.entries.iter().position(|entry| entry.handle == handle) {
            return Some(index);
        }
        self.entries.push(BodyVelocity::read(handle, bodies)?);
        Some(self.entries.len() - 1)
    }

    /// Adds gravity over `h` seconds.
    pub fn accelerate(&mut self, gravity: Vec3, h: f32) {
        for entry in &mut self.entries {
            entry.linear += gravity * (entry.gravity_scale * h);
        }
    }

    /// A body by index.
    pub fn get(&self, index: usize) -> &BodyVelocity {
        &self.entries[index]
    }

    /// A body by index, to push.
    pub fn get_mut(&mut self, index: usize) -> &mut BodyVelocity {
        &mut self.entries[index]
    }

    /// Writes the changes to rapier, less the gravity that rapier adds itself in its next step of `dt` seconds.
    pub fn write(&self, gravity: Vec3, dt: f32, bodies: &mut RigidBodySet) {
        for entry in &self.entries {
            let linear = entry.linear - gravity * (entry.gravity_scale * dt);
            let finite = linear.is_finite() && entry.angular.is_finite();
            let fixed = entry.inverse_mass == Vec3::ZERO && entry.inverse_inertia == Mat3::ZERO;
            if !finite || fixed {
                continue;
            }
            if let Some(body) = bodies.get_mut(entry.handle)
                && (linear, entry.angular) != entry.start
            {
                // Setting without waking would pile up velocity in a body that rapier does not move.
                let wake = body.is_sleeping();
                body.set_linvel(linear, wake);
                body.set_angvel(entry.angular, wake);
            }
        }
    }
}
