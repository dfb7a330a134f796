//! The convex part that a convex shape is.

use std::sync::Arc;

use rapier3d::parry::shape::{Capsule, Segment, SharedShape, Triangle, TypedShape};

use super::error::ObstacleError;
use super::local_part::{LocalPart, surface};
use crate::field::{ConvexHull, ConvexPart, PartShape};
use crate::math::{Pose, Vec3};

/// The part that a convex shape is; triangles and segments, which have no volume, are made `sheet` metres thick.
pub(super) fn convex_part(shape: &SharedShape, sheet: f32) -> Result<LocalPart, ObstacleError> {
    let whole = |part: PartShape| plain(part, 0.0, shape.clone(), shape.clone(), 0.0);
    Ok(match shape.as_typed_shape() {
        TypedShape::Ball(s) => plain(PartShape::Point, s.radius, shape.clone(), shape.clone(), 0.0),
        TypedShape::Capsule(s) => {
            let part = PartShape::Segment { a: s.segment.a, b: s.segment.b };
            plain(part, s.radius, shape.clone(), shape.clone(), 0.0)
        }
        TypedShape::Cuboid(s) => whole(PartShape::Cuboid { half_extents: s.half_extents }),
        TypedShape::Cylinder(s) => whole(PartShape::Cylinder { half_height: s.half_height, radius: s.radius }),
        TypedShape::Cone(s) => whole(PartShape::Cone { half_height: s.half_height, radius: s.radius }),
        TypedShape::HalfSpace(s) => whole(PartShape::HalfSpace { normal: s.normal }),
        TypedShape::RoundCuboid(s) => {
            let part = PartShape::Cuboid { half_extents: s.inner_shape.half_extents };
            plain(part, s.border_radius, shape.clone(), SharedShape::new(s.inner_shape), s.border_radius)
        }
        TypedShape::RoundCylinder(s) => {
            let inner = s.inner_shape;
            let part = PartShape::Cylinder { half_height: inner.half_height, radius: inner.radius };
            plain(part, s.border_radius, shape.clone(), SharedShape::new(inner), s.border_radius)
        }
        TypedShape::RoundCone(s) => {
            let inner = s.inner_shape;
            let part = PartShape::Cone { half_height: inner.half_height, radius: inner.radius };
            plain(part, s.border_radius, shape.clone(), SharedShape::new(inner), s.border_radius)
        }
        TypedShape::ConvexPolyhedron(s) => hull(shape, s.points(), 0.0)?,
        TypedShape::RoundConvexPolyhedron(s) => hull(shape, s.inner_shape.points(), s.border_radius)?,
        TypedShape::Triangle(s) => plate(s, sheet, 0.0)?,
        TypedShape::RoundTriangle(s) => {
            let size = s.inner_shape.local_aabb().extents().max_element();
            plate(&s.inner_shape, CORE_OF_ROUND_TRIANGLE * size, s.border_radius)?
        }
        TypedShape::Segment(s) => wire(s, 0.5 * sheet),
        _ => return Err(ObstacleError::Unknown(shape.shape_type())),
    })
}

/// The flat core of a round triangle is this part of its longest side thick: as thin as a hull can be made well.
const CORE_OF_ROUND_TRIANGLE: f32 = 1.0e-5;

fn plain(part: PartShape, rounding: f32, shape: SharedShape, exact: SharedShape, border: f32) -> LocalPart {
    LocalPart { pose: Pose::IDENTITY, part: ConvexPart { shape: part, rounding }, shape, exact, border, face: None }
}

fn hull(shape: &SharedShape, points: &[Vec3], rounding: f32) -> Result<LocalPart, ObstacleError> {
    let hull = ConvexHull::from_points(points)?;
    let exact = surface(&hull).unwrap_or_else(|| shape.clone());
    Ok(plain(PartShape::Hull(Arc::new(hull)), rounding, shape.clone(), exact, rounding))
}

/// A triangle as a plate, half of its thickness on each side.
fn plate(triangle: &Triangle, thickness: f32, rounding: f32) -> Result<LocalPart, ObstacleError> {
    let half = triangle.scaled_normal().try_normalize().unwrap_or_default() * (0.5 * thickness);
    let points: Vec<Vec3> = triangle.vertices().iter().flat_map(|&p| [p + half, p - half]).collect();
    Ok(LocalPart::hull(&points, rounding)?)
}

/// A segment as a wire.
pub(super) fn wire(segment: &Segment, radius: f32) -> LocalPart {
    let shape = SharedShape::new(Capsule { segment: *segment, radius });
    let part = PartShape::Segment { a: segment.a, b: segment.b };
    plain(part, radius, shape.clone(), shape, 0.0)
}
