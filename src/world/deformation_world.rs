//! The set of elastic bodies beside a rapier world.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rapier3d::data::arena::{Arena, Index};
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::geometry::{Collider, ColliderHandle, InteractionGroups, SharedShape};
use rapier3d::pipeline::PhysicsWorld;

use super::meetings::SegmentName;
use super::report::{BodyReport, StepReport};
use super::view::{RapierSets, RapierView};
use crate::coupling::self_pairs;
use crate::coupling::{
    CancelMemory, CancelSettings, CoherenceMemory, ContactMemories, FoundationMemory, FoundationSettings,
    ObstacleError, PairApproaches, PartCache, PartId, Ragdoll, RagdollStart, Widening,
};
use crate::elastic::{DeformSettings, ElasticBody, ElasticRig};
use crate::field::PlacedPart;
use crate::math::Pose;

/// Names an elastic body in its world, as rapier's handles do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ElasticBodyHandle(pub(super) Index);

impl ElasticBodyHandle {
    /// Index and generation.
    pub fn into_raw_parts(self) -> (u32, u32) {
        self.0.into_raw_parts()
    }
}

impl PartialOrd for ElasticBodyHandle {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for ElasticBodyHandle {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.into_raw_parts().cmp(&other.into_raw_parts())
    }
}

/// What all bodies of the world share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeformationSettings {
    /// Penetration cancellation.
    pub cancel: CancelSettings,
    /// The implicit solve of the repelling impulses.
    pub foundation: FoundationSettings,
    /// Factor on the stiffness of all contacts.
    pub stiffness: f32,
    /// How deep heightfields and triangle meshes are solid behind their surface, in sizes of the body that meets them:
    /// above 0. A body that goes in by less is found and led out on the right side.
    pub surface_thickness: f32,
    /// Measure depths, gaps and volumes after each step (they cost time, and nothing depends on them).
    pub measure: bool,
}

impl Default for DeformationSettings {
    fn default() -> Self {
        Self {
            cancel: CancelSettings::default(),
            foundation: FoundationSettings::default(),
            stiffness: 1.0,
            surface_thickness: SURFACE_THICKNESS,
            measure: true,
        }
    }
}

/// The usual [`DeformationSettings::surface_thickness`]: more than twice as deep as bodies are expected to go in.
pub const SURFACE_THICKNESS: f32 = 1.0;

/// Why a body was not inserted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InsertError {
    /// A rig was given other than one rigid body a segment.
    #[error("the rig has {segments} segments, but {bodies} rigid bodies were given: one a segment is needed")]
    BodyCount {
        /// Segments of the rig.
        segments: usize,
        /// Rigid bodies given.
        bodies: usize,
    },
}

/// Everything that a body's deformation depends on, once its mass-spring sets have come to rest. While none of it
/// changes, the skin stays as it is and costs nothing.
#[derive(Clone, PartialEq)]
pub(super) struct Circumstances {
    pub motions: Vec<Pose>,
    pub parts: Vec<(PartId, PlacedPart)>,
    pub neighbours: Vec<ElasticBodyHandle>,
    pub world: DeformationSettings,
    pub body: DeformSettings,
}

/// Circumstances that have been dealt with.
pub(super) struct Settled {
    pub circumstances: Circumstances,
    pub report: BodyReport,
}

/// One body with its ties to rapier.
pub(super) struct Entry {
    pub body: ElasticBody,
    pub ragdoll: Ragdoll,
    pub groups: InteractionGroups,
    pub memories: ContactMemories,
    /// Segments of the body that may touch each other.
    pub self_pairs: Arc<BTreeSet<(usize, usize)>>,
    /// What the last cancellation did.
    pub cancelled: CancelMemory,
    /// For the measurement of the time coherence.
    pub coherence: CoherenceMemory,
    /// False until the body has been placed on its rigid bodies.
    pub placed: bool,
    /// What the last deformation was made from, and what came out.
    pub last: Option<Settled>,
    /// Size and volume of the rig: the units of depths and of the volume ratio.
    pub size: f32,
    pub rest_volume: f64,
}

/// All elastic bodies of a rapier world.
///
/// Call [`DeformationWorld::step`] once after each step of rapier. Nothing of rapier is owned: its sets are borrowed for
/// the call, and only handles are kept.
#[derive(Default)]
pub struct DeformationWorld {
    /// Settings of all bodies.
    pub settings: DeformationSettings,
    pub(super) entries: Arena<Entry>,
    pub(super) parts: PartCache,
    pub(super) own: BTreeSet<(u32, u32)>,
    pub(super) foundation: FoundationMemory,
    pub(super) approaches: PairApproaches,
    /// How much interfaces between skins were widened in the last step.
    pub(super) widenings: BTreeMap<[SegmentName; 2], Widening>,
    pub(super) report: StepReport,
}

impl DeformationWorld {
    /// An empty world.
    pub fn new() -> Self {
        Self::default()
    }

