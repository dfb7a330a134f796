//! A line chart: a rate of stretching over one cycle, through control points that can be moved.

use std::ops::RangeInclusive;

/// Control points nearer to each other than this share of the cycle are one.
const SAME_PHASE: f32 = 1.0e-4;

/// How a chart runs between its control points. Neither leaves the range of the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChartInterpolation {
    /// Straight lines, as in the paper.
    #[default]
    Linear,
    /// A periodic monotone cubic (Fritsch and Carlson 1980): once differentiable, no overshoot.
    Smooth,
}

/// A control point of a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChartPoint {
    /// Where in the cycle, in [0, 1).
    pub phase: f32,
    /// Rate of stretching: below 1 contracts, above 1 expands.
    pub rate: f32,
}

/// Why a chart cannot be what it was asked to be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ChartError {
    /// No control point.
    #[error("a chart needs at least one control point")]
    Empty,
    /// A phase outside the cycle.
    #[error("control point {point} has the phase {phase}; phases go from 0 to below 1")]
    Phase {
        /// Index of the point, from 0.
        point: usize,
        /// Its phase.
        phase: f32,
    },
    /// A rate that is not positive and finite.
    #[error("control point {point} has the rate {rate}; rates are above 0 and finite")]
    Rate {
        /// Index of the point, from 0.
        point: usize,
        /// Its rate.
        rate: f32,
    },
    /// Phases that do not ascend.
    #[error("control point {point} at phase {phase} does not come after the one before; phases must ascend")]
    Order {
        /// Index of the point, from 0.
        point: usize,
        /// Its phase.
        phase: f32,
    },
    /// No such control point.
    #[error("there is no control point {point}; the chart has {count}")]
    NoPoint {
        /// The index.
        point: usize,
        /// Number of points.
        count: usize,
    },
}

/// A periodic chart through at least one control point.
#[derive(Clone, Debug, PartialEq)]
pub struct LineChart {
    points: Vec<ChartPoint>,
    /// How it runs between the points.
    pub interpolation: ChartInterpolation,
}

impl Default for LineChart {
    fn default() -> Self {
        Self::constant(1.0)
    }
}

impl LineChart {
    /// A chart of one control point.
    pub fn constant(rate: f32) -> Self {
        Self { points: vec![ChartPoint { phase: 0.0, rate }], interpolation: ChartInterpolation::default() }
    }

    /// A chart through points `[phase, rate]` in ascending order of phase.
    ///
    /// # Errors
    /// No points, a phase outside [0, 1), a rate that is not positive and finite, phases that do not ascend.
    pub fn through(points: &[[f32; 2]], interpolation: ChartInterpolation) -> Result<Self, ChartError> {
        if points.is_empty() {
            return Err(ChartError::Empty);
        }
        for (point, &[phase, rate]) in points.iter().enumerate() {
            if !(0.0..1.0).contains(&phase) {
                return Err(ChartError::Phase { point, phase });
            }
            if !(rate > 0.0 && rate.is_finite()) {
                return Err(ChartError::Rate { point, rate });
            }
            if point > 0 && phase - points[point - 1][0] < SAME_PHASE {
                return Err(ChartError::Order { point, phase });
            }
        }
        let points = points.iter().map(|&[phase, rate]| ChartPoint { phase, rate }).collect();
        Ok(Self { points, interpolation })
    }

    /// The control points, in order.
    pub fn points(&self) -> &[ChartPoint] {
        &self.points
    }

