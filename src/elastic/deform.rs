//! The deformation of one vertex: equation (18), then the drag stage, then the collision passes. `deform.wgsl` is the twin of this file.

use smallvec::SmallVec;

use super::palette::{CollisionField, CollisionPass, Palette, SegmentField, SpringStage};
use super::rig::{MAX_INFLUENCES, SkinWeights};
use crate::field::{Integrator, path_line};
use crate::math::Vec3;

impl Palette {
    /// Deforms the rest position `x` of a vertex: springs, then draggers, then collisions.
    #[inline]
    pub fn deform(&self, x: Vec3, skin: &SkinWeights) -> Vec3 {
        self.collide(self.drags.flow(self.spring(x, skin), skin, self.integrator), skin)
    }

    /// Equation (18) with the local and the global stage: `x' = Σ w_k d_k(M_k x)`. Pairs of weight zero are skipped.
    #[inline]
    pub fn spring(&self, x: Vec3, skin: &SkinWeights) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for k in 0..MAX_INFLUENCES {
            let weight = skin.weights[k];
            if weight > 0.0 {
                let entry = &self.segments[usize::from(skin.segments[k])];
                let moved = entry.motion.transform_point(x);
                let local = entry.local.flow(moved, self.integrator);
                sum += entry.global.flow(local, self.integrator) * weight;
            }
        }
        sum
    }

    /// The concatenated collision passes, applied to a position in the world.
    #[inline]
    pub fn collide(&self, x: Vec3, skin: &SkinWeights) -> Vec3 {
        self.passes.iter().fold(x, |x, pass| pass.flow(x, skin, self.integrator))
    }
}

/// Fields that move one vertex, few enough to stay off the heap.
type Active<'a, F> = SmallVec<[(f32, &'a F); 8]>;

impl SpringStage {
    /// Carries `x` through the stage. A point that no field can reach is returned as it is: then it never moves.
    #[inline]
    pub fn flow(&self, x: Vec3, integrator: Integrator) -> Vec3 {
        if !self.fields.iter().any(|field| field.reaches(x)) {
            return x;
        }
        path_line(x, integrator, self.steps, |x, t| self.velocity(x, t))
    }
}

impl CollisionPass {
    /// Carries `x` through the pass: its velocity is the sum of the fields, each times the vertex's share in it.
    #[inline]
    pub fn flow(&self, x: Vec3, skin: &SkinWeights, integrator: Integrator) -> Vec3 {
        let weigh = |entry: &'_ SegmentField| skin.share_of(&entry.shares);
        let weighted = self.fields.iter().map(|entry| (weigh(entry), &entry.field));
        let active: Active<'_, CollisionField> = weighted.filter(|(weight, _)| *weight > 0.0).collect();
        if !active.iter().any(|(_, field)| field.reaches(x)) {
            return x;
        }
        path_line(x, integrator, self.steps, |x, t| {
            active.iter().fold(Vec3::ZERO, |sum, (weight, field)| sum + field.velocity(x, t) * *weight)
        })
    }
}

impl SkinWeights {
    /// The segment that has the largest share; the first of several.
    pub fn heaviest(&self) -> u16 {
        let mut best = 0;
        for k in 1..MAX_INFLUENCES {
            if self.weights[k] > self.weights[best] {
                best = k;
            }
        }
        self.segments[best]
    }

    /// The weight of a segment for this vertex, 0 where it has none.
    #[inline]
    pub fn weight_of(&self, segment: u16) -> f32 {
        let mut sum = 0.0;
        for k in 0..MAX_INFLUENCES {
            if self.segments[k] == segment {
                sum += self.weights[k];
            }
        }
        sum
    }

    /// The vertex's share in a field that gives each segment a share: all of it where there are none.
    #[inline]
    pub fn share_of(&self, shares: &[f32]) -> f32 {
        if shares.is_empty() {
            return 1.0;
        }
        let share = |k: usize| self.weights[k] * shares.get(usize::from(self.segments[k])).copied().unwrap_or(0.0);
        (0..MAX_INFLUENCES).map(share).sum()
    }
}
