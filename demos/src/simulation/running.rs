//! The running scene: one verb, and what there is to see and to measure after it.

use std::time::Instant;

use pliant::math::Pose;
use pliant::world::{
    BodyReport, DeformationWorld, ElasticBodyHandle, ProcDefBodyReport, ProcDefTimes, ProcDefWorld, StageTimes,
};
use rapier3d::pipeline::PhysicsWorld;

use super::build::{BuildError, Built, build};
use super::grab::Grab;
use super::obstacle::ObstacleBody;
use super::scripted::Hand;
use super::soft::SoftActor;
use crate::scene::Scene;

/// An elastic body of the scene.
#[derive(Clone, Debug)]
pub struct Actor {
    /// Its name in the scene.
    pub name: String,
    /// The elastic body.
    pub handle: ElasticBodyHandle,
    /// Its colour, if the scene gives one.
    pub colour: Option<[f32; 3]>,
}

/// A scene with its rapier world and its deformation world.
pub struct Simulation {
    /// What it was built from.
    pub scene: Scene,
    /// Rapier's world.
    pub physics: PhysicsWorld,
    /// Pliant's world.
    pub deformation: DeformationWorld,
    /// Pliant's world of bodies that move by themselves.
    pub creatures: ProcDefWorld,
    /// The elastic bodies.
    pub actors: Vec<Actor>,
    /// The bodies that move by themselves.
    pub soft_actors: Vec<SoftActor>,
    /// The obstacles.
    pub obstacles: Vec<ObstacleBody>,
    /// Steps taken.
    pub frame: u64,
    /// Milliseconds that rapier took for the last step.
    pub rigid_ms: f32,
    /// Milliseconds that the bodies that move by themselves took for the last step.
    pub soft_times: ProcDefTimes,
    pub(super) grab: Option<Grab>,
    pub(super) hands: Vec<Hand>,
    /// Cues before this time have been followed.
    pub(super) cued: f32,
}

impl Simulation {
    /// Builds the scene. A `seed` other than 0 turns and shifts the bodies' starts at random.
    ///
    /// # Errors
    /// [`BuildError`] where a rig or a mesh is wrong.
    pub fn new(scene: Scene, seed: u64) -> Result<Self, BuildError> {
        let Built { physics, deformation, creatures, actors, soft_actors, obstacles } = build(&scene, seed)?;
        let hands = scene.draggers.iter().map(Hand::new).collect();
        Ok(Self {
            scene,
            physics,
            deformation,
            creatures,
            actors,
            soft_actors,
            obstacles,
            frame: 0,
            rigid_ms: 0.0,
            soft_times: ProcDefTimes::default(),
            grab: None,
            hands,
            cued: 0.0,
        })
    }

    /// Seconds simulated.
    pub fn time(&self) -> f32 {
        (self.frame as f64 * f64::from(self.scene.dt)) as f32
    }

    /// The number of steps in the scene's duration.
    pub fn frames(&self) -> u64 {
        (f64::from(self.scene.duration) / f64::from(self.scene.dt)).round().max(1.0) as u64
    }

    /// One step of the scene, in its substeps.
    pub fn step(&mut self) {
        let substeps = self.scene.substeps.max(1);
        self.physics.integration_parameters.dt = self.scene.dt / substeps as f32;
        (self.rigid_ms, self.soft_times) = (0.0, ProcDefTimes::default());
        for substep in 1..=substeps {
            let passed = self.frame as f64 + f64::from(substep) / f64::from(substeps);
            self.substep((passed * f64::from(self.scene.dt)) as f32);
        }
        self.frame += 1;
    }

    /// What is due happens, obstacles move, held bodies are pulled, rapier steps to the time `next`, pliant deforms and
    /// drives.
    fn substep(&mut self, next: f32) {
        self.follow_cues(next);
        self.move_obstacles(next);
        self.follow_scripts(next);
        self.pull_grabbed();
        let clock = Instant::now();
        self.physics.step();
        self.rigid_ms += clock.elapsed().as_secs_f32() * 1.0e3;
        if !self.actors.is_empty() {
            self.deformation.step(&mut self.physics);
        }
        if !self.soft_actors.is_empty() {
            let times = self.creatures.step(&mut self.physics).times;
            self.soft_times.exchange += times.exchange;
            self.soft_times.contact += times.contact;
            self.soft_times.drive += times.drive;
        }
    }

    /// What the last step did to a body.
    pub fn report(&self, actor: &Actor) -> BodyReport {
        self.deformation.report().body(actor.handle).copied().unwrap_or_default()
    }

    /// What the last step did to a body that moves by itself.
    pub fn soft_report(&self, actor: &SoftActor) -> ProcDefBodyReport {
        self.creatures.report().body(actor.handle).copied().unwrap_or_default()
    }

    /// Milliseconds that pliant's stages took in the last step.
    pub fn times(&self) -> StageTimes {
        self.deformation.report().times
    }

    /// Where each obstacle is.
    pub fn obstacle_poses(&self) -> Vec<Pose> {
        self.obstacles.iter().map(|o| o.pose(&self.physics)).collect()
    }

    fn move_obstacles(&mut self, next: f32) {
        for obstacle in self.obstacles.iter().filter(|o| o.obstacle.is_moving()) {
            if let Some(body) = self.physics.bodies.get_mut(obstacle.body) {
                body.set_next_kinematic_position(obstacle.obstacle.pose_at(next));
            }
        }
    }
}
