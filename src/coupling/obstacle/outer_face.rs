//! The one face of a surface's part that is not covered by its neighbours, and the ways out through it.
//!
//! A piece of a surface has sides that only its neighbours touch. Nothing leaves through them: the way out is up, through
//! the face, tilted over an edge at most as far as the surface bends away there.

use crate::math::{Pose, Vec3};

/// The outer face of a part, in the part's frame or in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct OuterFace {
    /// Unit normal, outward.
    pub normal: Vec3,
    /// Height of the face along the normal: inside is `normal · x ≤ offset`.
    pub offset: f32,
    /// Area in m².
    pub area: f32,
    /// The middle of the face.
    pub middle: Vec3,
    /// How deep the surface is solid, in metres: about the size of the body that meets it.
    pub thickness: f32,
    /// A sheet with an outer face on each side; solid behind the face otherwise.
    pub two_sided: bool,
    /// For each edge its outward direction in the face (unit) and the largest tangent of the angle by which a way out may
    /// be tilted that way: half of the bend of the surface where it bends away, 0 where it does not, infinite where the
    /// surface ends.
    pub edges: Vec<(Vec3, f32)>,
}

impl OuterFace {
    /// The face moved by `pose`.
    pub fn moved(&self, pose: &Pose) -> Self {
        let normal = pose.rotation * self.normal;
        Self {
            normal,
            offset: self.offset + normal.dot(pose.translation),
            area: self.area,
            middle: pose.transform_point(self.middle),
            thickness: self.thickness,
            two_sided: self.two_sided,
            edges: self.edges.iter().map(|(way, tangent)| (pose.rotation * *way, *tangent)).collect(),
        }
    }

    /// The way out nearest to `direction` (unit) that leads through the face.
    ///
    /// The part of the direction that lies in the face is shortened until no edge is passed by more than its tilt.
    /// A direction against the normal of a solid is kept: it says nothing about the face.
    pub fn way_out(&self, direction: Vec3) -> Vec3 {
        let normal = if self.two_sided && self.normal.dot(direction) < 0.0 { -self.normal } else { self.normal };
        let up = normal.dot(direction);
        if up <= 0.0 {
            return direction;
        }
        let aside = direction - normal * up;
        let allowed = |&(way, tangent): &(Vec3, f32)| {
            let tilt = way.dot(aside);
            // As far as rounding goes there is no tilt.
            if tilt <= 1.0e-6 { 1.0 } else { (tangent * up / tilt).min(1.0) }
        };
        let share = self.edges.iter().map(allowed).fold(1.0, f32::min);
        (normal * up + aside * share).normalize_or(normal)
    }

    /// The way from `x` behind the face to its plane; none for a sheet.
    pub fn way_to_surface(&self, x: Vec3) -> Option<Vec3> {
        (!self.two_sided).then(|| self.normal * (self.offset - self.normal.dot(x)).max(0.0))
    }

    /// How far `x` behind the face must go along `direction` (unit) to come out at its plane; none for a sheet, and where
    /// the direction leads along the face rather than out.
    pub fn exit(&self, x: Vec3, direction: Vec3) -> Option<f32> {
        let rate = self.normal.dot(direction);
        (!self.two_sided && rate > STEEPEST).then(|| (self.offset - self.normal.dot(x)).max(0.0) / rate)
    }
}

/// Least cosine between a way out and the normal.
const STEEPEST: f32 = 0.5;
