//! `pliant bench`: what bodies that move by themselves cost, in the scenes of the ProcDef paper's Table 1.

mod crowd;
mod matching;
mod report;
mod rows;
mod steps;

use std::io::Write;

use anyhow::Result;

use report::{Figures, Report};
use rows::ROWS;

/// How the measurement is made.
#[derive(Clone, Debug, clap::Args)]
pub struct BenchArgs {
    /// Measure only rows whose name contains this.
    #[arg(long, value_name = "NAME")]
    pub row: Option<String>,
    /// Steps that are measured in each scene, after as many in which bodies come down.
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub steps: u32,
    /// Runs of each scene; each part of a step counts with its quickest.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=100))]
    pub runs: u32,
    /// Length of a step in seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0 / 120.0)]
    pub dt: f32,
    /// Threads of the matching and of the bodies in the scenes [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Use the stiffness of the rig files instead of the paper's number of iterations.
    #[arg(long)]
    pub rig_stiffness: bool,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
}

/// Measures and prints.
pub fn run(args: &BenchArgs) -> Result<()> {
    anyhow::ensure!(args.dt > 0.0 && args.dt <= 1.0, "--dt must be above 0 and at most 1 second, it is {}", args.dt);
    let threads = args.threads.map_or_else(rayon::current_num_threads, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut report = Report { threads, dt: args.dt, steps: args.steps, runs: args.runs, rows: Vec::new() };
    for row in ROWS.iter().filter(|row| args.row.as_ref().is_none_or(|name| row.name.contains(name.as_str()))) {
        let model = crowd::model(row, args.rig_stiffness)?;
        let matching = matching::measure(row, &model, args.dt, &pool)?;
        let scene = pool.install(|| steps::measure(row, &model, args.dt, args.steps, args.runs));
        report.rows.push(Figures { row, vertices: model.rig.masses().len(), matching, scene });
    }
    anyhow::ensure!(!report.rows.is_empty(), "no row is called {:?}", args.row.as_deref().unwrap_or_default());
    let text = if args.json { report.json()? } else { report.table() };
    // Whoever closed the pipe does not want to read on.
    let _ = write!(std::io::stdout(), "{text}");
    Ok(())
}
