//! Shared rest data of an elastic body: skin, segments, joints and mass-spring sets. Built once, used by many bodies.

use crate::math::{Pose, Vec3};
use crate::mesh::TriangleMesh;
use crate::spring::SpringCoefficients;

/// At most this many segments move one vertex (equation 18 of the paper).
pub const MAX_INFLUENCES: usize = 4;

/// The index-weight pairs of one vertex. Weights are not negative and sum to 1; unused pairs have weight 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinWeights {
    /// Segment indices.
    pub segments: [u16; MAX_INFLUENCES],
    /// Their weights.
    pub weights: [f32; MAX_INFLUENCES],
}

/// The rigid shape of a segment, placed along its bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentShape {
    /// A ball about the middle of the bone.
    Ball {
        /// Radius in metres.
        radius: f32,
    },
    /// A capsule along the bone; its hemispheres end at the bone's ends.
    Capsule {
        /// Radius in metres.
        radius: f32,
    },
    /// A box about the middle of the bone, its z axis along the bone.
    Cuboid {
        /// Half extents in metres.
        half_extents: Vec3,
    },
}

/// How heavy a segment is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentMass {
    /// Total mass in kilograms.
    Mass(f32),
    /// Density in kilograms a cubic metre of the rigid shape.
    Density(f32),
}

/// One rigid piece of the body: a bone with the shape of its rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Name, unique in the rig.
    pub name: String,
    /// The bone's two ends in the rest pose of the mesh.
    pub bone: [Vec3; 2],
    /// Shape of the rigid body.
    pub shape: SegmentShape,
    /// Mass or density.
    pub mass: SegmentMass,
}

/// An elastic joint: a ball joint with limits that pulls its segments back to the rest pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Index of the segment nearer to the root.
    pub parent: usize,
    /// Index of the other segment.
    pub child: usize,
    /// The joint's centre in the rest pose of the mesh.
    pub anchor: Vec3,
    /// Largest angle about each axis in radians, or none for a free joint.
    pub limit: Option<f32>,
    /// The pull back to the rest pose.
    pub spring: SpringCoefficients,
}

/// Where a mass-spring set sits and how it moves (section 3.1).
#[derive(Clone, Debug, PartialEq)]
pub struct MassSpringSetRig {
    /// Index of the segment that carries the anchor.
    pub segment: usize,
    /// Indices of further segments that the set deforms besides its own.
    pub also: Vec<usize>,
    /// Anchor `p` in the rest pose of the mesh.
    pub anchor: Vec3,
    /// Radius of influence `r_o` in metres.
    pub radius: f32,
    /// Oscillator.
    pub spring: SpringCoefficients,
}

impl MassSpringSetRig {
    /// True where the set is in the list of this segment (section 3.4).
    pub fn affects(&self, segment: usize) -> bool {
        self.segment == segment || self.also.contains(&segment)
    }
}

/// How the body answers obstacles that it penetrates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSettings {
    /// Natural frequency and damping ratio of the whole body on its contact spring. The damping ratio is a restitution
    /// by another name: see [`ContactSettings::bouncing`].
    pub spring: SpringCoefficients,
    /// Coulomb friction coefficient, not negative.
    pub friction: f32,
}

impl ContactSettings {
    /// Contacts that give back the fraction `restitution`, from 0 to 1, of the speed at which they closed.
    pub fn bouncing(natural_frequency: f32, restitution: f32, friction: f32) -> Self {
        Self { spring: SpringCoefficients::from_restitution(natural_frequency, restitution), friction }
    }

    /// The coefficient of restitution: the speed at which a contact opens over the speed at which it closed.
    pub fn restitution(&self) -> f32 {
        self.spring.restitution()
    }
}

/// Everything about an elastic body that its copies share.
///
/// Made by [`super::ElasticRigBuilder`] or [`super::load_rig`], which check that all indices and numbers are in range.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ElasticRig {
    /// The skin at rest.
    pub mesh: TriangleMesh,
    /// Rigid pieces.
    pub segments: Vec<Segment>,
    /// Joints between them.
    pub joints: Vec<Joint>,
    /// Index-weight pairs, one entry a vertex.
    pub weights: Vec<SkinWeights>,
    /// Mass-spring sets.
    pub sets: Vec<MassSpringSetRig>,
    /// Softness `s`: collision fields reach `s · size` beyond a part (section 4.2); 1 to 2 looks good.
    pub softness: f32,
    /// Mass-spring sets with a radius below this belong to the local stage, the others to the global one (section 5.1).
    pub local_threshold: f32,
    /// Contact behaviour.
    pub contact: ContactSettings,
    /// Rest pose of each segment's frame: origin at the bone's middle, z along the bone.
    pub rest_poses: Vec<Pose>,
}
