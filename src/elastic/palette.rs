//! The palette of one frame: for each segment a rigid motion and the fields that deform it, and the collision passes.
//!
//! This is everything that the deformation of a vertex depends on besides its rest data; a few kilobytes that the
//! vector unit of a processor or a compute pass reads alike (section 5.4).

use super::drag_stage::DragStage;
use crate::field::{HuggingField, Integrator, Lipschitz, SphereField, SpringField, usual_steps};
use crate::math::{Pose, Vec3};

/// A collision field: the part-hugging one, or the paper's with the bounding sphere.
#[derive(Clone, Debug, PartialEq)]
pub enum CollisionField {
    /// See [`HuggingField`].
    Hugging(HuggingField),
    /// See [`SphereField`].
    Sphere(SphereField),
}

impl CollisionField {
    /// Velocity at `x` and `t`.
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        match self {
            Self::Hugging(field) => field.velocity(x, t),
            Self::Sphere(field) => field.velocity(x, t),
        }
    }

    /// True where the field may move the point `x`, should nothing else move it.
    #[inline]
    pub fn reaches(&self, x: Vec3) -> bool {
        match self {
            Self::Hugging(field) => field.reaches(x),
            Self::Sphere(field) => field.reaches(x),
        }
    }

    /// False where the field surely leaves the point `x` alone: a quick test.
    #[inline]
    pub fn may_reach(&self, x: Vec3) -> bool {
        // While strengths are solved for, many fields are off.
        self.displacement() != Vec3::ZERO
            && match self {
                Self::Hugging(field) => field.patch_reaches(x),
                Self::Sphere(field) => field.reaches(x),
            }
    }

    /// The displacement `d` that the field gives its region of constant velocity.
    pub fn displacement(&self) -> Vec3 {
        match self {
            Self::Hugging(field) => field.d,
            Self::Sphere(field) => field.d,
        }
    }
}

impl Lipschitz for CollisionField {
    fn lipschitz(&self) -> f32 {
        match self {
            Self::Hugging(field) => field.lipschitz(),
            Self::Sphere(field) => field.lipschitz(),
        }
    }
}

/// Summed fields of one stage (section 5.1) with the step count that certifies the sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpringStage {
    /// The fields that are added up.
    pub fields: Vec<SpringField>,
    /// Integration steps.
    pub steps: u32,
}

impl SpringStage {
    /// A stage of `fields` with the integrator's default steps, fewer where the fields are weak, more where their
    /// Lipschitz bound asks for them (see [`usual_steps`]), and at most `max_steps`: past that every `q` is pulled back
    /// towards its `p` until the bound is met.
    pub fn certified(mut fields: Vec<SpringField>, integrator: Integrator, max_steps: u32) -> Self {
        let bound: f32 = fields.iter().map(Lipschitz::lipschitz).sum();
        let needed = usual_steps(bound, integrator.default_steps());
        if needed > max_steps {
            let pull = max_steps as f32 / needed as f32;
            for field in &mut fields {
                field.q = field.p + (field.q - field.p) * pull;
            }
        }
        Self { fields, steps: needed.min(max_steps).max(1) }
    }

    /// The sum of the fields.
    #[inline]
    pub fn velocity(&self, x: Vec3, t: f32) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for field in &self.fields {
            sum += field.velocity(x, t);
        }
        sum
    }
}

/// One entry of the palette: the rigid motion of a segment and its two stages of mass-spring fields.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentEntry {
    /// World from rest: `M_k` of equation (18).
    pub motion: Pose,
    /// Sum of the fields with small radii.
    pub local: SpringStage,
    /// Sum of the fields with large radii.
    pub global: SpringStage,
}

/// A collision field and the skin that it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentField {
    /// From 0 to 1 for each segment, how much of the field's velocity its skin takes; none where all skin takes all of it.
    pub shares: Box<[f32]>,
    /// The field.
    pub field: CollisionField,
    /// What the field leads out of: an index into a list of whoever placed it. The deformation does not look at it.
    pub owner: u32,
}

/// One pass of penetration cancellation: fields that are added up, each times the vertex's share in it. Passes are concatenated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CollisionPass {
    /// The fields of the pass.
    pub fields: Vec<SegmentField>,
    /// Integration steps.
    pub steps: u32,
}

/// All parameters of one body's deformation in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Palette {
    /// One entry a segment.
    pub segments: Vec<SegmentEntry>,
    /// Fields of the draggers, after the blend of the segments.
    pub drags: DragStage,
    /// Collision passes, concatenated in order.
    pub passes: Vec<CollisionPass>,
    /// Integration rule of all stages.
    pub integrator: Integrator,
}

impl Palette {
    /// The largest number of integration steps of any stage that has fields.
    pub fn most_steps(&self) -> u32 {
        let stage = |stage: &SpringStage| if stage.fields.is_empty() { 0 } else { stage.steps };
        let springs = self.segments.iter().map(|entry| stage(&entry.local).max(stage(&entry.global)));
        let drags = if self.drags.fields.is_empty() { 0 } else { self.drags.steps };
        springs.chain([drags]).chain(self.passes.iter().map(|pass| pass.steps)).max().unwrap_or(0)
    }
}
