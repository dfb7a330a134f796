//! What a body wants to be at a time: the local transformation of each vertex from fields, charts and stimuli.
//!
//! `T = c1 d1 d1ᵀ + c2 d2 d2ᵀ + c3 d3 d3ᵀ` (equation 1) with `c = c(t − P/v)^A` (section 4.3).

use super::chart_table::{ChartTable, limited};
use super::charts::{ChartsError, DeformationCharts, VolumeMode};
use super::excitation::excitation;
use super::geodesic::GeodesicMesh;
use super::orientation::OrientationField;
use super::rise::risen;
use super::stimulus::{MAX_STIMULI, Stimulus, StimulusError, StimulusSettings};
use super::stretch::{LANES, StretchAxes};
use crate::math::{Mat3, Vec3};
use crate::mesh::TetrahedralMesh;

/// The fields of a body, a value for each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionFields {
    /// The directions of stretching.
    pub orientation: OrientationField,
    /// Exponents `A` of the rates, in [-1, 1].
    pub amplitude: Vec<f32>,
    /// Phase shifts `P`, in [0, 1].
    pub phase: Vec<f32>,
}

/// A cycle that repeats by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct CyclicMotion {
    /// The charts.
    pub charts: DeformationCharts,
    /// Propagation speed `v`: the signal goes from phase shift 0 to 1 in `1/v` seconds. Negative values run backwards;
    /// infinity, the same time everywhere.
    pub speed: f32,
    /// Seconds in which the cycle of a new body grows from nothing to its full strength, smoothly; 0: it is all there at once, and
    /// a body whose phases differ jumps into the middle of its wave.
    pub rise: f32,
}

/// Why no motion can be made of what was given.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A field with another number of values than the mesh has vertices.
    #[error("the {field} field has {given} values for {expected} vertices")]
    Length {
        /// `"orientation"`, `"amplitude"` or `"phase"`.
        field: &'static str,
        /// Its length.
        given: usize,
        /// Number of vertices.
        expected: usize,
    },
    /// A value that is not finite.
    #[error("the {field} field is not finite at vertex {vertex}")]
    NotFinite {
        /// `"orientation"`, `"amplitude"` or `"phase"`.
        field: &'static str,
        /// The vertex, from 0.
        vertex: usize,
    },
    /// A speed of 0 or none.
    #[error("the propagation speed is {0}; it must not be 0")]
    Speed(f32),
    /// A rise that is no time.
    #[error("the cycle rises in {0} s; it must be from 0 to 1e6 s")]
    Rise(f32),
    /// The charts are wrong.
    #[error(transparent)]
    Charts(#[from] ChartsError),
    /// The settings of stimuli are wrong.
    #[error("stimuli: {0}")]
    Stimulus(#[from] StimulusError),
}

/// The motion of all bodies of a kind: fields and charts.
#[derive(Clone, Debug)]
pub struct MotionRig {
    fields: MotionFields,
    axes: Vec<StretchAxes>,
    /// Phase of each vertex in the cycle when the clock is at 0, in [0, 1]: `-P/(v T)` without its whole cycles.
    offsets: Vec<f32>,
    cyclic: Option<(CyclicMotion, ChartTable)>,
    response: Option<(StimulusSettings, ChartTable)>,
    mesh: TetrahedralMesh,
    geodesic: GeodesicMesh,
    length: f32,
}

impl MotionRig {
    /// Makes a motion for a mesh from its fields, a cycle and an answer to stimuli, either of which may be missing.
    ///
    /// # Errors
    /// Fields of another length or with values that are not finite, charts or settings out of range.
    pub fn new(
        mesh: &TetrahedralMesh,
        fields: MotionFields,
        cyclic: Option<CyclicMotion>,
        response: Option<StimulusSettings>,
    ) -> Result<Self, MotionError> {
        check(&fields, mesh.vertex_count())?;
        let axes = StretchAxes::blocks(&fields.orientation.frames);
        let geodesic = GeodesicMesh::new(mesh);
        let length = geodesic.length(mesh);
        let mut rig = Self {
            fields,
            axes,
            offsets: Vec::new(),
            cyclic: None,
            response: None,
            mesh: mesh.clone(),
            geodesic,
            length,
        };
        rig.set_cyclic(cyclic)?;
        rig.set_response(response)?;
        Ok(rig)
    }

    /// The fields.
    pub fn fields(&self) -> &MotionFields {
        &self.fields
    }

    /// The cycle.
    pub fn cyclic(&self) -> Option<&CyclicMotion> {
        self.cyclic.as_ref().map(|c| &c.0)
    }

    /// The answer to stimuli.
    pub fn response(&self) -> Option<&StimulusSettings> {
        self.response.as_ref().map(|r| &r.0)
    }

    /// The length of the body along the ways inside it, in metres: the unit of distances of stimuli.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// How all charts together keep the volume: as each does, if they agree.
    fn volume(&self) -> VolumeMode {
        let cyclic = self.cyclic.as_ref().map(|c| c.1.volume());
        let response = self.response.as_ref().map(|r| r.1.volume());
        match (cyclic, response) {
            (Some(a), Some(b)) if a != b => VolumeMode::Free,
            (Some(mode), _) | (None, Some(mode)) => mode,
            (None, None) => VolumeMode::Free,
        }
    }

    /// Exchanges the cycle, as when charts are edited.
    ///
    /// # Errors
    /// Charts, a speed or a rise out of range; the old ones stay.
    pub fn set_cyclic(&mut self, cyclic: Option<CyclicMotion>) -> Result<(), MotionError> {
        if let Some(c) = &cyclic {
            c.charts.check()?;
            if c.speed.is_nan() || c.speed.abs() < 1.0e-6 {
                return Err(MotionError::Speed(c.speed));
            }
            if !(0.0..=1.0e6).contains(&c.rise) {
                return Err(MotionError::Rise(c.rise));
            }
        }
        self.offsets.clear();
        if let Some(c) = &cyclic {
            let shift = 1.0 / (f64::from(c.speed) * f64::from(c.charts.cycle));
            self.offsets.extend(self.fields.phase.iter().map(|p| (-f64::from(*p) * shift).rem_euclid(1.0) as f32));
        }
        self.cyclic = cyclic.map(|c| (c.clone(), ChartTable::new(&c.charts)));
        Ok(())
    }

    /// Exchanges the answer to stimuli.
    ///
    /// # Errors
    /// Settings out of range; the old ones stay.
    pub fn set_response(&mut self, response: Option<StimulusSettings>) -> Result<(), MotionError> {
        response.as_ref().map_or(Ok(()), StimulusSettings::check)?;
        self.response = response.map(|r| (r.clone(), ChartTable::new(&r.charts)));
        Ok(())
    }
}

/// Where a body is in its motion.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Seconds of the body's own cycle that have passed.
    pub clock: f64,
    /// How fast that clock goes; 1 is real time, 0 stops it, -1 runs the cycle backwards.
    pub pace: f32,
    /// Exponent on all rates of the cycle, in [0, 1]: at 0 the body is at rest but for stimuli.
    pub strength: f32,
    /// Seconds in which the cycle grows from nothing to that strength after the motion was made; 0 for at once. See
    /// [`CyclicMotion::rise`].
    pub rise: f32,
    /// Seconds since it was made, whatever the pace.
    age: f64,
    stimuli: Vec<Stimulus>,
}

