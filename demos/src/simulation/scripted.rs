//! The draggers of a scene at work: hands that follow their scripts.

use pliant::elastic::{DraggerHandle, DraggerStart, ElasticBody, Grip};
use pliant::math::Vec3;
use pliant::world::DeformationWorld;
use rapier3d::pipeline::PhysicsWorld;

use super::pull::Pull;
use super::running::{Actor, Simulation};
use crate::scene::{Dragger, Pulls};

/// One hand.
pub struct Hand {
    dragger: Dragger,
    hold: Option<Hold>,
}

/// What a hand has hold of.
enum Hold {
    Body(Pull),
    Skin(DraggerHandle),
}

impl Hand {
    /// A hand that holds nothing yet.
    pub fn new(dragger: &Dragger) -> Self {
        Self { dragger: dragger.clone(), hold: None }
    }

    /// Takes hold, moves on or lets go, as the script says for `time`.
    fn follow(&mut self, time: f32, actors: &[Actor], physics: &mut PhysicsWorld, deformation: &mut DeformationWorld) {
        let Some(actor) = actors.get(self.dragger.body) else { return };
        let Some(goal) = self.dragger.goal_at(time) else {
            if let (Some(Hold::Skin(handle)), Some(body)) = (self.hold.take(), deformation.get_mut(actor.handle)) {
                body.release_dragger(handle);
            }
            return;
        };
        if self.hold.is_none() {
            self.hold = self.take(actor, physics, deformation);
        }
        match &mut self.hold {
            Some(Hold::Body(pull)) => {
                pull.goal = goal;
                pull.apply(physics, deformation);
            }
            Some(Hold::Skin(handle)) => lead(deformation.get_mut(actor.handle), *handle, goal),
            None => {}
        }
    }

    fn take(&self, actor: &Actor, physics: &PhysicsWorld, deformation: &mut DeformationWorld) -> Option<Hold> {
        let elastic = deformation.get_mut(actor.handle)?;
        let grip = Grip::nearest(elastic.rig(), self.dragger.point)?;
        let (frequency, steady) = match self.dragger.pulls {
            Pulls::Body { frequency, steady } => (frequency, steady),
            Pulls::Skin { radius } => {
                let start = DraggerStart::new(grip, radius, elastic.grip_position(&grip));
                return elastic.add_dragger(start).ok().map(Hold::Skin);
            }
        };
        let segment = usize::from(grip.skin.heaviest());
        let local = elastic.rig().rest_poses[segment].inverse().transform_point(self.dragger.point);
        let body = *deformation.ragdoll(actor.handle)?.bodies.get(segment)?;
        let rotation = steady.then(|| physics.bodies.get(body).map(|body| body.position().rotation)).flatten();
        Some(Hold::Body(Pull { body, local, goal: Vec3::ZERO, frequency, rotation }))
    }
}

/// Skin is led relative to where it would be by itself.
fn lead(body: Option<&mut ElasticBody>, handle: DraggerHandle, offset: Vec3) {
    let Some(body) = body else { return };
    if let Some([by_itself, _]) = body.dragger(handle).map(|dragger| dragger.ends()) {
        body.move_dragger(handle, by_itself + offset);
    }
}

impl Simulation {
    /// All hands of the scene go on to the time `next`.
    pub(super) fn follow_scripts(&mut self, next: f32) {
        for hand in &mut self.hands {
            hand.follow(next, &self.actors, &mut self.physics, &mut self.deformation);
        }
    }
}
