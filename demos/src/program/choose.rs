//! From what was asked for to a loaded scene.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};

use crate::scene::{FindError, Scene, find_scene, load_scene};
use crate::simulation::Simulation;

/// The scene file that is meant by a path or a name.
pub fn scene_path(asked: &str) -> anyhow::Result<PathBuf> {
    let path = Path::new(asked);
    if path.is_file() {
        return Ok(path.into());
    }
    let is_path = path.extension().is_some_and(|e| e == "toml") || path.components().count() > 1;
    if is_path && !path.exists() {
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
        match find_scene(stem) {
            Ok(_) => bail!("{asked}: there is no such file; did you mean the scene `{stem}`?"),
            Err(FindError::Unknown { hint, .. }) => bail!("{asked}: there is no such file{hint}"),
            Err(error) => bail!("{asked}: there is no such file, and {error}"),
        }
    }
    find_scene(asked).map_err(|error| match path.is_dir() {
        true => anyhow!("{asked}: this is a folder; a scene is a .toml file"),
        false => error.into(),
    })
}

/// Reads and checks a scene.
pub fn scene(asked: &str) -> anyhow::Result<Scene> {
    Ok(load_scene(scene_path(asked)?)?)
}

/// Reads a scene and builds its world.
pub fn simulation(asked: &str, seed: u64) -> anyhow::Result<Simulation> {
    Ok(Simulation::new(scene(asked)?, seed)?)
}
