//! The deformation of one vertex: equation (18), then the collision passes. `deform.wgsl` is the twin of this file.

use super::palette::{CollisionPass, Palette, SpringStage};
use super::rig::{MAX_INFLUENCES, SkinWeights};
use crate::field::{Integrator, path_line};
use crate::math::Vec3;

impl Palette {
    /// Deforms the rest position `x` of a vertex: springs, then collisions.
    #[inline]
    pub fn deform(&self, x: Vec3, skin: &SkinWeights) -> Vec3 {
        self.collide(self.spring(x, skin), skin)
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

impl SpringStage {
    /// Carries `x` through the stage. A point that no field can reach is returned as it is.
    #[inline]
    pub fn flow(&self, x: Vec3, integrator: Integrator) -> Vec3 {
        if !self.fields.iter().any(|field| field.reaches(x)) {
            return x;
        }
        path_line(x, integrator, self.steps, |x, t| self.velocity(x, t))
    }
}

impl CollisionPass {
    /// Carries `x` through the pass: its velocity is the sum of the fields, each times the vertex's weight for the
    /// field's segment.
    #[inline]
    pub fn flow(&self, x: Vec3, skin: &SkinWeights, integrator: Integrator) -> Vec3 {
        if !self.fields.iter().any(|entry| skin.weight_of(entry.segment) > 0.0) {
            return x;
        }
        path_line(x, integrator, self.steps, |x, t| {
            let mut sum = Vec3::ZERO;
            for entry in &self.fields {
                let weight = skin.weight_of(entry.segment);
                if weight > 0.0 {
                    sum += entry.field.velocity(x, t) * weight;
                }
            }
            sum
        })
    }
}

impl SkinWeights {
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
}
