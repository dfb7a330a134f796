//! What rapier's last step did to the vertices: impulses that are felt, and where a body stands on fixed ground.
//!
//! Between two calls only gravity and rapier's constraints change a velocity. What is missing after gravity is the impulse of
//! contacts and attachments, exactly, whatever its cause: `J = m (v - v_written - g h)`.

use rapier3d::dynamics::{RigidBodySet, SoftBody};
use rapier3d::geometry::{ColliderHandle, ColliderSet, NarrowPhase};

use crate::math::Vec3;

/// A vertex on fixed ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundContact {
    /// The vertex.
    pub vertex: u32,
    /// Unit normal of the contact, out of the ground.
    pub normal: Vec3,
}

/// Contacts that a body feels: those with everything but fixed ground and its own attachments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FeltContacts {
    /// Sum of the impulses of all vertices, in N s.
    pub impulse: f32,
    /// The vertex with the largest impulse.
    pub vertex: Option<u32>,
}

/// The impulse on each vertex in N s, from its velocity now and the one that it was given before the step.
pub fn felt_impulses(masses: &[f32], now: &[Vec3], written: &[Vec3], gravity_step: Vec3, impulses: &mut Vec<Vec3>) {
    impulses.clear();
    let changes = now.iter().zip(written).map(|(v, w)| *v - *w - gravity_step);
    impulses.extend(changes.zip(masses).map(|(dv, &m)| dv * m));
}

impl FeltContacts {
    /// Of the impulses on all vertices, without those that `ignored` marks.
    pub fn of(impulses: &[Vec3], ignored: &[bool]) -> Self {
        let mut felt = Self::default();
        let mut largest = 0.0;
        for (v, (impulse, _)) in (0u32..).zip(impulses.iter().zip(ignored)).filter(|(_, (_, ignored))| !**ignored) {
            let size = impulse.length();
            felt.impulse += size;
            if size > largest {
                (largest, felt.vertex) = (size, Some(v));
            }
        }
        felt
    }
}

/// The vertices of a soft body that touch colliders of fixed bodies, each once, in ascending order; a vertex in several contacts
/// has the mean of their normals.
pub fn ground_contacts(
    soft: &SoftBody,
    boundary: &[[u32; 3]],
    narrow_phase: &NarrowPhase,
    colliders: &ColliderSet,
    bodies: &RigidBodySet,
) -> Vec<GroundContact> {
    let fixed = |handle: ColliderHandle| {
        let parent = colliders.get(handle).map(|c| c.parent());
        parent.is_some_and(|p| p.is_none_or(|p| bodies.get(p).is_none_or(|b| b.is_fixed())))
    };
    let mut found: Vec<(u32, Vec3)> = Vec::new();
    for mesh in soft.meshes().filter(|mesh| mesh.collision_enabled()) {
        let own = mesh.collider();
        for pair in narrow_phase.contact_pairs_with(own) {
            let first = pair.collider1 == own;
            if !fixed(if first { pair.collider2 } else { pair.collider1 }) {
                continue;
            }
            for manifold in pair.manifolds() {
                let (element, normal) = if first {
                    (manifold.subshape1, -manifold.data.normal)
                } else {
                    (manifold.subshape2, manifold.data.normal)
                };
                let Some(corners) = boundary.get(element as usize) else { continue };
                // Some points of the manifold may be open; a corner that no impulse reaches has no friction either.
                if normal.is_finite() && !manifold.points.is_empty() {
                    found.extend(corners.iter().map(|&v| (v, normal)));
                }
            }
        }
    }
    found.sort_by_key(|(v, _)| *v);
    let mut contacts: Vec<GroundContact> = Vec::new();
    for (vertex, normal) in found {
        match contacts.last_mut().filter(|c| c.vertex == vertex) {
            Some(contact) => contact.normal += normal,
            None => contacts.push(GroundContact { vertex, normal }),
        }
    }
    contacts.iter_mut().for_each(|c| c.normal = c.normal.normalize_or_zero());
    contacts
}
