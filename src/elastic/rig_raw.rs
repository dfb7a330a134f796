//! A rig file as it is written, before anything is checked but its keys and types.

use serde::Deserialize;
use std::path::PathBuf;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawRig {
    pub mesh: PathBuf,
    pub softness: Option<f32>,
    pub local_threshold: Option<f32>,
    #[serde(default)]
    pub contact: RawContact,
    #[serde(default)]
    pub segment: Vec<RawSegment>,
    #[serde(default)]
    pub joint: Vec<RawJoint>,
    #[serde(default)]
    pub mass_spring_set: Vec<RawSet>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawContact {
    pub frequency: Option<f32>,
    pub damping_ratio: Option<f32>,
    pub restitution: Option<f32>,
    pub friction: Option<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSegment {
    pub name: String,
    pub bone: [[f32; 3]; 2],
    pub shape: RawShape,
    pub mass: Option<f32>,
    pub density: Option<f32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawShape {
    pub kind: String,
    pub radius: Option<f32>,
    pub half_extents: Option<[f32; 3]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawJoint {
    pub parent: String,
    pub child: String,
    pub anchor: [f32; 3],
    pub limit_degrees: Option<f32>,
    pub frequency: f32,
    pub damping_ratio: f32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSet {
    pub segment: String,
    #[serde(default)]
    pub also: Vec<String>,
    pub anchor: [f32; 3],
    pub radius: f32,
    pub frequency: Option<f32>,
    pub damping_ratio: Option<f32>,
    pub mass: Option<f32>,
    pub stiffness: Option<f32>,
    pub damping: Option<f32>,
}
