//! The deformation of eight vertices at once: what [`super::deform`] does for one.

use wide::f32x8;

use super::palette::{CollisionField, CollisionPass, SpringStage};
use super::rig::SkinWeights;
use crate::field::{Integrator, LANES, WideVec, path_line};
use crate::math::Vec3;

impl SpringStage {
    /// [`SpringStage::flow`] of eight points.
    pub fn flow_wide(&self, x: [Vec3; LANES], integrator: Integrator) -> [Vec3; LANES] {
        if !self.fields.iter().any(|field| x.iter().any(|&x| field.reaches(x))) {
            return x;
        }
        let velocity = |x, t| self.fields.iter().fold(WideVec::ZERO, |sum, field| sum + field.velocity_wide(x, t));
        path_line(WideVec::from_lanes(x), integrator, self.steps, velocity).to_lanes()
    }
}

impl CollisionPass {
    /// [`CollisionPass::flow`] of eight points.
    pub fn flow_wide(&self, x: [Vec3; LANES], skins: [&SkinWeights; LANES], integrator: Integrator) -> [Vec3; LANES] {
        let mut active: smallvec::SmallVec<[(f32x8, &CollisionField); 8]> = smallvec::SmallVec::new();
        for entry in &self.fields {
            if !x.iter().any(|&x| entry.field.may_reach(x)) {
                continue;
            }
            let weights = skins.map(|skin| skin.share_of(&entry.shares));
            if weights.iter().any(|&weight| weight > 0.0) {
                active.push((f32x8::new(weights), &entry.field));
            }
        }
        if active.is_empty() {
            return x;
        }
        let velocity = |x: WideVec, t| {
            active.iter().fold(WideVec::ZERO, |sum, (weight, field)| sum + field.velocity_wide(x, t).scaled(*weight))
        };
        path_line(WideVec::from_lanes(x), integrator, self.steps, velocity).to_lanes()
    }
}

impl CollisionField {
    /// [`CollisionField::velocity`] of eight points.
    #[inline]
    pub fn velocity_wide(&self, x: WideVec, t: f32) -> WideVec {
        match self {
            Self::Hugging(field) => field.velocity_wide(x, t),
            Self::Sphere(field) => WideVec::from_lanes(x.to_lanes().map(|x| field.velocity(x, t))),
        }
    }
}
