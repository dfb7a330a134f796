//! How good the outcome of a way to cancel is.

use super::cancel::{CancelReport, CancelSettings, WORTH_CLOSING};
use super::folds::count_folds;
use crate::elastic::{CollisionState, ElasticBody};

/// What is wrong with the outcome of a way; of two, the lower is the better one. What comes first counts first.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Grade {
    /// How many times the tolerance a depth or a gap is, or in the same proportion to its limit the change of the skin since the step before; 0 where
    /// nothing is worth another way.
    pub open: f32,
    /// Triangles turned over.
    pub folds: u32,
    /// Passes.
    pub passes: u32,
}

impl Grade {
    pub fn of(
        report: &CancelReport,
        pop: f32,
        body: &ElasticBody,
        start: &CollisionState,
        size: f32,
        settings: &CancelSettings,
    ) -> Self {
        let depth = report.left / (settings.depth_tolerance * size);
        let gap = report.gap / (settings.gap_tolerance * size);
        let open = depth.max(gap).max(pop * WORTH_CLOSING / CALM);
        Self {
            open: if open <= WORTH_CLOSING { 0.0 } else { open },
            folds: count_folds(body, start.positions(), size, TURNED),
            passes: report.passes,
        }
    }

    /// True where there is nothing wrong but, maybe, the number of passes.
    pub fn is_good(&self) -> bool {
        self.open <= 0.0 && self.folds == 0
    }
}

/// More passes than these are many.
pub(super) const MANY: u32 = 4;

/// Cosine of the angle by which a triangle has turned that is looked at for a fold.
const TURNED: f32 = 0.0;

/// A time coherence up to this one is calm: a little below [`SMOOTH`](super::SMOOTH), since what is measured later knows more of what the skin touches.
pub(super) const CALM: f32 = 7.5;
