//! Which segment meets which convex part, and which way out.

use super::obstacle::ObstaclePart;
use crate::field::PartShape;
use crate::math::{Pose, Vec3};

/// A convex part close to a segment, with the direction that leads out of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proximity {
    /// Segment of the body.
    pub segment: u16,
    /// Index of the part in the list of obstacles around the body.
    pub part: usize,
    /// Unit direction out of the part, towards the segment's axis.
    pub normal: Vec3,
    /// The point of the segment's axis that is nearest to the part.
    pub axis_point: Vec3,
    /// True where the part led a group of contacts in the step before: it leads it again unless another is much deeper.
    pub leads: bool,
}

/// The direction from a part to a segment's axis, and the nearest point of the axis.
///
/// The distance from a convex part is a convex function along the axis, so its minimum is found by bisection on the
/// sign of its slope. The axis lies deep inside the body and a solid core keeps it out of the parts: the direction does
/// not flip where the skin has already passed through a thin wall, and it changes smoothly while the body slides.
/// `None` where the axis itself is inside the part.
pub fn way_out(part: &ObstaclePart, axis: [Vec3; 2]) -> Option<(Vec3, Vec3)> {
    if let PartShape::HalfSpace { normal } = part.placed.part().shape {
        return Some((*part.placed.rotation() * normal, 0.5 * (axis[0] + axis[1])));
    }
    let along = axis[1] - axis[0];
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    if along.length_squared() > 0.0 {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let (distance, direction) = part.placed.distance(axis[0] + along * middle);
            if distance <= 0.0 {
                return None;
            }
            if direction.dot(along) > 0.0 { high = middle } else { low = middle }
        }
    }
    let point = axis[0] + along * (0.5 * (low + high));
    let (distance, direction) = part.placed.distance(point);
    (distance > 0.0).then(|| (part.way_out(direction), point))
}

/// The axis is halved this often: to a 4096th of its length.
const BISECTIONS: usize = 12;

/// How far a point of the skin has gone into a part along the way out, if it has.
///
/// A point has penetrated where it is inside the part, or where the part stands between it and the segment's axis and
/// the skin faces away from the axis there (`facing`, the cosine between normal and way out, is negative): then the part, or a thin wall of it, is in the flesh.
pub fn penetration(part: &ObstaclePart, near: &Proximity, x: Vec3, facing: f32, reach: f32) -> Option<f32> {
    if part.contains(x) {
        return part.exit(x, near.normal, reach);
    }
    let flesh = (near.axis_point - x).dot(near.normal);
    if flesh <= 0.0 || facing > -FACING_AWAY {
        return None;
    }
    part.exit(x, near.normal, flesh.min(reach))
}

/// How much skin outside of a part counts that faces it by this cosine between its normal and the way out: from nothing, where
/// [`penetration`] begins to see it, to all, where it faces the part twice as much.
pub fn faces(facing: f32) -> f32 {
    (-facing / FACING_AWAY - 1.0).clamp(0.0, 1.0)
}

/// Least cosine between the skin's normal and the way into the part for skin that faces the part.
const FACING_AWAY: f32 = 0.2;

/// An axis in the world.
pub fn moved_axis(motion: &Pose, axis: [Vec3; 2]) -> [Vec3; 2] {
    axis.map(|end| motion.transform_point(end))
}
