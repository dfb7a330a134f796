//! Seeded random poses: an obstacle of some kind, pushed into a body up to 40 % of its size deep.

use std::sync::Arc;

use fastrand::Rng;
use pliant::coupling::{
    Contact, ContactMemories, LocalPart, ObstaclePart, PartId, Proximity, convex_parts, core_shape, find_contacts,
    proximities,
};
use pliant::elastic::{ElasticBody, ElasticRig};
use pliant::math::{Pose, Vec3};
use rapier3d::geometry::{ColliderHandle, SharedShape};
use rapier3d::parry::shape::HalfSpace;

use crate::random::{between, direction, in_cube, rotation};

/// What is pushed into the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    HalfSpace,
    Box,
    Ball,
    Capsule,
    Cylinder,
    Cone,
    Plate,
    Hull,
}

impl Kind {
    pub const ALL: [Self; 8] =
        [Self::HalfSpace, Self::Box, Self::Ball, Self::Capsule, Self::Cylinder, Self::Cone, Self::Plate, Self::Hull];

    /// A shape of this kind for a body of the given size.
    fn shape(self, rng: &mut Rng, size: f32) -> SharedShape {
        let length = |rng: &mut Rng, low, high| size * between(rng, low, high);
        match self {
            Self::HalfSpace => SharedShape::new(HalfSpace::new(Vec3::Y)),
            Self::Box => {
                let half = [0; 3].map(|_| length(rng, 0.1, 1.5));
                SharedShape::cuboid(half[0], half[1], half[2])
            }
            Self::Ball => SharedShape::ball(length(rng, 0.1, 1.0)),
            Self::Capsule => SharedShape::capsule_y(length(rng, 0.5, 1.5), length(rng, 0.05, 0.2)),
            Self::Cylinder => SharedShape::cylinder(length(rng, 0.1, 1.5), length(rng, 0.05, 0.5)),
            Self::Cone => SharedShape::cone(length(rng, 0.2, 0.8), length(rng, 0.1, 0.6)),
            Self::Plate => SharedShape::cuboid(length(rng, 0.5, 1.5), length(rng, 0.01, 0.03), length(rng, 0.5, 1.5)),
            Self::Hull => {
                let points: Vec<Vec3> = (0..16).map(|_| in_cube(rng, 0.6 * size)).collect();
                SharedShape::convex_hull(&points).expect("random points span a volume")
            }
        }
    }
}

/// A body with obstacles pushed into it.
pub struct Case {
    pub body: ElasticBody,
    pub parts: Vec<ObstaclePart>,
    pub near: Vec<Proximity>,
    pub size: f32,
    /// Deepest penetration along the way out, over the size.
    pub depth: f32,
}

/// Deepest penetration of a case, over the size of the body.
pub const DEEPEST: f32 = 0.4;

/// The case of this kind and seed: always the same.
pub fn random_case(rig: &Arc<ElasticRig>, template: &ElasticBody, kind: Kind, seed: u64) -> Case {
    let mut rng = Rng::with_seed(seed ^ ((kind as u64) << 32));
    let size = rig.mesh.size();
    let mut body = template.twin();
    let turn = Pose::from_parts(Vec3::ZERO, rotation(&mut rng));
    body.place(&vec![turn; body.motions().len()]);
    body.build_palette();
    body.deform_springs();
    loop {
        let local = convex_parts(&kind.shape(&mut rng, size)).expect("convex");
        let goal = between(&mut rng, 0.02, DEEPEST);
        let (towards, turn) = (direction(&mut rng), rotation(&mut rng));
        let target = body.positions()[rng.usize(..body.positions().len())] * between(&mut rng, 0.0, 0.8);
        let turn = if kind == Kind::HalfSpace { glam::Quat::from_rotation_arc(Vec3::Y, -towards) } else { turn };
        let place = |distance: f32| {
            let pose = Pose::from_parts(target + towards * distance, turn);
            let parts = placed(&local, pose);
            let near = proximities(&body, &parts, 0.2 * size, &mut ContactMemories::new());
            let contacts = find_contacts(&body, &parts, &near, 0.0);
            let share = |c: &Contact| c.depth() / body.skins()[usize::from(c.near.segment)].size;
            let deepest = contacts.iter().map(share).fold(0.0, f32::max);
            (parts, near, deepest)
        };
        let (mut near_end, mut far_end) = (0.0, 5.0 * size);
        for _ in 0..12 {
            let middle = 0.5 * (near_end + far_end);
            if place(middle).2 > goal { near_end = middle } else { far_end = middle }
        }
        let (parts, near, depth) = place(far_end);
        if depth > 0.01 && depth <= DEEPEST && (only_reachable() <= 0.0 || reachable(&body, &parts)) {
            return Case { body: body.clone(), parts, near, size, depth };
        }
    }
}

/// Parts in the world.
pub fn placed(local: &[LocalPart], pose: Pose) -> Vec<ObstaclePart> {
    let place = |(index, part): (usize, &LocalPart)| {
        let id = PartId { collider: (0, 0), part: index as u32 };
        ObstaclePart::new(id, ColliderHandle::from_raw_parts(0, 0), part, pose * part.pose)
    };
    local.iter().enumerate().map(place).collect()
}

fn only_reachable() -> f32 {
    if std::env::var("REACH").is_ok() { 1.0 } else { 0.0 }
}

/// True where no part reaches into the solid core of a segment by more than a hundredth of its thickness: rapier keeps cores out.
fn reachable(body: &ElasticBody, parts: &[ObstaclePart]) -> bool {
    let rig = body.rig();
    rig.segments.iter().zip(body.motions()).zip(&rig.rest_poses).all(|((segment, motion), rest)| {
        let core = core_shape(segment);
        let pose = *motion * *rest;
        parts.iter().all(|part| {
            rapier3d::parry::query::distance(&pose, &*core.0, part.placed.pose(), &*part.shape.0)
                .is_ok_and(|d| d.distance > 0.0)
        })
    })
}
