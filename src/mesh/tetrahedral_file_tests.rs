use super::*;
use crate::math::Vec3;
use std::fs;

const FORMATS: [(TetrahedralFormat, &str); 4] = [
    (TetrahedralFormat::Medit, "a.mesh"),
    (TetrahedralFormat::TetGen, "a.node"),
    (TetrahedralFormat::Gmsh2, "a2.msh"),
    (TetrahedralFormat::Gmsh4, "a4.msh"),
];

fn two_cells() -> TetrahedralMesh {
    let third = 1.0 / 3.0;
    let p = vec![Vec3::ZERO, Vec3::X * third, Vec3::Y * 1.1e-3, Vec3::Z * 12.5, Vec3::new(0.1, 0.2, -0.7)];
    TetrahedralMesh::new(p, vec![[0, 1, 2, 3], [0, 2, 1, 4]]).unwrap()
}

/// The error of a text in a file of that name.
fn error(name: &str, text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let error = load_tetrahedral(&path).unwrap_err().to_string();
    assert!(error.contains(name), "{error} names the file");
    error
}

#[test]
fn what_is_written_reads_back_with_the_same_bits_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = two_cells();
    for (format, name) in FORMATS {
        let path = folder.path().join(name);
        write_tetrahedral(&path, &mesh, format).unwrap();
        assert_eq!(load_tetrahedral(&path).unwrap(), mesh, "{format:?}");
    }
    assert_eq!(load_tetrahedral(folder.path().join("a.ele")).unwrap(), mesh);
}

#[test]
fn medit_files_of_other_programs_are_read_with_comments_surfaces_and_unused_vertices() {
    let text = "MeshVersionFormatted 2 # by hand\n\nDimension\n3\nVertices 5\n9 9 9 0\n0 0 0 0\n1 0 0 0\n0 1 0 7\n0 0 1 0\n\
                Triangles\n1\n2 3 4 1\nTetrahedra 1\n2 4 3 5 0\nEnd\nanything";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.MESH");
    fs::write(&path, text).unwrap();
    let mesh = load_tetrahedral(&path).unwrap();
    // The first vertex is unused; the cell was inside out.
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]);
    assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-9);
}

#[test]
fn gmsh_files_with_other_sections_other_elements_and_scattered_numbers_are_read() {
    let nodes = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"a body\"\n$EndPhysicalNames\n$Nodes\n4\n\
                 10 0 0 0\n7 1 0 0\n30 0 1 0\n2 0 0 1\n$EndNodes\n";
    let two = format!("{nodes}$Elements\n2\n1 2 2 0 1 10 7 30\n2 4 3 0 1 5 10 7 30 2\n$EndElements\n");
    let four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n2 4 2 30\n\
                2 1 1 3\n10\n7\n30\n0 0 0 .5 .5\n1 0 0 .5 .5\n0 1 0 .5 .5\n3 1 0 1\n2\n0 0 1\n$EndNodes\n\
                $Elements\n2 2 1 2\n2 1 2 1\n1 10 7 30\n3 1 4 1\n2 10 7 30 2\n$EndElements\n";
    let folder = tempfile::tempdir().unwrap();
    for text in [two.as_str(), four] {
        let path = folder.path().join("a.msh");
        fs::write(&path, text).unwrap();
        let mesh = load_tetrahedral(&path).unwrap();
        assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]);
        assert_eq!(mesh.cells, [[0, 1, 2, 3]]);
    }
}

