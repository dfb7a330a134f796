//! The data of a scene, all checked: finite, in range, files that exist.

use super::dragger::Dragger;
use super::shape_types::ObstacleShape;
use super::soft_types::{Attachment, Cue, SoftBody, Water};
use pliant::math::{Pose, Vec3};
use std::path::PathBuf;

/// Longest time step of a scene in seconds.
pub const MAX_DT: f32 = 0.1;

/// Longest duration of a scene in seconds.
pub const MAX_DURATION: f32 = 3600.0;

/// Most substeps of a step.
pub const MAX_SUBSTEPS: u32 = 64;

/// A scene of elastic bodies, bodies that move by themselves, and obstacles.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its name, not empty.
    pub name: String,
    /// How long it runs, in seconds: above 0, at most [`MAX_DURATION`].
    pub duration: f32,
    /// Time step in seconds: above 0, at most [`MAX_DT`].
    pub dt: f32,
    /// Steps of the physics in one such step: from 1 to [`MAX_SUBSTEPS`].
    pub substeps: u32,
    /// Gravity in metres a second squared.
    pub gravity: Vec3,
    /// Softness of all bodies instead of that of their rigs: above 0, at most 10.
    pub softness: Option<f32>,
    /// Where it is looked at from.
    pub camera: Camera,
    /// Elastic bodies, with names that differ.
    pub bodies: Vec<Body>,
    /// Obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Hands that follow a script.
    pub draggers: Vec<Dragger>,
    /// Bodies that move by themselves, with names that differ.
    pub soft_bodies: Vec<SoftBody>,
    /// Where water is.
    pub water: Vec<Water>,
    /// What happens to soft bodies in time.
    pub cues: Vec<Cue>,
    /// What holds soft bodies.
    pub attachments: Vec<Attachment>,
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: Vec3,
    /// What it looks at; not the eye.
    pub target: Vec3,
    /// Vertical field of view in degrees, from 1 to 179.
    pub fov_degrees: f32,
}

/// An elastic body: a rig, and how it starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name, unique in the scene.
    pub name: String,
    /// The rig file, which exists.
    pub rig: PathBuf,
    /// From the rest pose of the rig to where the body starts.
    pub pose: Pose,
    /// Velocity in metres a second.
    pub velocity: Vec3,
    /// Angular velocity in radians a second.
    pub angular_velocity: Vec3,
    /// True where its rigid bodies stay where they are, whatever pushes them.
    pub held: bool,
    /// Red, green and blue from 0 to 1.
    pub colour: Option<[f32; 3]>,
}

/// A rigid obstacle: fixed, moved along a path, or moved by rapier.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Name, if it has one.
    pub name: Option<String>,
    /// Shape.
    pub shape: ObstacleShape,
    /// Where it is; with a path, where it is relative to the path's point.
    pub pose: Pose,
    /// Coulomb friction coefficient, not negative.
    pub friction: Option<f32>,
    /// Coefficient of restitution between rigid bodies, from 0 to 1.
    pub restitution: Option<f32>,
    /// Set where rapier moves it; it has neither path nor spin then.
    pub dynamic: Option<Dynamic>,
    /// Red, green and blue from 0 to 1.
    pub colour: Option<[f32; 3]>,
    /// From 0 for invisible to 1, the default.
    pub opacity: f32,
    /// The path it moves on.
    pub path: Option<ObstaclePath>,
    /// How it turns about itself.
    pub spin: Option<Spin>,
}

/// An obstacle that rapier moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamic {
    /// How heavy it is.
    pub mass: ObstacleMass,
    /// Velocity at the start in metres a second.
    pub velocity: Vec3,
    /// Angular velocity at the start in radians a second.
    pub angular_velocity: Vec3,
    /// Rate at which its velocity dies away, in 1/s.
    pub linear_damping: f32,
    /// Rate at which its angular velocity dies away, in 1/s.
    pub angular_damping: f32,
}

/// How heavy a dynamic obstacle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ObstacleMass {
    /// Mass in kilograms, positive.
    Mass(f32),
    /// Kilograms a cubic metre, positive.
    Density(f32),
}

/// A path of straight pieces run through at an even pace.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstaclePath {
    /// At least two points.
    pub points: Vec<Vec3>,
    /// Seconds from one visit of the first point to the next, positive.
    pub period: f32,
    /// What happens at the last point.
    pub kind: PathKind,
}

/// What happens at the last point of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// On to the first point.
    Loop,
    /// Back the same way.
    PingPong,
}

/// A steady turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// Unit axis in the obstacle's frame.
    pub axis: Vec3,
    /// Speed in degrees a second.
    pub degrees_per_second: f32,
}

impl ObstaclePath {
    /// The point of the path at `time` seconds: straight between the points, at an even pace over the whole period.
    pub fn at(&self, time: f32) -> Vec3 {
        let mut stations = self.points.clone();
        match self.kind {
            PathKind::Loop => stations.extend(self.points.first()),
            PathKind::PingPong => stations.extend(self.points.iter().rev().skip(1)),
        }
        let lengths: Vec<f32> = stations.windows(2).map(|w| w[0].distance(w[1])).collect();
        let mut left = (time / self.period).rem_euclid(1.0) * lengths.iter().sum::<f32>();
        for (ends, length) in stations.windows(2).zip(&lengths) {
            if left <= *length && *length > 0.0 {
                return ends[0].lerp(ends[1], left / length);
            }
            left -= length;
        }
        stations.last().copied().unwrap_or(Vec3::ZERO)
    }
}

impl Obstacle {
    /// The obstacle's pose at `time` seconds: its own pose, turned by its spin, carried along its path.
    pub fn pose_at(&self, time: f32) -> Pose {
        let mut pose = self.pose;
        if let Some(spin) = self.spin {
            // In f64: after an hour of turning the angle still has its digits.
            let degrees = (f64::from(spin.degrees_per_second) * f64::from(time)).rem_euclid(360.0);
            pose.rotation *= glam::Quat::from_axis_angle(spin.axis, (degrees as f32).to_radians());
        }
        if let Some(path) = &self.path {
            pose.translation += path.at(time);
        }
        pose
    }

    /// True when the obstacle moves by a path or a spin.
    pub fn is_moving(&self) -> bool {
        self.path.is_some() || self.spin.is_some()
    }

    /// True when the obstacle stays where it is.
    pub fn is_fixed(&self) -> bool {
        !self.is_moving() && self.dynamic.is_none()
    }
}
