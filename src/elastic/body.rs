//! The state of one elastic body: where its segments are, how its mass-spring sets swing, what its skin looks like.

use std::sync::Arc;

use rayon::prelude::*;

use super::body_draggers::Draggers;
use super::body_normals::{BodyNormals, Normals};
use super::palette::{Palette, SegmentEntry, SpringStage};
use super::rest::SegmentSkin;
use super::rig::{ElasticRig, MAX_INFLUENCES, MassSpringSetRig, SkinWeights};
use super::skin_order::SkinOrder;
use crate::field::{Integrator, LANES, SpringField};
use crate::math::{Pose, Vec3};
use crate::spring::MassSpringSet;

/// How a body is deformed; each has a sensible default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeformSettings {
    /// Integration rule of the path lines.
    pub integrator: Integrator,
    /// Most integration steps of one stage; past them the displacements are pulled back.
    pub max_steps: u32,
    /// Acceleration that pulls at the free masses, in m/s² (zero: the rest shape is the shape under gravity).
    pub gravity: Vec3,
    /// Largest displacement of a mass-spring set as a fraction of its radius of influence.
    pub displacement_limit: f32,
    /// Viewer and threshold of the level of detail: a set is used only if `r_o > threshold · distance` (section 3.6).
    pub level_of_detail: Option<LevelOfDetail>,
    /// How the normals are found.
    pub normals: Normals,
    /// False: the skin follows the rigid bodies alone.
    pub enabled: bool,
}

impl Default for DeformSettings {
    fn default() -> Self {
        Self {
            integrator: Integrator::Midpoint,
            max_steps: 24,
            gravity: Vec3::ZERO,
            displacement_limit: 0.5,
            level_of_detail: None,
            normals: Normals::Triangles,
            enabled: true,
        }
    }
}

/// Who looks, and how much detail they get (section 3.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelOfDetail {
    /// Where the viewer is.
    pub viewer: Vec3,
    /// Sets with `r_o ≤ threshold · distance` are left out.
    pub threshold: f32,
}

impl LevelOfDetail {
    /// True where a set of this radius, anchored at `p`, is worth its cost.
    pub fn keeps(&self, p: Vec3, radius: f32) -> bool {
        radius > self.threshold * p.distance(self.viewer)
    }
}

/// One elastic body. Rest data is shared; this is only what changes.
#[derive(Clone, Debug)]
pub struct ElasticBody {
    rig: Arc<ElasticRig>,
    skins: Arc<[SegmentSkin]>,
    motions: Vec<Pose>,
    sets: Vec<MassSpringSet>,
    pub(super) palette: Palette,
    pub(super) draggers: Draggers,
    pub(super) positions: Vec<Vec3>,
    normals: BodyNormals,
    order: Arc<SkinOrder>,
    /// Scratch for the results of batches.
    moved: Vec<[Vec3; LANES]>,
    /// How the body is deformed.
    pub settings: DeformSettings,
}

impl ElasticBody {
    /// A body of this rig, at rest where the rig was modelled.
    pub fn new(rig: Arc<ElasticRig>) -> Self {
        let skins = (0..rig.segments.len()).map(|i| SegmentSkin::of(&rig, i)).collect();
        let motions = vec![Pose::IDENTITY; rig.segments.len()];
        let sets = rig.sets.iter().map(|set| MassSpringSet::at_rest(set.anchor)).collect();
        let positions = rig.mesh.positions.clone();
        let order = Arc::new(SkinOrder::new(&rig.weights, rig.segments.len()));
        let mut body = Self {
            normals: BodyNormals::new(&rig),
            order,
            moved: Vec::new(),
            rig,
            skins,
            motions,
            sets,
            palette: Palette::default(),
            draggers: Draggers::default(),
            positions,
            settings: DeformSettings::default(),
        };
        body.build_palette();
        body
    }

