//! Writing a mesh as a text OBJ file: positions with five decimals and triangles, nothing else.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use super::mesh::Mesh;

/// The text of the file.
pub fn text_of(mesh: &Mesh) -> String {
    let mut text = String::with_capacity(mesh.positions.len() * 60);
    for p in &mesh.positions {
        // Adding zero turns -0 into 0, so that "-0.00000" only ever means a small negative number.
        let [x, y, z] = p.to_array().map(|c| c + 0.0);
        writeln!(text, "v {x:.5} {y:.5} {z:.5}").expect("a string takes any text");
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v + 1);
        writeln!(text, "f {a} {b} {c}").expect("a string takes any text");
    }
    text
}

/// Writes `mesh` to `path`: beside it first, then renamed, so that no reader sees half a file.
pub fn write(mesh: &Mesh, path: &Path) -> io::Result<()> {
    let beside = path.with_extension("obj.part");
    fs::write(&beside, text_of(mesh))?;
    fs::rename(&beside, path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_text_counts_vertices_from_one() {
        let mesh = Mesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
        let text = text_of(&mesh);
        assert!(text.starts_with("v 0.00000 0.00000 0.00000\n"));
        assert!(text.ends_with("f 1 2 3\n"));
    }
}