#[test]
fn every_fault_is_told_with_its_line() {
    let medit = |body: &str| error("b.mesh", &format!("MeshVersionFormatted 1\nDimension 3\n{body}"));
    let vertices = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
    for (body, wanted) in [
        ("Vertices\n1\n0 x 0 0\n".to_owned(), ":5: `x` is not a coordinate"),
        ("Vertices\n1\n0 inf 0 0\n".to_owned(), ":5: vertex 1 has a coordinate that is not finite: `inf`"),
        ("Vertices\n-4\n".to_owned(), ":4: -4 vertices cannot be"),
        ("Vertices\n4000000000\n".to_owned(), ":4: 4000000000 vertices cannot be"),
        ("Vertices\n2\n0 0 0 0\n".to_owned(), ":5: the file ends where a coordinate was expected"),
        (vertices.to_owned(), ":8: the file ends without tetrahedra"),
        (format!("{vertices}Tetrahedra\n1\n1 2 3 5 0\n"), ":11: cell 1 uses vertex 5"),
        (format!("{vertices}Tetrahedra\n2\n1 2 3 4 0\n1 2 3 3 0\n"), ":12: cell 2 uses vertex 3 twice"),
        (
            "Vertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 2 0\n0 0 3 0\nTetrahedra\n3\n1 2 3 4 0\n1 2 3 5 0\n1 2 3 6 0\n"
                .to_owned(),
            ":15: cell 3 is the third one at a face",
        ),
        (format!("{vertices}Tetrahedra\n1\n1 2 3 1.5 0\n"), ":11: `1.5` is not a vertex"),
        ("Octahedra\n1\n".to_owned(), ":3: `Octahedra` is no section"),
    ] {
        let found = medit(&body);
        assert!(found.contains(wanted), "{found} | {wanted}");
    }
    assert!(error("b.mesh", "Dimension 2\n").contains(":1: the mesh has 2 dimensions"));
    assert!(error("b.mesh", "").contains(":1: the file ends without vertices"));
    assert!(error("b.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n").contains(":2: version 4.0"));
    assert!(error("b.msh", "$MeshFormat\n2.2 1 8\n").contains(":2: the file is binary"));
    assert!(error("b.msh", "$Nodes\n1\n").contains(":1: `$MeshFormat` must come first"));
    assert!(error("b.msh", "hello").contains("is this a Gmsh file?"));
    let twice = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n";
    assert!(error("b.msh", twice).contains(":7: vertex 1 is defined twice"));
    assert!(error("b.stl", "").contains("names no tetrahedral format"));
}

#[test]
fn faults_of_tetgen_name_the_file_of_the_two_that_has_them() {
    let folder = tempfile::tempdir().unwrap();
    let (node, ele) = (folder.path().join("c.node"), folder.path().join("c.ele"));
    fs::write(&node, "4 3 0 1\n1 0 0 0 1\n2 1 0 0 1\n3 0 1 0 1\n4 0 0 1 1\n").unwrap();
    assert!(load_tetrahedral(&node).unwrap_err().to_string().contains("c.ele: there is no such file"));
    fs::write(&ele, "1 4 1\n1 1 2 3 0 5\n").unwrap();
    assert!(load_tetrahedral(&node).unwrap_err().to_string().contains("c.ele:2: cell 1 uses vertex 0"));
    fs::write(&ele, "1 4 1\n1 1 2 3 4 5\n").unwrap();
    assert_eq!(load_tetrahedral(&node).unwrap().cells, [[0, 1, 2, 3]]);
    fs::write(&node, "4 3 0 1\n1 0 0 nan 1\n").unwrap();
    assert!(load_tetrahedral(&ele).unwrap_err().to_string().contains("c.node:2: vertex 1"));
    assert!(load_tetrahedral(folder.path().join("none.mesh")).unwrap_err().to_string().contains("no such file"));
}

#[test]
fn random_damage_never_panics() {
    let folder = tempfile::tempdir().unwrap();
    let mut rng = fastrand::Rng::with_seed(7);
    for (format, name) in FORMATS {
        let path = folder.path().join(name);
        for _ in 0..300 {
            write_tetrahedral(&path, &two_cells(), format).unwrap();
            let mut bytes = fs::read(&path).unwrap();
            for _ in 0..rng.usize(1..4) {
                let at = rng.usize(0..bytes.len());
                match rng.u8(0..3) {
                    0 => bytes[at] = rng.u8(32..127),
                    1 => bytes.truncate(at),
                    _ => bytes.insert(at, b'\n'),
                }
                if bytes.is_empty() {
                    bytes.push(b' ');
                }
            }
            fs::write(&path, bytes).unwrap();
            if let Ok(mesh) = load_tetrahedral(&path) {
                assert!(mesh.volumes().iter().all(|v| *v > 0.0));
            }
        }
    }
}
