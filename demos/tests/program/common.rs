//! Running the program and reading what it says.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What a run of the program left.
pub struct Run {
    /// Exit code; none where a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub said: String,
    /// Standard error.
    pub complained: String,
}

/// The program, without a display.
pub fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pliant"));
    command.current_dir(repository()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// Runs `pliant run SCENE --headless --out OUT` with further words.
pub fn run(scene: &str, out: &Path, words: &[&str]) -> Run {
    finish(program().args(["run", scene, "--headless", "--out"]).arg(out).args(words))
}

/// Runs a command to its end.
pub fn finish(command: &mut Command) -> Run {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Run { code: output.status.code(), said: text(output.stdout), complained: text(output.stderr) }
}

/// The folder that has `assets`.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap()
}
