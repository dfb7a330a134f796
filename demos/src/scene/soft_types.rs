//! Bodies that move by themselves, water, and what happens to them in time; all checked.

use pliant::math::{Pose, Vec3};
use pliant::procdef::{GroundDescription, Stiffness};
use std::path::PathBuf;

/// A body that moves by itself: a rig, and how it starts.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftBody {
    /// Name, unique in the scene.
    pub name: String,
    /// The rig file, which exists.
    pub rig: PathBuf,
    /// From the frame of the mesh to where the body starts.
    pub pose: Pose,
    /// Velocity in metres a second.
    pub velocity: Vec3,
    /// Seconds at which its clock starts.
    pub clock: f32,
    /// How fast that clock goes: 1 is real time, negative runs the cycle backwards.
    pub pace: f32,
    /// Exponent on the rates of its cycle, from 0 to 1.
    pub strength: f32,
    /// Seconds in which its cycle grows from nothing, instead of those of the rig.
    pub rise: Option<f32>,
    /// Stiffness instead of that of the rig.
    pub stiffness: Option<Stiffness>,
    /// Friction along and against a direction instead of that of the rig.
    pub ground: Option<GroundDescription>,
    /// Red, green and blue from 0 to 1.
    pub colour: Option<[f32; 3]>,
    /// From 0 for invisible to 1, the default.
    pub opacity: f32,
}

/// A box of water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Its lowest corner.
    pub min: Vec3,
    /// Its highest corner, above the lowest in all directions.
    pub max: Vec3,
    /// Its velocity in metres a second.
    pub flow: Vec3,
}

/// What happens to soft bodies at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Indices of the soft bodies, at least one.
    pub bodies: Vec<usize>,
    /// When, in seconds.
    pub time: f32,
    /// A place that is touched, in the mesh.
    pub touch: Option<Vec3>,
    /// The pace from then on.
    pub pace: Option<f32>,
    /// The strength from then on.
    pub strength: Option<f32>,
}

/// Vertices of a soft body that are held.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// Indices of the soft bodies, at least one.
    pub bodies: Vec<usize>,
    /// Vertices within this ball of the mesh are held.
    pub centre: Vec3,
    /// Its radius in metres, positive.
    pub radius: f32,
    /// Index of the obstacle that holds them; none where they are held in place.
    pub obstacle: Option<usize>,
}