impl Default for Motion {
    fn default() -> Self {
        Self { clock: 0.0, pace: 1.0, strength: 1.0, rise: 0.0, age: 0.0, stimuli: Vec::new() }
    }
}

impl Motion {
    /// A motion whose clock stands at `clock` seconds: bodies of a crowd start at different times.
    pub fn at(clock: f64) -> Self {
        Self { clock, ..Self::default() }
    }

    /// The same for a new body, whose cycle rises as its rig says.
    pub fn rising(clock: f64, rig: &MotionRig) -> Self {
        Self { rise: rig.cyclic().map_or(0.0, |cyclic| cyclic.rise), ..Self::at(clock) }
    }

    /// Signals under way, the oldest first.
    pub fn stimuli(&self) -> &[Stimulus] {
        &self.stimuli
    }

    /// Goes on by `dt` seconds and forgets signals that have passed. What is not finite is no time.
    pub fn advance(&mut self, rig: &MotionRig, dt: f32) {
        let dt = if dt.is_finite() { f64::from(dt) } else { 0.0 };
        let pace = if self.pace.is_finite() { f64::from(self.pace) } else { 0.0 };
        self.clock += dt * pace;
        self.age += dt;
        self.stimuli.iter_mut().for_each(|s| s.elapsed += dt);
        match &rig.response {
            Some((_, table)) => self.stimuli.retain(|s| !s.is_over(table)),
            None => self.stimuli.clear(),
        }
    }

    /// Touches the body at a place in the frame of its mesh at rest. False when it answers no stimuli, or the place is not
    /// finite.
    pub fn touch(&mut self, rig: &MotionRig, place: Vec3) -> bool {
        let Some((settings, _)) = rig.response.as_ref().filter(|_| place.is_finite()) else { return false };
        let metres = rig.geodesic.distances(&rig.mesh, place);
        let distances: Vec<f32> = metres.into_iter().map(|d| d / rig.length).collect();
        if self.stimuli.len() >= MAX_STIMULI {
            self.stimuli.remove(0);
        }
        self.stimuli.push(Stimulus::new(&distances, settings.speed, settings.damping));
        true
    }

