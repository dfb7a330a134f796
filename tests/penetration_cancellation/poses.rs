//! Seeded random poses: an obstacle of some kind, pushed into a body up to 40 % of its size deep.

use std::path::PathBuf;
use std::sync::Arc;

use fastrand::Rng;
use pliant::coupling::{
    CORE_FRACTION, Contact, ContactMemories, LocalPart, ObstaclePart, PartId, PartSource, Proximity, find_contacts,
    proximities, way_out,
};
use pliant::elastic::{ElasticBody, ElasticRig, SegmentShape, load_rig};
use pliant::field::PartShape;
use pliant::math::{Pose, Quat, Vec3};
use rapier3d::geometry::{ColliderHandle, SharedShape};
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};

use crate::kinds::{Kind, Placed};
use crate::random::{between, direction, rotation};

/// A body of the suite: a shipped rig.
pub struct Subject {
    pub name: &'static str,
    pub rig: PathBuf,
    pub size: f32,
    /// At rest where it was modelled.
    pub template: ElasticBody,
    /// The axes of the solid cores and how thick they are; the straight links between the cores of joined segments are
    /// not thick at all. In the rest pose.
    cores: Vec<([Vec3; 2], f32)>,
}

impl Subject {
    pub fn load(name: &'static str) -> Self {
        let path = PathBuf::from(format!("{}/assets/rigs/{name}.toml", env!("CARGO_MANIFEST_DIR")));
        let rig = Arc::new(load_rig(&path).expect("a shipped rig"));
        let template = ElasticBody::new(rig.clone());
        Self { name, rig: path, size: rig.mesh.size(), cores: cores(&rig, &template), template }
    }

    pub fn one_segment(&self) -> bool {
        self.template.skins().len() == 1
    }

    /// How far the obstacles are from the solid cores and links, if they are close; not above zero where one is inside.
    fn clearance(&self, turn: &Pose, parts: &[ObstaclePart]) -> f32 {
        let clearance = |(axis, radius): &([Vec3; 2], f32)| {
            let axis = axis.map(|x| turn.transform_point(x));
            let around = Aabb::new(axis[0].min(axis[1]) - *radius, axis[0].max(axis[1]) + *radius);
            let close = parts.iter().filter(|part| part.aabb.intersects(&around));
            close.map(|part| distance_of_axis(part, axis) - radius).fold(f32::INFINITY, f32::min)
        };
        self.cores.iter().map(clearance).fold(f32::INFINITY, f32::min)
    }
}

/// The capsules inside the solid cores, and the links.
fn cores(rig: &ElasticRig, body: &ElasticBody) -> Vec<([Vec3; 2], f32)> {
    let radius = |shape: &SegmentShape| match shape {
        SegmentShape::Ball { radius } | SegmentShape::Capsule { radius } => *radius,
        SegmentShape::Cuboid { half_extents } => half_extents.min_element(),
    };
    let axes: Vec<[Vec3; 2]> = body.skins().iter().map(|skin| skin.axis).collect();
    let own = axes.iter().zip(&rig.segments).map(|(axis, s)| (*axis, CORE_FRACTION * radius(&s.shape)));
    let nearest = |axis: [Vec3; 2], x: Vec3| if axis[0].distance(x) < axis[1].distance(x) { axis[0] } else { axis[1] };
    let links = rig.joints.iter().flat_map(|joint| {
        [joint.parent, joint.child].map(|segment| ([nearest(axes[segment], joint.anchor), joint.anchor], 0.0))
    });
    own.chain(links).collect()
}

fn distance_of_axis(part: &ObstaclePart, axis: [Vec3; 2]) -> f32 {
    if matches!(part.placed.part().shape, PartShape::HalfSpace { .. }) {
        return axis.map(|x| part.placed.distance(x).0).into_iter().fold(f32::INFINITY, f32::min);
    }
    way_out(part, axis).map_or(0.0, |(_, x)| part.placed.distance(x).0)
}

/// A body with obstacles pushed into it.
pub struct Case {
    pub body: ElasticBody,
    /// World from rest of the whole body.
    pub pose: Pose,
    pub parts: Vec<ObstaclePart>,
    pub near: Vec<Proximity>,
    pub size: f32,
    /// Deepest penetration along the way out, over the size of the segment.
    pub depth: f32,
    pub obstacles: Vec<Placed>,
}