    /// Another body of the same rig, at rest where the rig was modelled. All rest data is shared with this one, so that it
    /// costs much less than [`ElasticBody::new`].
    #[must_use]
    pub fn twin(&self) -> Self {
        let mut body = self.clone();
        body.settings = DeformSettings::default();
        body.draggers = Draggers::default();
        body.place(&vec![Pose::IDENTITY; self.motions.len()]);
        body.positions.copy_from_slice(&self.rig.mesh.positions);
        body.normals.normals.copy_from_slice(&self.rig.mesh.normals);
        body.build_palette();
        body
    }

    /// The shared rest data.
    pub fn rig(&self) -> &Arc<ElasticRig> {
        &self.rig
    }

    /// What each segment owns of the skin.
    pub fn skins(&self) -> &[SegmentSkin] {
        &self.skins
    }

    /// World from rest of each segment.
    pub fn motions(&self) -> &[Pose] {
        &self.motions
    }

    /// The mass-spring sets.
    pub fn sets(&self) -> &[MassSpringSet] {
        &self.sets
    }

    /// The parameters of this frame's deformation.
    pub fn palette(&self) -> &Palette {
        &self.palette
    }

    /// The parameters of this frame's deformation, to add collision passes to.
    pub fn palette_mut(&mut self) -> &mut Palette {
        &mut self.palette
    }

