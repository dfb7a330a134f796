//! The checks of a rig: numbers in their ranges, names that differ, joints that form one tree, a closed mesh.

use super::rig_fault::{RigFault, RigFaultKind as Kind, RigPlace, RigTable};
use super::{
    ContactSettings, Joint, MAX_INFLUENCES, MAX_SEGMENTS, MassSpringSetRig, Segment, SegmentMass, SegmentShape,
    SkinWeights,
};
use crate::math::Vec3;
use crate::mesh::{MeshError, Orientation, Topology, TriangleMesh};
use crate::spring::SpringCoefficients;
use std::collections::HashMap;

pub(super) type Check = Result<(), RigFault>;

/// A fault at a key of a table.
pub(super) fn fault(table: RigTable, key: &'static str, kind: Kind) -> RigFault {
    RigFault { place: RigPlace { table, key }, kind }
}

fn in_range(table: RigTable, key: &'static str, value: f32, ok: bool, range: &'static str) -> Check {
    if ok { Ok(()) } else { Err(fault(table, key, Kind::OutOfRange { value, range })) }
}

pub(super) fn positive(table: RigTable, key: &'static str, value: f32) -> Check {
    in_range(table, key, value, (1.0e-6..=1.0e15).contains(&value), "a finite number above 0 (1e-6 to 1e15)")
}

pub(super) fn not_negative(table: RigTable, key: &'static str, value: f32) -> Check {
    in_range(table, key, value, (0.0..=1.0e15).contains(&value), "a finite number of at least 0 (and at most 1e15)")
}

fn finite(table: RigTable, key: &'static str, point: Vec3) -> Check {
    if !point.is_finite() {
        return Err(fault(table, key, Kind::NotFinite));
    }
    let farthest = point.abs().max_element();
    in_range(table, key, farthest, farthest <= FARTHEST, "at most 1e5 m from the origin along each axis")
}

/// Coordinates beyond this have too few digits left for a skin.
const FARTHEST: f32 = 1.0e5;

fn spring(table: RigTable, spring: SpringCoefficients) -> Check {
    let f = spring.natural_frequency;
    in_range(table, "frequency", f, (1.0e-3..=1000.0).contains(&f), "from 0.001 to 1000 Hz")?;
    not_negative(table, "damping_ratio", spring.damping_ratio)
}

/// A coefficient of restitution.
pub(super) fn restitution(table: RigTable, restitution: f32) -> Check {
    in_range(table, "restitution", restitution, (0.0..=1.0).contains(&restitution), "from 0 to 1")
}

/// Softness and threshold.
pub(super) fn check_rig(softness: f32, local_threshold: f32) -> Check {
    in_range(RigTable::Rig, "softness", softness, softness > 0.0 && softness <= 10.0, "above 0 and at most 10")?;
    not_negative(RigTable::Rig, "local_threshold", local_threshold)
}

pub(super) fn check_contact(contact: &ContactSettings) -> Check {
    spring(RigTable::Contact, contact.spring)?;
    not_negative(RigTable::Contact, "friction", contact.friction)
}

pub(super) fn check_segments(segments: &[Segment]) -> Check {
    if segments.is_empty() {
        return Err(fault(RigTable::Rig, "", Kind::NoSegments));
    }
    if segments.len() > MAX_SEGMENTS {
        return Err(fault(RigTable::Rig, "", Kind::TooManySegments(segments.len())));
    }
    let mut names: HashMap<&str, usize> = HashMap::new();
    for (i, s) in segments.iter().enumerate() {
        let table = RigTable::Segment(i);
        if s.name.trim().is_empty() {
            return Err(fault(table, "name", Kind::EmptyName));
        }
        if let Some(first) = names.insert(&s.name, i) {
            return Err(fault(table, "name", Kind::DuplicateName { name: s.name.clone(), first }));
        }
        s.bone.iter().try_for_each(|end| finite(table, "bone", *end))?;
        match s.shape {
            SegmentShape::Ball { radius } => positive(table, "radius", radius)?,
            SegmentShape::Capsule { radius } => {
                positive(table, "radius", radius)?;
                if s.bone[0].as_dvec3().distance(s.bone[1].as_dvec3()) < 1e-9 {
                    return Err(fault(table, "bone", Kind::ZeroBone));
                }
            }
            SegmentShape::Cuboid { half_extents } => {
                half_extents.to_array().iter().try_for_each(|e| positive(table, "half_extents", *e))?;
            }
        }
        match s.mass {
            SegmentMass::Mass(mass) => positive(table, "mass", mass)?,
            SegmentMass::Density(density) => positive(table, "density", density)?,
        }
    }
    Ok(())
}

