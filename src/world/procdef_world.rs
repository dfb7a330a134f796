//! The set of bodies that move by themselves, beside a rapier world.

use std::sync::Arc;

use rapier3d::data::arena::{Arena, Index};
use rapier3d::dynamics::{RigidBodyHandle, SoftBodyHandle};
use rapier3d::geometry::InteractionGroups;
use rapier3d::pipeline::PhysicsWorld;

use super::procdef_report::ProcDefStepReport;
use super::procdef_view::ProcDefView;
use crate::coupling::procdef::{
    ContactSurface, Grip, GroundDirections, Meeting, MeetingMemory, ProcDefSets, ProcDefStart, WaterRegion, attach_to,
    crossings, spawn_attachment, spawn_soft_body,
};
use crate::math::{Mat3, Vec3};
use crate::procdef::{ContactTrigger, Motion, ProcDefBody, ProcDefModel};

/// Names a body in its world, as rapier's handles do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ProcDefHandle(pub(super) Index);

impl ProcDefHandle {
    /// Index and generation.
    pub fn into_raw_parts(self) -> (u32, u32) {
        self.0.into_raw_parts()
    }
}

impl PartialOrd for ProcDefHandle {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for ProcDefHandle {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.into_raw_parts().cmp(&other.into_raw_parts())
    }
}

/// What a body has in rapier.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProcDefLink {
    /// Its particles.
    pub soft_body: SoftBodyHandle,
    /// The rigid bodies of the model's attachments, in their order; none for one whose points have no convex hull.
    pub attachments: Vec<Option<RigidBodyHandle>>,
}

/// One body with its ties to rapier.
pub(super) struct ProcDefEntry {
    pub model: Arc<ProcDefModel>,
    pub body: ProcDefBody,
    pub motion: Motion,
    pub link: ProcDefLink,
    pub trigger: Option<ContactTrigger>,
    pub directions: Option<Arc<GroundDirections>>,
    pub grip: Option<Grip>,
    /// Vertices that are attached to something, and feel it all the time.
    pub attached: Vec<u32>,
    /// Velocities that were written for rapier's next step; empty until then and while the body is frozen.
    pub written: Vec<Vec3>,
    /// Impulses of rapier's last step.
    pub impulses: Vec<Vec3>,
    /// Local transformations of the step.
    pub local: Vec<Mat3>,
    /// The boundary, as vertices of other bodies meet it.
    pub surface: Arc<ContactSurface>,
    /// What it collides with.
    pub groups: InteractionGroups,
    /// What the last meeting of vertices did.
    pub meeting: Meeting,
}

/// All bodies of a rapier world that move by themselves.
///
/// Call [`ProcDefWorld::step`] once after each step of rapier. It reads the particles as that step left them and gives them
/// the velocities with which they want to go on, for rapier's next step: that one adds gravity, contacts and attachments and
/// moves them. Nothing of rapier is owned: its sets are borrowed for the call, and only handles are kept.
#[derive(Default)]
pub struct ProcDefWorld {
    /// Where water is.
    pub water: Vec<WaterRegion>,
    pub(super) entries: Arena<ProcDefEntry>,
    pub(super) report: ProcDefStepReport,
    /// What vertices met.
    pub(super) meetings: MeetingMemory,
}

impl ProcDefWorld {
    /// An empty world.
    pub fn new() -> Self {
        Self::default()
    }

