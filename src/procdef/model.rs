//! What all bodies of one kind share beside their mesh: how they move, and how they meet the world.

use std::sync::Arc;

use super::{
    GroundDescription, MotionRig, MotionRigFile, ProcDefRig, ProcDefRigBuilder, ProcDefRigError, ProcDefSettings,
    Stiffness, TriggerSettings, WaterDescription,
};
use crate::math::Vec3;

/// A rigid thing that some vertices of a body are attached to: a shell, a bone.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidAttachment {
    /// Its name in the rig.
    pub name: String,
    /// The vertices that are attached, ascending.
    pub vertices: Vec<u32>,
    /// Its mass in kilograms.
    pub mass: f32,
    /// Points in the frame of the body's mesh; their convex hull is its shape.
    pub hull: Vec<Vec3>,
}

/// Who finds and solves the contacts of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactKind {
    /// Rapier, between surfaces: exact, and dear where many bodies meet.
    #[default]
    Surfaces,
    /// This crate, between vertices, edges and what they meet: for crowds. Bodies that are apart stay apart. The body's collider stays, for rays and the like, but
    /// rapier lets it touch nothing, and it does not touch itself.
    Vertices,
}

/// A kind of body: rest data, fields and charts, contacts, water, ground, attachments.
#[derive(Clone, Debug)]
pub struct ProcDefModel {
    /// Mesh, masses, regions.
    pub rig: Arc<ProcDefRig>,
    /// Fields, charts, the answer to stimuli.
    pub motion: Arc<MotionRig>,
    /// How bodies are simulated when they are inserted.
    pub settings: ProcDefSettings,
    /// The triangles of the boundary, counter-clockwise seen from outside.
    pub boundary: Vec<[u32; 3]>,
    /// Volume at rest that belongs to each vertex, in cubic metres.
    pub volumes: Vec<f32>,
    /// Coulomb coefficient of contacts.
    pub friction: f32,
    /// Whether the body touches itself.
    pub self_contact: bool,
    /// Who makes its contacts.
    pub contacts: ContactKind,
    /// When contacts are stimuli; never if there is none.
    pub trigger: Option<TriggerSettings>,
    /// What water does to the body; nothing if there is none.
    pub water: Option<WaterDescription>,
    /// Friction on fixed ground that differs along and against a direction.
    pub ground: Option<GroundDescription>,
    /// Rigid things that come with the body.
    pub attachments: Vec<RigidAttachment>,
}

impl ProcDefModel {
    /// A kind of body without water, directed friction, triggers and attachments; friction 0.5.
    pub fn new(rig: Arc<ProcDefRig>, motion: Arc<MotionRig>) -> Self {
        let boundary = rig.mesh().boundary();
        let volumes = rig.mesh().vertex_volumes().into_iter().map(|v| v as f32).collect();
        Self {
            rig,
            motion,
            settings: ProcDefSettings::default(),
            boundary,
            volumes,
            friction: 0.5,
            self_contact: false,
            contacts: ContactKind::default(),
            trigger: None,
            water: None,
            ground: None,
            attachments: Vec::new(),
        }
    }

    /// The kind of body that a rig file describes.
    ///
    /// # Errors
    /// [`ProcDefRigError`] where the mesh is too small or too large, or a mass is lost in 32 bits.
    pub fn from_file(file: &MotionRigFile) -> Result<Self, ProcDefRigError> {
        let description = &file.description;
        let mut builder = ProcDefRigBuilder::new(file.mesh.clone());
        match (description.mass, description.density) {
            (Some(mass), _) => {
                builder.density((f64::from(mass) / file.mesh.volume()) as f32);
            }
            (None, Some(density)) => {
                builder.density(density);
            }
            (None, None) => {}
        }
        let mut model = Self::new(Arc::new(builder.build()?), Arc::new(file.built.motion.clone()));
        let plain = ProcDefSettings::default();
        model.settings = ProcDefSettings {
            stiffness: match (description.stiffness, description.iterations) {
                (Some(stiffness), _) => Stiffness::Solve(stiffness),
                (None, Some(n)) => Stiffness::Iterations(n),
                (None, None) => plain.stiffness,
            },
            damping: description.damping.unwrap_or(plain.damping),
            keep_volume: description.keep_volume.unwrap_or(plain.keep_volume),
            least_volume: description.least_volume.unwrap_or(plain.least_volume),
        };
        if let Some(contact) = description.contact {
            model.friction = contact.friction;
            model.self_contact = contact.self_contact;
            model.contacts = if contact.vertices { ContactKind::Vertices } else { ContactKind::Surfaces };
        }
        model.trigger = file.built.trigger;
        model.water = description.water;
        model.ground = description.ground;
        for (attachment, mesh) in description.attachment.iter().zip(&file.attachments) {
            let (Some(mesh), Some(mass)) = (mesh, attachment.mass) else { continue };
            model.attachments.push(RigidAttachment {
                name: attachment.name.clone(),
                vertices: model.vertices_within(Vec3::from(attachment.centre), attachment.radius),
                mass,
                hull: mesh.positions.clone(),
            });
        }
        Ok(model)
    }

    /// The vertices at rest within a ball, ascending.
    pub fn vertices_within(&self, centre: Vec3, radius: f32) -> Vec<u32> {
        let positions = (0u32..).zip(&self.rig.mesh().positions);
        positions.filter(|(_, x)| x.distance(centre) <= radius).map(|(v, _)| v).collect()
    }

    /// The mean length of the edges of the boundary, in metres.
    pub fn boundary_edge(&self) -> f32 {
        let positions = &self.rig.mesh().positions;
        let around = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            a.distance(b) + b.distance(c) + c.distance(a)
        };
        self.boundary.iter().map(around).sum::<f32>() / (3 * self.boundary.len()).max(1) as f32
    }
}
