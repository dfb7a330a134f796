//! The fields of draggers (figure 12): one stage of its own, between the springs and the collision passes.
//!
//! A dragger pulls at a point of the skin that is seen. Its field therefore acts after the blend of equation (18), as
//! collision fields do, on the share of the skin that belongs to the segments which move the held point. There the
//! weights sum to 1, so that one field alone carries its `p` to its `q` exactly, joints or not.

use wide::f32x8;

use super::rig::{MAX_INFLUENCES, SkinWeights};
use crate::field::{Integrator, LANES, Lipschitz, SpringField, WideVec, path_line, usual_steps};
use crate::math::Vec3;

/// Stands for no segment in [`DragField::segments`].
pub const NO_SEGMENT: u16 = u16::MAX;

/// The field of one dragger and the segments whose skin it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DragField {
    /// `p` is the held point before the drag, `q` where it is carried.
    pub field: SpringField,
    /// Segments that the held point belongs to, each once; [`NO_SEGMENT`] in what is left over.
    pub segments: [u16; MAX_INFLUENCES],
}

impl DragField {
    /// The field for a held point with these weights.
    pub fn new(field: SpringField, held: &SkinWeights) -> Self {
        let mut segments = [NO_SEGMENT; MAX_INFLUENCES];
        for k in 0..MAX_INFLUENCES {
            if held.weights[k] > 0.0 && !segments.contains(&held.segments[k]) {
                segments[k] = held.segments[k];
            }
        }
        Self { field, segments }
    }

    /// The share of a vertex that the field moves, 0 to 1.
    #[inline]
    pub fn weight_of(&self, skin: &SkinWeights) -> f32 {
        let mut sum = 0.0;
        for segment in self.segments {
            if segment != NO_SEGMENT {
                sum += skin.weight_of(segment);
            }
        }
        sum
    }
}

/// Summed fields of all draggers with the step count that certifies the sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DragStage {
    /// The fields that are added up.
    pub fields: Vec<DragField>,
    /// Integration steps.
    pub steps: u32,
}

impl DragStage {
    /// A stage of `fields`, with steps and with the pull back past `max_steps` as in [`super::SpringStage::certified`].
    pub fn certified(mut fields: Vec<DragField>, integrator: Integrator, max_steps: u32) -> Self {
        let bound: f32 = fields.iter().map(|drag| drag.field.lipschitz()).sum();
        let needed = usual_steps(bound, integrator.default_steps());
        if needed > max_steps {
            let pull = max_steps as f32 / needed as f32;
            for DragField { field, .. } in &mut fields {
                field.q = field.p + (field.q - field.p) * pull;
            }
        }
        Self { fields, steps: needed.min(max_steps).max(1) }
    }

    /// A certified stage in which every `p` arrives at its `q` although the fields overlap.
    ///
    /// The flow of a sum carries `p` farther or less far than its own field would. Each `q` is corrected by what its
    /// point misses, again and again. Where that does not converge (two draggers at one place that want different
    /// things), or where the certificate pulls back, the points end between. `held` has the weights at each `p`.
    pub fn meeting(fields: &[DragField], held: &[SkinWeights], integrator: Integrator, max_steps: u32) -> Self {
        let farthest = fields.iter().map(|drag| drag.field.p.distance(drag.field.q)).fold(0.0, f32::max);
        let mut aimed = fields.to_vec();
        let mut stage = Self::certified(aimed.clone(), integrator, max_steps);
        for _ in 0..if fields.len() > 1 { ROUNDS } else { 0 } {
            for ((aim, wanted), skin) in aimed.iter_mut().zip(fields).zip(held) {
                let SpringField { p, q, .. } = wanted.field;
                let missed = q - stage.flow(p, skin, integrator);
                aim.field.q = p + (aim.field.q + missed - p).clamp_length_max(FARTHEST * farthest);
            }
            stage = Self::certified(aimed.clone(), integrator, max_steps);
        }
        stage
    }

    /// Carries `x` through the stage. A point that no field can reach is returned as it is.
    #[inline]
    pub fn flow(&self, x: Vec3, skin: &SkinWeights, integrator: Integrator) -> Vec3 {
        if !self.fields.iter().any(|drag| drag.field.reaches(x) && drag.weight_of(skin) > 0.0) {
            return x;
        }
        path_line(x, integrator, self.steps, |x, t| {
            self.fields.iter().fold(Vec3::ZERO, |sum, drag| sum + drag.field.velocity(x, t) * drag.weight_of(skin))
        })
    }

    /// [`DragStage::flow`] of eight points.
    pub fn flow_wide(&self, x: [Vec3; LANES], skins: [&SkinWeights; LANES], integrator: Integrator) -> [Vec3; LANES] {
        let reached = |drag: &DragField| x.iter().any(|&x| drag.field.reaches(x));
        if !self.fields.iter().any(reached) {
            return x;
        }
        let weight = |drag: &DragField| f32x8::new(skins.map(|skin| drag.weight_of(skin)));
        let weights: smallvec::SmallVec<[f32x8; 8]> = self.fields.iter().map(weight).collect();
        let velocity = |x: WideVec, t| {
            self.fields
                .iter()
                .zip(&weights)
                .fold(WideVec::ZERO, |sum, (drag, weight)| sum + drag.field.velocity_wide(x, t).scaled(*weight))
        };
        path_line(WideVec::from_lanes(x), integrator, self.steps, velocity).to_lanes()
    }
}

/// Corrections of the fields that overlap: each leaves a fraction of the overlap's share of what was missed.
const ROUNDS: usize = 8;

/// No field is made stronger than this times the longest pull of all.
const FARTHEST: f32 = 2.0;
