//! Scenes: what is in a demo, read from TOML and checked; plain data without physics.

mod checks;
mod dragger;
mod find;
mod load;
mod raw;
mod types;

pub use dragger::{Dragger, Pulls};
pub use find::{FindError, find_scene, scene_names};
pub use load::load_scene;
pub use types::{Body, Camera, MAX_DT, MAX_DURATION, Obstacle, ObstaclePath, ObstacleShape, PathKind, Scene, Spin};
