//! Charts sampled over one cycle, so that a thousand vertices read them in microseconds.

use super::charts::{DeformationCharts, VolumeMode};
use super::line_chart::wrap;

/// Samples of a cycle. Between them the logarithms of the rates are linear: a kink of a chart is blunted over 1/1024 of the
/// cycle.
pub const CHART_SAMPLES: usize = 1024;

/// The logarithms of three charts, sampled.
#[derive(Clone, Debug)]
pub struct ChartTable {
    /// One more than there are samples: the first again, so that a sample and the next are always there.
    rows: Vec<[f32; 3]>,
    cycle: f32,
    bound: f32,
    volume: VolumeMode,
}

impl ChartTable {
    /// Samples charts.
    pub fn new(charts: &DeformationCharts) -> Self {
        let rows = (0..=CHART_SAMPLES).map(|i| charts.logarithms(i as f32 / CHART_SAMPLES as f32)).collect();
        Self { rows, cycle: charts.cycle, bound: charts.limit.ln(), volume: charts.volume }
    }

    /// The cycle in seconds.
    pub fn cycle(&self) -> f32 {
        self.cycle
    }

    /// `ln A`: no logarithm of a rate is farther from 0.
    pub fn bound(&self) -> f32 {
        self.bound
    }

    /// How the charts keep the volume.
    pub fn volume(&self) -> VolumeMode {
        self.volume
    }

    /// The logarithm of the primary rate at a phase in [0, 2]; the cycle repeats at 1. The fast way for many vertices.
    pub fn primary(&self, phase: f32) -> f32 {
        let place = phase * CHART_SAMPLES as f32;
        // A negative phase or none becomes 0.
        let row = place as usize;
        let u = place - row as f32;
        let row = row % CHART_SAMPLES;
        let (a, b) = (self.rows[row][0], self.rows[row + 1][0]);
        a + u * (b - a)
    }

    /// The logarithms at a phase of any size.
    pub fn at(&self, phase: f32) -> [f32; 3] {
        let place = wrap(phase) * CHART_SAMPLES as f32;
        // Not a number for a phase that is none; the cast then gives 0.
        let row = (place as usize).min(CHART_SAMPLES - 1);
        let u = place - row as f32;
        let (a, b) = (self.rows[row], self.rows[row + 1]);
        [a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]), a[2] + u * (b[2] - a[2])]
    }
}

/// Logarithms of rates brought within `±bound`: all three by one factor, so that a sum of 0, a kept volume, stays 0.
pub fn limited(logs: [f32; 3], bound: f32) -> [f32; 3] {
    let largest = logs.iter().fold(0.0f32, |m, l| m.max(l.abs()));
    if largest > bound { logs.map(|l| l * (bound / largest)) } else { logs }
}
