//! A run without a window: step, write, draw, and a line about it all.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

use super::args::RunArgs;
use super::choose;
use super::files::Files;
use super::pictures::Pictures;
use super::summary::Summary;
use super::tell;
use crate::simulation::Simulation;

/// Simulates a scene and writes its files.
pub fn run(args: &RunArgs) -> anyhow::Result<()> {
    let mut simulation = choose::simulation(&args.scene, args.seed)?;
    let folder = folder(args);
    let mut files = Files::create(&folder, &simulation)?;
    let frames = args.frames.unwrap_or_else(|| simulation.frames());
    let mut pictures = match args.no_pictures && args.strip.is_none() {
        true => None,
        false => open_pictures(args, frames, &folder, &simulation)?,
    };
    let bar = progress(frames);
    let mut summary = Summary::default();
    for frame in 0..frames as usize {
        simulation.step();
        let crossings = simulation.soft_crossings();
        summary.add(&simulation, &crossings);
        files.write(frame, &simulation, &crossings)?;
        if let Some(drawing) = pictures.as_mut().filter(|p| p.wants(frame)) {
            let clock = Instant::now();
            match drawing.draw(frame, &simulation)? {
                None => summary.add_picture(clock.elapsed().as_secs_f32() * 1.0e3),
                Some(complaint) => {
                    tell(&format!("no more pictures: {complaint}"));
                    pictures = None;
                }
            }
        }
        bar.inc(1);
    }
    files.finish()?;
    if let Some(drawing) = &pictures {
        drawing.finish()?;
    }
    bar.finish_and_clear();
    // Whoever closed the pipe does not want to read on.
    let _ = writeln!(std::io::stdout(), "{}: {summary}; files in {}", simulation.scene.name, folder.display());
    Ok(())
}

/// Where the files go.
fn folder(args: &RunArgs) -> PathBuf {
    let name = Path::new(&args.scene).file_stem().map_or_else(|| "scene".into(), |stem| stem.to_os_string());
    args.out.clone().unwrap_or_else(|| Path::new("out").join(name))
}

/// Pictures, if there is a device; all else works without.
fn open_pictures(
    args: &RunArgs,
    frames: u64,
    folder: &Path,
    simulation: &Simulation,
) -> anyhow::Result<Option<Pictures>> {
    match crate::render::Gpu::headless() {
        Ok(gpu) => Pictures::open(&gpu, args, frames, folder, simulation).map(Some),
        Err(error) => {
            tell(&format!("no pictures: {error}"));
            Ok(None)
        }
    }
}

/// Hidden where standard error is no terminal.
fn progress(frames: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left");
    ProgressBar::new(frames).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
