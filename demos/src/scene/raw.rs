//! A scene file as it is written, before anything is checked but its keys and types. The tests write scenes with it too.

use super::raw_soft::{RawAttachment, RawCue, RawSoftBody, RawWater};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

pub type Triple = [f32; 3];

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawScene {
    pub name: String,
    pub duration: f32,
    #[serde(default = "sixtieth")]
    pub dt: f32,
    #[serde(default = "one")]
    pub substeps: u32,
    #[serde(default = "earth")]
    pub gravity: Triple,
    pub softness: Option<f32>,
    pub camera: RawCamera,
    #[serde(default)]
    pub body: Vec<RawBody>,
    #[serde(default)]
    pub obstacle: Vec<RawObstacle>,
    #[serde(default)]
    pub dragger: Vec<RawDragger>,
    #[serde(default)]
    pub soft_body: Vec<RawSoftBody>,
    #[serde(default)]
    pub water: Vec<RawWater>,
    #[serde(default)]
    pub cue: Vec<RawCue>,
    #[serde(default)]
    pub attachment: Vec<RawAttachment>,
}

fn one() -> u32 {
    1
}

fn sixtieth() -> f32 {
    1.0 / 60.0
}

fn earth() -> Triple {
    [0.0, -9.81, 0.0]
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawCamera {
    pub eye: Triple,
    pub target: Triple,
    #[serde(default = "forty")]
    pub fov_degrees: f32,
}

fn forty() -> f32 {
    40.0
}

#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawBody {
    pub name: String,
    pub rig: PathBuf,
    #[serde(default)]
    pub position: Triple,
    #[serde(default)]
    pub rotation_degrees: Triple,
    #[serde(default)]
    pub velocity: Triple,
    #[serde(default)]
    pub angular_velocity: Triple,
    #[serde(default)]
    pub held: bool,
    pub colour: Option<Triple>,
}

#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawObstacle {
    pub name: Option<String>,
    pub shape: RawShape,
    #[serde(default)]
    pub position: Triple,
    #[serde(default)]
    pub rotation_degrees: Triple,
    pub friction: Option<f32>,
    pub restitution: Option<f32>,
    #[serde(default)]
    pub dynamic: bool,
    pub mass: Option<f32>,
    pub density: Option<f32>,
    pub velocity: Option<Triple>,
    pub angular_velocity: Option<Triple>,
    pub linear_damping: Option<f32>,
    pub angular_damping: Option<f32>,
    pub colour: Option<Triple>,
    pub opacity: Option<f32>,
    pub path: Option<RawPath>,
    pub spin: Option<RawSpin>,
}

#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawShape {
    pub kind: String,
    pub radius: Option<f32>,
    pub half_height: Option<f32>,
    pub half_extents: Option<Triple>,
    pub rounding: Option<f32>,
    pub thickness: Option<f32>,
    pub normal: Option<Triple>,
    pub points: Option<Vec<Triple>>,
    pub file: Option<PathBuf>,
    pub scale: Option<f32>,
    pub max_parts: Option<u32>,
    pub one_sided: Option<bool>,
    pub heights: Option<Vec<Vec<f32>>>,
    pub size: Option<[f32; 2]>,
    pub voxel_size: Option<f32>,
    pub cells: Option<Vec<[i32; 3]>>,
    pub shapes: Option<Vec<RawShape>>,
    /// Of a member of a compound.
    pub position: Option<Triple>,
    pub rotation_degrees: Option<Triple>,
}

impl RawShape {
    /// The keys of all kinds, and whether they are given.
    pub fn given(&self) -> [(&'static str, bool); 16] {
        [
            ("radius", self.radius.is_some()),
            ("half_height", self.half_height.is_some()),
            ("half_extents", self.half_extents.is_some()),
            ("rounding", self.rounding.is_some()),
            ("thickness", self.thickness.is_some()),
            ("normal", self.normal.is_some()),
            ("points", self.points.is_some()),
            ("file", self.file.is_some()),
            ("scale", self.scale.is_some()),
            ("max_parts", self.max_parts.is_some()),
            ("one_sided", self.one_sided.is_some()),
            ("heights", self.heights.is_some()),
            ("size", self.size.is_some()),
            ("voxel_size", self.voxel_size.is_some()),
            ("cells", self.cells.is_some()),
            ("shapes", self.shapes.is_some()),
        ]
    }
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawDragger {
    pub body: String,
    pub pulls: String,
    #[serde(default)]
    pub point: Triple,
    pub keys: Vec<[f32; 4]>,
    pub radius: Option<f32>,
    pub frequency: Option<f32>,
    pub steady: Option<bool>,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawPath {
    pub points: Vec<Triple>,
    pub period: f32,
    pub kind: String,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawSpin {
    pub axis: Triple,
    pub degrees_per_second: f32,
}
