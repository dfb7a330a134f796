//! Stimuli: a touched place starts one cycle of the charts that travels over the body (section 4.4).
//!
//! At a vertex whose distance from the touched place is `d`, in lengths of the body, the signal arrives after `d/v` with the
//! amplitude `D^-d`. The length of the body is one number for all touches ([`super::geodesic::GeodesicMesh::length`]), so that
//! the same signal runs at the same speed wherever it starts.
//!
//! Several stimuli and the body's own cycle act together: their deformations have the same axes at a vertex, so they are
//! multiplied, which adds the logarithms of their rates in any order and keeps the volume where each does. Sums beyond the
//! limit of the charts are scaled back to it.

use super::chart_table::ChartTable;
use super::charts::{ChartsError, DeformationCharts};

/// Most stimuli under way at once. A further one takes the place of the oldest.
pub const MAX_STIMULI: usize = 16;

/// How a body answers stimuli.
#[derive(Clone, Debug, PartialEq)]
pub struct StimulusSettings {
    /// What each place does when the signal passes. Let it begin and end at 1, else it jumps there.
    pub charts: DeformationCharts,
    /// Propagation speed `v`, in lengths of the body a second; above 0.
    pub speed: f32,
    /// Damping magnitude `D`: over one length of the body the amplitude falls to 1/D; at least 1.
    pub damping: f32,
}

impl Default for StimulusSettings {
    fn default() -> Self {
        Self { charts: DeformationCharts::default(), speed: 1.0, damping: 2.0 }
    }
}

/// Why settings of stimuli cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StimulusError {
    /// The speed is not positive.
    #[error("the speed is {0}; it must be from 1e-3 to 1e6 lengths of the body a second")]
    Speed(f32),
    /// The damping is below 1.
    #[error("the damping is {0}; it must be from 1 (none) to 1e6")]
    Damping(f32),
    /// The charts are wrong.
    #[error(transparent)]
    Charts(#[from] ChartsError),
}

impl StimulusSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// A speed, damping or chart out of its range.
    pub fn check(&self) -> Result<(), StimulusError> {
        if !(1.0e-3..=1.0e6).contains(&self.speed) {
            return Err(StimulusError::Speed(self.speed));
        }
        if !(1.0..=1.0e6).contains(&self.damping) {
            return Err(StimulusError::Damping(self.damping));
        }
        Ok(self.charts.check()?)
    }
}

/// A signal under way.
#[derive(Clone, Debug)]
pub struct Stimulus {
    /// Seconds since the touch.
    pub elapsed: f64,
    /// Delay of each vertex, in seconds; infinite where the signal never comes.
    delays: Vec<f32>,
    /// Amplitude at each vertex.
    amplitudes: Vec<f32>,
    /// The latest delay.
    last: f32,
}

impl Stimulus {
    /// A signal that starts now, from the distances of the vertices in lengths of the body.
    pub fn new(distances: &[f32], speed: f32, damping: f32) -> Self {
        let delays: Vec<f32> = distances.iter().map(|d| d / speed).collect();
        let amplitude = |d: &f32| if d.is_finite() { damping.powf(-d) } else { 0.0 };
        let last = delays.iter().copied().filter(|d| d.is_finite()).fold(0.0, f32::max);
        Self { elapsed: 0.0, amplitudes: distances.iter().map(amplitude).collect(), delays, last }
    }

    /// The logarithms of the rates that it adds at a vertex, and 0 before it comes and after it has passed.
    pub fn logarithms(&self, vertex: usize, table: &ChartTable) -> [f32; 3] {
        let since = self.elapsed as f32 - self.delays[vertex];
        if !(0.0..table.cycle()).contains(&since) {
            return [0.0; 3];
        }
        table.at(since / table.cycle()).map(|l| l * self.amplitudes[vertex])
    }

    /// True when it has passed the last vertex.
    pub fn is_over(&self, table: &ChartTable) -> bool {
        self.elapsed >= f64::from(self.last + table.cycle())
    }

    /// When the signal comes to a vertex, in seconds after the touch, and the amplitude it has there.
    pub fn arrival(&self, vertex: usize) -> Option<(f32, f32)> {
        Some((*self.delays.get(vertex)?, *self.amplitudes.get(vertex)?))
    }
}
