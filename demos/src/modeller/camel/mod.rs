//! A dromedary, modelled in metres: y up, looking along +x, its right side at z > 0 and its left
//! side at z < 0. It stands in mid-stride on the ground y = 0.

mod head;
mod legs;
mod neck;
mod tail;
mod trunk;

use glam::Vec3;

use super::blend::unite;
use super::field::Field;
use super::mesh::Mesh;
use super::remesh::remesh_to_count;
use super::shapes::mirrored;
use super::smooth::smooth;
use super::surface::mesh_of;
use super::tube::Tube;
use legs::Leg;

/// How many triangles the camel is wished to have.
pub const TRIANGLES: usize = 19_500;
/// The size of a cell of the first mesh, small enough for ears and tail.
const CELL: f32 = 0.0145;

/// The camel's mesh.
pub fn camel() -> Mesh {
    let camel = Camel::new();
    let low = Vec3::new(-1.1, -0.1, -0.6);
    let high = Vec3::new(2.0, 2.35, 0.6);
    let mut mesh = mesh_of(&camel, low, high, CELL);
    smooth(&mut mesh, 2);
    remesh_to_count(mesh, &camel, &fineness, TRIANGLES)
}

/// The whole animal as a distance field.
pub struct Camel {
    neck: Tube,
    tail: Tube,
    legs: [Leg; 4],
}

impl Camel {
    /// Puts the camel together.
    pub fn new() -> Self {
        Self { neck: neck::neck(), tail: tail::tail(), legs: legs::all_four() }
    }
}

impl Default for Camel {
    fn default() -> Self {
        Self::new()
    }
}

impl Field for Camel {
    fn distance(&self, p: Vec3) -> f32 {
        let trunk = trunk::distance(p);
        let with_neck = unite(trunk, self.neck.distance(p), neck::REACH);
        let with_head = unite(with_neck, head::distance(mirrored(p)), head::REACH);
        let body = unite(with_head, self.tail.distance(p), tail::REACH);
        // Each leg flows into the body, but the legs do not flow into each other.
        let limbed = self.legs.iter().map(|leg| leg.grafted_onto(body, p));
        limbed.fold(body, |whole, leg| unite(whole, leg, 0.012))
    }
}

/// The relative edge length: finer at the head, the ears, the tail and the feet.
fn fineness(p: Vec3) -> f32 {
    let near = |center: Vec3, inner: f32, outer: f32| {
        let t = ((p.distance(center) - inner) / (outer - inner)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let head = 0.52 + 0.48 * near(head::CENTER, 0.22, 0.65);
    let tail = 0.72 + 0.28 * near(tail::CENTER, 0.30, 0.55);
    let feet = 0.80 + 0.20 * (p.y / 0.25).clamp(0.0, 1.0);
    head.min(tail).min(feet)
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;
    use crate::modeller::mend::folded_triangles;
    use crate::modeller::obj;
    use crate::modeller::quality::Quality;

    /// One camel for all tests: it takes a while.
    fn shared() -> &'static Mesh {
        static CAMEL: OnceLock<Mesh> = OnceLock::new();
        CAMEL.get_or_init(camel)
    }

    #[test]
    fn the_camel_is_one_closed_piece_without_holes_that_faces_outward() {
        assert!(shared().is_closed());
        assert_eq!(shared().component_count(), 1);
        assert_eq!(shared().euler_characteristic(), 2);
        assert!(shared().volume() > 0.4, "{}", shared().volume());
        // A few may bridge the sharp corners of the mouth instead of lying in them.
        let bridging = folded_triangles(shared(), &Camel::new()).len();
        assert!(bridging <= 4, "{bridging}");
    }

    #[test]
    fn the_camel_has_about_as_many_triangles_as_wished() {
        let count = shared().triangles.len();
        assert!((19_000..=20_000).contains(&count), "{count}");
    }

    #[test]
    fn the_triangles_of_the_camel_are_even() {
        let quality = Quality::of(shared());
        assert!(quality.usual_smallest_angle > 30.0, "{quality:?}");
        assert!(quality.smallest_angle > 15.0, "{quality:?}");
        assert!(quality.longest_edge < 2.0 * quality.median_edge, "{quality:?}");
    }

    #[test]
    fn the_camel_stands_on_the_ground_and_is_as_tall_as_a_camel() {
        let heights = shared().positions.iter().map(|p| p.y);
        let (low, high) = heights.fold((f32::MAX, f32::MIN), |(l, h), y| (l.min(y), h.max(y)));
        assert!(low.abs() < 0.01, "{low}");
        assert!((2.0..2.25).contains(&high), "{high}");
    }

    #[test]
    fn the_camel_is_the_same_each_time() {
        assert_eq!(obj::text_of(shared()), obj::text_of(&camel()));
    }
}