    /// Inserts a body: its particles and attachments in rapier, its motion here.
    pub fn insert<'a>(
        &mut self,
        model: Arc<ProcDefModel>,
        start: &ProcDefStart,
        sets: impl Into<ProcDefSets<'a>>,
    ) -> ProcDefHandle {
        let mut sets = sets.into();
        let soft_body = spawn_soft_body(&model, start, &mut sets);
        let spawn = |a| spawn_attachment(a, start, soft_body, &mut sets);
        let attachments = model.attachments.iter().map(spawn).collect();
        let mut body = ProcDefBody::new(model.rig.clone(), &start.pose);
        body.settings = model.settings;
        body.velocities_mut().fill(start.velocity);
        let twin = self.entries.iter().find(|(_, e)| Arc::ptr_eq(&e.model, &model));
        let surface = match twin {
            Some((_, twin)) => twin.surface.clone(),
            None => Arc::new(ContactSurface::new(model.rig.mesh(), model.boundary_edge())),
        };
        let directions = match twin {
            Some((_, twin)) => twin.directions.clone(),
            None => model.ground.map(|g| Arc::new(GroundDirections::new(model.rig.mesh(), g))),
        };
        let attached = model.attachments.iter().flat_map(|a| &a.vertices).copied().collect();
        ProcDefHandle(self.entries.insert(ProcDefEntry {
            attached,
            body,
            motion: Motion::rising(start.clock, &model.motion),
            link: ProcDefLink { soft_body, attachments },
            trigger: model.trigger.map(ContactTrigger::new),
            directions,
            grip: None,
            written: Vec::new(),
            impulses: Vec::new(),
            local: Vec::new(),
            surface,
            groups: start.groups,
            meeting: Meeting::default(),
            model,
        }))
    }

    /// Removes a body. What it has in rapier stays: it is returned, to be removed there or kept.
    pub fn remove(&mut self, handle: ProcDefHandle) -> Option<ProcDefLink> {
        self.entries.remove(handle.0).map(|entry| entry.link)
    }

    /// A body: its positions after rapier's last step, and the velocities that it wants to go on with.
    pub fn get(&self, handle: ProcDefHandle) -> Option<&ProcDefBody> {
        self.entries.get(handle.0).map(|entry| &entry.body)
    }

    /// A body, to change its settings. Its positions are rapier's: change them there.
    pub fn get_mut(&mut self, handle: ProcDefHandle) -> Option<&mut ProcDefBody> {
        self.entries.get_mut(handle.0).map(|entry| &mut entry.body)
    }

    /// What the body shares with others of its kind.
    pub fn model(&self, handle: ProcDefHandle) -> Option<&Arc<ProcDefModel>> {
        self.entries.get(handle.0).map(|entry| &entry.model)
    }

    /// Exchanges the charts of one body and of no other: `change` gets its own copy of the model. The mesh must stay.
    /// False where there is no such body.
    pub fn edit(&mut self, handle: ProcDefHandle, change: impl FnOnce(&mut crate::procdef::MotionRig)) -> bool {
        let Some(entry) = self.entries.get_mut(handle.0) else { return false };
        change(Arc::make_mut(&mut Arc::make_mut(&mut entry.model).motion));
        true
    }

    /// Where a body is in its motion.
    pub fn motion(&self, handle: ProcDefHandle) -> Option<&Motion> {
        self.entries.get(handle.0).map(|entry| &entry.motion)
    }

    /// Where a body is in its motion, to set its pace or strength.
    pub fn motion_mut(&mut self, handle: ProcDefHandle) -> Option<&mut Motion> {
        self.entries.get_mut(handle.0).map(|entry| &mut entry.motion)
    }

    /// What a body has in rapier.
    pub fn link(&self, handle: ProcDefHandle) -> Option<&ProcDefLink> {
        self.entries.get(handle.0).map(|entry| &entry.link)
    }

    /// The body that a soft body belongs to.
    pub fn owner(&self, soft_body: SoftBodyHandle) -> Option<ProcDefHandle> {
        self.entries.iter().find(|(_, e)| e.link.soft_body == soft_body).map(|(index, _)| ProcDefHandle(index))
    }

    /// All bodies.
    pub fn iter(&self) -> impl Iterator<Item = (ProcDefHandle, &ProcDefBody)> {
        self.entries.iter().map(|(index, entry)| (ProcDefHandle(index), &entry.body))
    }

    /// How many edges of each body go through another's boundary: none where bodies are apart. For measuring; a step does not ask
    /// it, and it takes longer than one.
    pub fn crossings(&self) -> Vec<(ProcDefHandle, usize)> {
        let bodies: Vec<_> = self.entries.iter().map(|(_, e)| (e.body.positions(), &e.model.boundary[..])).collect();
        let handles = self.entries.iter().map(|(index, _)| ProcDefHandle(index));
        handles.zip(crossings(&bodies)).collect()
    }

    /// The excitation of each vertex of a body, in [-1, 1]: -1 is full contraction.
    pub fn excitations_into(&self, handle: ProcDefHandle, excitations: &mut Vec<f32>) {
        excitations.clear();
        if let Some(entry) = self.entries.get(handle.0) {
            entry.motion.excitations_into(&entry.model.motion, excitations);
        }
    }

    /// Attaches the vertices that are within a ball at rest, in the frame of the mesh, to a rigid body that exists: a bone.
    /// How many there are, and none where body or bone are gone.
    pub fn attach<'a>(
        &mut self,
        handle: ProcDefHandle,
        bone: RigidBodyHandle,
        centre: Vec3,
        radius: f32,
        sets: impl Into<ProcDefSets<'a>>,
    ) -> usize {
        let Some(entry) = self.entries.get_mut(handle.0) else { return 0 };
        let vertices = entry.model.vertices_within(centre, radius);
        if !attach_to(bone, &vertices, entry.link.soft_body, &mut sets.into()) {
            return 0;
        }
        let count = vertices.len();
        entry.attached.extend(vertices);
        count
    }

    /// Touches a body at a point of the world: a stimulus starts at the vertex next to it. False where it answers none.
    pub fn touch(&mut self, handle: ProcDefHandle, point: Vec3) -> bool {
        let Some(entry) = self.entries.get_mut(handle.0).filter(|_| point.is_finite()) else { return false };
        let rest = &entry.model.rig.mesh().positions;
        let pairs = entry.body.positions().iter().zip(rest);
        let nearest = pairs.min_by(|a, b| a.0.distance_squared(point).total_cmp(&b.0.distance_squared(point)));
        nearest.is_some_and(|(_, &place)| entry.motion.touch(&entry.model.motion, place))
    }

    /// Takes hold of a body around the vertex next to a point of the world, until [`ProcDefWorld::release`]. The grip is led
    /// by its target; `radius` is in metres.
    pub fn grab(&mut self, handle: ProcDefHandle, point: Vec3, radius: f32) -> Option<&mut Grip> {
        let entry = self.entries.get_mut(handle.0)?;
        entry.grip = Grip::new(&entry.body, point, radius);
        entry.grip.as_mut()
    }

    /// The grip on a body.
    pub fn grip(&self, handle: ProcDefHandle) -> Option<&Grip> {
        self.entries.get(handle.0)?.grip.as_ref()
    }

    /// The grip on a body, to lead it.
    pub fn grip_mut(&mut self, handle: ProcDefHandle) -> Option<&mut Grip> {
        self.entries.get_mut(handle.0)?.grip.as_mut()
    }

    /// Lets go of a body.
    pub fn release(&mut self, handle: ProcDefHandle) {
        if let Some(entry) = self.entries.get_mut(handle.0) {
            entry.grip = None;
        }
    }

    /// What the last step did.
    pub fn report(&self) -> &ProcDefStepReport {
        &self.report
    }

    /// Takes `substeps` steps (at least one) of `physics` and of these bodies, together as long as rapier's own time step, which is
    /// the same afterwards. What hangs on few vertices, or stands on them, sinks by the square of a step's length: see the limits
    /// in the architecture.
    pub fn advance(&mut self, physics: &mut PhysicsWorld, substeps: u32) -> &ProcDefStepReport {
        let whole = physics.integration_parameters.dt;
        let substeps = substeps.max(1);
        physics.integration_parameters.dt = whole / substeps as f32;
        for _ in 0..substeps {
            physics.step();
            self.step(physics);
        }
        physics.integration_parameters.dt = whole;
        &self.report
    }

    /// Reads all bodies after a step of `physics` and drives them for its next one. Never panics on the state of the world:
    /// bodies whose particles are gone or not finite are frozen and reported.
    pub fn step(&mut self, physics: &mut PhysicsWorld) -> &ProcDefStepReport {
        self.step_with(&mut ProcDefView::from(physics))
    }
}
