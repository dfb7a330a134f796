//! Bodies that move by themselves: their kinds, their places in rapier, and what happens to them in time.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use pliant::coupling::procdef::{ProcDefStart, WaterRegion};
use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::{FillReport, TriangleMesh};
use pliant::procdef::{EmbeddedSkin, ProcDefModel, load_motion_rig};
use pliant::world::{ProcDefHandle, ProcDefWorld};
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::pipeline::PhysicsWorld;

use super::build::BuildError;
use super::obstacle::ObstacleBody;
use super::running::Simulation;
use crate::scene::{Attachment, Random, Scene, SoftBody};

/// What all bodies of one rig file share.
#[derive(Debug)]
pub struct SoftKind {
    /// The model.
    pub model: Arc<ProcDefModel>,
    /// The surface that is shown and written: the rig's skin, or the boundary of the cells.
    pub skin: EmbeddedSkin,
    /// Whether the rig has a skin of its own.
    pub has_skin: bool,
    /// The layer of each vertex of the cells, if layers are painted.
    pub layers: Option<Vec<f32>>,
    /// The least and the largest dihedral angle of the cells at rest, in degrees.
    pub angles: [f64; 2],
    /// How well the cells fill the rig's surface, where they were made for one.
    pub fill: Option<FillReport>,
    /// Colour of the rig, linear.
    pub colour: Option<[f32; 3]>,
    /// The rigid things that come with the body, in the order of the model's attachments.
    pub things: Vec<AttachedThing>,
}

/// A rigid thing that comes with a body, such as a shell.
#[derive(Clone, Debug)]
pub struct AttachedThing {
    /// Its name in the rig.
    pub name: String,
    /// Its surface, in the frame of the body's mesh at rest.
    pub mesh: TriangleMesh,
    /// Its colour, linear.
    pub colour: Option<[f32; 3]>,
}

/// A body that moves by itself.
#[derive(Clone, Debug)]
pub struct SoftActor {
    /// Its name in the scene.
    pub name: String,
    /// The body.
    pub handle: ProcDefHandle,
    /// What it shares with others of its rig.
    pub kind: Arc<SoftKind>,
    /// Its colour, if the scene gives one.
    pub colour: Option<[f32; 3]>,
    /// From 0 for invisible to 1.
    pub opacity: f32,
}

impl SoftKind {
    /// Reads a rig and binds its skin.
    fn load(rig: &PathBuf) -> Result<Self, BuildError> {
        let file = load_motion_rig(rig)?;
        let model = ProcDefModel::from_file(&file).map_err(|error| BuildError::Model { rig: rig.clone(), error })?;
        let has_skin = file.skin.is_some();
        let surface = match file.skin {
            Some(skin) => skin,
            None => boundary_surface(&model)?,
        };
        let (skin, _) = EmbeddedSkin::new(surface, model.rig.mesh())
            .map_err(|error| BuildError::Skin { rig: rig.clone(), error })?;
        let layers = file.built.layers.map(|field| field.values(&file.mesh.positions));
        let things = file.description.attachment.iter().zip(file.attachments);
        // As the model does: what has no mesh or no mass is no thing of its own.
        let things = things.filter_map(|(a, mesh)| {
            let mesh = mesh.filter(|_| a.mass.is_some())?;
            Some(AttachedThing { name: a.name.clone(), mesh, colour: a.colour })
        });
        let things = things.collect();
        let (angles, fill) = (file.mesh.dihedral_angles(), file.fill);
        let colour = file.description.colour;
        Ok(Self { model: Arc::new(model), skin, has_skin, layers, angles, fill, colour, things })
    }
}

/// The boundary of the cells with the vertices that it uses.
fn boundary_surface(model: &ProcDefModel) -> Result<TriangleMesh, BuildError> {
    let mesh = model.rig.mesh();
    let used = mesh.surface_vertices();
    let place = |v: u32| used.binary_search(&v).map_or(0, |place| place as u32);
    let triangles = model.boundary.iter().map(|t| t.map(place)).collect();
    let positions = used.iter().map(|&v| mesh.positions[v as usize]).collect();
    TriangleMesh::from_triangles(positions, triangles).map_err(BuildError::Mesh)
}

