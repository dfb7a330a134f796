//! Contacts of vertices, found and solved here instead of in rapier.
//!
//! Rapier's contacts of deformable surfaces are general and dear: a heap of a hundred worms spends 95 % of its step in them. Here
//! a vertex meets the nearest point of another body's surface, or of a rigid collider, once a step: no edges against edges, no
//! substeps, no warm starts. That is enough for bodies whose triangles are small beside what they touch.
//!
//! The velocities that bodies want to go on with are changed so that rapier's next step, which moves the particles, ends without
//! overlaps: sequential impulses (Catto, *Iterative Dynamics with Temporal Coherence*, 2005) between vertices, triangles and
//! rigid bodies. Rapier keeps everything else.

mod detect;
mod rigid;
mod solve;
mod surface;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier3d::geometry::{ColliderSet, InteractionGroups};
use rapier3d::pipeline::QueryPipeline;
use rayon::prelude::*;

use super::{GroundContact, GroundDirections};
use crate::coupling::PartCache;
use crate::math::Vec3;
use crate::procdef::ProcDefBody;

use detect::{Sight, pairs, touches};
use rigid::{Copies, Surroundings, directed, rigid_touches};
pub use rigid::{Refused, RigidCopy};
use solve::{Contact, Friction, Other, PARTING, Velocities, solve};
pub use surface::ContactSurface;

/// Each body keeps this part of a boundary edge free around itself, as rapier's contact skin does.
pub const SKIN: f32 = 0.1;

/// The directed friction of a body on fixed ground.
#[derive(Clone, Copy, Debug)]
pub struct GroundFriction<'a> {
    /// The directions and coefficients.
    pub directions: &'a GroundDirections,
    /// Whether ahead and back change places.
    pub turned: bool,
}

/// A body that meets others.
pub struct MeetingBody<'a> {
    /// Positions now, and the velocities that it wants to go on with, which are changed.
    pub body: &'a mut ProcDefBody,
    /// Its boundary.
    pub surface: &'a ContactSurface,
    /// What it collides with.
    pub groups: InteractionGroups,
    /// Coulomb coefficient.
    pub friction: f32,
    /// Directed friction on fixed ground.
    pub ground: Option<GroundFriction<'a>>,
    /// Rigid bodies that it is attached to: they do not touch.
    pub attached: &'a [RigidBodyHandle],
    /// Whether its contacts are made here; else by rapier, but for those with bodies whose contacts are made here.
    pub own_contacts: bool,
}

/// What meeting did to a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meeting {
    /// Impulse on each vertex from what is not fixed, in N s; empty where there was none.
    pub felt: Vec<Vec3>,
    /// The vertices that fixed bodies push, ascending.
    pub ground: Vec<GroundContact>,
    /// How deep the deepest of its vertices was in something, with the gaps that are kept, in metres.
    pub deepest: f32,
}

/// The step in which bodies meet.
#[derive(Clone, Copy, Debug)]
pub struct MeetingStep {
    /// Gravity in m/s².
    pub gravity: Vec3,
    /// Length in seconds.
    pub dt: f32,
    /// Rapier's substeps: it moves bodies after each, so that they see only a part of the step's gravity in the mean.
    pub substeps: usize,
}

