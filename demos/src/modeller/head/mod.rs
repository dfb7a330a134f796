//! A human head with its neck, four times as large as life: y up, looking along +x, its right side at z > 0. Modelled
//! for z > 0 and mirrored.

mod ear;
mod eye;
mod mouth;
mod nose;
mod skull;

use glam::Vec3;

use super::blend::{intersect, unite};
use super::field::Field;
use super::mesh::Mesh;
use super::remesh::remesh_to_count;
use super::shapes::mirrored;
use super::smooth::smooth;
use super::surface::mesh_of;

/// How many triangles the head is wished to have.
pub const TRIANGLES: usize = 16_500;
/// The size of a cell of the first mesh, small enough for lips and lids.
const CELL: f32 = 0.0095;
/// The height at which the neck ends.
const NECK_END: f32 = -0.66;

/// The head's mesh.
pub fn head() -> Mesh {
    let low = Vec3::new(-0.60, -0.85, -0.55);
    let high = Vec3::new(0.60, 0.65, 0.55);
    let mut mesh = mesh_of(&Head, low, high, CELL);
    smooth(&mut mesh, 2);
    remesh_to_count(mesh, &Head, &fineness, TRIANGLES)
}

/// The whole head as a distance field.
pub struct Head;

impl Field for Head {
    fn distance(&self, p: Vec3) -> f32 {
        let p = mirrored(p);
        let bones = skull::distance(p);
        let mouthed = mouth::grown_onto(bones, p);
        let nosed = nose::grown_onto(mouthed, p);
        let eyed = eye::set_into(nosed, p);
        let eared = ear::grown_onto(eyed, p);
        intersect(unite(eared, skull::neck(p), 0.10), NECK_END - p.y, 0.06)
    }
}

/// The relative edge length: finer in the face, finest around eyes and mouth, and fine at the ears.
fn fineness(p: Vec3) -> f32 {
    let p = mirrored(p);
    let near = |center: Vec3, inner: f32, outer: f32| {
        let t = ((p.distance(center) - inner) / (outer - inner)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let face = 0.62 + 0.38 * near(Vec3::new(0.34, -0.10, 0.06), 0.20, 0.50);
    let eye = 0.44 + 0.56 * near(eye::CENTER, 0.10, 0.34);
    let mouth = 0.48 + 0.52 * near(mouth::CENTER, 0.12, 0.38);
    let ear = 0.52 + 0.48 * near(ear::CENTER, 0.12, 0.36);
    face.min(eye).min(mouth).min(ear)
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;
    use crate::modeller::mend::folded_triangles;
    use crate::modeller::obj;
    use crate::modeller::quality::Quality;

    /// One head for all tests: it takes a while.
    fn shared() -> &'static Mesh {
        static HEAD: OnceLock<Mesh> = OnceLock::new();
        HEAD.get_or_init(head)
    }

    #[test]
    fn the_head_is_one_closed_piece_without_holes_that_faces_outward() {
        assert!(shared().is_closed());
        assert_eq!(shared().component_count(), 1);
        assert_eq!(shared().euler_characteristic(), 2);
        assert!(shared().volume() > 0.25, "{}", shared().volume());
        // A few may bridge the sharp corners of eyes and mouth instead of lying in them.
        let bridging = folded_triangles(shared(), &Head).len();
        assert!(bridging <= 4, "{bridging}");
    }

    #[test]
    fn the_head_has_as_many_triangles_as_that_of_the_paper_about() {
        let count = shared().triangles.len();
        assert!((16_000..=17_000).contains(&count), "{count}");
    }

    #[test]
    fn the_triangles_of_the_head_are_even() {
        let quality = Quality::of(shared());
        assert!(quality.usual_smallest_angle > 30.0, "{quality:?}");
        assert!(quality.smallest_angle > 15.0, "{quality:?}");
        assert!(quality.longest_edge < 3.0 * quality.median_edge, "{quality:?}");
    }

    #[test]
    fn the_head_has_a_nose_in_front_ears_at_its_sides_and_a_neck_below() {
        let at = |direction: Vec3| {
            let along = |p: &&Vec3| p.dot(direction);
            shared().positions.iter().max_by(|a, b| along(a).total_cmp(&along(b))).copied().unwrap_or_default()
        };
        let (nose, ear, crown, neck) = (at(Vec3::X), at(Vec3::Z), at(Vec3::Y), at(Vec3::NEG_Y));
        assert!(nose.z.abs() < 0.05 && nose.y < 0.0, "{nose}");
        assert!(ear.distance(ear::CENTER) < 0.2, "{ear}");
        assert!(neck.x < nose.x - 0.2 && crown.y - neck.y > 1.0, "{crown} {neck}");
    }

    #[test]
    fn both_sides_of_the_head_are_alike() {
        for p in [Vec3::new(0.3, 0.02, 0.12), Vec3::new(0.1, -0.3, 0.2), Vec3::new(-0.1, 0.0, 0.33)] {
            assert_eq!(Head.distance(p), Head.distance(p * Vec3::new(1.0, 1.0, -1.0)));
        }
    }

    #[test]
    fn the_head_is_the_same_each_time() {
        assert_eq!(obj::text_of(shared()), obj::text_of(&head()));
    }
}
