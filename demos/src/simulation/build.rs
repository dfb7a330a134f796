//! From a scene to a world: rigs, ragdolls and obstacles.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use pliant::coupling::{ObstacleError, RagdollStart};
use pliant::elastic::{ElasticRig, RigError, load_rig};
use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::{MeshError, TetrahedralError};
use pliant::procdef::{MotionRigError, ProcDefRigError};
use pliant::world::{DeformationWorld, ElasticBodyHandle, ProcDefWorld};
use rapier3d::dynamics::RigidBodyType;
use rapier3d::pipeline::PhysicsWorld;

use super::obstacle::ObstacleBody;
use super::running::Actor;
use super::soft::{SoftActor, insert_soft_bodies};
use crate::scene::{Random, Scene};

/// Why a scene does not come to life.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// A rig is wrong.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// The rig of a body that moves by itself is wrong.
    #[error(transparent)]
    MotionRig(#[from] MotionRigError),
    /// The mesh of a body that moves by itself cannot be simulated.
    #[error("{}: {error}", rig.display())]
    Model {
        /// The rig file.
        rig: PathBuf,
        /// Why.
        error: ProcDefRigError,
    },
    /// The surface of a body that moves by itself cannot be drawn.
    #[error("{}: {error}", rig.display())]
    Skin {
        /// The rig file.
        rig: PathBuf,
        /// Why.
        error: TetrahedralError,
    },
    /// An attachment holds nothing.
    #[error("attachment {attachment}: no vertex of {body} is within {radius} m of {centre}")]
    Attachment {
        /// Index of the attachment in the scene.
        attachment: usize,
        /// The body.
        body: String,
        /// Middle of the ball, in the mesh.
        centre: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// The mesh of an obstacle is wrong.
    #[error(transparent)]
    Mesh(MeshError),
    /// An obstacle's shape cannot be made.
    #[error("obstacle {name}: {message}")]
    Shape {
        /// The obstacle.
        name: String,
        /// Why.
        message: String,
    },
    /// An obstacle has no convex parts.
    #[error("obstacle {name}: {error}")]
    Parts {
        /// The obstacle.
        name: String,
        /// Why.
        error: ObstacleError,
    },
}

pub(super) struct Built {
    pub physics: PhysicsWorld,
    pub deformation: DeformationWorld,
    pub creatures: ProcDefWorld,
    pub actors: Vec<Actor>,
    pub soft_actors: Vec<SoftActor>,
    pub obstacles: Vec<ObstacleBody>,
}

pub(super) fn build(scene: &Scene, seed: u64) -> Result<Built, BuildError> {
    let mut physics = PhysicsWorld::new();
    physics.gravity = scene.gravity;
    physics.integration_parameters.dt = scene.dt;
    let mut deformation = DeformationWorld::new();
    deformation.settings.cancel.softness = scene.softness;
    let obstacles =
        scene.obstacles.iter().map(|o| ObstacleBody::insert(o, &mut physics)).collect::<Result<Vec<_>, _>>()?;
    let mut rigs: BTreeMap<PathBuf, Arc<ElasticRig>> = BTreeMap::new();
    let mut random = Random(seed);
    let mut actors = Vec::new();
    for body in &scene.bodies {
        let rig = match rigs.get(&body.rig) {
            Some(rig) => rig.clone(),
            None => {
                let rig = Arc::new(load_rig(&body.rig)?);
                rigs.insert(body.rig.clone(), rig.clone());
                rig
            }
        };
        let start = RagdollStart {
            pose: if seed == 0 { body.pose } else { nudged(&mut random, body.pose, rig.mesh.size()) },
            linear_velocity: body.velocity,
            angular_velocity: body.angular_velocity,
            ..RagdollStart::default()
        };
        let handle = deformation.insert(rig, &start, &mut physics);
        if body.held {
            hold(&deformation, handle, &mut physics);
        }
        actors.push(Actor { name: body.name.clone(), handle, colour: body.colour });
    }
    let mut creatures = ProcDefWorld::new();
    let soft_actors = insert_soft_bodies(scene, seed, &obstacles, &mut creatures, &mut physics)?;
    Ok(Built { physics, deformation, creatures, actors, soft_actors, obstacles })
}

/// Fixes the rigid bodies of an elastic body where they are.
fn hold(deformation: &DeformationWorld, handle: ElasticBodyHandle, physics: &mut PhysicsWorld) {
    for rigid in deformation.ragdoll(handle).into_iter().flat_map(|ragdoll| &ragdoll.bodies) {
        if let Some(rigid) = physics.bodies.get_mut(*rigid) {
            rigid.set_body_type(RigidBodyType::Fixed, true);
        }
    }
}

/// A pose turned at random about all axes and moved a little sideways.
fn nudged(random: &mut Random, pose: Pose, size: f32) -> Pose {
    let turn = Vec3::new(0.4 * random.next(), std::f32::consts::PI * random.next(), 0.4 * random.next());
    let shift = Vec3::new(random.next(), 0.0, random.next()) * (0.15 * size);
    let rotation = Quat::from_scaled_axis(turn) * pose.rotation;
    Pose::from_parts(pose.translation + shift, rotation)
}
