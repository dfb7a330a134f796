//! Convex decompositions are kept on disk, and nothing that happens to the file does harm.

use std::fs;
use std::path::Path;

use pliant::coupling::{ObstacleError, convex_parts, decompose, decompose_cached};
use pliant::mesh::TriangleMesh;
use rapier3d::geometry::SharedShape;

use crate::kinds::torus;

fn mesh(radius: f32) -> TriangleMesh {
    let (points, triangles) = torus(radius, 0.3, 12, 6);
    TriangleMesh::from_triangles(points, triangles).expect("a torus")
}

fn same(a: &SharedShape, b: &SharedShape) -> bool {
    let parts =
        |shape: &SharedShape| convex_parts(shape).expect("parts").into_iter().map(|p| p.part).collect::<Vec<_>>();
    parts(a) == parts(b)
}

fn cut(mesh: &TriangleMesh, max_parts: u32, path: &Path) -> SharedShape {
    decompose_cached(mesh, max_parts, path).expect("parts")
}

#[test]
fn a_kept_decomposition_is_the_same_as_a_fresh_one_and_follows_the_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ring.obj.parts");
    let (ring, other) = (mesh(1.0), mesh(1.1));
    let fresh = decompose(&ring, 6).expect("parts");
    assert!(same(&cut(&ring, 6, &path), &fresh));
    let kept = fs::read(&path).unwrap();
    assert!(same(&cut(&ring, 6, &path), &fresh));
    assert_eq!(fs::read(&path).unwrap(), kept, "what is known is not written again");
    // Another mesh and another number of parts have their own entries, and leave the first where it is.
    assert!(same(&cut(&other, 6, &path), &decompose(&other, 6).expect("parts")));
    assert!(same(&cut(&ring, 3, &path), &decompose(&ring, 3).expect("parts")));
    let all = fs::read(&path).unwrap();
    assert!(same(&cut(&ring, 6, &path), &fresh));
    assert_eq!(fs::read(&path).unwrap(), all);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no other file is left behind");
}

#[test]
fn the_file_is_truly_used() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ring.parts");
    let ring = mesh(1.0);
    cut(&ring, 6, &path);
    let before = fs::metadata(&path).unwrap().modified().unwrap();
    let clock = std::time::Instant::now();
    cut(&ring, 6, &path);
    println!("from the file in {:?}", clock.elapsed());
    assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), before);
}

#[test]
fn a_corrupt_foreign_or_shortened_file_is_ignored_and_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ring.parts");
    let ring = mesh(1.0);
    let fresh = cut(&ring, 4, &path);
    let good = fs::read(&path).unwrap();
    let mut flipped = good.clone();
    let middle = good.len() / 2;
    flipped[middle] ^= 1;
    let mut version = good.clone();
    version[13] = b'9';
    let bad = [vec![], b"v 0 0 0\n".to_vec(), good[..good.len() - 7].to_vec(), good[..20].to_vec(), flipped, version];
    for (case, bytes) in bad.into_iter().enumerate() {
        fs::write(&path, bytes).unwrap();
        assert!(same(&cut(&ring, 4, &path), &fresh), "case {case}");
        assert_eq!(fs::read(&path).unwrap(), good, "case {case} is replaced");
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let ring = mesh(1.0);
    let fresh = decompose(&ring, 4).expect("parts");
    assert!(same(&cut(&ring, 4, &folder.path().join("none/ring.parts")), &fresh));
    assert!(same(&cut(&ring, 4, folder.path()), &fresh), "a folder instead of a file");
}

#[test]
fn a_mesh_without_parts_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flat.parts");
    let (points, triangles) = crate::kinds::sheet(2, 1.0);
    let flat = TriangleMesh::from_triangles(points, triangles).expect("a sheet");
    assert_eq!(decompose_cached(&flat, 4, &path).err(), Some(ObstacleError::NoParts));
    assert!(!path.exists());
}
