//! Grabbing what is under the pointer, a body or its skin, and dragging it.

use pliant::elastic::{DraggerHandle, DraggerStart, Grip};
use pliant::math::Vec3;
use rapier3d::parry::query::{Ray, RayCast};
use rapier3d::parry::shape::Triangle;

use super::pull::Pull;
use super::running::Simulation;
use super::soft_hand::SoftHit;

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
    /// The nearest vertex of the triangle that was met.
    pub vertex: usize,
}

/// What the pointer holds, at the distance from the eye at which it was grabbed.
pub(super) struct Grab {
    hold: Hold,
    distance: f32,
    /// Where the ray was at that distance when it was asked last.
    goal: Vec3,
}

enum Hold {
    Body(Pull),
    /// Of which actor, and how far the held vertex is from where the ray met the skin.
    Skin {
        actor: usize,
        dragger: DraggerHandle,
        aside: Vec3,
    },
    /// Which soft actor.
    Soft(usize),
}

/// What a grab takes hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Take {
    /// The rigid body under the skin.
    Body,
    /// The skin, within so many sizes of the body.
    Skin(f32),
}

/// Natural frequency of the pull in hertz; it is critically damped.
const FREQUENCY: f32 = 2.0;

/// The same of a hold on a body that moves by itself. It is critically damped for what is held; the rest of the body hangs
/// on it and swings for a while.
const SOFT_FREQUENCY: f32 = 4.0;

