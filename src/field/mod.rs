//! Divergence-free vector fields and their path lines: pure functions, no state.
//!
//! Every field here is the curl of one potential (see [`curl_of_weighted_rotation`]); only the scalar weight differs.

mod certificate;
mod convex_hull;
mod curl;
mod hugging;
mod kernel;
mod part;
mod part_distance;
mod path_line;
mod signed_distance;
mod sphere;
mod spring;
mod wide;

pub use certificate::{Lipschitz, certified_steps, usual_steps};
pub use convex_hull::{ConvexHull, HullError};
pub use curl::curl_of_weighted_rotation;
pub use hugging::{HuggingField, Patch, Spread};
pub use kernel::{CollisionKernel, SpringKernel};
pub use part::{ConvexPart, PartShape, PlacedPart};
pub use path_line::{Integrator, path_line};
pub use sphere::SphereField;
pub use spring::SpringField;
pub use wide::{LANES, WideVec};
