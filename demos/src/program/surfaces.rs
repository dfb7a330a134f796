//! The surfaces of obstacles: crisp, with edges a little rounded so that they catch the light.

use crate::render::{MeshData, shapes};
use crate::scene::ObstacleShape;
use crate::simulation::{ObstacleBody, ring_surface};

use super::creases::creased;

/// Radius of a rounded edge in metres, and at most this share of the shape's smallest side.
const BEVEL: f32 = 0.015;
const BEVEL_SHARE: f32 = 0.15;

/// Faces that meet at more than this angle have an edge between them, in degrees.
const CREASE: f32 = 40.0;

/// The surface of an obstacle in its own frame.
pub fn surface(obstacle: &ObstacleBody) -> MeshData {
    let bevel = |side: f32| BEVEL.min(BEVEL_SHARE * side);
    match &obstacle.obstacle.shape {
        ObstacleShape::Ball { radius } => shapes::ball(*radius),
        ObstacleShape::Cuboid { half_extents, rounding } if *rounding > 0.0 => {
            shapes::cuboid(*half_extents + *rounding, *rounding)
        }
        ObstacleShape::Cuboid { half_extents, .. } => shapes::cuboid(*half_extents, bevel(half_extents.min_element())),
        ObstacleShape::Capsule { half_height, radius } => shapes::capsule(*half_height, *radius),
        ObstacleShape::Cylinder { half_height, radius, rounding } if *rounding > 0.0 => {
            shapes::cylinder(half_height + rounding, radius + rounding, *rounding)
        }
        ObstacleShape::Cylinder { half_height, radius, .. } => {
            shapes::cylinder(*half_height, *radius, bevel(half_height.min(*radius)))
        }
        ObstacleShape::Ring { radius, thickness } => {
            let (positions, normals, triangles) = ring_surface(*radius, *thickness);
            MeshData { positions, normals, indices: triangles.into_flattened() }
        }
        _ => match &obstacle.mesh {
            Some(mesh) => creased(&mesh.positions, &mesh.triangles, CREASE),
            None => parts(obstacle),
        },
    }
}

/// The convex parts as they are.
fn parts(obstacle: &ObstacleBody) -> MeshData {
    let mut all = MeshData::default();
    for part in &obstacle.parts {
        let placed: Vec<_> = part.positions.iter().map(|p| part.pose.transform_point(*p)).collect();
        let mesh = creased(&placed, &part.triangles, CREASE);
        let first = all.positions.len() as u32;
        all.positions.extend(mesh.positions);
        all.normals.extend(mesh.normals);
        all.indices.extend(mesh.indices.iter().map(|i| i + first));
    }
    all
}