/// Changes the velocities of bodies so that rapier's next step ends without overlaps, and the velocities of rigid bodies by the
/// opposite impulses. One entry a body. The result does not depend on the number of threads.
pub fn meet(
    bodies: &mut [MeetingBody<'_>],
    step: &MeetingStep,
    query: QueryPipeline<'_>,
    (rigid_bodies, colliders): (&RigidBodySet, &ColliderSet),
    cache: &mut PartCache,
    refused: &mut Refused,
) -> (Vec<Meeting>, Vec<RigidCopy>) {
    let h = step.dt;
    let substeps = step.substeps.max(1) as f32;
    let drift = step.gravity * (h * (substeps + 1.0) / (2.0 * substeps));
    let seen: &[MeetingBody<'_>] = bodies;
    let sights: Vec<Sight> = seen.par_iter().map(|body| Sight::of(body, drift, h)).collect();
    let found = touches(seen, &sights, &pairs(seen, &sights), h);

    let around = Surroundings { query, bodies: rigid_bodies, colliders, drift, h };
    let mut copies = Copies::default();
    let mut offsets = Vec::with_capacity(seen.len());
    let mut contacts = Vec::new();
    let mut ground_from = Vec::new();
    let mut count = 0u32;
    for body in seen {
        offsets.push(count);
        count += body.body.positions().len() as u32;
    }
    // The last sweep runs backwards: what is rigid has the last word.
    for (a, body) in seen.iter().enumerate().filter(|(_, body)| body.own_contacts) {
        for touch in rigid_touches(body, &sights[a], &around, &mut copies, cache, refused) {
            let x = body.body.positions();
            let friction = match &body.ground {
                Some(ground) if touch.fixed => directed(ground, touch.vertex, touch.normal, touch.friction, x),
                _ => Friction::Even(touch.friction),
            };
            ground_from.push((a, touch.vertex, touch.fixed));
            contacts.push(Contact {
                vertex: offsets[a] + touch.vertex,
                other: Other::Rigid(touch.copy, x[touch.vertex as usize]),
                normal: touch.normal,
                gap: touch.gap,
                parting: PARTING * sights[a].skin,
                friction,
                impulse: (0.0, Vec3::ZERO),
            });
        }
    }
    for (a, (body, touches)) in seen.iter().zip(&found).enumerate() {
        for touch in touches {
            let other = &seen[touch.other as usize];
            let corners = touch.corners.map(|v| v + offsets[touch.other as usize]);
            contacts.push(Contact {
                vertex: offsets[a] + touch.vertex,
                other: Other::Triangle(corners, touch.weights),
                normal: touch.normal,
                gap: touch.gap,
                parting: PARTING * (sights[a].skin + sights[touch.other as usize].skin),
                friction: Friction::Even(between(body, other)),
                impulse: (0.0, Vec3::ZERO),
            });
        }
    }
    let mut meetings: Vec<Meeting> = bodies.iter().map(|_| Meeting::default()).collect();
    if contacts.is_empty() {
        return (meetings, Vec::new());
    }
    let mut velocities = Velocities {
        vertices: bodies.iter().flat_map(|b| b.body.velocities().iter().map(|v| *v + drift)).collect(),
        inverse_masses: bodies.iter().flat_map(|b| b.body.rig().masses().iter().map(|m| 1.0 / m)).collect(),
        rigid: copies.list,
    };
    solve(&mut contacts, &mut velocities, h);
    for (body, &offset) in bodies.iter_mut().zip(&offsets) {
        let own = velocities.vertices[offset as usize..].iter();
        body.body.velocities_mut().iter_mut().zip(own).for_each(|(v, &new)| *v = new - drift);
    }

    let mut felt = vec![Vec3::ZERO; count as usize];
    for (contact, from) in contacts.iter().zip(ground_from.into_iter().map(Some).chain(std::iter::repeat(None))) {
        let (pressed, braked) = contact.impulse;
        let body = offsets.partition_point(|&o| o <= contact.vertex) - 1;
        let deepest = &mut meetings[body].deepest;
        *deepest = deepest.max(-contact.gap);
        if pressed == 0.0 {
            continue;
        }
        let impulse = contact.normal * pressed + braked;
        if let Some((a, vertex, true)) = from {
            meetings[a].ground.push(GroundContact { vertex, normal: contact.normal });
            continue;
        }
        felt[contact.vertex as usize] += impulse;
        if let Other::Triangle(corners, weights) = contact.other {
            corners.iter().zip(weights).for_each(|(&v, w)| felt[v as usize] -= impulse * w);
        }
    }
    for ((meeting, body), &offset) in meetings.iter_mut().zip(bodies.iter()).zip(&offsets) {
        meeting.ground.dedup_by_key(|g| g.vertex);
        let own = &felt[offset as usize..][..body.body.positions().len()];
        if own.iter().any(|f| *f != Vec3::ZERO) {
            meeting.felt.extend_from_slice(own);
        }
    }
    (meetings, velocities.rigid)
}

/// The coefficient of friction between two bodies: the mean, or the least where one has a direction of its own.
fn between(a: &MeetingBody<'_>, b: &MeetingBody<'_>) -> f32 {
    if a.ground.is_some() || b.ground.is_some() { a.friction.min(b.friction) } else { 0.5 * (a.friction + b.friction) }
}
