//! Rig files: TOML that is written by hand in a minute, read into a checked rig.

use super::rig_builder::ElasticRigBuilder;
use super::rig_checks::fault;
use super::rig_fault::{RigFault, RigFaultKind as Kind, RigTable};
use super::rig_raw::{RawContact, RawJoint, RawRig, RawSegment, RawSet, RawShape};
use super::{ContactSettings, ElasticRig, Joint, MassSpringSetRig, Segment, SegmentMass, SegmentShape};
use crate::files::{TomlError, TomlKey, TomlText, did_you_mean};
use crate::math::Vec3;
use crate::mesh::load_obj;
use crate::spring::SpringCoefficients;
use std::path::{Path, PathBuf};

/// Why a rig file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RigError {
    /// The file cannot be read or is not the TOML of a rig.
    #[error(transparent)]
    Toml(#[from] TomlError),
    /// The rig that it describes is wrong.
    #[error("{}:{line}: {fault}", path.display())]
    Rig {
        /// The rig file.
        path: PathBuf,
        /// The line of the value at fault, from 1.
        line: usize,
        /// What is wrong.
        #[source]
        fault: Box<RigFault>,
    },
}

/// Reads a rig file and the mesh that it names (relative to the file), checks everything and computes weights.
///
/// # Errors
/// Each fault of the file, of the mesh or of the rig, with file and line.
pub fn load_rig(path: impl AsRef<Path>) -> Result<ElasticRig, RigError> {
    let text = TomlText::read(path)?;
    let raw: RawRig = text.parse()?;
    build(&text, raw).map_err(|fault| RigError::Rig {
        path: text.path().into(),
        line: line_of(&text, &fault),
        fault: Box::new(fault),
    })
}

/// The line of a fault: its key, or the table that should have the key. Shapes are looked into.
fn line_of(text: &TomlText, fault: &RigFault) -> usize {
    let key = fault.place.key;
    let mut keys: Vec<TomlKey> = match fault.place.table {
        RigTable::Rig => vec![],
        RigTable::Contact => vec!["contact".into()],
        RigTable::Segment(i) => vec!["segment".into(), i.into()],
        RigTable::Joint(i) => vec!["joint".into(), i.into()],
        RigTable::MassSpringSet(i) => vec!["mass_spring_set".into(), i.into()],
    };
    if matches!(fault.place.table, RigTable::Segment(_)) && ["radius", "half_extents", "kind"].contains(&key) {
        keys.push("shape".into());
    }
    if !key.is_empty() {
        keys.push(key.into());
    }
    text.line_of(&keys)
}

fn build(text: &TomlText, raw: RawRig) -> Result<ElasticRig, RigFault> {
    let mesh = load_obj(text.resolve(&raw.mesh)).map_err(|e| fault(RigTable::Rig, "mesh", Kind::Mesh(e)))?;
    let mut rig = ElasticRigBuilder::new(mesh);
    if let Some(softness) = raw.softness {
        rig.softness(softness);
    }
    if let Some(radius) = raw.local_threshold {
        rig.local_threshold(radius);
    }
    rig.contact(contact(&raw.contact)?);
    for (i, s) in raw.segment.into_iter().enumerate() {
        rig.segment(segment(i, s)?);
    }
    rig.check_segments()?;
    for (i, j) in raw.joint.iter().enumerate() {
        let joint = joint(&rig, i, j)?;
        rig.joint(joint);
    }
    for (i, s) in raw.mass_spring_set.iter().enumerate() {
        let segment = find(&rig, RigTable::MassSpringSet(i), "segment", &s.segment)?;
        let spring = set_spring(i, s)?;
        let also = s.also.iter().map(|name| find(&rig, RigTable::MassSpringSet(i), "also", name));
        let also = also.collect::<Result<Vec<usize>, RigFault>>()?;
        let anchor = Vec3::from(s.anchor);
        rig.mass_spring_set(MassSpringSetRig { segment, also, anchor, radius: s.radius, spring });
    }
    rig.build()
}

