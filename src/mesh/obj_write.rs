//! Writing OBJ: positions and triangles, whole or not at all.

use super::{AtomicFile, MeshError};
use crate::math::Vec3;
use std::io::{self, Write};
use std::path::Path;

/// Writes positions and triangles as an OBJ file: vertices in the order given, so that caches of positions fit.
///
/// # Errors
/// A triangle that names a vertex which does not exist, a coordinate that is not finite, or a failed write; what was
/// there before stays.
pub fn write_obj(path: impl AsRef<Path>, positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let vertices = positions.len();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&c| c as usize >= vertices) {
            return Err(MeshError::IndexOutOfRange { triangle, index, vertices });
        }
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        return Err(MeshError::NotFinite { vertex, position: positions[vertex].to_array() });
    }
    let path = path.as_ref();
    write(path, positions, triangles).map_err(|source| MeshError::Unwritable { path: path.into(), source })
}

fn write(path: &Path, positions: &[Vec3], triangles: &[[u32; 3]]) -> io::Result<()> {
    let mut file = AtomicFile::create(path)?;
    for p in positions {
        writeln!(file, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for t in triangles {
        let [a, b, c] = t.map(|i| u64::from(i) + 1);
        writeln!(file, "f {a} {b} {c}")?;
    }
    file.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{load_obj, measure::tests::sphere};

    #[test]
    fn what_is_written_reads_back_with_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ball.obj");
        let mesh = sphere(0.1, 12, 8);
        write_obj(&path, &mesh.positions, &mesh.triangles).unwrap();
        let back = load_obj(&path).unwrap();
        let corners = |m: &crate::mesh::TriangleMesh| {
            m.triangles.iter().flatten().map(|&i| m.positions[i as usize]).collect::<Vec<_>>()
        };
        assert_eq!(corners(&back), corners(&mesh));
        assert_eq!(back.positions.len(), mesh.positions.len());
    }

    #[test]
    fn a_triangle_out_of_range_writes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        assert!(write_obj(&path, &[Vec3::ZERO], &[[0, 0, 1]]).is_err());
        assert!(write_obj(&path, &[Vec3::NAN], &[]).is_err());
        assert!(!path.exists());
        let error = write_obj(folder.path(), &[Vec3::ZERO], &[]).unwrap_err().to_string();
        assert!(error.contains("cannot be written"), "{error}");
    }
}
