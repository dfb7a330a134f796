//! Convex decompositions on disk, known by the content of the mesh.
//!
//! The file is a cache: what cannot be read, was written by another version or is not whole is as good as absent, and what
//! cannot be written is only slower the next time.

use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use rapier3d::parry::shape::SharedShape;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::decompose::{Hull, compound, hulls};
use super::error::ObstacleError;
use crate::mesh::{AtomicFile, TriangleMesh};

/// The first bytes of a file, with the version of its format and of the decomposition's parameters.
const MAGIC: &[u8] = b"pliant parts 1\n";

/// Longer files are not read.
const LARGEST_FILE: u64 = 1 << 28;

/// So many decompositions are kept in a file: a mesh may be cut in several ways.
const MOST_ENTRIES: usize = 8;

/// A decomposition: of what, and what came out.
#[derive(Serialize, Deserialize)]
struct Entry {
    key: [u8; 32],
    hulls: Vec<Hull>,
}

/// [`super::decompose`], with the result kept in the file `cache`, such as `rock.obj.parts` beside `rock.obj`.
///
/// The file is known by the positions and triangles of the mesh and by `max_parts`: it is never out of date, and holds
/// several decompositions. A file that is corrupt or foreign is ignored and replaced; a folder that cannot be written is
/// no error.
///
/// # Errors
/// [`ObstacleError::NoParts`] where the mesh is empty, or so small, so large or so flat that no part comes out.
pub fn decompose_cached(
    mesh: &TriangleMesh,
    max_parts: u32,
    cache: impl AsRef<Path>,
) -> Result<SharedShape, ObstacleError> {
    let key = key(mesh, max_parts);
    let mut entries = read(cache.as_ref()).unwrap_or_default();
    let kept = entries.iter().find(|entry| entry.key == key);
    if let Some(shape) = kept.filter(|entry| entry.hulls.iter().all(is_sound)).and_then(|e| compound(&e.hulls)) {
        return Ok(shape);
    }
    let hulls = hulls(mesh, max_parts);
    let shape = compound(&hulls).ok_or(ObstacleError::NoParts)?;
    entries.retain(|entry| entry.key != key);
    entries.insert(0, Entry { key, hulls });
    entries.truncate(MOST_ENTRIES);
    // Not written, it is decomposed again the next time: nothing worse.
    let _ = write(cache.as_ref(), &entries);
    Ok(shape)
}

/// What a decomposition depends on.
fn key(mesh: &TriangleMesh, max_parts: u32) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(max_parts.to_le_bytes());
    hash.update((mesh.positions.len() as u64).to_le_bytes());
    for position in &mesh.positions {
        position.to_array().iter().for_each(|c| hash.update(c.to_le_bytes()));
    }
    mesh.triangles.as_flattened().iter().for_each(|corner| hash.update(corner.to_le_bytes()));
    hash.finalize().into()
}

/// True where the corners of the triangles exist and are finite.
fn is_sound(hull: &Hull) -> bool {
    hull.points.as_flattened().iter().all(|c| c.is_finite())
        && hull.triangles.as_flattened().iter().all(|&corner| (corner as usize) < hull.points.len())
}

/// Magic, SHA-256 of the rest, entries in postcard's format.
fn read(path: &Path) -> Option<Vec<Entry>> {
    let file = File::open(path).ok()?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE).read_to_end(&mut bytes).ok()?;
    let (digest, content) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<32>()?;
    if Sha256::digest(content)[..] != digest[..] {
        return None;
    }
    postcard::from_bytes(content).ok()
}

fn write(path: &Path, entries: &[Entry]) -> std::io::Result<()> {
    let content = postcard::to_stdvec(entries).map_err(std::io::Error::other)?;
    let mut file = AtomicFile::create(path)?;
    file.write_all(MAGIC)?;
    file.write_all(&Sha256::digest(&content))?;
    file.write_all(&content)?;
    file.finish()
}
