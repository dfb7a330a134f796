//! The files that the program writes: surfaces, caches of positions, obstacles, measurements and pictures.
//!
//! Each is written beside its place and renamed when it is whole; after a failure what was there is still there.

mod body_mesh;
mod error;
mod metrics;
mod obstacles;
mod pc2;
mod picture;
mod soft_metrics;

pub use body_mesh::{body_file_names, write_body_mesh};
pub use error::OutputError;
pub use metrics::{METRICS_HEADER, MetricsRow, MetricsWriter};
pub use obstacles::{ConvexPart, OBSTACLES_HEADER, ObstacleWriter, write_obstacle_parts};
pub use pc2::{Pc2, Pc2Writer, read_pc2};
pub use picture::{picture_path, write_picture};
pub use soft_metrics::{SOFT_METRICS_HEADER, SoftMetricsRow};
