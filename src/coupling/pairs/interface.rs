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

/// How much farther the two shadows of an interface reach than they did: down and up along the two axes of the plane, in metres.
pub type Widening = [[[f32; 2]; 2]; 2];

/// A rectangle in the plane, in the frame's coordinates, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// Middle.
    pub middle: [f32; 2],
    /// Half of the sides.
    pub half: [f32; 2],
}

impl Shadow {
    /// The smallest rectangle around this one and another.
    fn joined(self, other: Self) -> Self {
        let join = |k: usize| {
            let from = (self.middle[k] - self.half[k]).min(other.middle[k] - other.half[k]);
            let to = (self.middle[k] + self.half[k]).max(other.middle[k] + other.half[k]);
            (0.5 * (from + to), 0.5 * (to - from))
        };
        let (x, y) = (join(0), join(1));
        Self { middle: [x.0, y.0], half: [x.1, y.1] }
    }

    /// How much farther this rectangle reaches than another one: down and up along each axis, in metres.
    fn beyond(self, other: Self) -> [[f32; 2]; 2] {
        std::array::from_fn(|k| {
            let down = (other.middle[k] - other.half[k]) - (self.middle[k] - self.half[k]);
            let up = (self.middle[k] + self.half[k]) - (other.middle[k] + other.half[k]);
            [down.max(0.0), up.max(0.0)]
        })
    }

    /// This rectangle with a margin down and up along each axis.
    fn grown(self, margin: [[f32; 2]; 2]) -> Self {
        let middle = std::array::from_fn(|k| self.middle[k] + 0.5 * (margin[k][1] - margin[k][0]));
        let half = std::array::from_fn(|k| self.half[k] + 0.5 * (margin[k][0] + margin[k][1]));
        Self { middle, half }
    }

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

    /// How much farther the shadows reach than those of another interface of the same skins.
    pub fn beyond(&self, other: &Self) -> Widening {
        std::array::from_fn(|side| self.shadows[side].beyond(other.shadows[side]))
    }

    /// The same plane with wider shadows, by a part of a widening.
    pub fn grown(self, widening: &Widening, part: f32) -> Self {
        let margin = |side: usize| widening[side].map(|ends| ends.map(|end| end * part));
        Self { shadows: std::array::from_fn(|side| self.shadows[side].grown(margin(side))), ..self }
    }

    /// The same plane, reaching as far as another interface between the same skins does, too: what was pushed out of one place may bulge
    /// into the other skin beside it.
    pub fn reaching(self, other: &Self) -> Self {
        let low = (self.height - self.reach[0]).min(other.height - other.reach[0]);
        let high = (self.height + self.reach[1]).max(other.height + other.reach[1]);
        let shadows = std::array::from_fn(|side| self.shadows[side].joined(other.shadows[side]));
        Self { reach: [self.height - low, high - self.height], shadows, ..self }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn interface(middle: [f32; 2], half: [f32; 2], height: f32, reach: [f32; 2]) -> Interface {
        Interface { frame: Mat3::IDENTITY, height, reach, shadows: [Shadow { middle, half }; 2], round: false }
    }

    #[test]
    fn a_widened_interface_keeps_its_plane_and_covers_both_places() {
        let first = interface([0.0, 0.0], [1.0, 0.5], 2.0, [0.1, 0.2]);
        let beside = interface([1.5, 0.0], [0.5, 0.2], 2.1, [0.4, 0.05]);
        let both = first.reaching(&beside);
        assert_eq!(both.height, 2.0);
        for side in both.shadows {
            assert_eq!((side.middle, side.half), ([0.5, 0.0], [1.5, 0.5]));
        }
        // From 1.7 to 2.2.
        assert!((both.reach[0] - 0.3).abs() < 1e-6 && (both.reach[1] - 0.2).abs() < 1e-6, "{:?}", both.reach);
        // The same widening of the first one in the next step covers the same.
        let again = first.grown(&both.beyond(&first), 1.0);
        for (again, both) in again.shadows.iter().zip(both.shadows) {
            assert_eq!((again.middle, again.half), (both.middle, both.half));
        }
        let half = first.grown(&both.beyond(&first), 0.5);
        assert_eq!((half.shadows[0].middle[0], half.shadows[0].half[0]), (0.25, 1.25));
    }
}
