//! A pose as a scene file: the body held still, the obstacles fixed. `pliant run FILE` shows it.

use std::path::{Path, PathBuf};

use glam::EulerRot;
use pliant::math::Pose;

use crate::kinds::Placed;

#[allow(dead_code)] // the program's reader asks more of these structures than is needed to write them
#[path = "../../demos/src/scene/raw.rs"]
mod raw;
#[allow(dead_code)] // the same
#[path = "../../demos/src/scene/raw_soft.rs"]
mod raw_soft;

use raw::{RawBody, RawCamera, RawObstacle, RawScene};

pub use raw::RawShape;

impl RawShape {
    pub fn of_kind(kind: &str) -> Self {
        Self { kind: kind.into(), ..Self::default() }
    }

    /// A round shape along y.
    pub fn along(kind: &str, half_height: f32, radius: f32) -> Self {
        Self { half_height: Some(half_height), radius: Some(radius), ..Self::of_kind(kind) }
    }
}

/// Writes the scene of a body of a rig file at `pose` among `obstacles`; gives back its path.
pub fn write_scene(name: &str, rig: &Path, pose: Pose, size: f32, obstacles: &[Placed]) -> PathBuf {
    let centre = pose.translation;
    let obstacle = |placed: &Placed| {
        let (position, rotation_degrees) = place(placed.pose);
        RawObstacle {
            shape: placed.shape.raw.clone(),
            position,
            rotation_degrees,
            opacity: Some(0.5),
            ..Default::default()
        }
    };
    let (position, rotation_degrees) = place(pose);
    let scene = RawScene {
        name: name.into(),
        duration: 1.0,
        dt: 1.0 / 60.0,
        substeps: 1,
        gravity: [0.0; 3],
        softness: None,
        camera: RawCamera {
            eye: (centre + size * glam::Vec3::new(2.0, 1.5, 4.0)).to_array(),
            target: centre.to_array(),
            fov_degrees: 40.0,
        },
        body: vec![RawBody {
            name: "body".into(),
            rig: rig.into(),
            position,
            rotation_degrees,
            held: true,
            ..Default::default()
        }],
        obstacle: obstacles.iter().map(obstacle).collect(),
        dragger: Vec::new(),
        soft_body: Vec::new(),
        water: Vec::new(),
        cue: Vec::new(),
        attachment: Vec::new(),
    };
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.toml"));
    let text = toml::to_string(&scene).expect("plain data");
    std::fs::write(&path, text).expect("the tests' folder can be written");
    path
}

/// Position and angles in degrees, as scene files give them.
fn place(pose: Pose) -> ([f32; 3], [f32; 3]) {
    let (x, y, z) = pose.rotation.to_euler(EulerRot::XYZ);
    (pose.translation.to_array(), [x, y, z].map(f32::to_degrees))
}
