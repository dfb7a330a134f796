//! What one body meets in a step.

use rapier3d::parry::bounding_volume::Aabb;

use super::deformation_world::{Circumstances, ElasticBodyHandle};
use super::report::{BodyReport, Frozen};
use crate::coupling::{CancelReport, ObstaclePart, Proximity, TimeCoherence};
use crate::math::{Pose, Vec3};

/// What one body meets in this step.
pub(super) struct Encounter {
    pub handle: ElasticBodyHandle,
    pub frozen: Option<Frozen>,
    pub motions: Vec<Pose>,
    /// The same in the step before; empty in a body's first step and in the one after it was frozen.
    pub motions_before: Vec<Pose>,
    /// Everything that the skin may touch lies in here.
    pub region: Aabb,
    /// The convex parts of obstacles, then those of the interfaces with other elastic bodies and with itself.
    pub parts: Vec<ObstaclePart>,
    /// How many of the parts are obstacles.
    pub obstacles: usize,
    pub near: Vec<Proximity>,
    /// Stiffness of the whole body on its contacts in N/m.
    pub stiffness: f32,
    /// The skin before the cancellation.
    pub before: Vec<Vec3>,
    pub cancelled: CancelReport,
    /// Deepest overlap with another elastic body, or with itself, that is left, in metres.
    pub pair_depth: f32,
    /// How much the cancellation has changed since the last step.
    pub coherence: TimeCoherence,
    /// Nothing has changed since the last step: the skin stays as it is.
    pub settled: Option<BodyReport>,
    /// What to remember, where the mass-spring sets are at rest.
    pub circumstances: Option<Circumstances>,
}

impl Encounter {
    pub fn new(handle: ElasticBodyHandle, motions: Result<Vec<Pose>, Frozen>) -> Self {
        let (frozen, motions) = match motions {
            Ok(motions) => (None, motions),
            Err(frozen) => (Some(frozen), Vec::new()),
        };
        Self {
            handle,
            frozen,
            motions,
            motions_before: Vec::new(),
            region: Aabb::new_invalid(),
            parts: Vec::new(),
            obstacles: 0,
            near: Vec::new(),
            stiffness: f32::INFINITY,
            before: Vec::new(),
            cancelled: CancelReport::default(),
            pair_depth: 0.0,
            coherence: TimeCoherence::default(),
            settled: None,
            circumstances: None,
        }
    }

    /// How a segment has moved in the world since the step before, where that is known: exactly not at all for one that lies still.
    pub fn motion_of(&self, segment: usize) -> Option<Pose> {
        let (now, before) = (self.motions.get(segment)?, self.motions_before.get(segment)?);
        Some(if now == before { Pose::IDENTITY } else { *now * before.inverse() })
    }

    /// True where the skin has to be deformed in this step.
    pub fn is_active(&self) -> bool {
        self.frozen.is_none() && self.settled.is_none()
    }
}
