//! Mass-spring sets: the few oscillators that steer all secondary motion (section 3.1 of the paper).

mod coefficients;
mod oscillator;
mod set;

pub use coefficients::SpringCoefficients;
pub use oscillator::Propagator;
pub use set::MassSpringSet;