/// Deepest penetration of a case, over the size of the segment.
pub const DEEPEST: f32 = 0.4;

impl Case {
    /// A body at `pose` among `obstacles`.
    pub fn new(subject: &Subject, pose: Pose, obstacles: Vec<Placed>) -> Self {
        let size = subject.size;
        let mut parts = Vec::new();
        for (index, placed) in obstacles.iter().enumerate() {
            let local = local_parts(&placed.shape.shared, size);
            parts.extend(parts_at(&local, placed.pose, index as u32));
        }
        Self::among(posed(subject, pose), pose, parts, size, obstacles)
    }

    fn among(body: ElasticBody, pose: Pose, parts: Vec<ObstaclePart>, size: f32, obstacles: Vec<Placed>) -> Self {
        let near = proximities(&body, &parts, 0.2 * size, &mut ContactMemories::new());
        let contacts = find_contacts(&body, &parts, &near, 0.0);
        let share = |c: &Contact| c.depth() / body.skins()[usize::from(c.near.segment)].size;
        let depth = contacts.iter().map(share).fold(0.0, f32::max);
        Self { body, pose, parts, near, size, depth, obstacles }
    }
}

fn posed(subject: &Subject, pose: Pose) -> ElasticBody {
    let mut body = subject.template.twin();
    body.place(&vec![pose; body.motions().len()]);
    body.build_palette();
    body.deform_springs();
    body
}

/// The case of this kind and seed: always the same.
///
/// The obstacle comes in a random direction until it is stopped by a solid core, as rapier would stop it, and is drawn
/// back at random.
pub fn random_case(subject: &Subject, kind: Kind, seed: u64) -> Case {
    let mut rng = Rng::with_seed(seed ^ ((kind as u64 + 1) << 32));
    let size = subject.size;
    let turn = Pose::from_parts(Vec3::ZERO, rotation(&mut rng));
    let body = posed(subject, turn);
    loop {
        let shape = kind.shape(&mut rng, size);
        let local = local_parts(&shape.shared, size);
        let (towards, any) = (direction(&mut rng), rotation(&mut rng));
        let target = body.positions()[rng.usize(..body.positions().len())] * between(&mut rng, 0.0, 0.8);
        let up = Quat::from_rotation_arc(Vec3::Y, -towards);
        let rotation = if kind.is_ground() { up * Quat::from_rotation_y(between(&mut rng, 0.0, 6.0)) } else { any };
        let at = |distance: f32| Pose::from_parts(target + towards * distance, rotation);
        let clear = |distance: f32| subject.clearance(&turn, &parts_at(&local, at(distance), 0)) > 0.0;
        let (mut inside, mut outside) = (-size, 5.0 * size);
        for _ in 0..12 {
            let middle = 0.5 * (inside + outside);
            if clear(middle) { outside = middle } else { inside = middle }
        }
        // The flesh of a limb is thin: drawn back evenly, the obstacle would not touch it.
        let evenly = if subject.one_segment() { 1 } else { 3 };
        let back = between(&mut rng, 0.0, 1.0).powi(evenly) * DEEPEST * size;
        if !clear(outside + back) {
            continue;
        }
        let pose = at(outside + back);
        let parts = parts_at(&local, pose, 0);
        let case = Case::among(body.clone(), turn, parts, size, vec![Placed { shape, pose }]);
        if case.depth > 0.01 && case.depth <= DEEPEST {
            return case;
        }
    }
}

/// The convex parts of a shape; surfaces are as thick as the body is large.
fn local_parts(shape: &SharedShape, size: f32) -> Vec<(u32, LocalPart)> {
    let source = PartSource::new(shape).expect("a known shape");
    let mut cells = Vec::new();
    source.cells_near(&Aabb::new(Vec3::NEG_INFINITY, Vec3::INFINITY), size, &mut cells);
    cells.into_iter().flat_map(|cell| source.expand(cell, size)).collect()
}

/// Parts in the world.
fn parts_at(local: &[(u32, LocalPart)], pose: Pose, obstacle: u32) -> Vec<ObstaclePart> {
    let place = |(part, local): &(u32, LocalPart)| {
        let id = PartId { collider: (obstacle, 0), part: *part };
        ObstaclePart::new(id, ColliderHandle::from_raw_parts(obstacle, 0), local, pose * local.pose)
    };
    local.iter().map(place).collect()
}
