//! What can be wrong with the rig of a body that moves by itself, each fault with its key.

use super::charts::ChartsError;
use super::motion::MotionError;
use super::paint::PaintError;
use super::radial_basis::RadialBasisError;
use super::stimulus::StimulusError;
use crate::files::TomlKey;
use crate::mesh::{MeshError, TetrahedralError};
use std::fmt;

/// A fault of a rig: what is wrong, and where.
#[derive(Debug, thiserror::Error)]
#[error("{place}{kind}")]
pub struct MotionRigFault {
    /// The part of the rig at fault.
    pub place: MotionRigPlace,
    /// What is wrong with it.
    #[source]
    pub kind: Box<MotionRigFaultKind>,
}

/// A value of a rig by the names that rig files use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MotionRigPlace {
    /// The table, such as `"layer"` or `"charts"`; `""` for the file itself.
    pub table: &'static str,
    /// Which of several tables of that name, from 0.
    pub index: Option<usize>,
    /// A table in the table, such as `"region"`; `""` for none.
    pub inner: &'static str,
    /// The key; `""` for the table itself.
    pub key: &'static str,
}

impl MotionRigPlace {
    /// A key of the file itself.
    pub fn root(key: &'static str) -> Self {
        Self { key, ..Self::default() }
    }

    /// A key of a table.
    pub fn table(table: &'static str, key: &'static str) -> Self {
        Self { table, key, ..Self::default() }
    }

    /// A key of one of several tables.
    pub fn entry(table: &'static str, index: usize, key: &'static str) -> Self {
        Self { table, index: Some(index), key, ..Self::default() }
    }

    /// The way to it in the file.
    pub fn keys(&self) -> Vec<TomlKey<'static>> {
        let mut keys = Vec::new();
        let name = |keys: &mut Vec<TomlKey>, name: &'static str| {
            if !name.is_empty() {
                keys.push(TomlKey::Name(name));
            }
        };
        name(&mut keys, self.table);
        keys.extend(self.index.map(TomlKey::Index));
        name(&mut keys, self.inner);
        name(&mut keys, self.key);
        keys
    }
}

impl fmt::Display for MotionRigPlace {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match (self.table, self.index) {
            ("", _) => {}
            (table, Some(index)) => write!(f, "{table} {index}: ")?,
            (table, None) => write!(f, "{table}: ")?,
        }
        if !self.inner.is_empty() {
            write!(f, "{}: ", self.inner)?;
        }
        if self.key.is_empty() { Ok(()) } else { write!(f, "`{}` ", self.key) }
    }
}

/// What is wrong with a part of a rig. The messages follow the name of the key.
#[derive(Debug, thiserror::Error)]
pub enum MotionRigFaultKind {
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
    /// A word that is none of those there are.
    #[error("is `{given}`{hint}")]
    UnknownWord {
        /// The word.
        given: String,
        /// The nearest word, or all.
        hint: String,
    },
    /// Both or neither of `mass` and `density`.
    #[error("needs one of `mass` and `density` and has {0}")]
    MassOrDensity(&'static str),
    /// Both of `iterations` and `stiffness`.
    #[error("and `iterations` are two ways to say how stiff the body is; choose one")]
    StiffnessForm,
    /// None or several tools in a painted value.
    #[error("needs one of `face`, `region`, `stroke` and `section` and has {0}")]
    Brush(usize),
    /// A chart that follows from the primary one.
    #[error("follows from the primary chart; write `volume = \"free\"` to set it")]
    BoundChart,
    /// Painted phases without a propagation speed.
    #[error("is missing, but phases are painted: how many phase shifts of 1 does a signal pass in a second?")]
    NoSpeed,
    /// A propagation speed where none acts.
    #[error("belongs to the stimulus itself, not to its charts")]
    SpeedOfStimulus,
    /// A rise where nothing begins by itself.
    #[error("is for the cycle; an answer to a touch begins when the signal comes")]
    RiseOfStimulus,
    /// A stimulus without charts in a rig without.
    #[error("has no `charts`, and the rig has none either")]
    NoCharts,
    /// An empty name or one that is there already.
    #[error("is empty or the name of an earlier attachment")]
    Name,
    /// An attachment that holds nothing.
    #[error("holds no vertex of the body; the nearest is {0} m away from the centre")]
    HoldsNothing(f32),
    /// The surface to be filled, or the skin, cannot be used.
    #[error("cannot be used: {0}")]
    Surface(#[from] MeshError),
    /// The tetrahedral mesh cannot be used.
    #[error("cannot be used: {0}")]
    Tetrahedra(#[from] TetrahedralError),
    /// A cell size with a mesh that has its cells.
    #[error("is for a closed surface in an OBJ file; this mesh has its cells already")]
    CellSize,
    /// A tool that paints nothing.
    #[error("{0}")]
    Paint(#[from] PaintError),
    /// A stroke on a layer that is none.
    #[error("is {0}; layers go from 0 to 1, and there must be painted ones")]
    Layer(f32),
    /// A field that cannot be interpolated.
    #[error("cannot be interpolated: {0}")]
    Interpolation(#[from] RadialBasisError),
    /// Charts that cannot be used.
    #[error("{0}")]
    Charts(#[from] ChartsError),
    /// Settings of stimuli that cannot be used.
    #[error("{0}")]
    Stimulus(#[from] StimulusError),
    /// Anything else of the motion.
    #[error("{0}")]
    Motion(#[from] MotionError),
}
