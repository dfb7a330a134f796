//! Private copies of rapier's velocities: what the solve works on before anything is written back.
//!
//! A copy is the mean velocity of the body over rapier's next step. Rapier adds gravity in `n` substeps, after each of
//! which it moves the body: over the whole step that makes `(n + 1) / 2n` of a step's gravity. A contact that brings this mean
//! to zero leaves the body where it is.

use std::collections::HashMap;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};

use super::reactions::Support;
use crate::math::{Mat3, Vec3};

/// Velocity and inverse inertia of one rigid body, in world space.
#[derive(Clone, Copy, Debug)]
pub struct BodyVelocity {
    /// The body.
    pub handle: RigidBodyHandle,
    start: (Vec3, Vec3),
    /// The change of the velocity of the centre of mass, by impulses alone.
    change: Vec3,
    /// Mean velocity of the centre of mass over the next step, without the impulses.
    drift: Vec3,
    /// Angular velocity.
    pub angular: Vec3,
    /// Centre of mass.
    pub centre: Vec3,
    /// Inverse mass; zero for what cannot be pushed.
    pub inverse_mass: Vec3,
    /// Inverse inertia; zero for what cannot be turned.
    pub inverse_inertia: Mat3,
    /// How rapier supports it: its inverse mass and inertia are less by what is held.
    pub support: Support,
    /// Rapier's dominance group: of two bodies the lower one alone is pushed.
    pub dominance: i16,
}

impl BodyVelocity {
    /// Reads a body. `held` bodies are not pushed, whatever they are; `None` where there is no such body.
    pub fn read(
        handle: RigidBodyHandle,
        held: bool,
        support: Support,
        step: &StepSize,
        bodies: &RigidBodySet,
    ) -> Option<Self> {
        let body = bodies.get(handle)?;
        let properties = body.mass_properties();
        let movable = body.is_dynamic() && body.is_enabled() && !held;
        let inertia = properties.effective_world_inv_inertia;
        let gravity =
            if movable { step.gravity * (body.gravity_scale() * (1.0 - support.carried)) } else { Vec3::ZERO };
        let substeps = step.substeps.max(1) + body.additional_solver_iterations();
        let drift = if held { Vec3::ZERO } else { body.linvel() + gravity * (step.dt * mean_of_substeps(substeps)) };
        Some(Self {
            handle,
            start: (body.linvel(), body.angvel()),
            change: Vec3::ZERO,
            drift,
            angular: if held { Vec3::ZERO } else { body.angvel() },
            centre: body.center_of_mass(),
            inverse_mass: if movable { properties.effective_inv_mass * (1.0 - support.held) } else { Vec3::ZERO },
            inverse_inertia: if movable {
                Mat3::from_cols(inertia * Vec3::X, inertia * Vec3::Y, inertia * Vec3::Z) * (1.0 - support.held_turn)
            } else {
                Mat3::ZERO
            },
            support,
            dominance: body.effective_dominance_group(),
        })
    }

    /// True for what an impulse can move.
    pub fn is_movable(&self) -> bool {
        self.inverse_mass != Vec3::ZERO || self.inverse_inertia != Mat3::ZERO
    }

    /// Mean velocity, over the next step, of the material point at `x`.
    #[inline]
    pub fn at(&self, x: Vec3) -> Vec3 {
        self.drift + self.change + self.angular.cross(x - self.centre)
    }

    /// Applies an impulse at `x`.
    #[inline]
    pub fn push(&mut self, x: Vec3, impulse: Vec3) {
        self.change += self.inverse_mass * impulse;
        self.angular += self.inverse_inertia * (x - self.centre).cross(impulse);
    }

    /// [`BodyVelocity::response`] where nothing held the body: along one direction.
    pub fn free_response(&self, x: Vec3, n: Vec3) -> f32 {
        let turn = (x - self.centre).cross(n);
        let Support { held, held_turn, .. } = self.support;
        n.dot(self.inverse_mass * n) / (1.0 - held) + turn.dot(self.inverse_inertia * turn) / (1.0 - held_turn)
    }

    /// How much a unit impulse along `n` at `x` changes the velocity along `m` there.
    #[inline]
    pub fn response(&self, x: Vec3, n: Vec3, m: Vec3) -> f32 {
        let arm = x - self.centre;
        m.dot(self.inverse_mass * n) + arm.cross(m).dot(self.inverse_inertia * arm.cross(n))
    }

    /// The changes of linear and angular velocity that the impulses make in rapier.
    pub fn given(&self) -> [Vec3; 2] {
        let Support { held, held_turn, .. } = self.support;
        [self.change / (1.0 - held), (self.angular - self.start.1) / (1.0 - held_turn)]
    }

    /// The velocities that rapier's body gets.
    pub fn written(&self) -> [Vec3; 2] {
        let [linear, angular] = self.given();
        [self.start.0 + linear, self.start.1 + angular]
    }

    /// Gives rapier's body the impulses.
    pub fn write(&self, bodies: &mut RigidBodySet) {
        let [linear, angular] = self.written();
        if !self.is_movable() || !linear.is_finite() || !angular.is_finite() {
            return;
        }
        if let Some(body) = bodies.get_mut(self.handle)
            && (linear, angular) != self.start
        {
            // Setting without waking would pile up velocity in a body that rapier does not move.
            let wake = body.is_sleeping();
            body.set_linvel(linear, wake);
            body.set_angvel(angular, wake);
        }
    }
}

/// Rapier's next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSize {
    /// Length in seconds.
    pub dt: f32,
    /// Gravity in m/s².
    pub gravity: Vec3,
    /// Rapier's substeps (`num_solver_iterations`).
    pub substeps: usize,
}

/// The part of a step's gravity that a body has on the mean while it moves.
pub fn mean_of_substeps(substeps: usize) -> f32 {
    (substeps + 1) as f32 / (2 * substeps) as f32
}

/// All bodies that take part, each once, in the order in which they were asked for.
#[derive(Default)]
pub struct Velocities {
    places: HashMap<RigidBodyHandle, usize>,
    /// The bodies.
    pub entries: Vec<BodyVelocity>,
}

impl Velocities {
    /// The index of a body, made by `read` the first time.
    pub fn index(&mut self, handle: RigidBodyHandle, read: impl FnOnce() -> Option<BodyVelocity>) -> Option<usize> {
        if let Some(&place) = self.places.get(&handle) {
            return Some(place);
        }
        self.entries.push(read()?);
        self.places.insert(handle, self.entries.len() - 1);
        Some(self.entries.len() - 1)
    }
}
