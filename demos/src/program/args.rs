//! The command line.

use std::path::PathBuf;

use clap::{Parser, Subcommand};

use super::fields::Field;
use super::section::Cut;
use crate::bench::BenchArgs;

/// Elastic bodies on top of a rigid world: plays scenes in a window, or writes their pictures and figures.
#[derive(Debug, Parser)]
#[command(name = "pliant", version, about)]
pub struct Args {
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Plays a scene in a window, or writes its files where there is no display.
    Run(RunArgs),
    /// Measures bodies that move by themselves in the six scenes of the ProcDef paper's Table 1.
    Bench(BenchArgs),
}

/// How a scene is run.
#[derive(Clone, Debug, clap::Args)]
pub struct RunArgs {
    /// A scene file (.toml), or the name of a scene that comes with the program.
    pub scene: String,
    /// Run without a window and write files; implied by --frames, --out, --no-pictures, --strip and
    /// --picture-every.
    #[arg(long)]
    pub headless: bool,
    /// Stop after N frames instead of the scene's duration.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub frames: Option<u64>,
    /// Size of the pictures in pixels.
    #[arg(long, value_name = "WxH", default_value = "960x540", value_parser = size)]
    pub size: [u32; 2],
    /// Folder of the files [default: out/SCENE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write no pictures.
    #[arg(long)]
    pub no_pictures: bool,
    /// Draw every N-th frame [default: 1 on graphics hardware, 10 where drivers draw in software].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub picture_every: Option<u64>,
    /// Write a film strip too, strip.png: N moments side by side, from the first frame to the last.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub strip: Option<u32>,
    /// Rows of the film strip.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub strip_rows: u32,
    /// What is painted on bodies that move by themselves.
    #[arg(long, value_name = "FIELD", value_enum, default_value_t)]
    pub show: Field,
    /// Cut them open, such as x=0.1: a coordinate of the mesh at rest and its value in metres.
    #[arg(long, value_name = "AXIS=VALUE")]
    pub cut: Option<Cut>,
    /// Draw with the vertices that the processor deformed, not with the compute pass.
    #[arg(long)]
    pub cpu: bool,
    /// Turn and shift the starts of the bodies at random; 0 is the scene as written.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
}

impl RunArgs {
    /// A run of a scene with the defaults.
    pub fn of(scene: &str) -> Self {
        Self {
            scene: scene.into(),
            headless: false,
            frames: None,
            size: [960, 540],
            out: None,
            no_pictures: false,
            picture_every: None,
            strip: None,
            strip_rows: 1,
            show: Field::default(),
            cut: None,
            cpu: false,
            seed: 0,
        }
    }

    /// Whether no window is wanted.
    pub fn is_headless(&self) -> bool {
        self.headless
            || self.no_pictures
            || self.frames.is_some()
            || self.out.is_some()
            || self.picture_every.is_some()
            || self.strip.is_some()
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(sides) if sides.iter().all(|side| (16..=4096).contains(side)) => Ok(sides),
        Some(_) => Err("each side must be from 16 to 4096".into()),
        None => Err("write it like 960x540".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(words: &[&str]) -> Result<RunArgs, clap::Error> {
        let words = ["pliant", "run", "tower"].iter().chain(words);
        Args::try_parse_from(words).map(|args| match args.command {
            Some(Command::Run(run)) => run,
            _ => RunArgs::of("nothing"),
        })
    }

    #[test]
    fn defaults_and_sizes_are_understood() {
        let plain = run(&[]).unwrap();
        assert_eq!((plain.size, plain.seed, plain.is_headless()), ([960, 540], 0, false));
        assert_eq!((plain.show, plain.cut, plain.strip_rows), (Field::Excitation, None, 1));
        let shown = run(&["--show", "layers", "--cut", "z=-0.1"]).unwrap();
        assert_eq!((shown.show, shown.cut), (Field::Layers, Some(Cut { axis: 2, at: -0.1 })));
        assert_eq!(run(&["--size", "1920X1080"]).unwrap().size, [1920, 1080]);
        assert!(run(&["--frames", "30"]).unwrap().is_headless() && run(&["--strip", "8"]).unwrap().is_headless());
    }

    #[test]
    fn senseless_numbers_are_refused() {
        for words in [
            ["--size", "960"],
            ["--size", "0x10"],
            ["--size", "axb"],
            ["--size", "99999x10"],
            ["--frames", "0"],
            ["--frames", "-3"],
            ["--picture-every", "0"],
            ["--strip", "0"],
            ["--seed", "x"],
            ["--show", "everything"],
            ["--cut", "x"],
            ["--strip-rows", "0"],
        ] {
            assert_eq!(run(&words).unwrap_err().exit_code(), 2, "{words:?}");
        }
    }
}
