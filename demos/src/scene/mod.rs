//! Scenes: what is in a demo, read from TOML and checked; plain data without physics.

mod checks;
mod dragger;
mod find;
mod load;
mod random;
mod raw;
mod raw_soft;
mod shape;
mod shape_types;
mod soft;
mod soft_types;
mod types;

pub use dragger::{Dragger, Pulls};
pub use find::{FindError, find_scene, scene_names};
pub use load::load_scene;
pub(crate) use random::Random;
pub use shape_types::{Member, ObstacleShape, Points, VoxelSource};
pub use soft_types::{Attachment, Cue, SoftBody, Water};
pub use types::{
    Body, Camera, Dynamic, MAX_DT, MAX_DURATION, MAX_SUBSTEPS, Obstacle, ObstacleMass, ObstaclePath, PathKind, Scene,
    Spin,
};
