//! The figures as a table and as JSON.

use std::fmt::Write;

use serde::Serialize;

use super::matching::MatchingTimes;
use super::rows::Row;
use super::steps::SceneTimes;

/// Everything that was measured.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Threads of the scenes and of `all_cores`.
    pub threads: usize,
    /// Length of a step in seconds.
    pub dt: f32,
    /// Measured steps of each scene.
    pub steps: u32,
    /// Runs of each scene.
    pub runs: u32,
    /// One entry a row.
    pub rows: Vec<Figures>,
}

/// The figures of a row, in milliseconds a step.
#[derive(Debug, Serialize)]
pub struct Figures {
    /// The scene.
    pub row: &'static Row,
    /// Vertices of a body.
    pub vertices: usize,
    /// Fields and matching alone.
    pub matching: MatchingTimes,
    /// The whole scene.
    pub scene: SceneTimes,
}

impl Figures {
    /// How many times shorter the step is than the paper's.
    fn times_faster(&self) -> f64 {
        self.row.paper / self.scene.step.max(f64::MIN_POSITIVE)
    }
}

impl Report {
    /// Three tables of text.
    pub fn table(&self) -> String {
        let mut text = format!(
            "Milliseconds a step of 1/{:.0} s, medians of {} steps (the quickest of {} runs), {} threads.\n\nFields and matching alone\n",
            1.0 / self.dt,
            self.steps,
            self.runs,
            self.threads
        );
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:10} {:>6} {:>8} {:>2} {:>8} {:>9} {:>9} {:>9} {:>9}",
            "scene", "bodies", "vertices", "N", "fields", "matching", "one core", "limit", "all cores"
        );
        for f in &self.rows {
            let (row, m) = (f.row, &f.matching);
            let _ = writeln!(
                text,
                "{:10} {:6} {:8} {:2} {:8.3} {:9.3} {:9.3} {:9.3} {:9.3}",
                row.name,
                row.bodies,
                f.vertices,
                row.iterations,
                m.fields,
                m.matching,
                m.one_core,
                row.matching_limit,
                m.all_cores
            );
        }
        let _ = writeln!(
            text,
            "\nAs stiff as 64 passes of matching, one core\n{:10} {:>8} {:>12} {:>6}",
            "scene", "one pass", "global solve", "times"
        );
        for f in &self.rows {
            let m = &f.matching;
            let times = m.solve / m.one_pass.max(f64::MIN_POSITIVE);
            let _ = writeln!(text, "{:10} {:8.3} {:12.3} {times:6.2}", f.row.name, m.one_pass, m.solve);
        }
        let _ = writeln!(
            text,
            "\nThe whole step, with contacts\n{:10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}",
            "scene", "drive", "contact", "exchange", "rapier", "step", "mean", "worst", "paper", "faster", "rapier's"
        );
        for f in &self.rows {
            let s = &f.scene;
            let _ = writeln!(
                text,
                "{:10} {:8.3} {:8.3} {:8.3} {:8.3} {:8.3} {:8.3} {:8.3} {:8.2} {:7.1}x {:9.3}",
                f.row.name,
                s.drive,
                s.contact,
                s.exchange,
                s.rapier,
                s.step,
                s.mean,
                s.worst,
                f.row.paper,
                f.times_faster(),
                s.rapiers_own
            );
        }
        text
    }

    /// The same as JSON.
    pub fn json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}
