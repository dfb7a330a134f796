//! The three deformation charts of a body: rates of stretching in the three directions of the orientation field.

use super::line_chart::{ChartError, ChartInterpolation, LineChart};
use std::ops::RangeInclusive;

/// Which charts are the user's, and which follow from the primary one so that `c1 c2 c3 = 1` (section 4.2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VolumeMode {
    /// All three charts are the user's.
    Free,
    /// `c2 = c3 = 1/√c1`: the paper's "adjusting both charts".
    #[default]
    Both,
    /// `c2 = 1/c1`, `c3 = 1`: the paper's "adjusting the secondary chart only".
    Secondary,
}

/// Why charts cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ChartsError {
    /// The cycle is not a time.
    #[error("the cycle takes {0} s; it must be from 0.001 to 1e6 s")]
    Cycle(f32),
    /// The limit of the rates is no limit.
    #[error("the largest rate is {0}; it must be above 1 and at most 100")]
    Limit(f32),
    /// A chart is wrong.
    #[error("{chart} chart: {source}")]
    Chart {
        /// `"primary"`, `"secondary"` or `"tertiary"`.
        chart: &'static str,
        /// What is wrong with it.
        source: ChartError,
    },
    /// A control point outside `[1/A, A]`.
    #[error("{chart} chart: control point {point} has the rate {rate}, outside [1/{limit}, {limit}]")]
    OutOfLimits {
        /// `"primary"`, `"secondary"` or `"tertiary"`.
        chart: &'static str,
        /// Index of the point, from 0.
        point: usize,
        /// Its rate.
        rate: f32,
        /// The limit `A`.
        limit: f32,
    },
}

/// The names of the charts, as rig files call them.
pub const CHART_NAMES: [&str; 3] = ["primary", "secondary", "tertiary"];

/// Three charts over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct DeformationCharts {
    /// Length of the cycle `T`, in seconds.
    pub cycle: f32,
    /// The limit `A` of the rates, above 1: they stay in `[1/A, A]`.
    pub limit: f32,
    /// Which charts follow from the primary one.
    pub volume: VolumeMode,
    /// The charts of the primary, secondary and tertiary direction.
    pub charts: [LineChart; 3],
}

impl Default for DeformationCharts {
    fn default() -> Self {
        Self { cycle: 1.0, limit: 2.0, volume: VolumeMode::default(), charts: Default::default() }
    }
}

impl DeformationCharts {
    /// Charts that keep the volume, by their primary chart `[phase, rate]`, with the limit 2.
    ///
    /// # Errors
    /// As [`LineChart::through`] and [`DeformationCharts::check`].
    pub fn volume_preserving(
        cycle: f32,
        volume: VolumeMode,
        primary: &[[f32; 2]],
        interpolation: ChartInterpolation,
    ) -> Result<Self, ChartsError> {
        let chart = LineChart::through(primary, interpolation)
            .map_err(|source| ChartsError::Chart { chart: CHART_NAMES[0], source })?;
        let charts = [chart, LineChart::default(), LineChart::default()];
        let charts = Self { cycle, volume, charts, ..Self::default() };
        charts.check().map(|()| charts)
    }

    /// The range of the rates, `[1/A, A]`.
    pub fn rates(&self) -> RangeInclusive<f32> {
        1.0 / self.limit..=self.limit
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// A cycle or limit out of range, a control point outside `[1/A, A]`.
    pub fn check(&self) -> Result<(), ChartsError> {
        if !(1.0e-3..=1.0e6).contains(&self.cycle) {
            return Err(ChartsError::Cycle(self.cycle));
        }
        if !(self.limit > 1.0 && self.limit <= 100.0) {
            return Err(ChartsError::Limit(self.limit));
        }
        // A rate written as 0.667 is meant to be within 1/1.5.
        let slack = 1.0 + 1.0e-3;
        let within = 1.0 / (self.limit * slack)..=self.limit * slack;
        for (chart, line) in CHART_NAMES.into_iter().zip(&self.charts) {
            if let Some(point) = line.points().iter().position(|p| !within.contains(&p.rate)) {
                let rate = line.points()[point].rate;
                return Err(ChartsError::OutOfLimits { chart, point, rate, limit: self.limit });
            }
        }
        Ok(())
    }

    /// The three rates at a phase of any size: 1 is one cycle.
    pub fn at(&self, phase: f32) -> [f32; 3] {
        self.logarithms(phase).map(f32::exp)
    }

    /// The natural logarithms of the three rates at a phase, within `±ln A`.
    pub fn logarithms(&self, phase: f32) -> [f32; 3] {
        let bound = self.limit.ln();
        let log = |k: usize| self.charts[k].rate(phase).ln().clamp(-bound, bound);
        let first = log(0);
        match self.volume {
            VolumeMode::Free => [first, log(1), log(2)],
            VolumeMode::Both => [first, -0.5 * first, -0.5 * first],
            VolumeMode::Secondary => [first, -first, 0.0],
        }
    }
}
