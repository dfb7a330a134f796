//! Tests of reading OBJ: what must come through, and a table of files that must be refused with their line.

use super::*;
use crate::mesh::{Orientation, Topology};
use std::fs::File;

const CUBE: &str = "
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn good(text: &str) -> (TriangleMesh, ObjReport) {
    parse(text).unwrap_or_else(|(line, fault)| panic!("{line}: {fault}"))
}

#[test]
fn a_cube_of_quads_is_closed_and_turned_outward() {
    let (mesh, report) = good(CUBE);
    assert_eq!((mesh.positions.len(), mesh.triangles.len(), report.polygons), (8, 12, 6));
    assert!((mesh.volume() - 1.0).abs() < 1e-6 && report.computed_normals);
    let topology = Topology::of(&mesh);
    assert!(topology.is_closed_manifold() && topology.orientation == Orientation::Outward);
}

#[test]
fn negative_indices_comments_continued_lines_and_foreign_statements_are_read() {
    let (mesh, _) = good(
        "\u{feff}# made by hand\nmtllib none.mtl\no a\nvendor stuff\nv 0 0 0 # first\nv 1 0 0 1.0\r\nv 0 1 0 0.5 0.5 0.5\nusemtl\ng b\nf -3 \\\n -2 \\\n -1\nl 1 2\np 1\n",
    );
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn objects_and_groups_are_merged_into_one_mesh_with_shared_vertices() {
    let half = CUBE.replace("f 1 2 6 5", "o second\nusemtl skin\nf 1 2 6 5").replace("f 4 1", "g third\nf 4 1");
    let (mesh, _) = good(&half);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12));
}

#[test]
fn texture_and_normal_seams_split_vertices_and_weld_beneath() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0.5\nvn 0 0 2\nvn 0 1 0\n\
                f 1/1/1 2/2/1 3/3/1\nf 2/3/1 4/1/1 3/3/2\n";
    let (mesh, report) = good(text);
    assert_eq!(mesh.positions.len(), 6);
    assert_eq!(mesh.welded, [0, 1, 2, 1, 4, 2]);
    assert_eq!(mesh.normals[0], Vec3::Z);
    assert_eq!(mesh.normals[5], Vec3::Y);
    assert_eq!(mesh.texture[3], Vec2::new(0.5, 0.0));
    assert!(!report.computed_normals);
}

#[test]
fn corners_with_and_without_texture_or_normal_give_computed_normals_and_no_texture() {
    let (mesh, report) = good("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 1 0 0\nf 1/1/1 2//1 3\n");
    assert!(mesh.texture.is_empty() && report.computed_normals);
    assert!(mesh.normals.iter().all(|n| *n == Vec3::Z));
}

#[test]
fn a_concave_face_with_a_corner_in_line_leaves_the_surface_closed() {
    // A prism over an L whose long side has a middle point that the side faces use too.
    let outline = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let mut text = String::new();
    for z in 0..2 {
        outline.iter().for_each(|(x, y)| text += &format!("v {x} {y} {z}\n"));
    }
    text += "f 7 6 5 4 3 2 1\nf 8 9 10 11 12 13 14\n";
    (1..=7).for_each(|k| text += &format!("f {k} {} {} {}\n", k % 7 + 1, k % 7 + 8, k + 7));
    let (mesh, _) = good(&text);
    assert!(Topology::of(&mesh).is_closed_manifold());
    assert!((mesh.volume() - 3.0).abs() < 1e-6);
}

#[test]
fn triangles_that_collapse_are_dropped_and_counted_and_the_rest_stays_closed() {
    let (mesh, report) = good(&format!("{CUBE}v 0 0 0.0000001\nf 1 9 2\nf 3 3 4\n"));
    assert_eq!(report.dropped_triangles, 2);
    assert!(Topology::of(&mesh).is_closed_manifold());
}

#[test]
fn bad_files_are_refused_with_the_line_at_fault_and_a_hint() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let table: &[(String, usize, &str)] = &[
        (String::new(), 1, "empty"),
        (" \n\n".into(), 1, "empty"),
        ("# only\n# comments".into(), 2, "without a vertex"),
        (v.into(), 3, "without a face"),
        ("Lorem ipsum\ndolor".into(), 1, "`Lorem` is no OBJ statement"),
        ("\0\u{1}PNG\nxyz".into(), 1, "is no OBJ statement"),
        (format!("{v}v 1 2\nf 1 2 3"), 4, "`v` needs 3 numbers and has 2"),
        (format!("{v}v 1 two 3\nf 1 2 3"), 4, "`two` is not a number"),
        (format!("v nan 0 0\n{v}"), 1, "`nan` is not a finite number"),
        (format!("{v}v 0 inf 0\nf 1 2 3"), 4, "not a finite number"),
        (format!("{v}v 0 1e40 0\nf 1 2 3"), 4, "not a finite number"),
        (format!("{v}vn 0 -inf 0\nf 1 2 3"), 4, "not a finite number"),
        (format!("{v}vt\nf 1 2 3"), 4, "`vt` needs 1 numbers"),
        (format!("{v}f 1 2"), 4, "at least 3 corners and this one has 2"),
        (format!("{v}f"), 4, "has 0"),
        (format!("{v}f 0 1 2"), 4, "index 0"),
        (format!("{v}\nf 1 2 4"), 5, "vertex 4 does not exist; the file has 3"),
        (format!("{v}f 1 2 -4"), 4, "vertex -4 does not exist"),
        (format!("{v}f 1/1 2/1 3/1"), 4, "texture coordinate 1 does not exist; the file has 0"),
        (format!("{v}f 1//2 2//2 3//2\nvn 0 0 1"), 4, "normal 2 does not exist; the file has 1"),
        (format!("{v}f 1 2 3.5"), 4, "`3.5` is not a face corner"),
        (format!("{v}f 1/1/1/1 2 3"), 4, "is not a face corner"),
        (format!("{v}f 1 2 99999999999999999999"), 4, "is not a face corner"),
        (format!("{v}f -9223372036854775808 2 3"), 4, "does not exist"),
        (format!("{v}f 1 2 2\n"), 4, "degenerate"),
        (format!("{v}f{}", " 1 2 3".repeat(2000)), 4, "6000 corners"),
    ];
    for (text, line, words) in table {
        let (at, fault) = parse(text).expect_err(text);
        assert!(at == *line && fault.to_string().contains(words), "{text:?}: {at}: {fault}");
    }
}

#[test]
fn a_vertex_may_be_defined_after_the_face_that_uses_it() {
    assert_eq!(good("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").0.triangles.len(), 1);
}

#[test]
fn paths_that_are_no_mesh_file_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let message = |path: &Path| load_obj(path).unwrap_err().to_string();
    assert!(message(folder.path()).contains("not a file"));
    assert!(message(&folder.path().join("none.obj")).contains("none.obj: there is no such file"));
    let big = folder.path().join("big.obj");
    File::create(&big).unwrap().set_len(MAX_OBJ_BYTES + 1).unwrap();
    assert!(message(&big).contains("1073741825 bytes, more than"));
    let bad = folder.path().join("bad.obj");
    std::fs::write(&bad, "v 0 0 0\nv 0 0\n").unwrap();
    assert!(message(&bad).contains("bad.obj:2: `v` needs 3"));
    let latin = folder.path().join("latin.obj");
    std::fs::write(&latin, b"# caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert_eq!(load_obj(&latin).unwrap().triangles.len(), 1);
}
