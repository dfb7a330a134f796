//! The plane between two skins that overlap, and the convex parts that push each skin to its side.

use std::f32::consts::FRAC_PI_2;

use rapier3d::geometry::{ColliderHandle, SharedShape};

use super::overlap::{Overlap, frame_of};
use crate::coupling::obstacle::{ObstacleError, ObstaclePart, OuterFace, PartId, convex_parts};
use crate::math::{Mat3, Pose, Quat, Vec3};

/// Where two skins are to touch: a rectangle or a disc across the line between their axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// Middle of the rectangle.
    pub centre: Vec3,
    /// Its two sides and, as the z axis, the direction towards the first skin.
    pub frame: Mat3,
    /// Half of its sides in metres.
    pub half: [f32; 2],
    /// Where the overlap follows no direction: the radius of a disc instead of the rectangle, in metres.
    pub round: Option<f32>,
    /// How far the first skin reaches beyond it, and the second on the other side, in metres.
    pub reach: [f32; 2],
}

impl Interface {
    /// The interface of an overlap. `share` is the part of it by which the first skin yields, from 0 to 1: its compliance
    /// over that of both. `along` is the direction that the rectangle follows; it is a disc where there is none.
    ///
    /// None where nothing overlaps.
    pub fn of(overlap: &Overlap, normal: Vec3, along: Option<Vec3>, share: f32) -> Option<Self> {
        if overlap.is_empty() {
            return None;
        }
        let (low, high) = overlap.heights(normal);
        let plane = low + (high - low) * share;
        let interface = Self {
            centre: normal * plane,
            frame: frame_of(normal, along.unwrap_or(Vec3::ZERO)),
            half: [f32::NEG_INFINITY; 2],
            round: along.is_none().then_some(f32::NEG_INFINITY),
            reach: [0.0; 2],
        };
        Some(interface.widened(overlap))
    }

    /// The same plane, wide enough for what overlaps now too.
    #[must_use]
    pub fn widened(&self, overlap: &Overlap) -> Self {
        let frame = self.frame;
        let plane = self.centre.dot(frame.z_axis);
        let (mut from, mut to) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        if self.half[0] >= 0.0 {
            let (middle, half) = (frame.transpose() * self.centre, Vec3::new(self.half[0], self.half[1], 0.0));
            (from, to) = (middle - half, middle + half);
        }
        let points = || overlap.a.iter().chain(&overlap.b).map(|p| p.position);
        for x in points() {
            let local = frame.transpose() * x;
            (from, to) = (from.min(local), to.max(local));
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let centre = frame * Vec3::new(middle.x, middle.y, plane);
        let aside = |x: Vec3| (x - centre - frame.z_axis * (x - centre).dot(frame.z_axis)).length();
        let kept = self.round.map(|radius| radius + aside(self.centre));
        let round = kept.map(|kept| points().map(aside).fold(kept.max(0.0), f32::max));
        let (low, high) = overlap.heights(frame.z_axis);
        let reach = [self.reach[0].max(plane - low), self.reach[1].max(high - plane)];
        Self { centre, frame, half: [half.x, half.y], round, reach }
    }
}

/// The convex part that pushes one of the two skins to its side of the interface: a box with the interface as its face.
///
/// `first` tells which of the two skins; the box is as deep as that skin reaches beyond the interface, and `margin`
/// metres more, and `margin` metres wider on each side than the overlap.
///
/// # Errors
/// Where the box is not finite.
pub fn interface_part(
    interface: &Interface,
    first: bool,
    margin: f32,
    id: PartId,
) -> Result<ObstaclePart, ObstacleError> {
    let out = if first { interface.frame.z_axis } else { -interface.frame.z_axis };
    let depth = 0.5 * (interface.reach[usize::from(!first)] + margin);
    let beside = margin * BESIDE;
    let half = interface.half.map(|half| half + beside);
    let flat = Quat::from_mat3(&interface.frame);
    let (shape, rotation) = match interface.round {
        // Parry's cylinders stand along y.
        Some(radius) => (SharedShape::cylinder(depth, radius + beside), flat * Quat::from_rotation_x(FRAC_PI_2)),
        None => (SharedShape::cuboid(half[0], half[1], depth), flat),
    };
    let pose = Pose::from_parts(interface.centre - out * depth, rotation);
    let mut parts = convex_parts(&shape)?;
    let local = parts.swap_remove(0);
    let mut part = ObstaclePart::new(id, ColliderHandle::invalid(), &local, pose);
    // Nothing leaves through the sides: the other skin is all around.
    part.face = Some(OuterFace {
        normal: out,
        offset: out.dot(interface.centre),
        area: 4.0 * half[0] * half[1],
        middle: interface.centre,
        thickness: 2.0 * depth,
        two_sided: false,
        edges: Vec::new(),
    });
    Ok(part)
}

/// The box is wider than the overlap by this part of its margin.
const BESIDE: f32 = 0.1;
