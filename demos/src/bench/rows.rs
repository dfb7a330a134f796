//! The rows of the ProcDef paper's Table 1, and what was measured elsewhere for them.

use serde::Serialize;

/// A scene of the table.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Row {
    /// Its name here.
    pub name: &'static str,
    /// Rig file without its ending.
    pub rig: &'static str,
    /// Figure of the paper.
    pub figure: &'static str,
    /// Number of bodies.
    pub bodies: u32,
    /// Iterations of the matching.
    pub iterations: u32,
    /// In water instead of on the ground.
    pub water: bool,
    /// The paper's milliseconds a step, on a 2.4 GHz Core 2 Duo.
    pub paper: f64,
    /// The most that fields and matching together may take on one core, in milliseconds: twice what a matching written by hand
    /// for AVX-512 took.
    pub matching_limit: f64,
}

const ROW: Row =
    Row { name: "", rig: "", figure: "", bodies: 1, iterations: 1, water: true, paper: 0.0, matching_limit: 0.0 };

/// All of them.
#[rustfmt::skip]
pub const ROWS: [Row; 6] = [
    Row { name: "jellyfish", rig: "jellyfish", figure: "1", iterations: 2, paper: 4.37, matching_limit: 0.10, ..ROW },
    Row { name: "worm", rig: "worm", figure: "8", iterations: 6, water: false, paper: 5.04, matching_limit: 0.16, ..ROW },
    Row { name: "swarm", rig: "small_jellyfish", figure: "10 left", bodies: 31, paper: 31.64, matching_limit: 0.62, ..ROW },
    Row { name: "heap", rig: "short_worm", figure: "10 right", bodies: 101, water: false, paper: 34.01, matching_limit: 0.46, ..ROW },
    Row { name: "heart", rig: "heart", figure: "11 a-c", iterations: 6, paper: 14.79, matching_limit: 0.44, ..ROW },
    Row { name: "bowel", rig: "bowel", figure: "11 d-g", iterations: 6, paper: 17.49, matching_limit: 0.54, ..ROW },
];
