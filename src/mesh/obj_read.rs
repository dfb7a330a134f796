//! Reading OBJ: the checked text through tobj, polygons into triangles, seams welded beneath the render vertices.

use super::{MeshError, ObjFault, TriangleMesh, obj_scan, polygon};
use crate::math::{Vec2, Vec3};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Larger files are refused before they are read: 1 GiB.
pub const MAX_OBJ_BYTES: u64 = 1 << 30;

/// What was done to a mesh while it was read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ObjReport {
    /// Triangles left out because two of their corners are one point. The surface stays closed without them.
    pub dropped_triangles: usize,
    /// Faces with more than three corners that were cut into triangles.
    pub polygons: usize,
    /// True when the file's normals were missing or unusable and smooth ones were computed.
    pub computed_normals: bool,
}

/// Reads an OBJ file as one mesh; see [`load_obj_with_report`].
///
/// # Errors
/// As [`load_obj_with_report`].
pub fn load_obj(path: impl AsRef<Path>) -> Result<TriangleMesh, MeshError> {
    load_obj_with_report(path).map(|(mesh, _)| mesh)
}

/// Reads an OBJ file as one mesh, with a report of what was changed.
///
/// All objects and groups are merged; materials, lines and points are ignored, and a missing material file is no
/// error. Polygons, also concave ones, are cut into triangles. One vertex is made of each different
/// `position/texture/normal` corner, in the order of their first use. Triangles of which two corners weld together are
/// dropped and counted; other triangles without area stay, because the surface would open without them. If not every
/// corner has a normal, smooth area-weighted ones are computed for the whole mesh; if not every corner has texture
/// coordinates, there are none.
///
/// # Errors
/// A missing or unreadable file, a folder, a file over [`MAX_OBJ_BYTES`]; with the line at fault: text that is not OBJ, no
/// faces, faces with fewer than 3 or more than 4096 corners, numbers missing or not finite, indices 0 or out of range.
pub fn load_obj_with_report(path: impl AsRef<Path>) -> Result<(TriangleMesh, ObjReport), MeshError> {
    let path = path.as_ref();
    let text = read_limited(path, MAX_OBJ_BYTES)?;
    parse(&text).map_err(|(line, fault)| MeshError::Obj { path: path.into(), line, fault })
}

/// Reads a file of at most `limit` bytes; bytes that are not UTF-8 (old exporters' names) are replaced.
fn read_limited(path: &Path, limit: u64) -> Result<String, MeshError> {
    let unreadable = |source: std::io::Error| match source.kind() {
        ErrorKind::NotFound => MeshError::Missing { path: path.into() },
        _ => MeshError::Unreadable { path: path.into(), source },
    };
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(MeshError::NotAFile { path: path.into() });
    }
    if metadata.len() > limit {
        return Err(MeshError::TooLarge { path: path.into(), bytes: metadata.len(), limit });
    }
    let bytes = fs::read(path).map_err(unreadable)?;
    Ok(String::from_utf8(bytes).unwrap_or_else(|e| String::from_utf8_lossy(e.as_bytes()).into_owned()))
}

/// The mesh of an OBJ text, or the line at fault.
pub(super) fn parse(text: &str) -> Result<(TriangleMesh, ObjReport), (usize, ObjFault)> {
    let last = text.lines().count().max(1);
    let plain = obj_scan::scan(text.strip_prefix('\u{feff}').unwrap_or(text))?;
    let options = tobj::LoadOptions { single_index: true, triangulate: false, ..Default::default() };
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut plain.as_bytes(), &options, no_materials)
        .map_err(|e| (last, ObjFault::Parser(e.to_string())))?;
    // The scan leaves out objects, groups and materials: there is exactly one model.
    let source = models.into_iter().next().ok_or((last, ObjFault::NoFaces))?.mesh;
    drop(plain);

    let positions: Vec<Vec3> = source.positions.as_chunks().0.iter().map(|&p: &[f32; 3]| Vec3::from(p)).collect();
    let (triangles, polygons) = triangles_of(&source, &positions);
    let count = triangles.len();
    // The scan has checked all that this checks again.
    let mut mesh =
        TriangleMesh::from_triangles(positions, triangles).map_err(|e| (last, ObjFault::Parser(e.to_string())))?;
    let welded = &mesh.welded;
    mesh.triangles.retain(|t| {
        let [a, b, c] = t.map(|i| welded[i as usize]);
        a != b && b != c && c != a
    });
    if mesh.triangles.is_empty() {
        return Err((last, ObjFault::OnlyDegenerateFaces));
    }
    let computed_normals = !take_normals(&mut mesh, &source.normals);
    if source.texcoords.len() == 2 * mesh.positions.len() {
        mesh.texture = source.texcoords.as_chunks().0.iter().map(|&t: &[f32; 2]| Vec2::from(t)).collect();
    }
    let report = ObjReport { dropped_triangles: count - mesh.triangles.len(), polygons, computed_normals };
    Ok((mesh, report))
}

/// Cuts the faces into triangles; also the number of faces that had more than three corners.
fn triangles_of(source: &tobj::Mesh, positions: &[Vec3]) -> (Vec<[u32; 3]>, usize) {
    if source.face_arities.is_empty() {
        return (source.indices.as_chunks().0.to_vec(), 0);
    }
    let mut triangles = Vec::with_capacity(source.indices.len());
    let mut corners = Vec::new();
    let mut rest = &source.indices[..];
    for &arity in &source.face_arities {
        let (face, after) = rest.split_at((arity as usize).min(rest.len()));
        rest = after;
        if face.len() >= 3 {
            corners.clear();
            corners.extend(face.iter().map(|&i| positions[i as usize]));
            polygon::triangulate(&corners, |t| triangles.push(t.map(|k| face[k])));
        }
    }
    (triangles, source.face_arities.iter().filter(|&&n| n > 3).count())
}

/// Puts the file's normals in the place of the computed ones where each vertex has one. Those of no length keep the
/// computed one.
fn take_normals(mesh: &mut TriangleMesh, normals: &[f32]) -> bool {
    if normals.len() != 3 * mesh.positions.len() {
        return false;
    }
    for (n, &given) in mesh.normals.iter_mut().zip(normals.as_chunks().0) {
        *n = Vec3::from(given).normalize_or(*n);
    }
    true
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
