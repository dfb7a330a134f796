//! Rigid things that vertices are attached to: a shell that comes with the body, or a bone that exists already.
//!
//! Each vertex is held at its place on the rigid body by rapier's point constraint, which acts on both. The goals of shape
//! matching know nothing of it: the neighbours of held vertices follow in the next steps.

use rapier3d::dynamics::{GenericJointBuilder, JointAxesMask, RigidBodyBuilder, RigidBodyHandle, SoftBodyHandle};
use rapier3d::geometry::ColliderBuilder;

use super::{ProcDefSets, ProcDefStart};
use crate::procdef::RigidAttachment;

/// Makes the rigid body of an attachment and attaches the vertices to it. None where its points have no convex hull.
pub fn spawn_attachment(
    attachment: &RigidAttachment,
    start: &ProcDefStart,
    soft: SoftBodyHandle,
    sets: &mut ProcDefSets<'_>,
) -> Option<RigidBodyHandle> {
    let collider = ColliderBuilder::convex_hull(&attachment.hull)?;
    let rigid = RigidBodyBuilder::dynamic().pose(start.pose).linvel(start.velocity).can_sleep(false);
    let rigid = sets.bodies.insert(rigid);
    let collider = collider.mass(attachment.mass).collision_groups(start.groups);
    sets.colliders.insert_with_parent(collider, rigid, sets.bodies);
    attach_to(rigid, &attachment.vertices, soft, sets);
    Some(rigid)
}

/// Attaches vertices to a rigid body where they are now. The two no longer touch each other. False where one of them is gone.
pub fn attach_to(rigid: RigidBodyHandle, vertices: &[u32], soft: SoftBodyHandle, sets: &mut ProcDefSets<'_>) -> bool {
    let Some(body) = sets.soft_bodies.get_mut(soft).filter(|_| sets.bodies.contains(rigid)) else { return false };
    let count = body.num_particles();
    for &v in vertices.iter().filter(|&&v| (v as usize) < count) {
        body.attach_particle(v as usize, rigid, sets.bodies);
    }
    // A joint that locks nothing: it only says that the two do not touch.
    let joint = GenericJointBuilder::new(JointAxesMask::empty()).contacts_enabled(false);
    sets.joints.insert(body.root_body(), rigid, joint, true);
    true
}