    /// Builds the ragdoll of a rig in rapier's sets and the elastic body on top of it.
    pub fn insert<'a>(
        &mut self,
        rig: Arc<ElasticRig>,
        start: &RagdollStart,
        sets: impl Into<RapierSets<'a>>,
    ) -> ElasticBodyHandle {
        let sets = sets.into();
        let ragdoll = Ragdoll::spawn(&rig, start, sets.bodies, sets.colliders, sets.joints);
        let mut body = self.body_of(rig);
        let motions = vec![start.pose; body.motions().len()];
        body.place(&motions);
        body.build_palette();
        body.deform_springs();
        body.renew_normals();
        self.add(body, ragdoll, start.groups, true)
    }

    /// Puts an elastic body on top of rigid bodies that exist already, one a segment and in their order. Its skin is there
    /// after the next step.
    ///
    /// # Errors
    /// [`InsertError`] where the counts differ.
    pub fn attach(
        &mut self,
        rig: Arc<ElasticRig>,
        ragdoll: Ragdoll,
        groups: InteractionGroups,
    ) -> Result<ElasticBodyHandle, InsertError> {
        let (segments, bodies) = (rig.segments.len(), ragdoll.bodies.len());
        if segments != bodies {
            return Err(InsertError::BodyCount { segments, bodies });
        }
        let body = self.body_of(rig);
        Ok(self.add(body, ragdoll, groups, false))
    }

    /// A new body of a rig: what is derived from the rig is shared with the bodies that it has already.
    fn body_of(&self, rig: Arc<ElasticRig>) -> ElasticBody {
        let mut bodies = self.iter().map(|(_, body)| body);
        match bodies.find(|body| Arc::ptr_eq(body.rig(), &rig)) {
            Some(body) => body.twin(),
            None => ElasticBody::new(rig),
        }
    }

    fn add(
        &mut self,
        body: ElasticBody,
        ragdoll: Ragdoll,
        groups: InteractionGroups,
        placed: bool,
    ) -> ElasticBodyHandle {
        let mut known = self.entries.iter().filter(|(_, entry)| Arc::ptr_eq(entry.body.rig(), body.rig()));
        let self_pairs = match known.next() {
            Some((_, entry)) => entry.self_pairs.clone(),
            None => Arc::new(self_pairs(&ElasticBody::new(body.rig().clone()))),
        };
        self.own.extend(ragdoll.bodies.iter().map(|handle| handle.into_raw_parts()));
        let rig = body.rig().clone();
        let entry = Entry {
            size: rig.mesh.size(),
            rest_volume: rig.mesh.volume(),
            body,
            ragdoll,
            groups,
            memories: ContactMemories::new(),
            cancelled: CancelMemory::default(),
            self_pairs,
            coherence: CoherenceMemory::default(),
            placed,
            last: None,
        };
        ElasticBodyHandle(self.entries.insert(entry))
    }

    /// Removes an elastic body. Its rigid bodies stay: they are returned, to be removed from rapier or kept.
    pub fn remove(&mut self, handle: ElasticBodyHandle) -> Option<Ragdoll> {
        let entry = self.entries.remove(handle.0)?;
        for body in &entry.ragdoll.bodies {
            self.own.remove(&body.into_raw_parts());
        }
        Some(entry.ragdoll)
    }

    /// A body.
    pub fn get(&self, handle: ElasticBodyHandle) -> Option<&ElasticBody> {
        self.entries.get(handle.0).map(|entry| &entry.body)
    }

    /// A body, to change its settings.
    pub fn get_mut(&mut self, handle: ElasticBodyHandle) -> Option<&mut ElasticBody> {
        self.entries.get_mut(handle.0).map(|entry| &mut entry.body)
    }

    /// The rigid bodies and joints of a body.
    pub fn ragdoll(&self, handle: ElasticBodyHandle) -> Option<&Ragdoll> {
        self.entries.get(handle.0).map(|entry| &entry.ragdoll)
    }

    /// The elastic body that a rigid body belongs to.
    pub fn owner(&self, rigid: RigidBodyHandle) -> Option<ElasticBodyHandle> {
        self.iter()
            .map(|(handle, _)| handle)
            .find(|&handle| self.ragdoll(handle).is_some_and(|ragdoll| ragdoll.bodies.contains(&rigid)))
    }

    /// All bodies.
    pub fn iter(&self) -> impl Iterator<Item = (ElasticBodyHandle, &ElasticBody)> {
        self.entries.iter().map(|(index, entry)| (ElasticBodyHandle(index), &entry.body))
    }

    /// Makes an obstacle ready before a body meets it: for a triangle mesh of 100,000 triangles it takes a moment, which
    /// the first step near it would take otherwise.
    ///
    /// # Errors
    /// [`ObstacleError`] for a collider that has no convex parts.
    pub fn prepare(&mut self, handle: ColliderHandle, collider: &Collider) -> Result<(), ObstacleError> {
        self.parts.prepare(handle, collider)
    }

    /// From now on a collider is taken for `shape` by the elastic bodies, in the same place, until it is removed; `None`
    /// undoes it. Rapier goes on with the collider's own shape.
    ///
    /// So a triangle mesh that rapier collides with can be a compound of convex parts, made by
    /// [`crate::coupling::decompose_cached`], for the skin: fewer parts, and solid all through.
    pub fn stand_in(&mut self, handle: ColliderHandle, shape: Option<SharedShape>) {
        self.parts.stand_in(handle, shape);
    }

    /// What the last step did.
    pub fn report(&self) -> &StepReport {
        &self.report
    }

    /// Moves and deforms all bodies after a step of `physics`, and gives their rigid bodies the repelling impulses
    /// that act in rapier's next step. Never panics on the state of the world: see [`super::Frozen`].
    pub fn step(&mut self, physics: &mut PhysicsWorld) -> &StepReport {
        self.step_with(&mut RapierView::from(physics))
    }
}
