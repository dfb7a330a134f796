//! From what a rig file says to the motion of a body: fields painted, charts made, everything checked.

use super::charts::{CHART_NAMES, ChartsError, DeformationCharts, VolumeMode};
use super::line_chart::{ChartInterpolation, LineChart};
use super::motion::{CyclicMotion, MotionFields, MotionRig};
use super::orientation::{DirectionStroke, OrientationError, OrientationField};
use super::paint::{Brush, Canvas};
use super::rig_description::{
    ChartsDescription, PaintDescription, RigDescription, StimulusDescription, StrokeDescription,
};
use super::rig_fault::{MotionRigFault, MotionRigFaultKind as Kind, MotionRigPlace as Place};
use super::scalar_field::{AMPLITUDES, FieldError, LAYERS, PHASES, ScalarConstraint, ScalarField};
use super::stimulus::StimulusSettings;
use super::trigger::TriggerSettings;
use crate::files::did_you_mean;
use crate::math::Vec3;
use crate::mesh::TetrahedralMesh;
use std::ops::RangeInclusive;

/// A fault at a place.
pub(super) fn fault(place: Place, kind: impl Into<Kind>) -> MotionRigFault {
    MotionRigFault { place, kind: Box::new(kind.into()) }
}

/// The fields and charts of a rig, on its mesh.
#[derive(Clone, Debug)]
pub struct BuiltMotion {
    /// The motion.
    pub motion: MotionRig,
    /// The layer field, if layers are painted.
    pub layers: Option<ScalarField>,
    /// When contacts are stimuli, if the body answers any.
    pub trigger: Option<TriggerSettings>,
}

impl RigDescription {
    /// Paints the fields on a mesh, makes the charts and checks all numbers of the description, also those that act
    /// elsewhere.
    ///
    /// # Errors
    /// The first fault, with the table and key at fault.
    pub fn build(&self, mesh: &TetrahedralMesh) -> Result<BuiltMotion, MotionRigFault> {
        super::rig_checks::check(self, mesh)?;
        let canvas = Canvas::new(mesh);
        let layers = painted(&canvas, "layer", &self.layer, LAYERS)?;
        let amplitude = painted(&canvas, "amplitude", &self.amplitude, AMPLITUDES)?;
        let phase = painted(&canvas, "phase", &self.phase, PHASES)?;
        let values = |field: &Option<ScalarField>, plain: f32| {
            field.as_ref().map_or(vec![plain; mesh.vertex_count()], |f| f.values(&mesh.positions))
        };
        let fields = MotionFields {
            orientation: orientation(&canvas, layers.as_ref(), &self.direction)?,
            amplitude: values(&amplitude, 1.0),
            phase: values(&phase, 0.0),
        };
        let cyclic = self.charts.as_ref().map(|c| cyclic(c, !self.phase.is_empty())).transpose()?;
        let response = self.stimulus.as_ref().map(|s| response(s, cyclic.as_ref().map(|c| &c.charts))).transpose()?;
        let motion = MotionRig::new(mesh, fields, cyclic, response).map_err(|e| fault(Place::root(""), e))?;
        Ok(BuiltMotion { motion, layers, trigger: self.stimulus.as_ref().map(trigger) })
    }
}

fn painted(
    canvas: &Canvas,
    table: &'static str,
    described: &[PaintDescription],
    range: RangeInclusive<f32>,
) -> Result<Option<ScalarField>, MotionRigFault> {
    if described.is_empty() {
        return Ok(None);
    }
    let constraint =
        |(i, p): (usize, &PaintDescription)| Ok(ScalarConstraint { value: p.value, brush: brush(table, i, p)? });
    let constraints: Vec<ScalarConstraint> = described.iter().enumerate().map(constraint).collect::<Result<_, _>>()?;
    ScalarField::paint(canvas, &constraints, range.clone()).map(Some).map_err(|e| match e {
        FieldError::Paint { constraint, source } => {
            fault(Place::entry(table, constraint, tool(&described[constraint])), source)
        }
        FieldError::Value { constraint, value, .. } => {
            let range = if *range.start() < 0.0 { "from -1 to 1" } else { "from 0 to 1" };
            fault(Place::entry(table, constraint, "value"), Kind::OutOfRange { value, range })
        }
        FieldError::Interpolation(e) => fault(Place::table(table, ""), e),
    })
}

/// The key of the tool in use.
fn tool(p: &PaintDescription) -> &'static str {
    match (p.face, &p.region, &p.stroke) {
        (Some(_), ..) => "face",
        (_, Some(_), _) => "region",
        (.., Some(_)) => "stroke",
        _ => "section",
    }
}

fn vectors(points: &[[f32; 3]]) -> Vec<Vec3> {
    points.iter().map(|p| Vec3::from(*p)).collect()
}

