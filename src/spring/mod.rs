//! Mass-spring sets: the few oscillators that steer all secondary motion (section 3.1 of the paper).

mod coefficients;
pub use coefficients::SpringCoefficients;
