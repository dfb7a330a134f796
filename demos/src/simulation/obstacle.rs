//! An obstacle of a scene in rapier, and its convex parts as surfaces to show and to write.

use std::path::PathBuf;

use pliant::coupling::{convex_parts, decompose};
use pliant::math::{Pose, Vec3};
use pliant::mesh::{TriangleMesh, load_obj};
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::{ColliderBuilder, ColliderHandle, SharedShape, TypedShape};
use rapier3d::pipeline::PhysicsWorld;

use super::build::BuildError;
use super::ring::ring;
use crate::scene::{Obstacle, ObstacleShape};

/// Convex parts of a mesh obstacle that says nothing about their number.
const DEFAULT_PARTS: u32 = 16;

/// A convex part as a closed surface in its own frame.
#[derive(Clone, Debug)]
pub struct ShownPart {
    /// Obstacle from part.
    pub pose: Pose,
    /// Corners in the part's frame.
    pub positions: Vec<Vec3>,
    /// Triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

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
    /// The mesh it was cut from, if it was one.
    pub mesh: Option<TriangleMesh>,
}

impl ObstacleBody {
    /// Puts an obstacle into the world, fixed or kinematic.
    pub fn insert(obstacle: &Obstacle, physics: &mut PhysicsWorld) -> Result<Self, BuildError> {
        let (shape, mesh) = shape_of(obstacle)?;
        let builder = match obstacle.is_moving() {
            true => RigidBodyBuilder::kinematic_position_based(),
            false => RigidBodyBuilder::fixed(),
        };
        let body = physics.insert_body(builder.pose(obstacle.pose_at(0.0)));
        let mut collider = ColliderBuilder::new(shape.clone());
        if let Some(friction) = obstacle.friction {
            collider = collider.friction(friction);
        }
        let collider = physics.insert_collider(collider, Some(body));
        let parts = convex_parts(&shape).map_err(|error| BuildError::Parts { name: name_of(obstacle), error })?;
        let parts = parts
            .iter()
            .map(|part| {
                let (positions, triangles) = surface(&part.shape);
                ShownPart { pose: part.pose, positions, triangles }
            })
            .collect();
        Ok(Self { obstacle: obstacle.clone(), body, collider, parts, mesh })
    }

    /// Where the obstacle is.
    pub fn pose(&self, physics: &PhysicsWorld) -> Pose {
        physics.bodies.get(self.body).map_or(Pose::IDENTITY, |body| *body.position())
    }
}

fn name_of(obstacle: &Obstacle) -> String {
    obstacle.name.clone().unwrap_or_else(|| "without a name".into())
}

fn shape_of(obstacle: &Obstacle) -> Result<(SharedShape, Option<TriangleMesh>), BuildError> {
    let shape = match &obstacle.shape {
        ObstacleShape::Ball { radius } => SharedShape::ball(*radius),
        ObstacleShape::Cuboid { half_extents: h } => SharedShape::cuboid(h.x, h.y, h.z),
        ObstacleShape::Capsule { half_height, radius } => SharedShape::capsule_y(*half_height, *radius),
        ObstacleShape::Cylinder { half_height, radius } => SharedShape::cylinder(*half_height, *radius),
        ObstacleShape::Cone { half_height, radius } => SharedShape::cone(*half_height, *radius),
        ObstacleShape::Ring { radius, thickness } => ring(*radius, *thickness),
        ObstacleShape::Mesh { file, scale, max_parts } => {
            let mesh = scaled_mesh(file, *scale)?;
            let shape = decompose(&mesh, max_parts.unwrap_or(DEFAULT_PARTS));
            let shape = shape.map_err(|error| BuildError::Parts { name: file.display().to_string(), error })?;
            return Ok((shape, Some(mesh)));
        }
    };
    Ok((shape, None))
}

fn scaled_mesh(file: &PathBuf, scale: f32) -> Result<TriangleMesh, BuildError> {
    let mut mesh = load_obj(file).map_err(BuildError::Mesh)?;
    mesh.positions.iter_mut().for_each(|p| *p *= scale);
    Ok(mesh)
}

/// Segments around a round shape.
const AROUND: u32 = 48;

/// The surface of a convex shape as triangles.
fn surface(shape: &SharedShape) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    match shape.as_typed_shape() {
        TypedShape::Ball(s) => s.to_trimesh(AROUND, AROUND / 2),
        TypedShape::Cuboid(s) => s.to_trimesh(),
        TypedShape::Capsule(s) => s.to_trimesh(AROUND, AROUND / 4),
        TypedShape::Cylinder(s) => s.to_trimesh(AROUND),
        TypedShape::Cone(s) => s.to_trimesh(AROUND),
        TypedShape::ConvexPolyhedron(s) => s.to_trimesh(),
        _ => (Vec::new(), Vec::new()),
    }
}
