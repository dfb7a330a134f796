//! Bodies that move by themselves: local deformations, prescribed in space and time, that add up to motions of the whole.
//!
//! The method is that of Ijiri, Takayama, Yokota and Igarashi, *ProcDef: Local-to-global Deformation for Skeleton-free
//! Character Animation* (2009); section and equation numbers are that paper's.

mod body;
mod cell_search;
mod chart_table;
mod charts;
mod embedded_skin;
mod excitation;
mod factor;
mod geodesic;
mod global_solve;
mod line_chart;
mod line_field;
mod matching;
mod model;
mod motion;
mod open_cells;
mod ordering;
mod orientation;
mod paint;
mod radial_basis;
mod regions;
mod rig;
mod rig_build;
mod rig_checks;
mod rig_description;
mod rig_error;
mod rig_fault;
mod rig_file;
mod rigid;
mod rise;
mod rotation;
mod rotation_wide;
mod scalar_field;
mod settings;
mod spread;
mod stimulus;
mod stretch;
mod trigger;
mod volume;

pub use body::ProcDefBody;
pub use cell_search::{BoundaryPoint, barycentric, cell_at, nearest_on_boundary};
pub use chart_table::{CHART_SAMPLES, ChartTable};
pub use charts::{CHART_NAMES, ChartsError, DeformationCharts, VolumeMode};
pub use embedded_skin::{DeformedSkin, EmbeddedSkin, EmbeddingReport, SkinBinding};
pub use excitation::{excitation, excitation_colour};
pub use geodesic::GeodesicMesh;
pub use line_chart::{ChartError, ChartInterpolation, ChartPoint, LineChart};
pub use model::{ContactKind, ProcDefModel, RigidAttachment};
pub use motion::{CyclicMotion, Motion, MotionError, MotionFields, MotionRig};
pub use orientation::{DirectionStroke, OrientationError, OrientationField};
pub use paint::{Brush, Canvas, PaintError, STROKE_REACH};
pub use radial_basis::{MAX_POINTS, MERGE_DISTANCE, RadialBasis, RadialBasisError};
pub use rig::{ProcDefRig, ProcDefRigBuilder};
pub use rig_build::BuiltMotion;
pub use rig_description::{
    AttachmentDescription, ChartsDescription, ContactDescription, GroundDescription, PaintDescription,
    RegionDescription, RigDescription, SectionDescription, StimulusDescription, StrokeDescription, WaterDescription,
};
pub use rig_error::ProcDefRigError;
pub use rig_fault::{MotionRigFault, MotionRigFaultKind, MotionRigPlace};
pub use rig_file::{MotionRigError, MotionRigFile, load_motion_rig, write_motion_rig};
pub use rotation::nearest_rotation;
pub use scalar_field::{AMPLITUDES, FieldError, LAYERS, PHASES, ScalarConstraint, ScalarField};
pub use settings::{GroundPlane, ProcDefSettings, Stiffness, wave_speed};
pub use stimulus::{MAX_STIMULI, Stimulus, StimulusError, StimulusSettings};
pub use stretch::stretch_along;
pub use trigger::{ContactTrigger, TriggerSettings};