    /// Adds a control point and tells its index. One at the same phase is replaced; phases are taken modulo 1.
    ///
    /// # Errors
    /// A phase or rate that is not finite, or a rate that is not positive.
    pub fn add(&mut self, phase: f32, rate: f32) -> Result<usize, ChartError> {
        let point = self.points.len();
        if !phase.is_finite() {
            return Err(ChartError::Phase { point, phase });
        }
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(ChartError::Rate { point, rate });
        }
        let phase = wrap(phase);
        let at = self.points.partition_point(|p| p.phase < phase);
        for near in [at.wrapping_sub(1), at] {
            if self.points.get(near).is_some_and(|p| (p.phase - phase).abs() < SAME_PHASE) {
                self.points[near].rate = rate;
                return Ok(near);
            }
        }
        self.points.insert(at, ChartPoint { phase, rate });
        Ok(at)
    }

    /// Moves a control point. It stays between its neighbours and in `rates`, as when it is dragged.
    ///
    /// # Errors
    /// There is no such point, or the place is not finite.
    pub fn drag(
        &mut self,
        point: usize,
        phase: f32,
        rate: f32,
        rates: RangeInclusive<f32>,
    ) -> Result<ChartPoint, ChartError> {
        self.exists(point)?;
        if !phase.is_finite() {
            return Err(ChartError::Phase { point, phase });
        }
        if !rate.is_finite() {
            return Err(ChartError::Rate { point, rate });
        }
        let least = if point == 0 { 0.0 } else { self.points[point - 1].phase + 2.0 * SAME_PHASE };
        let most = self.points.get(point + 1).map_or(1.0, |p| p.phase) - 2.0 * SAME_PHASE;
        let moved = ChartPoint { phase: phase.min(most).max(least), rate: rate.min(*rates.end()).max(*rates.start()) };
        self.points[point] = moved;
        Ok(moved)
    }

    /// Removes a control point.
    ///
    /// # Errors
    /// There is no such point, or it is the last.
    pub fn remove(&mut self, point: usize) -> Result<(), ChartError> {
        self.exists(point)?;
        if self.points.len() == 1 {
            return Err(ChartError::Empty);
        }
        self.points.remove(point);
        Ok(())
    }

    fn exists(&self, point: usize) -> Result<(), ChartError> {
        let count = self.points.len();
        if point < count { Ok(()) } else { Err(ChartError::NoPoint { point, count }) }
    }

    /// The rate at a phase of any size; the chart repeats after 1.
    pub fn rate(&self, phase: f32) -> f32 {
        let n = self.points.len();
        let phase = wrap(phase);
        let after = self.points.partition_point(|p| p.phase <= phase);
        let (a, b) = ((after + n - 1) % n, after % n);
        if a == b {
            return self.points[a].rate;
        }
        let length = self.step(a);
        let u = (wrap(phase - self.points[a].phase) / length).clamp(0.0, 1.0);
        let (ra, rb) = (self.points[a].rate, self.points[b].rate);
        match self.interpolation {
            ChartInterpolation::Linear => ra + u * (rb - ra),
            ChartInterpolation::Smooth => {
                let (ma, mb) = (self.slope(a) * length, self.slope(b) * length);
                let (u2, u3) = (u * u, u * u * u);
                let curve = ra * (2.0 * u3 - 3.0 * u2 + 1.0)
                    + rb * (3.0 * u2 - 2.0 * u3)
                    + ma * (u3 - 2.0 * u2 + u)
                    + mb * (u3 - u2);
                // The cubic is monotone; the bounds take away rounding.
                curve.clamp(ra.min(rb), ra.max(rb))
            }
        }
    }

    /// From point `a` to the next, in cycles.
    fn step(&self, a: usize) -> f32 {
        let b = (a + 1) % self.points.len();
        let step = self.points[b].phase - self.points[a].phase;
        if step > 0.0 { step } else { step + 1.0 }
    }

    /// The slope at a point: the weighted harmonic mean of the slopes beside it, 0 at a peak (Fritsch and Butland 1984).
    fn slope(&self, point: usize) -> f32 {
        let n = self.points.len();
        let before = (point + n - 1) % n;
        let (h0, h1) = (self.step(before), self.step(point));
        let d0 = (self.points[point].rate - self.points[before].rate) / h0;
        let d1 = (self.points[(point + 1) % n].rate - self.points[point].rate) / h1;
        if d0 * d1 <= 0.0 {
            return 0.0;
        }
        let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
        (w0 + w1) / (w0 / d0 + w1 / d1)
    }
}

/// The fraction of a phase, in [0, 1).
pub(super) fn wrap(phase: f32) -> f32 {
    let fraction = phase - phase.floor();
    // Just below zero rounds up to one.
    if fraction < 1.0 { fraction } else { 0.0 }
}
