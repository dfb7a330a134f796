//! The program: its command line, runs without a window, the pictures of a scene, and the player in the window.

mod args;
mod blend;
mod choose;
mod compute_skin;
mod creases;
mod device_skin;
mod directions;
mod fields;
mod files;
mod headless;
mod looks;
mod memory_skin;
mod moment;
mod overlays;
mod painter;
mod pictures;
mod player;
mod section;
mod soft_painter;
mod soft_panel;
mod soft_skin;
mod strip;
mod summary;
mod surfaces;
mod vertex_pass;
mod watch;
mod water;

use std::io::Write;
use std::process::ExitCode;

use args::{Args, Command, RunArgs};
use clap::{CommandFactory, Parser};
use player::Player;

use crate::render::Gpu;
use crate::scene::scene_names;
use crate::window::{self, display_available};

/// The scene that is shown where none is asked for.
const FIRST_SCENE: &str = "tower";

/// Reads the command line and does what it says. Trouble is one line on standard error and exit code 1 (2 for a command
/// line that cannot be understood).
pub fn main() -> ExitCode {
    match start(Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

fn start(args: Args) -> anyhow::Result<()> {
    match args.command {
        Some(Command::Run(run)) if run.is_headless() || !display_available() => headless::run(&run),
        Some(Command::Run(run)) => show(&run),
        Some(Command::Bench(bench)) => crate::bench::run(&bench),
        None if display_available() => show(&RunArgs::of(FIRST_SCENE)),
        None => {
            let scenes = scene_names().join(", ");
            let help = Args::command().after_help(format!("Scenes: {scenes}")).render_help();
            // Whoever closed the pipe does not want to read on.
            let _ = write!(std::io::stdout(), "{help}");
            Ok(())
        }
    }
}

/// Opens the window.
fn show(run: &RunArgs) -> anyhow::Result<()> {
    let player = Player::open(run)?;
    let gpu = Gpu::headless().map_err(|e| anyhow::anyhow!("{e} (--headless runs without a window)"))?;
    window::run(&gpu, "pliant", Box::new(player))
}

/// One line on standard error, whatever the text.
fn tell(text: &str) {
    let line: Vec<&str> = text.lines().map(str::trim).filter(|l| !l.is_empty()).collect();
    let _ = writeln!(std::io::stderr(), "{}", line.join(" "));
}
