//! What a step did, body by body.

use rapier3d::geometry::ColliderHandle;

use super::ElasticBodyHandle;
use crate::coupling::{ObstacleError, PenetrationFigures};

/// Why a body stands still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frozen {
    /// One of its rigid bodies was removed.
    ParentRemoved,
    /// One of its rigid bodies is disabled.
    ParentDisabled,
    /// A pose, a spring or a vertex is not finite.
    NotFinite,
}

/// What the last step did to one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyReport {
    /// Set where the body was left as it is. It goes on by itself once the reason is gone.
    pub frozen: Option<Frozen>,
    /// Volume of the skin over its volume at rest.
    pub volume_ratio: f32,
    /// Depths and gaps before and after the cancellation.
    pub penetration: PenetrationFigures,
    /// Deepest overlap with another elastic body, or of two segments of this one, that is left after the cancellation,
    /// along the line between their axes, as a fraction of the body's size.
    pub max_pair_depth: f32,
    /// Passes of the cancellation.
    pub passes: u32,
    /// Most integration steps of any stage.
    pub steps: u32,
}

/// Milliseconds that each stage of the last step took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimes {
    /// Mass-spring sets.
    pub springs: f32,
    /// Finding contacts, repelling impulses and cancellation.
    pub contact: f32,
    /// Deforming the skin by the spring fields, and its normals.
    pub deform: f32,
    /// Measuring depths, gaps and volumes.
    pub measure: f32,
}

/// What the last step did.
#[derive(Clone, Debug, Default)]
pub struct StepReport {
    /// One entry a body, in the order of the handles.
    pub bodies: Vec<(ElasticBodyHandle, BodyReport)>,
    /// Colliders near a body that were ignored because they have no convex parts.
    pub refused: Vec<(ColliderHandle, ObstacleError)>,
    /// Time taken.
    pub times: StageTimes,
}

impl StepReport {
    /// The entry of one body.
    pub fn body(&self, handle: ElasticBodyHandle) -> Option<&BodyReport> {
        self.bodies.iter().find(|(h, _)| *h == handle).map(|(_, report)| report)
    }
}
