//! What can be wrong with a tetrahedral file, one fault after the other: each is told with the file and the line, vertex or cell.

use std::fs;
use std::path::Path;

use pliant::math::Vec3;
use pliant::mesh::{TetrahedralMesh, load_tetrahedral};

const MEDIT: &str = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n\
                     1 2 3 4 0\nEnd\n";
const NODE: &str = "4 3 1 1\n0 0 0 0 9.5 1\n1 1 0 0 9.5 1\n2 0 1 0 9.5 1\n3 0 0 1 9.5 1\n";
const ELE: &str = "1 4 1\n0 0 1 2 3 7\n";
const GMSH_2: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n\
                      $Elements\n2\n1 2 2 0 1 1 2 3\n2 4 2 0 1 1 2 3 4\n$EndElements\n";
const GMSH_4: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n\
                      $EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

/// A file with one place changed, and what is told of it.
struct Case(&'static str, &'static str, &'static str);

fn check(name: &str, good: &str, cases: &[Case]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(folder.path().join("m.node"), NODE).unwrap();
    fs::write(folder.path().join("m.ele"), ELE).unwrap();
    fs::write(&path, good).unwrap();
    assert_eq!(load_tetrahedral(&path).unwrap().cells, [[0, 1, 2, 3]], "{name}");
    let mut failed = Vec::new();
    for Case(from, to, told) in cases {
        assert!(good.contains(from), "{from}");
        fs::write(&path, good.replacen(from, to, 1)).unwrap();
        let message = load_tetrahedral(&path).expect_err(to).to_string();
        let told = format!("{name}:{told}");
        if !message.contains(&told) || message.contains('\n') {
            failed.push(format!("{from:?} as {to:?}\n{message}\nshould contain\n{told}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

#[test]
fn every_fault_of_a_medit_file_is_told_with_its_line() {
    check(
        "m.mesh",
        MEDIT,
        &[
            // Cut off, at every section.
            Case(&MEDIT[7..], "", "1: `MeshVer` is no section"),
            Case(&MEDIT[35..], "", "2: the file ends without vertices"),
            Case(
                "4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n",
                "",
                "3: the file ends where vertices",
            ),
            Case("0 0 1 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n", "0 0", "8: the file ends where a coordinate"),
            Case("Tetrahedra\n1\n1 2 3 4 0\nEnd\n", "", "8: the file ends without tetrahedra"),
            Case("1\n1 2 3 4 0\nEnd\n", "", "9: the file ends where tetrahedra"),
            Case("1 2 3 4 0\nEnd\n", "1 2", "11: the file ends where a vertex was expected"),
            Case("1 2 3 4 0\nEnd\n", "1 2 3 4", "11: the file ends where a reference was expected"),
            // Counts.
            Case(
                "Vertices\n4",
                "Vertices\n3",
                "8: `0` stands where the next section was expected: there are more vertices",
            ),
            Case("Vertices\n4", "Vertices\n5", "9: `Tetrahedra` is not a coordinate"),
            Case("Vertices\n4", "Vertices\n0", "5: `0` stands where the next section"),
            Case("Vertices\n4", "Vertices\n-4", "4: -4 vertices cannot be in a file of this length"),
            Case("Vertices\n4", "Vertices\n4000000000", "4: 4000000000 vertices cannot be"),
            Case(
                "Vertices\n4",
                "Vertices\n99999999999999999999",
                "4: `99999999999999999999` is not a number of vertices",
            ),
            Case("Vertices\n4", "Vertices\nfour", "4: `four` is not a number of vertices"),
            Case("Vertices\n4", "Vertices\n4.0", "4: `4.0` is not a number of vertices"),
            Case("Tetrahedra\n1", "Tetrahedra\n2", "12: `End` is not a vertex"),
            Case(
                "Tetrahedra\n1",
                "Tetrahedra\n0",
                "11: `1` stands where the next section was expected: there are more tetrahedra",
            ),
            Case("Tetrahedra\n1", "Tetrahedra\n123456789012", "10: 123456789012 tetrahedra cannot be"),
            Case("Tetrahedra\n1", "Triangles\n1\n1 2 3 0\nTetrahedra\n0", "14: `1` stands where"),
            // Indices.
            Case(
                "1 2 3 4 0",
                "0 1 2 3 0",
                "11: cell 1 uses vertex 0, which the file does not define: its vertices are 1 to 4",
            ),
            Case("1 2 3 4 0", "1 2 3 5 0", "11: cell 1 uses vertex 5"),
            Case("1 2 3 4 0", "1 2 3 -4 0", "11: cell 1 uses vertex -4"),
            Case("1 2 3 4 0", "1 2 3 4294967297 0", "11: cell 1 uses vertex 4294967297"),
            Case("1 2 3 4 0", "1 2 3 1e3 0", "11: `1e3` is not a vertex"),
            Case("1 2 3 4 0", "1 2 2 4 0", "11: cell 1 uses vertex 2 twice"),
            // Numbers.
            Case("0 1 0 0", "0 nan 0 0", "7: vertex 3 has a coordinate that is not finite: `nan`"),
            Case("0 1 0 0", "0 -inf 0 0", "7: vertex 3 has a coordinate that is not finite: `-inf`"),
            Case("0 1 0 0", "0 1e39 0 0", "7: vertex 3 has a coordinate that is not finite: `1e39`"),
            Case("0 1 0 0", "0 1,5 0 0", "7: `1,5` is not a coordinate"),
            Case("0 1 0 0", "0 \u{0}\u{7} 0 0", "7: `\\0\\u{7}` is not a coordinate"),
            // Shapes.
            Case("0 0 1 0", "1 1 0 0", "11: cell 1 has no volume: its vertices [1, 2, 3, 4] lie in a plane"),
            Case("0 0 1 0", "0 0 1e-9 0", "11: cell 1 has no volume"),
            Case("1\n1 2 3 4 0", "3\n1 2 3 4 0\n1 2 3 4 0\n2 1 3 4 0", "13: cell 3 is the third one at a face"),
            // Sections.
            Case("Dimension 3", "Dimension 2", "2: the mesh has 2 dimensions"),
            Case("Dimension 3", "Dimension", "3: `Vertices` is not a dimension"),
            Case("Vertices", "Vertixes", "3: `Vertixes` is no section"),
            Case("End", "Vertices\n1\n0 0 0 0", "14: vertex 1 is defined twice"),
            Case("MeshVersionFormatted 1\nDimension 3", "solid a", "1: `solid` is no section"),
        ],
    );
}

#[test]
fn every_fault_of_a_tetgen_file_is_told_with_the_file_and_its_line() {
    check(
        "m.node",
        NODE,
        &[
            Case(NODE, "", "1: the file ends where vertices"),
            Case(NODE, "# nothing\n", "1: the file ends where vertices"),
            Case("4 3 1 1", "4", "2: the nodes have 0 dimensions"),
            Case("4 3 1 1", "5 3 1 1", "5: the file ends where a vertex was expected"),
            Case("4 3 1 1", "3 3 1 1", "5: `3` stands where the end of the file was expected: there are more vertices"),
            Case("4 3 1 1", "4 3 1 0", "2: the row of vertex 1 has another length than"),
            Case("4 3 1 1", "4 3 2 1", "2: the row of vertex 0 has another length than"),
            Case("4 3 1 1", "4000000000 3 1 1", "1: 4000000000 vertices cannot be"),
            Case("4 3 1 1", "4 3 1000000000 1", "1: 1000000000 attributes cannot be"),
            Case("4 3 1 1", "4 2 1 1", "1: the nodes have 2 dimensions"),
            Case("2 0 1 0 9.5 1", "1 0 1 0 9.5 1", "4: vertex 1 is defined twice"),
            Case("2 0 1 0 9.5 1", "2 0 1 9.5 1", "4: the row of vertex 2 has another length than"),
            Case("2 0 1 0 9.5 1", "2 0 NaN 0 9.5 1", "4: vertex 2 has a coordinate that is not finite"),
            Case("2 0 1 0 9.5 1", "2 0 one 0 9.5 1", "4: `one` is not a coordinate"),
        ],
    );
    check(
        "m.ele",
        ELE,
        &[
            Case(ELE, "", "1: the file ends where tetrahedra"),
            Case("1 4 1", "0 4 1", "2: `0` stands where the end of the file was expected: there are more tetrahedra"),
            Case("1 4 1", "2 4 1", "2: the file ends where a tetrahedron was expected"),
            Case("1 4 1", "1 5 1", "1: tetrahedra of 5 nodes are not known"),
            Case("1 4 1", "1 4 2", "2: the file ends where an attribute was expected"),
            Case(
                "0 0 1 2 3 7",
                "0 1 2 3 4 7",
                "2: cell 0 uses vertex 4, which the file does not define: its vertices are 0 to 3",
            ),
            Case("0 0 1 2 3 7", "0 0 1 2 2 7", "2: cell 0 uses vertex 2 twice"),
            Case("0 0 1 2 3 7", "0 0 1 2 x 7", "2: `x` is not a vertex"),
        ],
    );
}

#[test]
fn every_fault_of_a_gmsh_file_is_told_with_its_line() {
    check(
        "two.msh",
        GMSH_2,
        &[
            Case(GMSH_2, "", "1: the file ends without `$MeshFormat`"),
            Case("2.2 0 8", "2.2 1 8", "2: the file is binary; save it as ASCII"),
            Case("2.2 0 8", "1.0 0 8", "2: version 1.0"),
            Case("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "", "1: `$MeshFormat` must come first"),
            Case("$EndMeshFormat\n", "", "14: the file ends where the end of a section"),
            Case("$Nodes\n4", "$Nodes\n3", "9: `4` stands where $EndNodes was expected: there are more vertices"),
            Case("$Nodes\n4", "$Nodes\n5", "10: `$EndNodes` is not a vertex"),
            Case("$Nodes\n4", "$Nodes\n5000000000", "5: 5000000000 vertices cannot be"),
            Case(
                "$Elements\n2",
                "$Elements\n1",
                "14: `2` stands where $EndElements was expected: there are more elements",
            ),
            Case("$Elements\n2", "$Elements\n3", "15: `$EndElements` is not an element"),
            Case("$EndNodes\n", "", "10: `$Elements` stands where $EndNodes was expected"),
            Case("$EndElements\n", "", "14: the file ends where $EndElements was expected"),
            Case("2 4 2 0 1 1 2 3 4", "2 4 2 0 1 0 1 2 3", "14: cell 2 uses vertex 0"),
            Case("2 4 2 0 1 1 2 3 4", "2 4 2 0 1 1 1 2 3", "14: cell 2 uses vertex 1 twice"),
            Case("2 4 2 0 1 1 2 3 4", "2 4 99999 0 1 1 2 3 4", "14: 99999 tags cannot be"),
            Case("2 4 2 0 1 1 2 3 4", "2 77 2 0 1 1 2 3 4", "14: elements of type 77 are not known"),
            Case(
                "2 4 2 0 1 1 2 3 4",
                "2 -9223372036854775808 2 0 1 1 2 3 4",
                "14: elements of type -9223372036854775808",
            ),
            Case("2 4 2 0 1 1 2 3 4", "2 15 2 0 1 1", "15: the file ends without tetrahedra"),
            Case("3 0 1 0", "3 0 inf 0", "8: vertex 3 has a coordinate that is not finite"),
        ],
    );
    check(
        "four.msh",
        GMSH_4,
        &[
            Case("4.1 0 8", "4.1 1 8", "2: the file is binary"),
            Case("4.1 0 8", "4.0 0 8", "2: version 4.0"),
            Case("1 4 1 4", "2 4 1 4", "15: `$EndNodes` is not a number of dimensions"),
            Case("1 4 1 4", "0 4 1 4", "6: `3` stands where $EndNodes was expected"),
            Case("1 4 1 4", "1 9 1 4", "5: there are 4 vertices, the file announces 9"),
            Case("3 1 0 4", "3 1 0 3", "13: `0` stands where $EndNodes"),
            Case("3 1 0 4", "3 1 0 44444444", "6: 44444444 vertices cannot be"),
            Case("3 1 0 4", "3 1 1 4", "15: `$EndNodes` is not a coordinate"),
            Case("1 1 1 1\n3 1 4 1", "1 2 1 1\n3 1 4 1", "17: there are 1 elements, the file announces 2"),
            Case("3 1 4 1", "3 1 4 2", "20: `$EndElements` is not an element"),
            Case("3 1 4 1", "3 1 0 1", "18: elements of type 0 are not known"),
            Case("1 1 2 3 4", "1 1 2 3 9", "19: cell 1 uses vertex 9"),
            Case("1 1 2 3 4", "1 1 2 3", "20: `$EndElements` is not a vertex"),
            Case("$EndElements\n", "", "19: the file ends where $EndElements was expected"),
        ],
    );
}

/// The one cell, however the file is written.
fn loads(folder: &Path, name: &str, bytes: &[u8]) -> TetrahedralMesh {
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    load_tetrahedral(&path).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn other_ends_of_lines_comments_and_foreign_letters_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, text) in [("m.mesh", MEDIT), ("two.msh", GMSH_2), ("four.msh", GMSH_4)] {
        let plain = loads(folder, name, text.as_bytes());
        assert_eq!(loads(folder, name, text.replace('\n', "\r\n").as_bytes()), plain, "{name}");
        assert_eq!(loads(folder, name, format!("\u{feff}{text}").as_bytes()), plain, "{name}");
        assert_eq!(loads(folder, name, text.trim_end().as_bytes()), plain, "{name}");
    }
    fs::write(folder.join("m.ele"), ELE.replace('\n', " # a cell\r\n\r\n")).unwrap();
    assert_eq!(loads(folder, "m.node", format!("# by hand\n{NODE}\n# the end\n").as_bytes()).cells, [[0, 1, 2, 3]]);
    let latin = [b"# caf\xe9\n", MEDIT.as_bytes()].concat();
    assert_eq!(loads(folder, "m.mesh", &latin).cells, [[0, 1, 2, 3]]);
    let broken = MEDIT.as_bytes().iter().map(|b| if *b == b'4' { 0xe9 } else { *b }).collect::<Vec<u8>>();
    fs::write(folder.join("m.mesh"), broken).unwrap();
    let message = load_tetrahedral(folder.join("m.mesh")).unwrap_err().to_string();
    assert!(message.contains("m.mesh:4: `\u{fffd}` is not a number of vertices"), "{message}");
}

#[test]
fn cells_that_are_inside_out_are_turned() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = loads(folder.path(), "m.mesh", MEDIT.replace("1 2 3 4 0", "2 1 3 4 0").as_bytes());
    assert_eq!((mesh.cells, mesh.positions[1]), (vec![[1, 0, 3, 2]], Vec3::X));
}

#[test]
fn what_is_no_readable_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let message = |name: &str| load_tetrahedral(folder.join(name)).unwrap_err().to_string();
    for name in ["none.mesh", "none.msh", "none.node"] {
        assert!(message(name).contains(&format!("{name}: there is no such file")), "{}", message(name));
    }
    // Each of TetGen's two files without the other.
    fs::write(folder.join("a.node"), NODE).unwrap();
    assert!(message("a.node").contains("a.ele: there is no such file"));
    assert!(message("a.ele").contains("a.ele: there is no such file"));
    fs::write(folder.join("b.ele"), ELE).unwrap();
    assert!(message("b.ele").contains("b.node: there is no such file"));
    fs::create_dir(folder.join("folder.mesh")).unwrap();
    assert!(message("folder.mesh").contains("folder.mesh: this is not a file"));
    fs::create_dir(folder.join("a.ele")).unwrap();
    assert!(message("a.node").contains("a.ele: this is not a file"));
    for name in ["a.stl", "a", "a.meshb"] {
        fs::write(folder.join(name), "").unwrap();
        assert!(message(name).contains("the ending names no tetrahedral format"));
    }
    fs::File::create(folder.join("big.mesh")).unwrap().set_len((1 << 30) + 1).unwrap();
    assert!(message("big.mesh").contains("1073741825 bytes, more than"));
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read_is_named() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("secret.mesh");
    fs::write(&path, MEDIT).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    // Whoever runs as root may read it all the same.
    if let Err(error) = load_tetrahedral(&path) {
        assert!(error.to_string().contains("secret.mesh: cannot be read: "), "{error}");
    }
    // The memory of the process is a file that nobody can read from its beginning.
    let memory = folder.path().join("memory.mesh");
    if Path::new("/proc/self/mem").exists() {
        symlink("/proc/self/mem", &memory).unwrap();
        let message = load_tetrahedral(&memory).unwrap_err().to_string();
        assert!(message.contains("memory.mesh: cannot be read: "), "{message}");
    }
    symlink(folder.path().join("nowhere.mesh"), folder.path().join("loose.mesh")).unwrap();
    let message = load_tetrahedral(folder.path().join("loose.mesh")).unwrap_err().to_string();
    assert!(message.contains("loose.mesh: there is no such file"), "{message}");
}
