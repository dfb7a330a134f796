//! The figures of a run in one line.

use std::fmt;

use pliant::math::Vec3;

use crate::simulation::Simulation;

/// A body that is nowhere faster than this is at rest, in metres a second.
const STILL: f32 = 0.1;

/// For at least so many seconds.
const STILL_TIME: f32 = 0.5;

/// Figures gathered frame by frame.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    frames: u64,
    bodies: usize,
    seconds: f32,
    before: f32,
    after: f32,
    gap: f32,
    frames_inside: u64,
    frames_frozen: u64,
    volume: Option<[f32; 2]>,
    /// Sums of milliseconds: rigid, springs, contact, deform, measure.
    stages: [f32; 5],
    still_since: Option<f32>,
    speed: f32,
    pictures: u64,
    picture_ms: f32,
    soft: SoftSummary,
}

/// Figures of the bodies that move by themselves.
#[derive(Clone, Debug, Default)]
struct SoftSummary {
    bodies: usize,
    volume: Option<[f64; 2]>,
    /// The worst dihedral angles of all cells at rest, in degrees.
    angles: Option<[f64; 2]>,
    /// The largest distance of cells from the surface that they fill, as a part of its size.
    unfilled: Option<f32>,
    /// Most cells inside out at once.
    inverted: usize,
    crossings: usize,
    frames_frozen: u64,
    /// Where the centre of all was after the first step, and where it is.
    way: Option<[Vec3; 2]>,
    /// Sums of milliseconds: exchange, contact, drive.
    stages: [f32; 3],
}

impl Summary {
    /// Takes in the state after a step, and how many edges of each soft actor go through another.
    pub fn add(&mut self, simulation: &Simulation, crossings: &[usize]) {
        self.frames += 1;
        self.bodies = simulation.actors.len();
        self.seconds = simulation.time();
        let mut inside = false;
        let mut frozen = false;
        for report in simulation.actors.iter().map(|actor| simulation.report(actor)) {
            let figures = report.penetration;
            self.before = self.before.max(figures.max_depth_before);
            self.after = self.after.max(figures.max_depth_after);
            self.gap = self.gap.max(figures.max_gap);
            inside |= figures.vertices_inside > 0;
            frozen |= report.frozen.is_some();
            let [low, high] = self.volume.unwrap_or([f32::INFINITY, f32::NEG_INFINITY]);
            self.volume = Some([low.min(report.volume_ratio), high.max(report.volume_ratio)]);
        }
        self.frames_inside += u64::from(inside);
        self.frames_frozen += u64::from(frozen);
        let times = simulation.times();
        let stages = [simulation.rigid_ms, times.springs, times.contact, times.deform, times.measure];
        for (sum, stage) in self.stages.iter_mut().zip(stages) {
            *sum += stage;
        }
        self.soft.add(simulation);
        self.soft.crossings = self.soft.crossings.max(crossings.iter().sum());
        self.speed = fastest(simulation);
        self.still_since = match self.still_since {
            _ if self.speed > STILL => None,
            None => Some(self.seconds),
            since => since,
        };
    }

    /// Takes in the time that a picture took.
    pub fn add_picture(&mut self, milliseconds: f32) {
        self.pictures += 1;
        self.picture_ms += milliseconds;
    }
}

impl SoftSummary {
    fn add(&mut self, simulation: &Simulation) {
        self.bodies = simulation.soft_actors.len();
        let (mut inverted, mut frozen, mut centre) = (0, false, Vec3::ZERO);
        for actor in &simulation.soft_actors {
            let figures = simulation.soft_figures(actor);
            let [low, high] = self.volume.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
            self.volume = Some([low.min(figures.volume_ratio), high.max(figures.volume_ratio)]);
            let [least, most] = self.angles.unwrap_or([180.0, 0.0]);
            self.angles = Some([least.min(actor.kind.angles[0]), most.max(actor.kind.angles[1])]);
            if let Some(fill) = actor.kind.fill {
                self.unfilled = Some(self.unfilled.unwrap_or(0.0).max(fill.relative));
            }
            inverted += figures.inverted;
            frozen |= simulation.soft_report(actor).frozen.is_some();
            centre += figures.centre / self.bodies as f32;
        }
        self.inverted = self.inverted.max(inverted);
        self.frames_frozen += u64::from(frozen);
        self.way = Some([self.way.map_or(centre, |[first, _]| first), centre]);
        let times = simulation.soft_times;
        let stages = self.stages.iter_mut().zip([times.exchange, times.contact, times.drive]);
        stages.for_each(|(sum, time)| *sum += time);
    }

