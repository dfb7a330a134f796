//! All contacts of a step solved together: sequential impulses on the velocities of the vertices.
//!
//! A contact asks that its two sides come no nearer in the step than they are apart (`n · u ≥ -gap / h`), and part slowly where
//! they overlap. Impulses push only; friction is Coulomb's, at most the coefficient times the normal impulse. Sweeps go
//! through the contacts forwards and backwards in turn, always in the same order, so that the result does not depend on
//! threads. Equal and opposite impulses keep the linear momentum of what is not fixed.

use super::rigid::RigidCopy;
use crate::math::Vec3;

/// Sweeps over all contacts.
const SWEEPS: u32 = 8;
/// The part of an overlap that is undone in a step.
const UNDONE: f32 = 0.5;
/// Bodies that overlap part by so many times the gap that is kept between them a second, at most.
pub const PARTING: f32 = 20.0;

/// What touches what.
#[derive(Clone, Copy, Debug)]
pub enum Sides {
    /// Four vertices, counted through all bodies, with weights that add up to nothing: a vertex and a triangle, or two edges.
    Soft([u32; 4], [f32; 4]),
    /// A vertex, a rigid body by its place in the list of copies, and the point of the contact.
    Rigid(u32, u32, Vec3),
    /// A point of a triangle by its corners and their weights, a rigid body and the point, in the same manner.
    Face([u32; 3], [f32; 3], u32, Vec3),
}

/// How hard a contact may brake.
#[derive(Clone, Copy, Debug)]
pub enum Friction {
    /// The same in all directions: Coulomb's coefficient.
    Even(f32),
    /// Coefficients ahead, back and sideways of a direction in the plane of the contact (unit or zero).
    Directed {
        /// The direction.
        along: Vec3,
        /// Against sliding ahead, sliding back, and sideways.
        coefficients: [f32; 3],
    },
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// What touches what.
    pub sides: Sides,
    /// Unit normal towards the first side.
    pub normal: Vec3,
    /// Gap in metres, negative for an overlap.
    pub gap: f32,
    /// Fastest parting in m/s.
    pub parting: f32,
    /// Friction.
    pub friction: Friction,
    /// The impulse so far: along the normal and in the plane.
    pub impulse: (f32, Vec3),
}

/// The velocities that contacts change.
pub struct Velocities {
    /// Of all vertices, body after body, in m/s.
    pub vertices: Vec<Vec3>,
    /// One over their masses.
    pub inverse_masses: Vec<f32>,
    /// Of the rigid bodies.
    pub rigid: Vec<RigidCopy>,
}

/// What a contact needs in every sweep.
struct Row {
    target: f32,
    mass: f32,
    tangent_mass: f32,
}

/// Solves the contacts for a step of `h` seconds; their impulses start at nothing.
pub fn solve(contacts: &mut [Contact], velocities: &mut Velocities, h: f32) {
    let rows: Vec<Row> = contacts.iter().map(|contact| Row::of(contact, velocities, h)).collect();
    for sweep in 0..SWEEPS {
        if sweep % 2 == 0 {
            contacts.iter_mut().zip(&rows).for_each(|(contact, row)| push(contact, row, velocities));
        } else {
            contacts.iter_mut().zip(&rows).rev().for_each(|(contact, row)| push(contact, row, velocities));
        }
    }
}

impl Row {
    fn of(contact: &Contact, velocities: &Velocities, h: f32) -> Self {
        let inverse = |v: u32| velocities.inverse_masses[v as usize];
        let (response, tangent) = match contact.sides {
            Sides::Soft(vertices, weights) => {
                let all: f32 = vertices.iter().zip(weights).map(|(&v, w)| inverse(v) * w * w).sum();
                (all, all)
            }
            Sides::Rigid(vertex, index, point) => {
                let rigid = &velocities.rigid[index as usize];
                let own = inverse(vertex);
                (own + rigid.response(point, contact.normal), own + rigid.largest_response(point))
            }
            Sides::Face(vertices, weights, index, point) => {
                let rigid = &velocities.rigid[index as usize];
                let own: f32 = vertices.iter().zip(weights).map(|(&v, w)| inverse(v) * w * w).sum();
                (own + rigid.response(point, contact.normal), own + rigid.largest_response(point))
            }
        };
        let target =
            if contact.gap > 0.0 { -contact.gap / h } else { (-UNDONE * contact.gap / h).min(contact.parting) };
        let or_none = |x: f32| if x > 0.0 { 1.0 / x } else { 0.0 };
        Self { target, mass: or_none(response), tangent_mass: or_none(tangent) }
    }
}

#[inline]
fn push(contact: &mut Contact, row: &Row, velocities: &mut Velocities) {
    let u = match contact.sides {
        Sides::Soft([a, b, c, d], [wa, wb, wc, wd]) => {
            let v = &velocities.vertices;
            v[a as usize] * wa + v[b as usize] * wb + v[c as usize] * wc + v[d as usize] * wd
        }
        Sides::Rigid(vertex, index, point) => {
            velocities.vertices[vertex as usize] - velocities.rigid[index as usize].at(point)
        }
        Sides::Face([a, b, c], [wa, wb, wc], index, point) => {
            let v = &velocities.vertices;
            v[a as usize] * wa + v[b as usize] * wb + v[c as usize] * wc - velocities.rigid[index as usize].at(point)
        }
    };
    let n = contact.normal;
    let along = u.dot(n);
    let pressed = (contact.impulse.0 + row.mass * (row.target - along)).max(0.0);
    if pressed == 0.0 && contact.impulse.0 == 0.0 {
        return;
    }
    let braked = contact.friction.limited(contact.impulse.1 - (u - n * along) * row.tangent_mass, n, pressed);
    let impulse = n * (pressed - contact.impulse.0) + (braked - contact.impulse.1);
    contact.impulse = (pressed, braked);
    match contact.sides {
        Sides::Soft(vertices, weights) => {
            for (&v, w) in vertices.iter().zip(weights) {
                velocities.vertices[v as usize] += impulse * (velocities.inverse_masses[v as usize] * w);
            }
        }
        Sides::Rigid(vertex, index, point) => {
            velocities.vertices[vertex as usize] += impulse * velocities.inverse_masses[vertex as usize];
            velocities.rigid[index as usize].push(point, -impulse);
        }
        Sides::Face(vertices, weights, index, point) => {
            for (&v, w) in vertices.iter().zip(weights) {
                velocities.vertices[v as usize] += impulse * (velocities.inverse_masses[v as usize] * w);
            }
            velocities.rigid[index as usize].push(point, -impulse);
        }
    }
}

impl Friction {
    /// The impulse that is left of a wanted one in the plane of the normal, for a normal impulse.
    fn limited(&self, wanted: Vec3, normal: Vec3, pressed: f32) -> Vec3 {
        match *self {
            Self::Even(coefficient) => wanted.clamp_length_max(coefficient * pressed),
            Self::Directed { along, coefficients: [ahead, back, sideways] } => {
                let across = normal.cross(along);
                let (a, b) = (wanted.dot(along), wanted.dot(across));
                // Sliding ahead is braked by an impulse back.
                let half_axes = [if a < 0.0 { ahead } else { back }, sideways].map(|c| c * pressed);
                let [a, b] = super::super::ground::within_ellipse([a, b], half_axes);
                along * a + across * b
            }
        }
    }
}
