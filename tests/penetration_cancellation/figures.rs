//! What is measured of a cancelled body.

use pliant::coupling::{
    CancelReport, CancelSettings, INSIDE, PIERCED, PenetrationFigures, cancel, count_folds, measure,
};
use pliant::elastic::CollisionPass;
use pliant::math::Vec3;
use pliant::mesh::measure::signed_volume;

use crate::poses::Case;

/// Lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Depths and gaps.
    pub penetration: PenetrationFigures,
    pub passes: u32,
    /// Change of the volume, as a fraction.
    pub volume: f32,
    /// The same less that of the exact flow.
    pub drift: f32,
    /// Triangles turned over against the flow.
    pub folded: u32,
    pub finite: bool,
}

/// Cancels a case, and measures what came out. The exact flow costs eight times as much: only where `exact` is true.
pub fn cancelled(case: &mut Case, settings: &CancelSettings, exact: bool) -> (Figures, CancelReport) {
    let mut twin = case.body.clone();
    let triangles = &case.body.rig().mesh.triangles.clone();
    let before = signed_volume(case.body.positions(), triangles);
    let change = |positions: &[Vec3]| (signed_volume(positions, triangles) / before - 1.0) as f32;
    let report = cancel(&mut case.body, &case.parts, &case.near, case.size, settings);
    let volume = change(case.body.positions());
    let folded = count_folds(&case.body, twin.positions(), case.size, TURNED);
    let mut drift = 0.0;
    if exact {
        for pass in &case.body.palette().passes {
            twin.deform_collision(CollisionPass { steps: EXACT * pass.steps, ..pass.clone() });
        }
        drift = volume - change(twin.positions());
    }
    let figures = Figures {
        penetration: measure(&case.body, &case.parts, case.size, &report),
        passes: report.passes,
        volume,
        drift,
        folded,
        finite: case.body.is_finite(),
    };
    (figures, report)
}

/// With this many times the steps a flow counts as exact: the midpoint rule is then 64 times as exact.
const EXACT: u32 = 8;

/// Triangles that turned by more than 60 degrees are looked at for folds.
const TURNED: f32 = 0.5;

/// What is asserted of every pose.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub depth: f32,
    pub piercing: f32,
    pub gap: f32,
    /// Drift of the numbers off the exact flow's volume.
    pub drift: f32,
    /// Change of the volume altogether.
    pub volume: f32,
}

impl Limits {
    /// Of one rigid obstacle. The volume of a body of several segments is not bounded: where the skin is shared, fields
    /// are blended.
    pub const ONE: Self = Self { depth: INSIDE, piercing: PIERCED, gap: 5e-3, drift: 1e-3, volume: 1e-2 };
}

impl Figures {
    /// What does not hold, in words.
    pub fn faults(&self, limits: &Limits, one_segment: bool) -> Vec<String> {
        let p = &self.penetration;
        let mut faults = Vec::new();
        let mut holds = |name: &str, value: f32, limit: f32| {
            if value.is_nan() || value > limit {
                faults.push(format!("{name} {value:.4}"));
            }
        };
        holds("depth", p.max_depth_after, limits.depth);
        holds("piercing", p.max_piercing, limits.piercing);
        holds("gap", p.max_gap, limits.gap);
        holds("drift", self.drift.abs(), limits.drift);
        holds("folded", self.folded as f32, 0.0);
        holds("not finite", if self.finite { 0.0 } else { 1.0 }, 0.5);
        if one_segment {
            holds("volume", self.volume.abs(), limits.volume);
        }
        faults
    }
}
