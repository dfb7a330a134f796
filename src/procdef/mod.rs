//! Bodies that move by themselves: local deformations, prescribed in space and time, that add up to motions of the whole.
//!
//! The method is that of Ijiri, Takayama, Yokota and Igarashi, *ProcDef: Local-to-global Deformation for Skeleton-free
//! Character Animation* (2009); section and equation numbers are that paper's.

mod cell_search;
mod chart_table;
mod charts;
mod excitation;
mod geodesic;
mod line_chart;
mod line_field;
mod motion;
mod orientation;
mod paint;
mod radial_basis;
mod rig_build;
mod rig_checks;
mod rig_description;
mod rig_fault;
mod scalar_field;
mod stimulus;
mod stretch;
mod trigger;

pub use cell_search::{BoundaryPoint, barycentric, cell_at, nearest_on_boundary};
pub use chart_table::{CHART_SAMPLES, ChartTable};
pub use charts::{CHART_NAMES, ChartsError, DeformationCharts, VolumeMode};
pub use excitation::{excitation, excitation_colour};
pub use geodesic::GeodesicMesh;
pub use line_chart::{ChartError, ChartInterpolation, ChartPoint, LineChart};
pub use motion::{CyclicMotion, Motion, MotionError, MotionFields, MotionRig};
pub use orientation::{DirectionStroke, OrientationError, OrientationField};
pub use paint::{Brush, Canvas, PaintError, STROKE_REACH};
pub use radial_basis::{MAX_POINTS, MERGE_DISTANCE, RadialBasis, RadialBasisError};
pub use rig_build::BuiltMotion;
pub use rig_description::{
    AttachmentDescription, ChartsDescription, ContactDescription, GroundDescription, PaintDescription, RegionDescription,
    RigDescription, SectionDescription, StimulusDescription, StrokeDescription, WaterDescription,
};
pub use rig_fault::{MotionRigFault, MotionRigFaultKind, MotionRigPlace};
pub use scalar_field::{AMPLITUDES, FieldError, LAYERS, PHASES, ScalarConstraint, ScalarField};
pub use stimulus::{MAX_STIMULI, Stimulus, StimulusError, StimulusSettings};
pub use stretch::stretch_along;
pub use trigger::{ContactTrigger, TriggerSettings};
