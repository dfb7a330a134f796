//! Grabbing a body by its skin and dragging it.

use pliant::math::Vec3;
use rapier3d::parry::query::{Ray, RayCast};
use rapier3d::parry::shape::Triangle;

use super::pull::Pull;
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

/// What the pointer holds, at the distance from the eye at which it was grabbed.
pub(super) struct Grab {
    pull: Pull,
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
                    let segment = usize::from(skin.heaviest());
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
        let pull = Pull { body, local, goal: hit.point, frequency: FREQUENCY, rotation: None };
        self.grab = Some(Grab { pull, distance: hit.distance });
        true
    }

    /// Moves the goal of the grabbed point along with the ray, at the distance at which it was grabbed.
    pub fn drag(&mut self, origin: Vec3, direction: Vec3) {
        if let Some(grab) = &mut self.grab {
            grab.pull.goal = origin + direction.normalize_or(Vec3::Z) * grab.distance;
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        self.grab = None;
    }

    /// The grabbed point and its goal.
    pub fn grabbed(&self) -> Option<(Vec3, Vec3)> {
        let grab = self.grab.as_ref()?;
        Some((grab.pull.point(&self.physics)?, grab.pull.goal))
    }

    /// The grabbed body is pulled to where the pointer is.
    pub(super) fn pull_grabbed(&mut self) {
        if let Some(grab) = &self.grab {
            grab.pull.apply(&mut self.physics, &self.deformation);
        }
    }
}
