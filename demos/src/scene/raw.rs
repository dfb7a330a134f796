//! A scene file as it is written, before anything is checked but its keys and types.

use serde::Deserialize;
use std::path::PathBuf;

pub(super) type Triple = [f32; 3];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScene {
    pub name: String,
    pub duration: f32,
    #[serde(default = "sixtieth")]
    pub dt: f32,
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
}

fn sixtieth() -> f32 {
    1.0 / 60.0
}

fn earth() -> Triple {
    [0.0, -9.81, 0.0]
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCamera {
    pub eye: Triple,
    pub target: Triple,
    #[serde(default = "forty")]
    pub fov_degrees: f32,
}

fn forty() -> f32 {
    40.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBody {
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
    pub colour: Option<Triple>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawObstacle {
    pub name: Option<String>,
    pub shape: RawShape,
    #[serde(default)]
    pub position: Triple,
    #[serde(default)]
    pub rotation_degrees: Triple,
    pub friction: Option<f32>,
    pub colour: Option<Triple>,
    pub opacity: Option<f32>,
    pub path: Option<RawPath>,
    pub spin: Option<RawSpin>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawShape {
    pub kind: String,
    pub radius: Option<f32>,
    pub half_height: Option<f32>,
    pub half_extents: Option<Triple>,
    pub file: Option<PathBuf>,
    pub scale: Option<f32>,
    pub max_parts: Option<u32>,
    pub thickness: Option<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawDragger {
    pub body: String,
    pub pulls: String,
    #[serde(default)]
    pub point: Triple,
    pub keys: Vec<[f32; 4]>,
    pub radius: Option<f32>,
    pub frequency: Option<f32>,
    pub steady: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPath {
    pub points: Vec<Triple>,
    pub period: f32,
    pub kind: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSpin {
    pub axis: Triple,
    pub degrees_per_second: f32,
}
