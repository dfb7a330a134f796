//! The surface of a body at rest, in the vertex order of its cache; and names of bodies as names of files.

use super::OutputError;
use pliant::mesh::{TriangleMesh, write_obj};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Longest file name that is made, in characters, without what makes it unique.
const MAX_NAME: usize = 64;

/// Names that the program or a system uses for other things.
const TAKEN: [&str; 7] = ["obstacles", "metrics", "soft_bodies", "con", "nul", "prn", "aux"];

/// A file name (without ending) for each body, in order: letters, digits, `-` and `_` are kept, all else becomes `_`.
/// Names that differ in no more than case get `_2`, `_3` and so on behind them.
pub fn body_file_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut taken: HashSet<String> = TAKEN.map(String::from).into();
    let unique = |name: &str| {
        let kept = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
        let base: String = name.trim().chars().take(MAX_NAME).map(kept).collect();
        let base = if base.is_empty() { "body".to_owned() } else { base };
        let mut result = base.clone();
        let mut number = 1;
        while !taken.insert(result.to_lowercase()) {
            number += 1;
            result = format!("{base}_{number}");
        }
        result
    };
    names.into_iter().map(unique).collect()
}

/// Writes the surface at rest as `<file_name>.obj` into `folder`, vertices in the order of `mesh`, and returns the path.
/// `file_name` is one of [`body_file_names`].
///
/// # Errors
/// A failed write; what was there before stays.
pub fn write_body_mesh(folder: impl AsRef<Path>, file_name: &str, mesh: &TriangleMesh) -> Result<PathBuf, OutputError> {
    let path = folder.as_ref().join(format!("{file_name}.obj"));
    write_obj(&path, &mesh.positions, &mesh.triangles)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pliant::math::Vec3;

    #[test]
    fn names_of_bodies_become_different_names_of_files() {
        let names = ["camel", "Camel", "camel", "../up/there", "", "  ", "obstacles", "größe 2", "a.b", "camel_2"];
        let files = [
            "camel",
            "Camel_2",
            "camel_3",
            "___up_there",
            "body",
            "body_2",
            "obstacles_2",
            "größe_2",
            "a_b",
            "camel_2_2",
        ];
        assert_eq!(body_file_names(names), files);
        assert_eq!(body_file_names(["x".repeat(500).as_str()])[0].len(), MAX_NAME);
    }

    #[test]
    fn the_surface_is_written_in_its_own_vertex_order() {
        let folder = tempfile::tempdir().unwrap();
        let p = vec![Vec3::ZERO, Vec3::Z, Vec3::Y, Vec3::X];
        let mesh = TriangleMesh::from_triangles(p, vec![[3, 2, 1], [0, 2, 3]]).unwrap();
        let path = write_body_mesh(folder.path(), "camel", &mesh).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(text, "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 1 0 0\nf 4 3 2\nf 1 3 4\n");
        assert!(write_body_mesh(folder.path().join("none"), "camel", &mesh).is_err());
    }
}
