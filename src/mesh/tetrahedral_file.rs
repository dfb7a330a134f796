//! Tetrahedral meshes from files and to files, by the ending of the name.

use std::io;
use std::path::{Path, PathBuf};

use super::tetrahedral_formats::{parse_medit, parse_tetgen, write_elements, write_medit, write_nodes};
use super::tetrahedral_gmsh::{parse_gmsh, write_gmsh_2, write_gmsh_4};
use super::tetrahedral_scan::read_text;
use super::{AtomicFile, TetrahedralError, TetrahedralMesh};

/// A format that is written; all of them are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TetrahedralFormat {
    /// Medit, `.mesh`.
    Medit,
    /// TetGen, `.node` and `.ele` beside each other.
    TetGen,
    /// Gmsh 2.2 in ASCII, `.msh`.
    Gmsh2,
    /// Gmsh 4.1 in ASCII, `.msh`.
    Gmsh4,
}

/// Reads a tetrahedral mesh: Medit (`.mesh`), TetGen (`.node` or `.ele`, the other one beside it) or Gmsh 2.2 or 4.1 in ASCII
/// (`.msh`).
///
/// Other elements than tetrahedra are passed over, vertices that no tetrahedron uses are left out, and tetrahedra that are inside
/// out are turned.
///
/// # Errors
/// A missing or unreadable file, an ending that names no format, and with file and line: words that are no numbers,
/// coordinates that are not finite, cells that are flat, that share a face with two others, name a vertex twice or one that there is
/// not, more or less of something than is announced, versions that are not known.
pub fn load_tetrahedral(path: impl AsRef<Path>) -> Result<TetrahedralMesh, TetrahedralError> {
    let path = path.as_ref();
    let at = |path: &Path, (line, fault)| TetrahedralError::Line { path: path.into(), line, fault };
    match ending(path).as_str() {
        "mesh" => parse_medit(&read_text(path)?).map_err(|e| at(path, e)),
        "msh" => parse_gmsh(&read_text(path)?).map_err(|e| at(path, e)),
        "node" | "ele" => {
            let files = [path.with_extension("node"), path.with_extension("ele")];
            parse_tetgen(&read_text(&files[0])?, &read_text(&files[1])?)
                .map_err(|(file, line, fault)| at(&files[file], (line, fault)))
        }
        _ => Err(TetrahedralError::UnknownFormat { path: path.into() }),
    }
}

/// Writes a tetrahedral mesh. For TetGen the path's ending is replaced by `.node` and `.ele`.
///
/// # Errors
/// A failed write; what was there before stays.
pub fn write_tetrahedral(
    path: impl AsRef<Path>,
    mesh: &TetrahedralMesh,
    format: TetrahedralFormat,
) -> Result<(), TetrahedralError> {
    type Writer = fn(&mut AtomicFile, &TetrahedralMesh) -> io::Result<()>;
    let path = path.as_ref();
    let files: Vec<(PathBuf, Writer)> = match format {
        TetrahedralFormat::Medit => vec![(path.into(), write_medit)],
        TetrahedralFormat::Gmsh2 => vec![(path.into(), write_gmsh_2)],
        TetrahedralFormat::Gmsh4 => vec![(path.into(), write_gmsh_4)],
        TetrahedralFormat::TetGen => {
            vec![(path.with_extension("node"), write_nodes), (path.with_extension("ele"), write_elements)]
        }
    };
    for (path, writer) in files {
        let write = || {
            let mut file = AtomicFile::create(&path)?;
            writer(&mut file, mesh)?;
            file.finish()
        };
        write().map_err(|source| TetrahedralError::Unwritable { path: path.clone(), source })?;
    }
    Ok(())
}

fn ending(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase()
}

#[cfg(test)]
#[path = "tetrahedral_file_tests.rs"]
mod tests;