/// Puts the soft bodies of a scene and its water into the worlds. A `seed` other than 0 turns and shifts the starts.
pub(super) fn insert_soft_bodies(
    scene: &Scene,
    seed: u64,
    obstacles: &[ObstacleBody],
    creatures: &mut ProcDefWorld,
    physics: &mut PhysicsWorld,
) -> Result<Vec<SoftActor>, BuildError> {
    creatures.water = scene.water.iter().map(|w| WaterRegion { min: w.min, max: w.max, flow: w.flow }).collect();
    let mut kinds: BTreeMap<&PathBuf, Arc<SoftKind>> = BTreeMap::new();
    let mut random = Random(seed);
    let mut actors = Vec::new();
    for body in &scene.soft_bodies {
        let kind = match kinds.get(&body.rig) {
            Some(kind) => kind.clone(),
            None => kinds.entry(&body.rig).or_insert(Arc::new(SoftKind::load(&body.rig)?)).clone(),
        };
        let mut start = start(body);
        if seed != 0 {
            nudge(&mut random, &mut start, kind.model.rig.mesh().size());
        }
        let handle = creatures.insert(model(body, &kind), &start, &mut *physics);
        if let (Some(stiffness), Some(inserted)) = (body.stiffness, creatures.get_mut(handle)) {
            inserted.settings.stiffness = stiffness;
        }
        if let Some(motion) = creatures.motion_mut(handle) {
            (motion.pace, motion.strength) = (body.pace, body.strength);
            motion.rise = body.rise.unwrap_or(motion.rise);
        }
        let (name, colour, opacity) = (body.name.clone(), body.colour, body.opacity);
        actors.push(SoftActor { name, handle, kind, colour, opacity });
    }
    for (index, attachment) in scene.attachments.iter().enumerate() {
        attach(index, attachment, scene, &actors, obstacles, creatures, physics)?;
    }
    Ok(actors)
}

fn start(body: &SoftBody) -> ProcDefStart {
    ProcDefStart { pose: body.pose, velocity: body.velocity, clock: f64::from(body.clock), ..ProcDefStart::default() }
}

/// Turns a start about the vertical, shifts it sideways and sets its clock on, all at random.
fn nudge(random: &mut Random, start: &mut ProcDefStart, size: f32) {
    let turn = Quat::from_rotation_y(std::f32::consts::PI * random.next());
    let shift = Vec3::new(random.next(), 0.0, random.next()) * (0.15 * size);
    start.pose = Pose::from_parts(start.pose.translation + shift, turn * start.pose.rotation);
    start.clock += f64::from(random.next());
}

/// The model of a body: that of its kind, or one of its own where the scene changes it.
fn model(body: &SoftBody, kind: &SoftKind) -> Arc<ProcDefModel> {
    match body.ground {
        Some(ground) => Arc::new(ProcDefModel { ground: Some(ground), ..(*kind.model).clone() }),
        None => kind.model.clone(),
    }
}

/// Ties vertices to an obstacle, or to where they are.
fn attach(
    index: usize,
    attachment: &Attachment,
    scene: &Scene,
    actors: &[SoftActor],
    obstacles: &[ObstacleBody],
    creatures: &mut ProcDefWorld,
    physics: &mut PhysicsWorld,
) -> Result<(), BuildError> {
    let held = attachment.obstacle.and_then(|obstacle| obstacles.get(obstacle)).map(|obstacle| obstacle.body);
    for &body in &attachment.bodies {
        let actor = &actors[body];
        let place = scene.soft_bodies[body].pose.transform_point(attachment.centre);
        let bone = held.unwrap_or_else(|| physics.insert_body(RigidBodyBuilder::fixed().translation(place)));
        let count = creatures.attach(actor.handle, bone, attachment.centre, attachment.radius, &mut *physics);
        if count == 0 {
            let (body, centre, radius) = (actor.name.clone(), attachment.centre, attachment.radius);
            return Err(BuildError::Attachment { attachment: index, body, centre, radius });
        }
    }
    Ok(())
}

impl Simulation {
    /// Where the rigid things of a body are, in the order of its kind; none for one that rapier does not have.
    pub fn thing_poses(&self, actor: &SoftActor) -> Vec<Option<Pose>> {
        let things = self.creatures.link(actor.handle).map(|link| &link.attachments[..]).unwrap_or_default();
        things.iter().map(|thing| self.physics.bodies.get((*thing)?).map(|body| *body.position())).collect()
    }

    /// The cues that are due before the time `next`, each once: at the beginning of the substep in which its time lies.
    pub(super) fn follow_cues(&mut self, next: f32) {
        let since = std::mem::replace(&mut self.cued, next);
        for cue in self.scene.cues.iter().filter(|cue| (since..next).contains(&cue.time)) {
            for actor in cue.bodies.iter().filter_map(|&body| self.soft_actors.get(body)) {
                let Some(model) = self.creatures.model(actor.handle).cloned() else { continue };
                let Some(motion) = self.creatures.motion_mut(actor.handle) else { continue };
                motion.pace = cue.pace.unwrap_or(motion.pace);
                motion.strength = cue.strength.unwrap_or(motion.strength);
                if let Some(place) = cue.touch {
                    motion.touch(&model.motion, place);
                }
            }
        }
    }
}
