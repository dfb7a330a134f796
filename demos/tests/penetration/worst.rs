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
    pub fn faults(&self, limits: &Limits) -> Vec<String> {
        let mut faults = Vec::new();
        let mut holds = |name: &str, worst: &Worst, limit: f32| {
            if worst.value.is_nan() || worst.value > limit {
                faults.push(format!("{name} {:.4} above {limit} in {}", worst.value, worst.place));
            }
        };
        holds("depth", &self.depth, limits.depth);
        holds("piercing", &self.piercing, limits.piercing);
        holds("gap", &self.gap, limits.gap);
        holds("overlap of skins", &self.pairs, limits.pairs);
        holds("time coherence", &self.coherence, limits.coherence);
        if self.many_passes as f32 > limits.many_passes * self.cancelled as f32 {
            faults.push(format!("more than 4 passes in {} of {} frames", self.many_passes, self.cancelled));
        }
        faults.extend(self.frozen.clone());
        faults
    }
}

/// What is asserted of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub depth: f32,
    pub piercing: f32,
    pub gap: f32,
    pub pairs: f32,
    pub coherence: f32,
    pub many_passes: f32,
}

impl Limits {
    /// What is aimed at everywhere.
    pub const AIM: Self =
        Self { depth: INSIDE, piercing: PIERCED, gap: GAP, pairs: PAIRS, coherence: SMOOTH, many_passes: MANY_PASSES };

    /// What is asserted of one scene: the aim, or what was measured where it is not reached yet, and a half more. These
    /// numbers may only become smaller; `docs/penetration.md` says why they are there. The shares of many passes are those of the
    /// first 120 frames, in which the bodies land.
    pub fn of(scene: &str) -> Self {
        match scene {
            // Of four starts at random one lands with a leg between two bars, where neither the leg nor the bars give way. The skin of the leg
            // is held off by up to 7.5 % in four frames. In another, in one frame, legs are so tangled that skins overlap by 3.2 %.
            "tower starts" => Self { gap: 0.11, pairs: 0.048, many_passes: 0.12, ..Self::AIM },
            // A bean and a ball press each other into a corner: gaps that one leaves at the walls are closed in further passes, 6 of 419.
            "corners" => Self { many_passes: 0.022, ..Self::AIM },
            // Twelve planks stand around: 5 of 90.
            "funnel" => Self { many_passes: 0.06, ..Self::AIM },
            // Bodies land on tips: 10 of 272. In frame 159 of the whole scene a gap of 0.513 % is left.
            "spikes" => Self { gap: 5.5e-3, many_passes: 0.05, ..Self::AIM },
            // Meshes of others: a leg or a horn comes through the ring, or is caught by it, from one frame to the next.
            "spot in a ring" => Self { gap: 0.01, coherence: 22.4, many_passes: 0.019, ..Self::AIM },
            // Ears and trunk of the head's skin fold around an arm: a plane cannot part them well. Since they do not overlap any more (by up
            // to 32 % before), skin is held off by 4.1 % in one frame (2.4 % before).
            "elephant ragdoll in the tower" => {
                Self { piercing: 0.012, gap: 0.062, coherence: 17.0, many_passes: 0.08, ..Self::AIM }
            }
            _ => Self::AIM,
        }
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
