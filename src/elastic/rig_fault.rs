//! What can be wrong with a rig, each fault with the part of the rig at fault.

use super::{MAX_SEGMENTS, WeightsError};
use crate::mesh::MeshError;
use std::fmt;

/// A fault of a rig: what is wrong, and where.
#[derive(Debug, thiserror::Error)]
#[error("{place}{kind}")]
pub struct RigFault {
    /// The part of the rig at fault.
    pub place: RigPlace,
    /// What is wrong with it.
    #[source]
    pub kind: RigFaultKind,
}

/// A part of a rig: a value by its key in a rig file, or a whole table when the key is empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RigPlace {
    /// The table.
    pub table: RigTable,
    /// The key in the table, as rig files call it; `""` for the table itself.
    pub key: &'static str,
}

/// A table of a rig file, or the part of a rig that it stands for. Numbers count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigTable {
    /// The rig itself.
    Rig,
    /// Contact behaviour.
    Contact,
    /// A segment.
    Segment(usize),
    /// A joint.
    Joint(usize),
    /// A mass-spring set.
    MassSpringSet(usize),
}

impl fmt::Display for RigPlace {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.table {
            RigTable::Rig => {}
            RigTable::Contact => write!(f, "contact: ")?,
            RigTable::Segment(i) => write!(f, "segment {i}: ")?,
            RigTable::Joint(i) => write!(f, "joint {i}: ")?,
            RigTable::MassSpringSet(i) => write!(f, "mass-spring set {i}: ")?,
        }
        if self.key.is_empty() { Ok(()) } else { write!(f, "`{}` ", self.key) }
    }
}

/// What is wrong with a part of a rig. The messages follow the name of the key.
#[derive(Debug, thiserror::Error)]
pub enum RigFaultKind {
    /// No segment at all.
    #[error("the rig has no segments; add a [[segment]]")]
    NoSegments,
    /// More than [`MAX_SEGMENTS`].
    #[error("{0} segments are more than the {MAX_SEGMENTS} that a body may have")]
    TooManySegments(usize),
    /// A segment without a name.
    #[error("is empty; every segment needs a name")]
    EmptyName,
    /// Two segments with one name.
    #[error("`{name}` is the name of segment {first} too; names must differ")]
    DuplicateName {
        /// The name.
        name: String,
        /// The earlier segment.
        first: usize,
    },
    /// NaN or infinite.
    #[error("must be finite numbers")]
    NotFinite,
    /// A number out of its range.
    #[error("must be {range} and is {value}")]
    OutOfRange {
        /// The value.
        value: f32,
        /// The range in words.
        range: &'static str,
    },
    /// Contacts with a damping ratio and a restitution.
    #[error("and `damping_ratio` are two names for one thing; give one of them")]
    DampingAndRestitution,
    /// A capsule on a bone without length.
    #[error("has no length, so a capsule has no axis; move an end or use a ball")]
    ZeroBone,
    /// A name that no segment has.
    #[error("names no segment: `{name}`{hint}")]
    UnknownSegment {
        /// The name.
        name: String,
        /// The nearest name, or all.
        hint: String,
    },
    /// An index that no segment has.
    #[error("is segment {index}, but there are {count}")]
    SegmentIndex {
        /// The index.
        index: usize,
        /// Number of segments.
        count: usize,
    },
    /// A joint from a segment to itself.
    #[error("is the parent too: a joint needs two segments")]
    SelfJoint,
    /// A segment that is the child of two joints.
    #[error("`{child}` already has a parent by joint {first}; a segment has one parent")]
    SecondParent {
        /// Name of the child.
        child: String,
        /// The earlier joint.
        first: usize,
    },
    /// A joint between segments that are connected already.
    #[error("`{parent}` and `{child}` are connected already: joints must not form a cycle")]
    Cycle {
        /// Name of the parent.
        parent: String,
        /// Name of the child.
        child: String,
    },
    /// A segment that no chain of joints connects with the first.
    #[error("`{name}` is not connected with `{first}`; add a [[joint]]")]
    Disconnected {
        /// Name of the lone segment.
        name: String,
        /// Name of the first segment.
        first: String,
    },
    /// The mesh cannot be built or read.
    #[error("cannot be used: {0}")]
    Mesh(#[from] MeshError),
    /// The surface is not closed.
    #[error("is open: {edges} edges have only one triangle, one of them at vertex {vertex} at {at:?}; close the holes")]
    OpenMesh {
        /// Number of open edges.
        edges: usize,
        /// A vertex of the first of them.
        vertex: u32,
        /// Where that vertex is.
        at: [f32; 3],
    },
    /// Neighbouring triangles face opposite ways.
    #[error(
        "has triangles that face opposite ways along {edges} edges, one of them at vertex {vertex} at {at:?}; make the normals consistent"
    )]
    InconsistentMesh {
        /// Number of such edges.
        edges: usize,
        /// A vertex of the first of them.
        vertex: u32,
        /// Where that vertex is.
        at: [f32; 3],
    },
    /// The surface is inside out or encloses nothing.
    #[error(
        "faces inward or encloses nothing (signed volume {volume:.3e} m³); flip the normals so that they point outward"
    )]
    InwardMesh {
        /// Its signed volume in cubic metres.
        volume: f64,
    },
    /// Arrays of the mesh that do not fit each other.
    #[error("`{array}` has {given} entries for {expected} vertices")]
    MeshArray {
        /// The field.
        array: &'static str,
        /// Its length.
        given: usize,
        /// The number of vertices.
        expected: usize,
    },
    /// Weights given for another number of vertices.
    #[error("has {given} entries for {expected} vertices")]
    WeightsLength {
        /// Their number.
        given: usize,
        /// The number of vertices.
        expected: usize,
    },
    /// Weights of a vertex that are negative, do not sum to 1, differ from a welded vertex's, or name no segment.
    #[error("of vertex {vertex} are wrong: {why}")]
    BadWeights {
        /// The vertex.
        vertex: usize,
        /// In what way.
        why: &'static str,
    },
    /// No weights can be computed.
    #[error("cannot be computed: {0}")]
    Weights(#[from] WeightsError),
    /// A shape of no known kind.
    #[error("is no known shape: `{kind}`{hint}")]
    UnknownShape {
        /// What stands there.
        kind: String,
        /// The nearest kind, or all.
        hint: String,
    },
    /// A key that the shape needs and does not have.
    #[error("of kind `{kind}` needs `{key}`")]
    ShapeNeeds {
        /// The kind.
        kind: &'static str,
        /// The missing key.
        key: &'static str,
    },
    /// A key that the shape does not have.
    #[error("of kind `{kind}` has no `{key}`; remove it")]
    ShapeHasNo {
        /// The kind.
        kind: &'static str,
        /// The key too much.
        key: &'static str,
    },
    /// Both or neither of `mass` and `density`.
    #[error("needs exactly one of `mass` and `density`, and has {0}")]
    MassOrDensity(&'static str),
    /// A set with neither of its two forms, or a mixture.
    #[error("needs either `frequency` and `damping_ratio`, or `mass`, `stiffness` and `damping`")]
    SpringForm,
}
