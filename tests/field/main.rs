//! Properties of the vector fields and of their flows.

#[path = "../common/icosphere.rs"]
mod icosphere;
#[path = "../common/random.rs"]
mod random;

mod certificate;
mod difference;
mod divergence;
mod hugging;
mod hull;
mod kernel;
mod lipschitz;
mod paper;
mod parts;
mod path_line;
mod samples;
mod volume;
mod wide;
