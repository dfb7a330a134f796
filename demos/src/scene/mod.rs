//! Scenes: what is in a demo, read from TOML and checked; plain data without physics.

mod checks;
mod dragger;
mod find;
mod load;
mod raw;
mod shape;
mod shape_types;
mod types;

pub use dragger::{Dragger, Pulls};
pub use find::{FindError, find_scene, scene_names};
pub use load::load_scene;
pub use shape_types::{Member, ObstacleShape, Points, VoxelSource};
pub use types::{
    Body, Camera, Dynamic, MAX_DT, MAX_DURATION, Obstacle, ObstacleMass, ObstaclePath, PathKind, Scene, Spin,
};
