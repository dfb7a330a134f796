//! The plane between two skins that overlap, and the convex parts that push each skin to its side.

use std::f32::consts::FRAC_PI_2;

use rapier3d::geometry::{ColliderHandle, SharedShape};

use super::overlap::{Overlap, SkinSide, frame_of};
use crate::coupling::obstacle::{ObstacleError, ObstaclePart, OuterFace, PartId, convex_parts};
use crate::math::{Mat3, Pose, Quat, Vec3};

/// Where two skins are to touch: a plane across the line between their axes, and how far each skin reaches along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// Two directions in the plane and, as the z axis, the one towards the first skin.
    pub frame: Mat3,
    /// Height of the plane along the z axis, in metres.
    pub height: f32,
    /// How far the first skin reaches beyond it, and the second on the other side, in metres.
    pub reach: [f32; 2],
    /// The shadows of the two skins on the plane.
    pub shadows: [Shadow; 2],
    /// True where the shadows are taken for discs, not for rectangles.
    pub round: bool,
}

/// A rectangle in the plane, in the frame's coordinates, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// Middle.
    pub middle: [f32; 2],
    /// Half of the sides.
    pub half: [f32; 2],
}

impl Shadow {
    fn of(points: impl Iterator<Item = Vec3>, frame: Mat3) -> Self {
        let turned = frame.transpose();
        let (mut from, mut to) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for x in points {
            let x = turned * x;
            (from, to) = (from.min(x), to.max(x));
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        Self { middle: [middle.x, middle.y], half: [half.x, half.y] }
    }
}

impl Interface {
    /// The interface of an overlap between two skins. `share` is the part of it by which the first yields, from 0 to 1: its
    /// compliance over that of both. `along` is a direction that the skins follow; without one they are taken for round.
    ///
    /// None where nothing overlaps.
    pub fn of(
        overlap: &Overlap,
        skins: Option<[SkinSide<'_>; 2]>,
        normal: Vec3,
        along: Option<Vec3>,
        share: f32,
    ) -> Option<Self> {
        if overlap.is_empty() {
            return None;
        }
        let frame = frame_of(normal, along.unwrap_or(Vec3::ZERO));
        let (low, high) = overlap.heights(normal);
        let height = low + (high - low) * share;
        let shadows = match skins {
            Some(skins) => {
                skins.map(|side| Shadow::of(side.vertices.iter().map(|&v| side.positions[v as usize]), frame))
            }
            None => [Shadow::of(overlap.a.iter().chain(&overlap.b).map(|p| p.position), frame); 2],
        };
        Some(Self { frame, height, reach: [height - low, high - height], shadows, round: along.is_none() })
    }
}

/// The convex part that pushes one of the two skins to its side of the interface: a box, or a cylinder, behind the plane,
/// as wide as the other skin. `first` tells which skin is pushed; the part is as deep as that skin reaches beyond the plane,
/// and `margin` metres more.
///
/// # Errors
/// Where the part is not finite or has no volume.
pub fn interface_part(
    interface: &Interface,
    first: bool,
    margin: f32,
    id: PartId,
) -> Result<ObstaclePart, ObstacleError> {
    let out = if first { interface.frame.z_axis } else { -interface.frame.z_axis };
    let depth = 0.5 * (interface.reach[usize::from(!first)] + margin);
    let Shadow { middle, half } = interface.shadows[usize::from(first)];
    let flat = Quat::from_mat3(&interface.frame);
    let (shape, rotation) = match interface.round {
        // Parry's cylinders stand along y.
        true => (SharedShape::cylinder(depth, half[0].max(half[1])), flat * Quat::from_rotation_x(FRAC_PI_2)),
        false => (SharedShape::cuboid(half[0], half[1], depth), flat),
    };
    let centre = interface.frame * Vec3::new(middle[0], middle[1], interface.height);
    let pose = Pose::from_parts(centre - out * depth, rotation);
    let mut parts = convex_parts(&shape)?;
    let local = parts.swap_remove(0);
    let mut part = ObstaclePart::new(id, ColliderHandle::invalid(), &local, pose);
    // Nothing leaves through the sides: the other skin is all around.
    part.face = Some(OuterFace {
        normal: out,
        offset: out.dot(centre),
        area: 4.0 * half[0] * half[1],
        two_sided: false,
        edges: Vec::new(),
    });
    Ok(part)
}