fn contact(raw: &RawContact) -> Result<ContactSettings, RigFault> {
    let plain = ContactSettings::default();
    let frequency = raw.frequency.unwrap_or(plain.spring.natural_frequency);
    let friction = raw.friction.unwrap_or(plain.friction);
    let spring = match (raw.damping_ratio, raw.restitution) {
        (Some(_), Some(_)) => return Err(fault(RigTable::Contact, "restitution", Kind::DampingAndRestitution)),
        (None, Some(restitution)) => {
            super::rig_checks::restitution(RigTable::Contact, restitution)?;
            return Ok(ContactSettings::bouncing(frequency, restitution, friction));
        }
        (ratio, None) => SpringCoefficients::new(frequency, ratio.unwrap_or(plain.spring.damping_ratio)),
    };
    Ok(ContactSettings { spring, friction })
}

fn segment(i: usize, raw: RawSegment) -> Result<Segment, RigFault> {
    let mass = match (raw.mass, raw.density) {
        (Some(mass), None) => SegmentMass::Mass(mass),
        (None, Some(density)) => SegmentMass::Density(density),
        (Some(_), Some(_)) => return Err(fault(RigTable::Segment(i), "density", Kind::MassOrDensity("both"))),
        (None, None) => return Err(fault(RigTable::Segment(i), "", Kind::MassOrDensity("neither"))),
    };
    Ok(Segment { name: raw.name, bone: raw.bone.map(Vec3::from), shape: shape(i, &raw.shape)?, mass })
}

fn shape(i: usize, raw: &RawShape) -> Result<SegmentShape, RigFault> {
    let at = |key, kind| fault(RigTable::Segment(i), key, kind);
    let radius = |kind| {
        if raw.half_extents.is_some() {
            return Err(at("half_extents", Kind::ShapeHasNo { kind, key: "half_extents" }));
        }
        raw.radius.ok_or_else(|| at("shape", Kind::ShapeNeeds { kind, key: "radius" }))
    };
    match raw.kind.as_str() {
        "ball" => Ok(SegmentShape::Ball { radius: radius("ball")? }),
        "capsule" => Ok(SegmentShape::Capsule { radius: radius("capsule")? }),
        "cuboid" => {
            if raw.radius.is_some() {
                return Err(at("radius", Kind::ShapeHasNo { kind: "cuboid", key: "radius" }));
            }
            let needs = || at("shape", Kind::ShapeNeeds { kind: "cuboid", key: "half_extents" });
            Ok(SegmentShape::Cuboid { half_extents: Vec3::from(raw.half_extents.ok_or_else(needs)?) })
        }
        kind => {
            let hint = did_you_mean(kind, ["ball", "capsule", "cuboid"]);
            Err(at("kind", Kind::UnknownShape { kind: kind.into(), hint }))
        }
    }
}

fn joint(rig: &ElasticRigBuilder, i: usize, raw: &RawJoint) -> Result<Joint, RigFault> {
    Ok(Joint {
        parent: find(rig, RigTable::Joint(i), "parent", &raw.parent)?,
        child: find(rig, RigTable::Joint(i), "child", &raw.child)?,
        anchor: Vec3::from(raw.anchor),
        limit: raw.limit_degrees.map(f32::to_radians),
        spring: SpringCoefficients::new(raw.frequency, raw.damping_ratio),
    })
}

fn find(rig: &ElasticRigBuilder, table: RigTable, key: &'static str, name: &str) -> Result<usize, RigFault> {
    rig.segment_index(name).ok_or_else(|| {
        let hint = did_you_mean(name, rig.segment_names());
        fault(table, key, Kind::UnknownSegment { name: name.into(), hint })
    })
}

fn set_spring(i: usize, raw: &RawSet) -> Result<SpringCoefficients, RigFault> {
    let table = RigTable::MassSpringSet(i);
    match (raw.frequency, raw.damping_ratio, raw.mass, raw.stiffness, raw.damping) {
        (Some(frequency), Some(ratio), None, None, None) => Ok(SpringCoefficients::new(frequency, ratio)),
        (None, None, Some(mass), Some(stiffness), Some(damping)) => {
            super::rig_checks::positive(table, "mass", mass)?;
            super::rig_checks::positive(table, "stiffness", stiffness)?;
            super::rig_checks::not_negative(table, "damping", damping)?;
            Ok(SpringCoefficients::from_mass_stiffness_damping(mass, stiffness, damping))
        }
        _ => Err(fault(table, "", Kind::SpringForm)),
    }
}

#[cfg(test)]
#[path = "rig_file_tests.rs"]
mod tests;
