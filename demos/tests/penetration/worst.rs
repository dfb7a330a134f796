//! The worst figures of a run, and where they were.

use std::fmt;

use pliant::coupling::{INSIDE, PIERCED, SMOOTH};
use pliant::world::BodyReport;

/// A value, and the frame in which a body had it.
#[derive(Clone, Debug, Default)]
pub struct Worst {
    /// The value.
    pub value: f32,
    /// Frame and body.
    pub place: String,
}

impl Worst {
    fn see(&mut self, value: f32, place: &str) {
        // A value that is not a number is worse than any.
        if value.is_nan() || value > self.value {
            *self = Self { value, place: place.to_owned() };
        }
    }
}

/// The worst of all bodies in all frames; lengths as fractions of the bodies' sizes.
#[derive(Clone, Debug, Default)]
pub struct WorstFigures {
    /// Rows: bodies times frames.
    pub rows: u32,
    /// Rows in which the cancellation did anything.
    pub cancelled: u32,
    /// Rows with more than four passes.
    pub many_passes: u32,
    /// Rows that do not meet what is asserted of each.
    pub bad: u32,
    /// Depth before the cancellation.
    pub before: Worst,
    /// Depth of a vertex after it.
    pub depth: Worst,
    /// Depth of a triangle after it.
    pub piercing: Worst,
    /// Gap at a contact.
    pub gap: Worst,
    /// Overlap of two elastic skins.
    pub pairs: Worst,
    /// Time coherence.
    pub coherence: Worst,
    /// Volume ratio, least and largest.
    pub volume: [f32; 2],
    /// Passes.
    pub passes: Worst,
    /// What was frozen, and why.
    pub frozen: Option<String>,
}

impl WorstFigures {
    /// Takes a row.
    pub fn see(&mut self, frame: u64, name: &str, report: &BodyReport) {
        let place = format!("frame {frame}, {name}");
        let figures = &report.penetration;
        self.rows += 1;
        self.cancelled += u32::from(report.passes > 0);
        self.many_passes += u32::from(report.passes > 4);
        self.before.see(figures.max_depth_before, &place);
        self.depth.see(figures.max_depth_after, &place);
        self.piercing.see(figures.max_piercing, &place);
        self.gap.see(figures.max_gap, &place);
        self.pairs.see(report.max_pair_depth, &place);
        let coherence = &figures.coherence;
        let change = format!(
            "{place}: vertex {} changed by {:.4}, motion {:.4}, {} passes",
            coherence.vertex, coherence.change, coherence.motion, report.passes
        );
        self.coherence.see(coherence.ratio, &change);
        self.passes.see(report.passes as f32, &place);
        if self.rows == 1 {
            self.volume = [report.volume_ratio; 2];
        }
        self.volume = [self.volume[0].min(report.volume_ratio), self.volume[1].max(report.volume_ratio)];
        let fits = figures.max_depth_after <= INSIDE
            && figures.max_piercing <= PIERCED
            && figures.max_gap <= GAP
            && report.max_pair_depth <= PAIRS
            && coherence.ratio <= SMOOTH
            && report.frozen.is_none();
        self.bad += u32::from(!fits);
        if let Some(frozen) = report.frozen {
            self.frozen.get_or_insert(format!("{place}: {frozen:?}"));
        }
    }

    /// What does not hold.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut holds = |name: &str, worst: &Worst, limit: f32| {
            if worst.value.is_nan() || worst.value > limit {
                faults.push(format!("{name} {:.4} above {limit} in {}", worst.value, worst.place));
            }
        };
        holds("depth", &self.depth, INSIDE);
        holds("piercing", &self.piercing, PIERCED);
        holds("gap", &self.gap, GAP);
        holds("overlap of skins", &self.pairs, PAIRS);
        holds("time coherence", &self.coherence, SMOOTH);
        if self.many_passes as f32 > MANY_PASSES * self.cancelled as f32 {
            faults.push(format!("more than 4 passes in {} of {} frames", self.many_passes, self.cancelled));
        }
        faults.extend(self.frozen.clone());
        faults
    }
}

/// Widest gap that may be left at a contact, as a fraction of the body's size.
const GAP: f32 = 5.0e-3;

/// Deepest overlap of two elastic skins that may be left, as a fraction of the body's size.
const PAIRS: f32 = 5.0e-3;

/// The share of cancellations that may take more than four passes.
const MANY_PASSES: f32 = 0.01;

impl fmt::Display for WorstFigures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} rows, {} bad, before {:.3}, depth {:.4}, piercing {:.4}, gap {:.4}, skins {:.4}, coherence {:.1}, volume {:.3} to {:.3}, passes at most {}, above 4 in {} of {}",
            self.rows,
            self.bad,
            self.before.value,
            self.depth.value,
            self.piercing.value,
            self.gap.value,
            self.pairs.value,
            self.coherence.value,
            self.volume[0],
            self.volume[1],
            self.passes.value,
            self.many_passes,
            self.cancelled,
        )
    }
}