    fn tell(&self, frames: u64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([low, high], [from, to]) = (self.volume.unwrap_or([1.0; 2]), self.way.unwrap_or_default());
        let [x, y, z] = (to - from).to_array();
        write!(
            f,
            "; {} moving by themselves: volume {low:.3} to {high:.3}, at most {} cells inside out, way of all \
             ({x:.2}, {y:.2}, {z:.2}) m",
            self.bodies, self.inverted
        )?;
        if let Some([least, most]) = self.angles {
            write!(f, "; cells at rest with angles of {least:.1} to {most:.1} degrees")?;
        }
        if let Some(distance) = self.unfilled {
            write!(f, ", up to {:.2} % of the size from the surface that they fill", 100.0 * distance)?;
        }
        if self.bodies > 1 {
            write!(f, ", at most {} edges through another body", self.crossings)?;
        }
        if self.frames_frozen > 0 {
            write!(f, "; {} frames with a FROZEN one", self.frames_frozen)?;
        }
        let [exchange, contact, drive] = self.stages.map(|sum| sum / frames.max(1) as f32);
        write!(f, "; ms a frame: particles {exchange:.2}, touch {contact:.2}, charts and matching {drive:.2}")
    }
}

/// Speed of the fastest rigid body of all ragdolls.
fn fastest(simulation: &Simulation) -> f32 {
    let ragdolls = simulation.actors.iter().filter_map(|a| simulation.deformation.ragdoll(a.handle));
    let bodies = ragdolls.flat_map(|r| &r.bodies).filter_map(|&body| simulation.physics.bodies.get(body));
    bodies.map(|body| body.linvel().length()).fold(0.0, f32::max)
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} frames, {:.1} s simulated", self.frames, self.seconds)?;
        if self.bodies > 0 {
            let [low, high] = self.volume.unwrap_or([1.0; 2]);
            write!(
                f,
                "; of the body size: depth {:.4} before and {:.5} after cancellation, gap {:.4}; \
                 {} frames with vertices inside; volume {low:.4} to {high:.4}",
                self.before, self.after, self.gap, self.frames_inside
            )?;
            if self.frames_frozen > 0 {
                write!(f, "; {} frames with a FROZEN body (a pose or a vertex was not finite)", self.frames_frozen)?;
            }
            match self.still_since {
                Some(since) if self.seconds - since >= STILL_TIME => write!(f, "; at rest since {since:.1} s")?,
                _ => write!(f, "; not at rest ({:.2} m/s)", self.speed)?,
            }
        }
        if self.soft.bodies > 0 {
            self.soft.tell(self.frames, f)?;
        }
        let [rigid, springs, contact, deform, measure] = self.stages.map(|sum| sum / self.frames.max(1) as f32);
        match self.bodies == 0 && self.soft.bodies > 0 {
            true => write!(f, ", rapier {rigid:.2}")?,
            false => write!(
                f,
                "{} rigid {rigid:.2}, springs {springs:.2}, contact {contact:.2}, deform {deform:.2}, \
                 measure {measure:.2}",
                if self.soft.bodies > 0 { "," } else { "; ms a frame:" }
            )?,
        }
        if self.pictures > 0 {
            write!(f, "; {} pictures of {:.0} ms", self.pictures, self.picture_ms / self.pictures as f32)?;
        }
        Ok(())
    }
}