    /// Deformed position of each vertex.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Unit normal of each vertex, as [`DeformSettings::normals`] asks for.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals.normals
    }

    /// Renews the normals from the deformed skin.
    pub fn renew_normals(&mut self) {
        self.normals.renew(self.settings.normals, &self.rig, &self.palette, &self.positions);
    }

    /// Moves the segments without moving the sets: for the first frame and for teleports. Nothing happens unless there
    /// is one motion a segment.
    pub fn place(&mut self, motions: &[Pose]) {
        if motions.len() != self.motions.len() {
            return;
        }
        self.motions.copy_from_slice(motions);
        for (state, set) in self.sets.iter_mut().zip(&self.rig.sets) {
            *state = MassSpringSet::at_rest(motions[set.segment].transform_point(set.anchor));
        }
        self.draggers.list.iter_mut().for_each(|(_, dragger)| dragger.place(motions));
    }

    /// Moves the segments and lets the mass-spring sets and what draggers let go follow over `h` seconds.
    ///
    /// Returns false, and puts the sets to rest, where a state came out that is not finite; false too unless there is
    /// one motion a segment.
    pub fn move_springs(&mut self, motions: &[Pose], h: f32) -> bool {
        if motions.len() != self.motions.len() {
            return false;
        }
        self.motions.copy_from_slice(motions);
        let DeformSettings { gravity, displacement_limit, .. } = self.settings;
        let mut finite = true;
        for (state, set) in self.sets.iter_mut().zip(&self.rig.sets) {
            let p = motions[set.segment].transform_point(set.anchor);
            *state = state.stepped(p, h, set.spring, gravity, displacement_limit * set.radius);
            if !state.is_finite() {
                *state = MassSpringSet::at_rest(p);
                finite = false;
            }
        }
        self.draggers.list.retain_mut(|(_, dragger)| dragger.step(motions, h));
        finite
    }

    /// True when no mass-spring set swings by more than `tolerance` metres any more and there are no draggers; the sets are
    /// then put to rest exactly.
    pub fn settle_springs(&mut self, tolerance: f32) -> bool {
        // The energy of the oscillation, as the displacement at which it would turn back.
        let swings = |(set, rig): (&MassSpringSet, &MassSpringSetRig)| {
            let turning = set.velocity / rig.spring.angular_frequency();
            set.displacement().length_squared() + turning.length_squared() > tolerance * tolerance
        };
        if self.settings.gravity != Vec3::ZERO
            || !self.draggers.list.is_empty()
            || self.sets.iter().zip(&self.rig.sets).any(swings)
        {
            return false;
        }
        for set in &mut self.sets {
            *set = MassSpringSet::at_rest(set.p);
        }
        true
    }

    /// Builds the palette of this frame from the segments, sets and draggers; it has no collision passes yet.
    pub fn build_palette(&mut self) {
        let DeformSettings { integrator, max_steps, level_of_detail, enabled, .. } = self.settings;
        self.palette.integrator = integrator;
        self.palette.passes.clear();
        self.palette.segments.clear();
        for (segment, motion) in self.motions.iter().enumerate() {
            let mut stages = [Vec::new(), Vec::new()];
            for (state, set) in self.sets.iter().zip(&self.rig.sets) {
                let moves = enabled && set.affects(segment) && state.p != state.q;
                if moves && level_of_detail.is_none_or(|detail| detail.keeps(state.p, set.radius)) {
                    let stage = usize::from(set.radius >= self.rig.local_threshold);
                    stages[stage].push(SpringField { p: state.p, q: state.q, radius: set.radius });
                }
            }
            let [local, global] = stages.map(|fields| SpringStage::certified(fields, integrator, max_steps));
            self.palette.segments.push(SegmentEntry { motion: *motion, local, global });
        }
        self.build_drags();
    }

    /// Where the rigid segments alone would carry each vertex: equation (18) without fields.
    pub fn rigid_positions(&self) -> Vec<Vec3> {
        let carried = |(x, skin): (&Vec3, &SkinWeights)| {
            let share = |k: usize| self.motions[usize::from(skin.segments[k])].transform_point(*x) * skin.weights[k];
            (0..MAX_INFLUENCES).filter(|&k| skin.weights[k] > 0.0).map(share).sum()
        };
        self.rig.mesh.positions.iter().zip(&self.rig.weights).map(carried).collect()
    }

    /// True when every vertex is finite.
    pub fn is_finite(&self) -> bool {
        self.positions.iter().all(|x| x.is_finite())
    }

    /// Deforms every vertex by all but the collision passes, in parallel: equation (18), then the draggers.
    pub fn deform_springs(&mut self) {
        let Self { rig, palette, positions, order, moved, .. } = self;
        let batches = order.pairs.par_iter().with_min_len(BATCHES);
        batches
            .map(|batch| {
                let entry = &palette.segments[usize::from(batch.segment)];
                let x = batch.vertices.map(|v| entry.motion.transform_point(rig.mesh.positions[v as usize]));
                let local = entry.local.flow_wide(x, palette.integrator);
                entry.global.flow_wide(local, palette.integrator)
            })
            .collect_into_vec(moved);
        let moved = moved.as_flattened();
        for ((position, slots), skin) in positions.iter_mut().zip(&order.slots).zip(&rig.weights) {
            *position = (0..MAX_INFLUENCES)
                .filter(|&k| slots[k] != u32::MAX)
                .fold(Vec3::ZERO, |sum, k| sum + moved[slots[k] as usize] * skin.weights[k]);
        }
        if !self.palette.drags.fields.is_empty() {
            self.carry(|x, skins, palette| palette.drags.flow_wide(x, skins, palette.integrator));
        }
    }

    /// Carries every vertex through one more collision pass, in parallel, and keeps the pass in the palette.
    pub fn deform_collision(&mut self, pass: super::CollisionPass) {
        self.carry(|x, skins, palette| pass.flow_wide(x, skins, palette.integrator));
        self.palette.passes.push(pass);
    }

    /// Carries every vertex from where it is, eight at a time.
    fn carry(&mut self, flow: impl Fn([Vec3; LANES], [&SkinWeights; LANES], &Palette) -> [Vec3; LANES] + Sync) {
        let Self { rig, palette, positions, order, moved, .. } = self;
        let batches = order.vertices.par_iter().with_min_len(BATCHES);
        batches
            .map(|batch| {
                let x = batch.map(|v| positions[v as usize]);
                flow(x, batch.map(|v| &rig.weights[v as usize]), palette)
            })
            .collect_into_vec(moved);
        for (batch, moved) in order.vertices.iter().zip(moved.iter()) {
            for (&v, &x) in batch.iter().zip(moved) {
                positions[v as usize] = x;
            }
        }
    }
}

/// Batches a task: few enough to share the work evenly, many enough not to drown in tasks. Results do not depend on it.
const BATCHES: usize = 32;