/// How far a hold on a body that moves by itself reaches, in sizes of the body.
const SOFT_REACH: f32 = 0.2;

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
                    let point = ray.point_at(distance);
                    let away = |v: &usize| x[*v].distance_squared(point);
                    let vertex = t.map(|v| v as usize).into_iter().min_by(|a, b| away(a).total_cmp(&away(b)));
                    best = vertex.map(|vertex| Hit { actor, distance, point, segment, vertex });
                }
            }
        }
        best
    }

    /// Grabs what is under a ray. False where there is nothing.
    pub fn grab(&mut self, origin: Vec3, direction: Vec3, take: Take) -> bool {
        self.release();
        let elastic = self.pick(origin, direction);
        let limit = elastic.map_or(f32::MAX, |hit| hit.distance);
        if let Some(hit) = self.pick_soft(origin, direction, limit) {
            self.grab = self.hold_soft(&hit).map(|hold| Grab { hold, distance: hit.distance, goal: hit.point });
            return self.grab.is_some();
        }
        let held = elastic
            .and_then(|hit| Some(Grab { hold: self.hold(&hit, take)?, distance: hit.distance, goal: hit.point }));
        self.grab = held;
        self.grab.is_some()
    }

    fn hold(&mut self, hit: &Hit, take: Take) -> Option<Hold> {
        let actor = self.actors.get(hit.actor)?.handle;
        match take {
            Take::Body => {
                let body = *self.deformation.ragdoll(actor)?.bodies.get(hit.segment)?;
                let local = self.physics.bodies.get(body)?.position().inverse_transform_point(hit.point);
                Some(Hold::Body(Pull { body, local, goal: hit.point, frequency: FREQUENCY, rotation: None }))
            }
            Take::Skin(reach) => {
                let body = self.deformation.get_mut(actor)?;
                let radius = reach * body.rig().mesh.size();
                let grip = Grip::on_vertex(body.rig(), hit.vertex)?;
                let place = body.grip_position(&grip);
                let dragger = body.add_dragger(DraggerStart::new(grip, radius, place)).ok()?;
                Some(Hold::Skin { actor: hit.actor, dragger, aside: place - hit.point })
            }
        }
    }

    fn hold_soft(&mut self, hit: &SoftHit) -> Option<Hold> {
        let actor = self.soft_actors.get(hit.actor)?;
        let radius = SOFT_REACH * actor.kind.model.rig.mesh().size();
        let grip = self.creatures.grab(actor.handle, hit.point, radius)?;
        grip.frequency = SOFT_FREQUENCY;
        Some(Hold::Soft(hit.actor))
    }

    /// Moves the goal of the grabbed point along with the ray, at the distance at which it was grabbed.
    pub fn drag(&mut self, origin: Vec3, direction: Vec3) {
        let Some(grab) = &mut self.grab else { return };
        let goal = origin + direction.normalize_or(Vec3::Z) * grab.distance;
        let moved = goal - std::mem::replace(&mut grab.goal, goal);
        match &mut grab.hold {
            Hold::Body(pull) => pull.goal = goal,
            Hold::Skin { actor, dragger, aside } => {
                let body = self.actors.get(*actor).and_then(|actor| self.deformation.get_mut(actor.handle));
                if let Some(body) = body {
                    body.move_dragger(*dragger, goal + *aside);
                }
            }
            Hold::Soft(actor) => {
                let handle = self.soft_actors.get(*actor).map(|actor| actor.handle);
                if let Some(grip) = handle.and_then(|handle| self.creatures.grip_mut(handle)) {
                    grip.target += moved;
                }
            }
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        match self.grab.take().map(|grab| grab.hold) {
            Some(Hold::Skin { actor, dragger, .. }) => {
                let body = self.actors.get(actor).and_then(|actor| self.deformation.get_mut(actor.handle));
                if let Some(body) = body {
                    body.release_dragger(dragger);
                }
            }
            Some(Hold::Soft(actor)) => {
                if let Some(actor) = self.soft_actors.get(actor) {
                    self.creatures.release(actor.handle);
                }
            }
            Some(Hold::Body(_)) | None => {}
        }
    }

    /// The grabbed point of a body and its goal.
    pub fn grabbed(&self) -> Option<(Vec3, Vec3)> {
        match &self.grab.as_ref()?.hold {
            Hold::Body(pull) => Some((pull.point(&self.physics)?, pull.goal)),
            Hold::Skin { .. } => None,
            Hold::Soft(actor) => {
                let handle = self.soft_actors.get(*actor)?.handle;
                let grip = self.creatures.grip(handle)?;
                Some((grip.place(self.creatures.get(handle)?), grip.target))
            }
        }
    }

    /// The grabbed body is pulled to where the pointer is.
    pub(super) fn pull_grabbed(&mut self) {
        if let Some(Grab { hold: Hold::Body(pull), .. }) = &self.grab {
            pull.apply(&mut self.physics, &self.deformation);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{find_scene, load_scene};

    #[test]
    fn skin_that_is_grabbed_follows_the_pointer_and_returns() {
        let scene = load_scene(find_scene("ball").unwrap()).unwrap();
        let mut simulation = Simulation::new(scene, 0).unwrap();
        simulation.physics.gravity = Vec3::ZERO;
        let (eye, ahead) = (Vec3::new(0.0, 1.5, 4.0), Vec3::NEG_Z);
        assert!(!simulation.grab(eye, Vec3::Z, Take::Skin(0.5)), "nothing is behind the eye");
        assert!(simulation.grab(eye, ahead, Take::Skin(0.5)));
        let aside = Vec3::new(0.2, 0.1, 0.0);
        for share in 1..=10 {
            simulation.drag(eye + aside * share as f32 * 0.1, ahead);
            simulation.step();
        }
        let farthest = |simulation: &Simulation| {
            let body = simulation.deformation.get(simulation.actors[0].handle).unwrap();
            let rest = body.rig().mesh.positions.iter().map(|x| body.motions()[0].transform_point(*x));
            rest.zip(body.positions()).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
        };
        assert!((farthest(&simulation) - aside.length()).abs() < 0.02, "{}", farthest(&simulation));
        simulation.release();
        (0..300).for_each(|_| simulation.step());
        assert!(farthest(&simulation) < 1e-4, "{}", farthest(&simulation));
    }
}