    /// The local transformations of all vertices now, symmetric matrices in the frame of the mesh at rest.
    pub fn transforms_into(&self, rig: &MotionRig, transforms: &mut Vec<Mat3>) {
        transforms.resize(rig.fields.amplitude.len(), Mat3::IDENTITY);
        let now = Now::of(self, rig);
        let volume = rig.volume();
        for ((block, out), axes) in transforms.chunks_mut(LANES).enumerate().zip(&rig.axes) {
            let first = block * LANES;
            if volume == VolumeMode::Free {
                let mut logs = [[0.0; LANES]; 3];
                for (vertex, lane) in (first..).zip(0..out.len()) {
                    let three = now.logarithms(vertex);
                    logs.iter_mut().zip(three).for_each(|(row, log)| row[lane] = log);
                }
                axes.stretch(&logs, out);
            } else {
                let mut logs = [0.0; LANES];
                let count = out.len();
                now.primaries(first, &mut logs[..count]);
                axes.stretch_by_primary(volume, logs, out);
            }
        }
    }

    /// The excitation of all vertices now, each in [-1, 1]; see [`excitation`].
    pub fn excitations_into(&self, rig: &MotionRig, excitations: &mut Vec<f32>) {
        let now = Now::of(self, rig);
        excitations.clear();
        excitations.extend((0..rig.fields.amplitude.len()).map(|v| excitation(now.logarithms(v)[0], now.bound)));
    }

    /// The three rates at a vertex now; 1 for a vertex that there is not.
    pub fn rates(&self, rig: &MotionRig, vertex: usize) -> [f32; 3] {
        if vertex < rig.fields.amplitude.len() { Now::of(self, rig).logarithms(vertex).map(f32::exp) } else { [1.0; 3] }
    }
}

/// A moment of a motion: what is the same for all vertices.
struct Now<'a> {
    rig: &'a MotionRig,
    stimuli: &'a [Stimulus],
    strength: f32,
    /// Phase of the cycle without shift, in [0, 1].
    phase: f32,
    bound: f32,
}

impl<'a> Now<'a> {
    fn of(motion: &'a Motion, rig: &'a MotionRig) -> Self {
        let phase = rig.cyclic.as_ref().map_or(0.0, |(c, _)| {
            let cycles = motion.clock / f64::from(c.charts.cycle);
            (cycles - cycles.floor()) as f32
        });
        let strength = if motion.strength.is_finite() { motion.strength.clamp(0.0, 1.0) } else { 0.0 };
        let bounds = [rig.cyclic.as_ref().map(|c| c.1.bound()), rig.response.as_ref().map(|r| r.1.bound())];
        Self {
            rig,
            stimuli: &motion.stimuli,
            strength: strength * risen(motion.age, motion.rise),
            phase,
            bound: bounds.into_iter().flatten().fold(0.0, f32::max),
        }
    }

    /// Logarithms of the primary rates of the vertices from `first` on.
    fn primaries(&self, first: usize, logs: &mut [f32]) {
        match &self.rig.cyclic {
            Some((_, table)) if self.stimuli.is_empty() => {
                let vertices = first..first + logs.len();
                let (offsets, amplitudes) = (&self.rig.offsets[vertices.clone()], &self.rig.fields.amplitude[vertices]);
                for ((log, offset), amplitude) in logs.iter_mut().zip(offsets).zip(amplitudes) {
                    *log = self.strength * amplitude * table.primary(self.phase + offset);
                }
            }
            _ => logs.iter_mut().enumerate().for_each(|(k, log)| *log = self.logarithms(first + k)[0]),
        }
    }

    fn logarithms(&self, vertex: usize) -> [f32; 3] {
        let mut logs = [0.0; 3];
        if let Some((_, table)) = &self.rig.cyclic {
            let exponent = self.strength * self.rig.fields.amplitude[vertex];
            logs = table.at(self.phase + self.rig.offsets[vertex]).map(|l| l * exponent);
        }
        if self.stimuli.is_empty() {
            return logs;
        }
        if let Some((_, table)) = &self.rig.response {
            for stimulus in self.stimuli {
                let more = stimulus.logarithms(vertex, table);
                (0..3).for_each(|k| logs[k] += more[k]);
            }
        }
        limited(logs, self.bound)
    }
}

fn check(fields: &MotionFields, expected: usize) -> Result<(), MotionError> {
    let length =
        |field, given| if given == expected { Ok(()) } else { Err(MotionError::Length { field, given, expected }) };
    length("orientation", fields.orientation.frames.len())?;
    length("amplitude", fields.amplitude.len())?;
    length("phase", fields.phase.len())?;
    let finite =
        |field, found: Option<usize>| found.map_or(Ok(()), |vertex| Err(MotionError::NotFinite { field, vertex }));
    finite("orientation", fields.orientation.frames.iter().position(|f| !f.is_finite()))?;
    finite("amplitude", fields.amplitude.iter().position(|a| !a.is_finite()))?;
    finite("phase", fields.phase.iter().position(|p| !p.is_finite()))
}
