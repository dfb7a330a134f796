//! An obstacle of a scene in rapier.

use pliant::coupling::convex_parts;
use pliant::math::Pose;
use pliant::mesh::TriangleMesh;
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::{ColliderBuilder, ColliderHandle};
use rapier3d::pipeline::PhysicsWorld;

use super::build::BuildError;
use super::shape::shape_of;
use super::shown_part::ShownPart;
use crate::scene::{Obstacle, ObstacleMass};

/// An obstacle with its rigid body.
pub struct ObstacleBody {
    /// Its description.
    pub obstacle: Obstacle,
    /// Its rigid body.
    pub body: RigidBodyHandle,
    /// Its collider.
    pub collider: ColliderHandle,
    /// Its convex parts.
    pub parts: Vec<ShownPart>,
    /// The mesh it was made from, if it was.
    pub mesh: Option<TriangleMesh>,
}

impl ObstacleBody {
    /// Puts an obstacle into the world: fixed, kinematic or dynamic.
    pub fn insert(obstacle: &Obstacle, physics: &mut PhysicsWorld) -> Result<Self, BuildError> {
        let name = obstacle.name.as_deref().unwrap_or("without a name");
        let (shape, mesh) = shape_of(name, &obstacle.shape)?;
        let parts = convex_parts(&shape).map_err(|error| BuildError::Parts { name: name.into(), error })?;
        let builder = match obstacle.dynamic {
            Some(dynamic) => RigidBodyBuilder::dynamic()
                .linvel(dynamic.velocity)
                .angvel(dynamic.angular_velocity)
                .ccd_enabled(true)
                .linear_damping(dynamic.linear_damping)
                .angular_damping(dynamic.angular_damping),
            None if obstacle.is_moving() => RigidBodyBuilder::kinematic_position_based(),
            None => RigidBodyBuilder::fixed(),
        };
        let body = physics.insert_body(builder.pose(obstacle.pose_at(0.0)));
        let mut collider = ColliderBuilder::new(shape);
        if let Some(friction) = obstacle.friction {
            collider = collider.friction(friction);
        }
        if let Some(restitution) = obstacle.restitution {
            collider = collider.restitution(restitution);
        }
        collider = match obstacle.dynamic.map(|dynamic| dynamic.mass) {
            Some(ObstacleMass::Mass(mass)) => collider.mass(mass),
            Some(ObstacleMass::Density(density)) => collider.density(density),
            None => collider,
        };
        let collider = physics.insert_collider(collider, Some(body));
        let parts = parts.iter().map(ShownPart::new).collect();
        Ok(Self { obstacle: obstacle.clone(), body, collider, parts, mesh })
    }

    /// Where the obstacle is.
    pub fn pose(&self, physics: &PhysicsWorld) -> Pose {
        physics.bodies.get(self.body).map_or(Pose::IDENTITY, |body| *body.position())
    }
}
