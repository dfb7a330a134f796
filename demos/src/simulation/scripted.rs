//! The draggers of a scene at work: hands that follow their scripts.

use pliant::math::Vec3;
use pliant::world::DeformationWorld;
use rapier3d::pipeline::PhysicsWorld;

use super::pull::Pull;
use super::running::{Actor, Simulation};
use crate::scene::{Dragger, Pulls};

/// One hand.
pub struct Hand {
    dragger: Dragger,
    hold: Option<Pull>,
}

impl Hand {
    /// A hand that holds nothing yet.
    pub fn new(dragger: &Dragger) -> Self {
        Self { dragger: dragger.clone(), hold: None }
    }

    /// Takes hold, moves on or lets go, as the script says for `time`.
    fn follow(&mut self, time: f32, actors: &[Actor], physics: &mut PhysicsWorld, deformation: &mut DeformationWorld) {
        let Some(goal) = self.dragger.goal_at(time) else {
            self.hold = None;
            return;
        };
        if self.hold.is_none() {
            self.hold = actors.get(self.dragger.body).and_then(|actor| self.take(actor, physics, deformation));
        }
        if let Some(pull) = &mut self.hold {
            pull.goal = goal;
            pull.apply(physics, deformation);
        }
    }

    fn take(&self, actor: &Actor, physics: &PhysicsWorld, deformation: &DeformationWorld) -> Option<Pull> {
        let rig = deformation.get(actor.handle)?.rig();
        let away = |v: &usize| rig.mesh.positions[*v].distance_squared(self.dragger.point);
        let vertex = (0..rig.mesh.positions.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let segment = usize::from(rig.weights[vertex].heaviest());
        let body = *deformation.ragdoll(actor.handle)?.bodies.get(segment)?;
        let Pulls::Body { frequency, steady } = self.dragger.pulls else { return None };
        let rotation = steady.then(|| physics.bodies.get(body).map(|body| body.position().rotation)).flatten();
        let local = rig.rest_poses[segment].inverse().transform_point(self.dragger.point);
        Some(Pull { body, local, goal: Vec3::ZERO, frequency, rotation })
    }
}

impl Simulation {
    /// All hands of the scene go on to the next step.
    pub(super) fn follow_scripts(&mut self) {
        let next = ((self.frame + 1) as f64 * f64::from(self.scene.dt)) as f32;
        for hand in &mut self.hands {
            hand.follow(next, &self.actors, &mut self.physics, &mut self.deformation);
        }
    }
}
