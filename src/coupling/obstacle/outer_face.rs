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

#[cfg(test)]
mod tests {
    use super::*;

    fn face(edges: Vec<(Vec3, f32)>, two_sided: bool) -> OuterFace {
        OuterFace { normal: Vec3::Y, offset: 0.0, area: 1.0, two_sided, edges }
    }

    #[test]
    fn a_way_out_is_tilted_over_an_edge_as_far_as_the_surface_bends_away_there() {
        // To the right the surface bends away by a right angle, to the left it goes on, to the back it ends.
        let face = face(vec![(Vec3::X, 1.0), (Vec3::NEG_X, 0.0), (Vec3::NEG_Z, f32::INFINITY)], false);
        let close = |a: Vec3, b: Vec3| a.distance(b) < 1e-6;
        let diagonal = Vec3::new(1.0, 1.0, 0.0).normalize();
        assert!(close(face.way_out(diagonal), diagonal));
        assert!(close(face.way_out(Vec3::new(3.0, 1.0, 0.0).normalize()), diagonal), "halfway round the edge at most");
        assert!(close(face.way_out(Vec3::new(-1.0, 1.0, 0.0).normalize()), Vec3::Y), "not into the neighbour");
        let back = Vec3::new(0.0, 0.1, -1.0).normalize();
        assert!(close(face.way_out(back), back));
        let below = Vec3::new(0.3, -1.0, 0.2).normalize();
        assert!(close(face.way_out(below), below), "a solid says nothing about its inside");
    }

    #[test]
    fn a_sheet_leads_out_on_the_side_that_one_is_on() {
        let sheet = face(vec![(Vec3::X, 0.0), (Vec3::NEG_X, 0.0)], true);
        assert!(sheet.way_out(Vec3::new(0.5, -1.0, 0.0).normalize()).distance(Vec3::NEG_Y) < 1e-6);
        assert_eq!((sheet.exit(Vec3::NEG_Y, Vec3::Y), sheet.way_to_surface(Vec3::NEG_Y)), (None, None));
    }

    #[test]
    fn depths_count_to_the_plane_of_the_face_wherever_it_is_moved() {
        let pose = Pose::from_parts(Vec3::new(1.0, 2.0, 3.0), crate::math::Quat::from_rotation_z(0.7));
        let moved = face(Vec::new(), false).moved(&pose);
        let x = pose.transform_point(Vec3::new(0.3, -0.25, -0.4));
        let way = moved.way_to_surface(x).expect("a solid");
        assert!((way - pose.rotation * (Vec3::Y * 0.25)).length() < 1e-6);
        let tilted = pose.rotation * Vec3::new(0.6, 0.8, 0.0);
        assert!((moved.exit(x, tilted).expect("it leads out") - 0.25 / 0.8).abs() < 1e-6);
        assert_eq!(moved.exit(x, pose.rotation * Vec3::X), None);
    }
}