fn brush(table: &'static str, index: usize, p: &PaintDescription) -> Result<Brush, MotionRigFault> {
    match (p.face, &p.region, &p.stroke, &p.section) {
        (Some(face), None, None, None) => Ok(Brush::Face(face)),
        (None, Some(r), None, None) => Ok(Brush::Region { seed: r.seed.into(), angle: r.angle_degrees.to_radians() }),
        (None, None, Some(stroke), None) => Ok(Brush::Stroke(vectors(stroke))),
        (None, None, None, Some(s)) => {
            Ok(Brush::Section { origin: s.origin.into(), normal: s.normal.into(), stroke: vectors(&s.stroke) })
        }
        (face, region, stroke, section) => {
            let count = [face.is_some(), region.is_some(), stroke.is_some(), section.is_some()];
            Err(fault(Place::entry(table, index, ""), Kind::Brush(count.into_iter().filter(|g| *g).count())))
        }
    }
}

fn orientation(
    canvas: &Canvas,
    layers: Option<&ScalarField>,
    strokes: &[StrokeDescription],
) -> Result<OrientationField, MotionRigFault> {
    let strokes: Vec<DirectionStroke> =
        strokes.iter().map(|s| DirectionStroke { points: vectors(&s.stroke), layer: s.layer }).collect();
    OrientationField::paint(canvas, layers, &strokes).map_err(|e| match e {
        OrientationError::Stroke { stroke, source } => fault(Place::entry("direction", stroke, "stroke"), source),
        OrientationError::Layer { stroke, layer } => {
            fault(Place::entry("direction", stroke, "layer"), Kind::Layer(layer))
        }
        OrientationError::Interpolation(e) => fault(Place::table("direction", ""), e),
    })
}

/// Where charts stand in the file.
fn chart_place(of_stimulus: bool, key: &'static str) -> Place {
    if of_stimulus {
        Place { table: "stimulus", inner: "charts", key, ..Place::default() }
    } else {
        Place::table("charts", key)
    }
}

fn word<T: Copy>(place: Place, given: Option<&String>, words: &[(&str, T)]) -> Result<T, MotionRigFault> {
    let Some(given) = given else { return Ok(words[0].1) };
    words.iter().find(|w| w.0 == given).map(|w| w.1).ok_or_else(|| {
        let hint = did_you_mean(given, words.iter().map(|w| w.0));
        fault(place, Kind::UnknownWord { given: given.clone(), hint })
    })
}

fn charts(raw: &ChartsDescription, of_stimulus: bool) -> Result<DeformationCharts, MotionRigFault> {
    let at = |key| chart_place(of_stimulus, key);
    let modes = [("both", VolumeMode::Both), ("secondary", VolumeMode::Secondary), ("free", VolumeMode::Free)];
    let volume = word(at("volume"), raw.volume.as_ref(), &modes)?;
    let ways = [("linear", ChartInterpolation::Linear), ("smooth", ChartInterpolation::Smooth)];
    let interpolation = word(at("interpolation"), raw.interpolation.as_ref(), &ways)?;
    let lines = [Some(&raw.primary), raw.secondary.as_ref(), raw.tertiary.as_ref()];
    let mut charts = DeformationCharts { cycle: raw.cycle, volume, ..DeformationCharts::default() };
    charts.limit = raw.limit.unwrap_or(charts.limit);
    for (k, points) in lines.into_iter().enumerate() {
        let (chart, place) = (CHART_NAMES[k], at(CHART_NAMES[k]));
        let Some(points) = points else { continue };
        if k > 0 && volume != VolumeMode::Free {
            return Err(fault(place, Kind::BoundChart));
        }
        charts.charts[k] = LineChart::through(points, interpolation)
            .map_err(|source| fault(place, ChartsError::Chart { chart, source }))?;
    }
    charts.check().map(|()| charts).map_err(|e| {
        let key = match e {
            ChartsError::Cycle(_) => "cycle",
            ChartsError::Limit(_) => "limit",
            ChartsError::Chart { chart, .. } | ChartsError::OutOfLimits { chart, .. } => chart,
        };
        fault(at(key), e)
    })
}

fn cyclic(raw: &ChartsDescription, phases: bool) -> Result<CyclicMotion, MotionRigFault> {
    let charts = charts(raw, false)?;
    match raw.speed {
        None if phases => Err(fault(chart_place(false, "speed"), Kind::NoSpeed)),
        // Without phases nothing is shifted, whatever the speed.
        speed => Ok(CyclicMotion { charts, speed: speed.unwrap_or(1.0), rise: raw.rise.unwrap_or(0.0) }),
    }
}

fn response(raw: &StimulusDescription, cycle: Option<&DeformationCharts>) -> Result<StimulusSettings, MotionRigFault> {
    let charts = match (&raw.charts, cycle) {
        (Some(own), _) if own.speed.is_some() => {
            return Err(fault(chart_place(true, "speed"), Kind::SpeedOfStimulus));
        }
        (Some(own), _) if own.rise.is_some() => {
            return Err(fault(chart_place(true, "rise"), Kind::RiseOfStimulus));
        }
        (Some(own), _) => charts(own, true)?,
        (None, Some(cycle)) => cycle.clone(),
        (None, None) => return Err(fault(Place::table("stimulus", ""), Kind::NoCharts)),
    };
    Ok(StimulusSettings { charts, speed: raw.speed, damping: raw.damping })
}

fn trigger(raw: &StimulusDescription) -> TriggerSettings {
    let plain = TriggerSettings::default();
    TriggerSettings {
        threshold: raw.threshold.unwrap_or(plain.threshold),
        refractory: raw.refractory.unwrap_or(plain.refractory),
    }
}
