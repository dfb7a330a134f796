//! A dromedary, modelled in metres: y up, looking along +x, its left at +z... as a rider sees it
//! reversed: its right side is +z. It stands on the ground y = 0.

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
        let body = unite(with_head, tail::distance(&self.tail, p), tail::REACH);
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
