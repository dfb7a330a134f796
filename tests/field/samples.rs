//! Random fields with a sampler of points in their reach, as boxed functions: one list for all properties.

use fastrand::Rng;
use pliant::field::{
    ConvexPart, HuggingField, Lipschitz, PartShape, Patch, PlacedPart, SphereField, Spread, SpringField,
};
use pliant::math::Vec3;

use crate::random::{SHAPES, between, direction, in_cube, part, pose};

/// A field with what the tests ask of it.
pub struct Sample {
    /// What it is, for messages.
    pub name: String,
    /// Velocity at a point and time.
    pub velocity: Box<dyn Fn(Vec3, f32) -> Vec3>,
    /// The bound that the field states.
    pub bound: f32,
    /// The length over which it varies.
    pub width: f32,
    /// Points in and about its reach lie within this distance of `middle`.
    pub middle: Vec3,
    /// See `middle`.
    pub reach: f32,
    /// Only points within this distance of `gauge` obey the bound.
    pub gauge: Vec3,
    /// See `gauge`.
    pub extent: f32,
    /// True where the gradient of the distance has kinks, at the borders between faces, edges and corners.
    pub kinks: bool,
}

impl Sample {
    /// A random point in the field's reach.
    pub fn point(&self, rng: &mut Rng) -> Vec3 {
        loop {
            let x = self.middle + in_cube(rng, self.reach);
            if x.distance(self.gauge) <= self.extent {
                return x;
            }
        }
    }
}

pub fn spring(rng: &mut Rng) -> Sample {
    let p = in_cube(rng, 1.0);
    let radius = between(rng, 0.3, 2.0);
    let field = SpringField { p, q: p + direction(rng) * between(rng, 0.1, 1.5), radius };
    let middle = (field.p + field.q) * 0.5;
    Sample {
        name: format!("{field:?}"),
        velocity: Box::new(move |x, t| field.velocity(x, t)),
        bound: field.lipschitz(),
        width: radius,
        middle,
        reach: radius * 1.1,
        gauge: middle,
        extent: f32::INFINITY,
        kinks: false,
    }
}

pub fn sphere(rng: &mut Rng) -> Sample {
    let inner = if rng.bool() { between(rng, 0.0, 1.0) } else { 0.0 };
    let field = SphereField {
        centre: in_cube(rng, 1.0),
        d: direction(rng) * between(rng, 0.1, 1.0),
        inner,
        outer: inner + between(rng, 0.5, 2.0),
    };
    Sample {
        name: format!("{field:?}"),
        velocity: Box::new(move |x, t| field.velocity(x, t)),
        bound: field.lipschitz(),
        width: field.outer - field.inner,
        middle: field.centre + field.d * 0.5,
        reach: field.outer * 1.1,
        gauge: field.centre,
        extent: f32::INFINITY,
        kinks: false,
    }
}

/// A field that hugs a part of the given kind, and a gauge point near the part.
pub fn hugging_field(rng: &mut Rng, kind: usize) -> HuggingField {
    let part = PlacedPart::new(part(rng, kind), pose(rng, 1.0));
    let width = between(rng, 0.7, 2.0);
    let gauge = part.pose().translation + in_cube(rng, 0.7);
    let d = direction(rng) * between(rng, 0.1, 1.0);
    HuggingField { part, d, gauge, width, spread: spread(rng, d), patch: patch(rng, gauge), extent: 1.5 }
}

/// Every second one is even.
pub fn spread(rng: &mut Rng, d: Vec3) -> Spread {
    if rng.bool() {
        return Spread::EVEN;
    }
    let along = (d.cross(direction(rng))).normalize();
    Spread { along, share: rng.f32() }
}

/// Every second one is everywhere.
pub fn patch(rng: &mut Rng, near: Vec3) -> Patch {
    if rng.bool() {
        return Patch::EVERYWHERE;
    }
    Patch { centre: near + in_cube(rng, 0.3), radius: between(rng, 0.0, 0.5), width: between(rng, 0.5, 1.5) }
}

pub fn hugging(rng: &mut Rng, kind: usize) -> Sample {
    let field = hugging_field(rng, kind);
    let HuggingField { width, gauge, extent, .. } = field;
    let ConvexPart { shape, rounding } = field.part.part();
    let kinks = !matches!(shape, PartShape::Point | PartShape::HalfSpace { .. });
    Sample {
        name: format!("{shape:?} rounded by {rounding}, width {width}"),
        bound: field.lipschitz(),
        width,
        middle: gauge,
        reach: extent,
        gauge,
        extent,
        kinks,
        velocity: Box::new(move |x, t| field.velocity(x, t)),
    }
}

/// Several of each kind of field.
pub fn all(rng: &mut Rng) -> Vec<Sample> {
    let mut samples: Vec<_> = (0..8).map(|_| spring(rng)).collect();
    samples.extend((0..8).map(|_| sphere(rng)));
    samples.extend((0..4 * SHAPES).map(|kind| hugging(rng, kind)));
    samples
}
