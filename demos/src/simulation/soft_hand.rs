//! The pointer on bodies that move by themselves: what is under it, a touch, a hold.

use pliant::math::Vec3;
use rapier3d::parry::query::{Ray, RayCast};
use rapier3d::parry::shape::Triangle;

use super::running::Simulation;

/// Where a ray meets the boundary of a body that moves by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftHit {
    /// Index of the soft actor.
    pub actor: usize,
    /// Distance along the ray.
    pub distance: f32,
    /// The point.
    pub point: Vec3,
}

impl Simulation {
    /// The first body that moves by itself that a ray meets, no farther than `limit` metres.
    pub fn pick_soft(&self, origin: Vec3, direction: Vec3, limit: f32) -> Option<SoftHit> {
        let ray = Ray::new(origin, direction.normalize_or(Vec3::Z));
        let mut best: Option<SoftHit> = None;
        for (actor, entry) in self.soft_actors.iter().enumerate() {
            let Some(body) = self.creatures.get(entry.handle) else { continue };
            let x = body.positions();
            for t in &entry.kind.model.boundary {
                let triangle = Triangle::new(x[t[0] as usize], x[t[1] as usize], x[t[2] as usize]);
                let limit = best.map_or(limit, |hit| hit.distance);
                if let Some(distance) = triangle.cast_local_ray(&ray, limit, true) {
                    best = Some(SoftHit { actor, distance, point: ray.point_at(distance) });
                }
            }
        }
        best
    }

    /// Touches the body under a ray: a stimulus starts there. The index of its actor, if it answers stimuli.
    pub fn touch(&mut self, origin: Vec3, direction: Vec3) -> Option<usize> {
        let elastic = self.pick(origin, direction).map_or(f32::MAX, |hit| hit.distance);
        let hit = self.pick_soft(origin, direction, elastic)?;
        let handle = self.soft_actors.get(hit.actor)?.handle;
        self.creatures.touch(handle, hit.point).then_some(hit.actor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{find_scene, load_scene};
    use crate::simulation::Take;

    fn bar() -> (Simulation, Vec3) {
        let mut simulation = Simulation::new(load_scene(find_scene("bending-bar").unwrap()).unwrap(), 0).unwrap();
        let handle = simulation.soft_actors[0].handle;
        simulation.creatures.motion_mut(handle).unwrap().strength = 0.0;
        let place = simulation.scene.soft_bodies[0].pose.translation;
        (simulation, place)
    }

    #[test]
    fn a_body_that_is_grabbed_follows_the_pointer_until_it_is_let_go() {
        let (mut simulation, place) = bar();
        let (eye, ahead) = (place + Vec3::Z * 4.0, Vec3::NEG_Z);
        assert!(!simulation.grab(eye, Vec3::Z, Take::Body), "nothing is behind the eye");
        assert!(simulation.grab(eye, ahead, Take::Body));
        let (held, _) = simulation.grabbed().unwrap();
        assert!(held.distance(place) < 0.35, "the hold is within its reach of the pointer: {held}");
        let aside = Vec3::new(0.1, 0.4, 0.0);
        (1..=60).for_each(|k| {
            simulation.drag(eye + aside * (k as f32 / 60.0), ahead);
            simulation.step();
        });
        (0..180).for_each(|_| simulation.step());
        let (now, goal) = simulation.grabbed().unwrap();
        assert!((goal - held).distance(aside) < 1e-4, "the goal goes with the pointer");
        // The rest of the bar still swings a little about what is held.
        assert!(now.distance(goal) < 0.05, "{now} {goal}");
        simulation.release();
        assert!(simulation.grabbed().is_none());
    }

    #[test]
    fn a_touch_starts_a_stimulus_where_the_body_answers_and_nowhere_else() {
        let (mut simulation, place) = bar();
        assert_eq!(simulation.touch(place + Vec3::Z * 4.0, Vec3::NEG_Z), None, "the bar answers nothing");
        let mut snail = Simulation::new(load_scene(find_scene("snail").unwrap()).unwrap(), 0).unwrap();
        let place = snail.scene.soft_bodies[0].pose.transform_point(Vec3::new(0.4, 0.15, 0.0));
        assert_eq!(snail.touch(place + Vec3::Z * 4.0, Vec3::Z), None, "nothing is there");
        assert_eq!(snail.touch(place + Vec3::Z * 4.0, Vec3::NEG_Z), Some(0));
        let motion = snail.creatures.motion(snail.soft_actors[0].handle).unwrap();
        assert_eq!(motion.stimuli().len(), 1);
        let nearest =
            (0..500).filter_map(|v| motion.stimuli()[0].arrival(v)).map(|(delay, _)| delay).fold(9.0, f32::min);
        assert!(nearest < 0.1, "it starts at once where it was touched: {nearest}");
    }
}
