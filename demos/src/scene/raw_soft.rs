//! Bodies that move by themselves, water, cues and attachments as they are written in a scene file.

use pliant::procdef::GroundDescription;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

use super::raw::Triple;

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawSoftBody {
    pub name: String,
    pub rig: PathBuf,
    #[serde(default)]
    pub position: Triple,
    #[serde(default)]
    pub rotation_degrees: Triple,
    #[serde(default)]
    pub velocity: Triple,
    #[serde(default)]
    pub clock: f32,
    pub pace: Option<f32>,
    pub strength: Option<f32>,
    pub rise: Option<f32>,
    pub stiffness: Option<f32>,
    pub iterations: Option<u32>,
    pub ground: Option<GroundDescription>,
    pub colour: Option<Triple>,
    pub opacity: Option<f32>,
    pub crowd: Option<RawCrowd>,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawCrowd {
    pub count: u32,
    pub columns: [u32; 2],
    pub spacing: Triple,
    #[serde(default)]
    pub scatter: f32,
    #[serde(default)]
    pub turn_degrees: f32,
    #[serde(default)]
    pub tilt_degrees: f32,
    #[serde(default)]
    pub clock: f32,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawWater {
    pub min: Option<Triple>,
    pub max: Option<Triple>,
    #[serde(default)]
    pub flow: Triple,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawCue {
    pub body: String,
    pub time: f32,
    pub touch: Option<Triple>,
    pub pace: Option<f32>,
    pub strength: Option<f32>,
}

#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RawAttachment {
    pub body: String,
    pub centre: Triple,
    pub radius: f32,
    pub obstacle: Option<String>,
}
