//! From a scene to a world: rigs, ragdolls and obstacles.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use pliant::coupling::{ObstacleError, RagdollStart};
use pliant::elastic::{ElasticRig, RigError, load_rig};
use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::MeshError;
use pliant::world::{DeformationWorld, ElasticBodyHandle};
use rapier3d::dynamics::RigidBodyType;
use rapier3d::pipeline::PhysicsWorld;

use super::obstacle::ObstacleBody;
use super::running::Actor;
use crate::scene::Scene;

/// Why a scene does not come to life.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// A rig is wrong.
    #[error(transparent)]
    Rig(#[from] RigError),
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
    pub actors: Vec<Actor>,
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
            pose: if seed == 0 { body.pose } else { random.nudged(body.pose, rig.mesh.size()) },
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
    Ok(Built { physics, deformation, actors, obstacles })
}

/// Fixes the rigid bodies of an elastic body where they are.
fn hold(deformation: &DeformationWorld, handle: ElasticBodyHandle, physics: &mut PhysicsWorld) {
    for rigid in deformation.ragdoll(handle).into_iter().flat_map(|ragdoll| &ragdoll.bodies) {
        if let Some(rigid) = physics.bodies.get_mut(*rigid) {
            rigid.set_body_type(RigidBodyType::Fixed, true);
        }
    }
}

/// SplitMix64: the same starts for the same seed, everywhere.
struct Random(u64);

impl Random {
    /// A number in [-1, 1).
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    /// A pose turned at random about all axes and moved a little sideways.
    fn nudged(&mut self, pose: Pose, size: f32) -> Pose {
        let turn = Vec3::new(0.4 * self.next(), std::f32::consts::PI * self.next(), 0.4 * self.next());
        let shift = Vec3::new(self.next(), 0.0, self.next()) * (0.15 * size);
        let rotation = Quat::from_scaled_axis(turn) * pose.rotation;
        Pose::from_parts(pose.translation + shift, rotation)
    }
}
