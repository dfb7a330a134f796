//! Grabbing a body by its skin and dragging it.

use pliant::math::Vec3;
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::parry::query::{Ray, RayCast};
use rapier3d::parry::shape::Triangle;

use super::running::Simulation;

/// Where a ray meets a skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the actor.
    pub actor: usize,
    /// Distance along the ray.
    pub distance: f32,
    /// The point.
    pub point: Vec3,
    /// The segment that owns most of the skin there.
    pub segment: usize,
}

/// A point of a rigid body that is pulled to a goal.
pub(super) struct Grab {
    body: RigidBodyHandle,
    local: Vec3,
    goal: Vec3,
    distance: f32,
}

/// Natural frequency of the pull in hertz; it is critically damped.
const FREQUENCY: f32 = 2.0;

impl Simulation {
    /// The first skin that a ray meets.
    pub fn pick(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        let ray = Ray::new(origin, direction.normalize_or(Vec3::Z));
        let mut best: Option<Hit> = None;
        for (actor, entry) in self.actors.iter().enumerate() {
            let Some(body) = self.deformation.get(entry.handle) else { continue };
            let x = body.positions();
            for t in &body.rig().mesh.triangles {
                let triangle = Triangle::new(x[t[0] as usize], x[t[1] as usize], x[t[2] as usize]);
                let limit = best.map_or(f32::MAX, |hit| hit.distance);
                if let Some(distance) = triangle.cast_local_ray(&ray, limit, true) {
                    let skin = &body.rig().weights[t[0] as usize];
                    let heaviest = (0..4).max_by(|&a, &b| skin.weights[a].total_cmp(&skin.weights[b])).unwrap_or(0);
                    let segment = usize::from(skin.segments[heaviest]);
                    best = Some(Hit { actor, distance, point: ray.point_at(distance), segment });
                }
            }
        }
        best
    }

    /// Grabs the skin under a ray. False where there is none.
    pub fn grab(&mut self, origin: Vec3, direction: Vec3) -> bool {
        let Some(hit) = self.pick(origin, direction) else { return false };
        let ragdoll = self.deformation.ragdoll(self.actors[hit.actor].handle);
        let Some(&body) = ragdoll.and_then(|ragdoll| ragdoll.bodies.get(hit.segment)) else { return false };
        let Some(rigid) = self.physics.bodies.get(body) else { return false };
        let local = rigid.position().inverse_transform_point(hit.point);
        self.grab = Some(Grab { body, local, goal: hit.point, distance: hit.distance });
        true
    }

    /// Moves the goal of the grabbed point along with the ray, at the distance at which it was grabbed.
    pub fn drag(&mut self, origin: Vec3, direction: Vec3) {
        if let Some(grab) = &mut self.grab {
            grab.goal = origin + direction.normalize_or(Vec3::Z) * grab.distance;
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        self.grab = None;
    }

    /// The grabbed point and its goal.
    pub fn grabbed(&self) -> Option<(Vec3, Vec3)> {
        let grab = self.grab.as_ref()?;
        let body = self.physics.bodies.get(grab.body)?;
        Some((body.position().transform_point(grab.local), grab.goal))
    }

    /// A critically damped spring, implicit in time, strong enough for the whole ragdoll.
    pub(super) fn pull_grabbed(&mut self) {
        let Some(grab) = &self.grab else { return };
        let mass = self.deformation.owner(grab.body).and_then(|owner| self.deformation.ragdoll(owner)).map(|ragdoll| {
            ragdoll.bodies.iter().filter_map(|&body| self.physics.bodies.get(body)).map(|body| body.mass()).sum::<f32>()
        });
        let h = self.scene.dt;
        let omega = std::f32::consts::TAU * FREQUENCY;
        let Some(body) = self.physics.bodies.get_mut(grab.body) else { return };
        let point = body.position().transform_point(grab.local);
        let velocity = body.velocity_at_point(point);
        let mass = mass.unwrap_or_else(|| body.mass());
        let (k, c) = (mass * omega * omega, 2.0 * mass * omega);
        let softened = 1.0 + h * (c + h * k) / mass;
        let impulse = ((grab.goal - point - velocity * h) * k - velocity * c) * (h / softened);
        body.apply_impulse_at_point(impulse, point, true);
    }
}
