//! Medit's `.mesh` files: vertices and tetrahedra in ASCII.

use super::{AtomicFile, TetrahedralError, TetrahedralFault as Fault, TetrahedralMesh};
use crate::math::Vec3;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// Reads a `.mesh` file. Cells that are inside out are turned; other sections than those of vertices and tetrahedra are
/// passed over.
///
/// # Errors
/// A file that cannot be read, a line that is wrong, or a mesh that [`TetrahedralMesh::new`] refuses.
pub fn load_tetrahedra(path: impl AsRef<Path>) -> Result<TetrahedralMesh, TetrahedralError> {
    let path = path.as_ref();
    let text = std::fs::read_to_string(path).map_err(|source| match source.kind() {
        std::io::ErrorKind::NotFound => TetrahedralError::Missing { path: path.into() },
        _ => TetrahedralError::Unreadable { path: path.into(), source },
    })?;
    let (positions, cells) =
        parse(&text).map_err(|(line, fault)| TetrahedralError::Line { path: path.into(), line, fault })?;
    TetrahedralMesh::new(positions, cells)
}

type Parsed = (Vec<Vec3>, Vec<[u32; 4]>);

fn parse(text: &str) -> Result<Parsed, (usize, Fault)> {
    let numbered = text.lines().enumerate().flat_map(|(line, content)| {
        let content = content.split('#').next().unwrap_or("");
        content.split_whitespace().map(move |word| (line + 1, word))
    });
    let last = text.lines().count();
    let mut words = numbered.peekable();
    let (mut positions, mut cells): Parsed = (Vec::new(), Vec::new());
    while let Some((line, word)) = words.next() {
        if word != "Vertices" && word != "Tetrahedra" {
            continue;
        }
        let mut number = |what: &'static str| {
            let (line, word) = words.next().ok_or((last, Fault::Ended(what)))?;
            word.parse::<f64>().map(|n| (line, n)).map_err(|_| (line, Fault::NotANumber { what, word: word.into() }))
        };
        let (_, count) = number("a count")?;
        if !(0.0..=text.len() as f64).contains(&count) {
            return Err((line, Fault::BadCount { what: "entries", count: count as i64 }));
        }
        for entry in 0..count as i64 {
            let mut four = [0.0; 5];
            let size = if word == "Vertices" { 4 } else { 5 };
            let mut at = line;
            for value in &mut four[..size] {
                (at, *value) = number("a number")?;
            }
            if word == "Vertices" {
                positions.push(Vec3::new(four[0] as f32, four[1] as f32, four[2] as f32));
                continue;
            }
            let mut cell = [0; 4];
            for (slot, vertex) in cell.iter_mut().zip(four) {
                if !(vertex >= 1.0 && vertex <= positions.len() as f64) {
                    return Err((at, Fault::UnknownVertex { cell: entry + 1, vertex: vertex as i64 }));
                }
                *slot = vertex as u32 - 1;
            }
            let [a, b, c, d] = cell.map(|v| positions[v as usize].as_dvec3());
            if (b - a).dot((c - a).cross(d - a)) < 0.0 {
                cell.swap(2, 3);
            }
            cells.push(cell);
        }
    }
    if cells.is_empty() { Err((last, Fault::Without("tetrahedra"))) } else { Ok((positions, cells)) }
}

/// Writes a `.mesh` file.
///
/// # Errors
/// The file cannot be written; what was there before is still there.
pub fn write_tetrahedra(mesh: &TetrahedralMesh, path: impl AsRef<Path>) -> Result<(), TetrahedralError> {
    let path = path.as_ref();
    let mut text = String::from("MeshVersionFormatted 1\nDimension 3\n");
    let _ = writeln!(text, "Vertices\n{}", mesh.positions.len());
    for p in &mesh.positions {
        let _ = writeln!(text, "{} {} {} 0", p.x, p.y, p.z);
    }
    let _ = writeln!(text, "Tetrahedra\n{}", mesh.cells.len());
    for [a, b, c, d] in mesh.cells.iter().map(|c| c.map(|v| v + 1)) {
        let _ = writeln!(text, "{a} {b} {c} {d} 0");
    }
    text.push_str("End\n");
    let failed = |source| TetrahedralError::Unwritable { path: path.into(), source };
    let mut file = AtomicFile::create(path).map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
    file.finish().map_err(failed)
}
