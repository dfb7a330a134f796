//! Building a rig in plain code, with the same checks as a rig file gets.

use super::rig_checks as checks;
use super::rig_fault::{RigFault, RigFaultKind, RigTable};
use super::{
    ContactSettings, ElasticRig, Joint, MassSpringSetRig, Segment, SegmentShape, SkinWeights, WeightOptions,
    compute_weights,
};
use crate::math::{Pose, Quat, Vec3};
use crate::mesh::TriangleMesh;
use crate::spring::SpringCoefficients;

/// Softness of a rig that says nothing about it.
pub const DEFAULT_SOFTNESS: f32 = 1.2;

/// The local threshold of a rig that says nothing about it, as a part of the size of its mesh.
pub const DEFAULT_LOCAL_THRESHOLD: f32 = 0.5;

impl Default for ContactSettings {
    /// 3 Hz at a damping ratio of 0.3, friction 0.6.
    fn default() -> Self {
        Self { spring: SpringCoefficients::new(3.0, 0.3), friction: 0.6 }
    }
}

/// Puts a rig together: a mesh, then segments, joints and sets, then [`ElasticRigBuilder::build`], which checks it all.
#[derive(Clone, Debug)]
pub struct ElasticRigBuilder {
    mesh: TriangleMesh,
    segments: Vec<Segment>,
    joints: Vec<Joint>,
    sets: Vec<MassSpringSetRig>,
    weights: Option<Vec<SkinWeights>>,
    softness: f32,
    local_threshold: Option<f32>,
    contact: ContactSettings,
}

impl ElasticRigBuilder {
    /// Starts a rig with its skin, which must be closed and face outward.
    pub fn new(mesh: TriangleMesh) -> Self {
        Self {
            mesh,
            segments: Vec::new(),
            joints: Vec::new(),
            sets: Vec::new(),
            weights: None,
            softness: DEFAULT_SOFTNESS,
            local_threshold: None,
            contact: ContactSettings::default(),
        }
    }

    /// Adds a rigid piece and returns its index, by which joints and sets name it.
    pub fn segment(&mut self, segment: Segment) -> usize {
        self.segments.push(segment);
        self.segments.len() - 1
    }

    /// Adds an elastic joint. All segments must end up in one tree.
    pub fn joint(&mut self, joint: Joint) -> &mut Self {
        self.joints.push(joint);
        self
    }

    /// Adds a mass-spring set.
    pub fn mass_spring_set(&mut self, set: MassSpringSetRig) -> &mut Self {
        self.sets.push(set);
        self
    }

    /// Gives the weights, one entry a vertex, instead of having them computed by [`compute_weights`].
    pub fn weights(&mut self, weights: Vec<SkinWeights>) -> &mut Self {
        self.weights = Some(weights);
        self
    }

    /// Softness, above 0 and at most 10; [`DEFAULT_SOFTNESS`] otherwise.
    pub fn softness(&mut self, softness: f32) -> &mut Self {
        self.softness = softness;
        self
    }

    /// Radius in metres below which sets belong to the local stage, not negative; [`DEFAULT_LOCAL_THRESHOLD`] times the
    /// size of the mesh otherwise.
    pub fn local_threshold(&mut self, radius: f32) -> &mut Self {
        self.local_threshold = Some(radius);
        self
    }

    /// Contact behaviour; [`ContactSettings::default`] otherwise.
    pub fn contact(&mut self, contact: ContactSettings) -> &mut Self {
        self.contact = contact;
        self
    }

    /// The index of a segment by its name.
    pub fn segment_index(&self, name: &str) -> Option<usize> {
        self.segments.iter().position(|s| s.name == name)
    }

    /// The names of the segments so far, in order.
    pub fn segment_names(&self) -> impl Iterator<Item = &str> {
        self.segments.iter().map(|s| s.name.as_str())
    }

    /// Checks everything, computes what was not given, and makes the rig.
    ///
    /// # Errors
    /// The first fault with the part of the rig it is in: numbers out of range or not finite, names that are empty or
    /// twice there, joints that are no tree of all segments, a mesh that is open or inside out, bad weights.
    pub fn build(self) -> Result<ElasticRig, RigFault> {
        let local_threshold = self.local_threshold.unwrap_or_else(|| DEFAULT_LOCAL_THRESHOLD * self.mesh_size());
        checks::check_rig(self.softness, local_threshold)?;
        checks::check_contact(&self.contact)?;
        checks::check_segments(&self.segments)?;
        checks::check_joints(&self.joints, &self.segments)?;
        checks::check_sets(&self.sets, self.segments.len())?;
        checks::check_mesh(&self.mesh)?;
        let weights = match self.weights {
            Some(weights) => {
                checks::check_weights(&weights, &self.mesh, self.segments.len())?;
                weights
            }
            None => weights_of(&self.mesh, &self.segments)?,
        };
        Ok(ElasticRig {
            rest_poses: self.segments.iter().map(|s| rest_pose(s.bone)).collect(),
            mesh: self.mesh,
            segments: self.segments,
            joints: self.joints,
            weights,
            sets: self.sets,
            softness: self.softness,
            local_threshold,
            contact: self.contact,
        })
    }

    /// Checks the segments so far: names that are twice there or empty would make names of other tables ambiguous.
    pub(super) fn check_segments(&self) -> Result<(), RigFault> {
        checks::check_segments(&self.segments)
    }

    /// The size of a mesh that is not checked yet; 0 for one without a finite size, which the checks refuse.
    fn mesh_size(&self) -> f32 {
        Some(self.mesh.size()).filter(|s| s.is_finite()).unwrap_or(0.0)
    }
}

fn weights_of(mesh: &TriangleMesh, segments: &[Segment]) -> Result<Vec<SkinWeights>, RigFault> {
    let bones: Vec<[Vec3; 2]> = segments.iter().map(|s| s.bone).collect();
    let radii = segments.iter().map(|s| match s.shape {
        SegmentShape::Ball { radius } | SegmentShape::Capsule { radius } => radius,
        SegmentShape::Cuboid { half_extents } => half_extents.x.min(half_extents.y),
    });
    let options = WeightOptions { radii: radii.collect(), ..WeightOptions::default() };
    compute_weights(mesh, &bones, &options)
        .map_err(|e| checks::fault(RigTable::Rig, "weights", RigFaultKind::Weights(e)))
}

/// The frame of a segment: origin at the bone's middle, z along the bone; without rotation for a bone of no length.
pub fn rest_pose(bone: [Vec3; 2]) -> Pose {
    let [a, b] = bone.map(|e| e.as_dvec3());
    let along = (b - a).normalize_or_zero().as_vec3();
    let turn = if along.is_normalized() { Quat::from_rotation_arc(Vec3::Z, along) } else { Quat::IDENTITY };
    Pose::from_parts(((a + b) * 0.5).as_vec3(), turn)
}

#[cfg(test)]
#[path = "rig_builder_tests.rs"]
mod tests;