/// Joints must make one tree of all segments. To be called with valid segments.
pub(super) fn check_joints(joints: &[Joint], segments: &[Segment]) -> Check {
    let count = segments.len();
    let mut parent_joint = vec![None; count];
    let mut tree: Vec<usize> = (0..count).collect();
    for (i, j) in joints.iter().enumerate() {
        let table = RigTable::Joint(i);
        for (key, index) in [("parent", j.parent), ("child", j.child)] {
            if index >= count {
                return Err(fault(table, key, Kind::SegmentIndex { index, count }));
            }
        }
        finite(table, "anchor", j.anchor)?;
        if let Some(limit) = j.limit {
            let degrees = limit.to_degrees();
            in_range(table, "limit_degrees", degrees, degrees > 0.0 && degrees <= 180.001, "above 0 and at most 180")?;
        }
        spring(table, j.spring)?;
        if j.parent == j.child {
            return Err(fault(table, "child", Kind::SelfJoint));
        }
        let child = segments[j.child].name.clone();
        if let Some(first) = parent_joint[j.child].replace(i) {
            return Err(fault(table, "child", Kind::SecondParent { child, first }));
        }
        let (a, b) = (root(&mut tree, j.parent), root(&mut tree, j.child));
        if a == b {
            return Err(fault(table, "child", Kind::Cycle { parent: segments[j.parent].name.clone(), child }));
        }
        tree[a.max(b)] = a.min(b);
    }
    match (0..count).find(|&s| root(&mut tree, s) != 0) {
        None => Ok(()),
        Some(s) => {
            let (name, first) = (segments[s].name.clone(), segments[0].name.clone());
            Err(fault(RigTable::Segment(s), "name", Kind::Disconnected { name, first }))
        }
    }
}

fn root(tree: &mut [usize], mut at: usize) -> usize {
    while tree[at] != at {
        tree[at] = tree[tree[at]];
        at = tree[at];
    }
    at
}

pub(super) fn check_sets(sets: &[MassSpringSetRig], count: usize) -> Check {
    for (i, set) in sets.iter().enumerate() {
        let table = RigTable::MassSpringSet(i);
        if set.segment >= count {
            return Err(fault(table, "segment", Kind::SegmentIndex { index: set.segment, count }));
        }
        if let Some(&index) = set.also.iter().find(|&&index| index >= count) {
            return Err(fault(table, "also", Kind::SegmentIndex { index, count }));
        }
        finite(table, "anchor", set.anchor)?;
        positive(table, "radius", set.radius)?;
        spring(table, set.spring)?;
    }
    Ok(())
}

/// The mesh must be consistent in itself, closed, and face outward.
pub(super) fn check_mesh(mesh: &TriangleMesh) -> Check {
    let at = |kind| fault(RigTable::Rig, "mesh", kind);
    let expected = mesh.positions.len();
    for (array, given) in [("normals", mesh.normals.len()), ("welded", mesh.welded.len())] {
        if given != expected {
            return Err(at(Kind::MeshArray { array, given, expected }));
        }
    }
    if !mesh.texture.is_empty() && mesh.texture.len() != expected {
        return Err(at(Kind::MeshArray { array: "texture", given: mesh.texture.len(), expected }));
    }
    if let Some(vertex) = mesh.welded.iter().position(|&w| w as usize >= expected) {
        let point = mesh.welded[vertex];
        return Err(at(MeshError::WeldOutOfRange { vertex, point, vertices: expected }.into()));
    }
    if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
        let position = mesh.positions[vertex].to_array();
        return Err(at(MeshError::NotFinite { vertex, position }.into()));
    }
    for (triangle, t) in mesh.triangles.iter().enumerate() {
        if let Some(&index) = t.iter().find(|&&i| i as usize >= expected) {
            return Err(at(MeshError::IndexOutOfRange { triangle, index, vertices: expected }.into()));
        }
    }
    let topology = Topology::of(mesh);
    let place = |vertex: u32| mesh.positions[vertex as usize].to_array();
    if let Some(&[vertex, _]) = topology.open.first() {
        return Err(at(Kind::OpenMesh { edges: topology.open.len(), vertex, at: place(vertex) }));
    }
    if let Some(&[vertex, _]) = topology.inconsistent.first() {
        return Err(at(Kind::InconsistentMesh { edges: topology.inconsistent.len(), vertex, at: place(vertex) }));
    }
    match topology.orientation {
        Orientation::Outward => Ok(()),
        _ => Err(at(Kind::InwardMesh { volume: mesh.volume() })),
    }
}

/// True where two pairs with a weight name the same segment.
fn names_twice(w: &SkinWeights) -> bool {
    let used = |k: &usize| w.weights[*k] > 0.0;
    (0..MAX_INFLUENCES).filter(used).any(|k| (0..k).filter(used).any(|other| w.segments[k] == w.segments[other]))
}

/// Weights given by the caller. To be called with a valid mesh.
pub(super) fn check_weights(weights: &[SkinWeights], mesh: &TriangleMesh, segments: usize) -> Check {
    let at = |kind| Err(fault(RigTable::Rig, "weights", kind));
    let expected = mesh.positions.len();
    if weights.len() != expected {
        return at(Kind::WeightsLength { given: weights.len(), expected });
    }
    for (vertex, w) in weights.iter().enumerate() {
        let why = if w.weights.iter().any(|x| !(0.0..=1.001).contains(x)) {
            "a weight is not between 0 and 1"
        } else if (w.weights.iter().sum::<f32>() - 1.0).abs() > 1e-3 {
            "they do not sum to 1"
        } else if w.segments.iter().any(|&s| usize::from(s) >= segments) {
            "they name a segment that does not exist"
        } else if names_twice(w) {
            "they name a segment twice"
        } else if weights.get(mesh.welded[vertex] as usize) != Some(w) {
            "they differ from those of the vertex welded to it, the skin would tear"
        } else {
            continue;
        };
        return at(Kind::BadWeights { vertex, why });
    }
    Ok(())
}
