//! The convex parts of an obstacle as closed surfaces, to show and to write.

use std::f32::consts::{FRAC_PI_2, TAU};

use pliant::coupling::LocalPart;
use pliant::math::{Pose, Quat, Vec3};
use rapier3d::geometry::{SharedShape, TypedShape};
use rapier3d::parry::transformation::try_convex_hull;

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

impl ShownPart {
    /// The surface of a part.
    pub(super) fn new(part: &LocalPart) -> Self {
        let (positions, triangles) = surface(&part.shape);
        Self { pose: part.pose, positions, triangles }
    }
}

/// Segments around a round shape.
const AROUND: u32 = 48;

/// A half-space is shown as a block of this half width, in metres.
const WIDE: f32 = 50.0;

type Surface = (Vec<Vec3>, Vec<[u32; 3]>);

/// The surface of a convex shape as triangles.
fn surface(shape: &SharedShape) -> Surface {
    match shape.as_typed_shape() {
        TypedShape::Ball(s) => s.to_trimesh(AROUND, AROUND / 2),
        TypedShape::Cuboid(s) => s.to_trimesh(),
        TypedShape::Capsule(s) => s.to_trimesh(AROUND, AROUND / 4),
        TypedShape::Cylinder(s) => s.to_trimesh(AROUND),
        TypedShape::Cone(s) => s.to_trimesh(AROUND),
        TypedShape::ConvexPolyhedron(s) => s.to_trimesh(),
        TypedShape::TriMesh(s) => (s.vertices().to_vec(), s.indices().to_vec()),
        TypedShape::RoundCuboid(s) => rounded(&s.inner_shape.to_trimesh().0, s.border_radius),
        TypedShape::RoundCylinder(s) => rounded(&s.inner_shape.to_trimesh(AROUND).0, s.border_radius),
        TypedShape::RoundCone(s) => rounded(&s.inner_shape.to_trimesh(AROUND).0, s.border_radius),
        TypedShape::RoundConvexPolyhedron(s) => rounded(s.inner_shape.points(), s.border_radius),
        TypedShape::HalfSpace(s) => {
            let turned = Quat::from_rotation_arc(Vec3::Y, s.normal);
            let (positions, triangles) = rapier3d::parry::shape::Cuboid::new(Vec3::splat(WIDE)).to_trimesh();
            (positions.into_iter().map(|p| turned * (p - Vec3::Y * WIDE)).collect(), triangles)
        }
        _ => Surface::default(),
    }
}

/// The hull of `corners` with a round border: in each of many directions the farthest corner, and the radius from there.
fn rounded(corners: &[Vec3], radius: f32) -> Surface {
    let rows = AROUND / 2;
    let direction = |row: u32, column: u32| {
        let (up, out) = (FRAC_PI_2 - TAU * 0.5 * row as f32 / rows as f32).sin_cos();
        let (sin, cos) = (TAU * column as f32 / AROUND as f32).sin_cos();
        Vec3::new(out * sin, up, out * cos)
    };
    let directions = (0..=rows).flat_map(|row| (0..AROUND).map(move |column| direction(row, column)));
    let points: Vec<Vec3> = directions
        .filter_map(|d| corners.iter().max_by(|a, b| a.dot(d).total_cmp(&b.dot(d))).map(|corner| *corner + d * radius))
        .collect();
    try_convex_hull(&points).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pliant::coupling::convex_parts;
    use pliant::mesh::measure::signed_volume;

    #[test]
    fn shown_parts_have_the_volume_of_their_shapes_and_face_outward() {
        let pi = std::f32::consts::PI;
        // Of a box: its own, its faces', its edges' and its corners' share of the border.
        let (a, b, c, r) = (0.8_f32, 0.4, 0.6, 0.1);
        let edges = pi * r * r * (a + b + c);
        let round_box = a * b * c + 2.0 * r * (a * b + b * c + c * a) + edges + 4.0 / 3.0 * pi * r.powi(3);
        let shapes = [
            (SharedShape::ball(0.5), 4.0 / 3.0 * pi * 0.125),
            (SharedShape::round_cuboid(0.4, 0.2, 0.3, 0.1), round_box),
            (SharedShape::cone(0.5, 0.4), pi * 0.16 / 3.0),
            (SharedShape::halfspace(Vec3::X), (2.0 * WIDE).powi(3)),
        ];
        for (shape, volume) in shapes {
            let part = ShownPart::new(&convex_parts(&shape).expect("parts")[0]);
            let shown = signed_volume(&part.positions, &part.triangles) as f32;
            // Flat facets lie below the round surface, by a percent or so at 48 segments.
            assert!(shown < 1.001 * volume && shown > 0.975 * volume, "{shown} instead of {volume}");
        }
    }
}
