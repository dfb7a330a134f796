//! Finding a shipped scene by its name, wherever the program was started.

use pliant::elastic::did_you_mean;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where scenes are below a folder that has them.
const SCENES: &str = "assets/scenes";

/// Why a scene is not found.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FindError {
    /// There are scenes, but none of this name.
    #[error("there is no scene `{name}`{hint}")]
    Unknown {
        /// The name asked for.
        name: String,
        /// The nearest name, and all names.
        hint: String,
    },
    /// No folder of scenes is found at all.
    #[error("no scenes are found: there is no folder {SCENES} here, above the program, or where it was built")]
    NoScenes,
}

/// The path of a scene by its name, such as `tower` for `assets/scenes/tower.toml`, or by the path of its file.
///
/// Looked for under the current folder, then under the program's folder and those above it, then where the program was
/// built; the first that has the name counts.
///
/// # Errors
/// No scene of that name: with the nearest name and a list of all.
pub fn find_scene(name: &str) -> Result<PathBuf, FindError> {
    find_in(name, &roots())
}

/// The names of all scenes that [`find_scene`] finds, in alphabetical order.
pub fn scene_names() -> Vec<String> {
    all(&roots()).into_keys().collect()
}

fn roots() -> Vec<PathBuf> {
    let mut roots = vec![PathBuf::from(".")];
    if let Ok(program) = std::env::current_exe() {
        roots.extend(program.ancestors().skip(1).map(Path::to_path_buf));
    }
    roots.push(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    roots
}

fn find_in(name: &str, roots: &[PathBuf]) -> Result<PathBuf, FindError> {
    let as_path = Path::new(name);
    if as_path.extension().is_some_and(|e| e == "toml") && as_path.is_file() {
        return Ok(as_path.into());
    }
    let scenes = all(roots);
    if scenes.is_empty() {
        return Err(FindError::NoScenes);
    }
    scenes.get(name).cloned().ok_or_else(|| {
        let names: Vec<&str> = scenes.keys().map(String::as_str).collect();
        let mut hint = did_you_mean(name, names.iter().copied());
        if !hint.starts_with(';') {
            hint = format!("{hint}{} there are: {}", if hint.is_empty() { ";" } else { "" }, names.join(", "));
        }
        FindError::Unknown { name: name.into(), hint }
    })
}

/// Name and path of the scenes under all roots; earlier roots win.
fn all(roots: &[PathBuf]) -> BTreeMap<String, PathBuf> {
    let mut scenes = BTreeMap::new();
    for root in roots {
        let files = std::fs::read_dir(root.join(SCENES)).into_iter().flatten().flatten();
        for path in files.map(|f| f.path()).filter(|p| p.extension().is_some_and(|e| e == "toml")) {
            if let Some(name) = path.file_stem().and_then(|n| n.to_str()) {
                scenes.entry(name.to_owned()).or_insert(path);
            }
        }
    }
    scenes
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn folder(names: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join(SCENES)).unwrap();
        for name in names {
            fs::write(folder.path().join(SCENES).join(name), "").unwrap();
        }
        folder
    }

    #[test]
    fn a_scene_is_found_under_the_first_root_that_has_it() {
        let (a, b) = (folder(&["tower.toml", "notes.txt"]), folder(&["tower.toml", "rocks.toml"]));
        let roots = [a.path().to_path_buf(), b.path().to_path_buf()];
        assert!(find_in("tower", &roots).unwrap().starts_with(a.path()));
        assert!(find_in("rocks", &roots).unwrap().starts_with(b.path()));
        assert!(find_in("notes", &roots).is_err());
        let file = b.path().join(SCENES).join("rocks.toml");
        assert_eq!(find_in(file.to_str().unwrap(), &[]).unwrap(), file);
    }

    #[test]
    fn a_wrong_name_gets_the_nearest_one_and_the_list() {
        let a = folder(&["tower.toml", "rocks.toml"]);
        let message = |name| find_in(name, &[a.path().to_path_buf()]).unwrap_err().to_string();
        assert_eq!(message("towr"), "there is no scene `towr`, did you mean `tower`? there are: rocks, tower");
        assert_eq!(message("zzzzzzzz"), "there is no scene `zzzzzzzz`; there are: rocks, tower");
        assert_eq!(find_in("tower", &[]), Err(FindError::NoScenes));
    }
}
