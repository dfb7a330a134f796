//! The formats, each a parser of a text and a writer: Medit's `.mesh`, TetGen's `.node` and `.ele`, Gmsh's `.msh` in the versions
//! 2.2 and 4.1; all in ASCII.

use std::io::{self, Write};

use super::tetrahedral_scan::{At, Reading, Words, shown};
use super::{TetrahedralFault, TetrahedralMesh};

/// Medit: `Vertices n`, then `x y z reference`; `Tetrahedra n`, then four numbers from 1 and a reference. Other elements are
/// passed over.
pub(super) fn parse_medit(text: &str) -> At<TetrahedralMesh> {
    let mut words = Words::new(text);
    let mut reading = Reading::default();
    while let Some(word) = words.next() {
        // How many words each line of the section has.
        let width = match word {
            "MeshVersionFormatted" => {
                words.integer("a version")?;
                continue;
            }
            "Dimension" => {
                let dimension = words.integer("a dimension")?;
                if dimension != 3 {
                    return words.fault(TetrahedralFault::Unsupported(format!(
                        "the mesh has {dimension} dimensions; 3 are needed"
                    )));
                }
                continue;
            }
            "End" => break,
            "Vertices" => {
                for number in 1..=words.count("vertices")? as i64 {
                    let position = words.position(number)?;
                    words.skip(1, "a reference")?;
                    reading.vertex(words.line, number, position)?;
                }
                continue;
            }
            "Tetrahedra" => {
                for number in 1..=words.count("tetrahedra")? as i64 {
                    let vertices = four(&mut words)?;
                    words.skip(1, "a reference")?;
                    reading.cell(words.line, number, vertices);
                }
                continue;
            }
            "Corners" | "RequiredVertices" | "Ridges" | "RequiredEdges" | "RequiredTriangles" => 1,
            "NormalAtVertices" | "TangentAtVertices" => 2,
            "Edges" | "Normals" | "Tangents" => 3,
            "Triangles" => 4,
            "Quadrilaterals" => 5,
            "Pyramids" => 6,
            "Prisms" => 7,
            "Hexahedra" => 9,
            _ => {
                let text = format!("`{}` is no section of a Medit file that is known here", shown(word));
                return words.fault(TetrahedralFault::Unsupported(text));
            }
        };
        let count = words.count("elements")?;
        words.skip(count * width, "an element")?;
    }
    let last = words.line;
    reading.finish(last)
}

/// TetGen: `.node` has `count 3 attributes markers`, then `number x y z …`; `.ele` has `count 4 attributes`, then
/// `number a b c d …`. Numbers start anywhere. A fault's file is 0 for the nodes and 1 for the cells.
pub(super) fn parse_tetgen(nodes: &str, elements: &str) -> Result<TetrahedralMesh, (usize, usize, TetrahedralFault)> {
    let mut reading = Reading::default();
    tetgen_nodes(nodes, &mut reading).map_err(|(line, fault)| (0, line, fault))?;
    let mut words = Words::new(elements);
    tetgen_elements(&mut words, &mut reading).map_err(|(line, fault)| (1, line, fault))?;
    let last = words.line;
    reading.finish(last).map_err(|(line, fault)| (1, line, fault))
}

fn tetgen_nodes(text: &str, reading: &mut Reading) -> At<()> {
    let mut words = Words::new(text);
    let count = words.count("vertices")?;
    let dimension = words.integer("a dimension")?;
    if dimension != 3 {
        return words
            .fault(TetrahedralFault::Unsupported(format!("the nodes have {dimension} dimensions; 3 are needed")));
    }
    let rest = words.count("attributes")? + words.count("markers")?;
    for _ in 0..count {
        let number = words.integer("a vertex")?;
        let position = words.position(number)?;
        words.skip(rest, "an attribute")?;
        reading.vertex(words.line, number, position)?;
    }
    Ok(())
}

fn tetgen_elements(words: &mut Words, reading: &mut Reading) -> At<()> {
    let count = words.count("tetrahedra")?;
    let nodes = words.count("nodes of a tetrahedron")?;
    if nodes != 4 && nodes != 10 {
        let text = format!("tetrahedra of {nodes} nodes are not known; 4 or 10 are");
        return words.fault(TetrahedralFault::Unsupported(text));
    }
    let rest = words.count("attributes")? + nodes - 4;
    for _ in 0..count {
        let number = words.integer("a tetrahedron")?;
        let vertices = four(words)?;
        words.skip(rest, "an attribute")?;
        reading.cell(words.line, number, vertices);
    }
    Ok(())
}

/// Gmsh 2.2 or 4.1: the sections `$MeshFormat`, `$Nodes` and `$Elements`; others are passed over, as are elements that are not
/// tetrahedra of four nodes.
pub(super) fn parse_gmsh(text: &str) -> At<TetrahedralMesh> {
    let mut words = Words::new(text);
    let mut reading = Reading::default();
    let mut version = "";
    while let Some(section) = words.next() {
        match section {
            "$MeshFormat" => {
                version = words.word("a version")?;
                if !matches!(version, "2.2" | "4.1") {
                    let text = format!("version {} of Gmsh's format is not known; 2.2 and 4.1 are", shown(version));
                    return words.fault(TetrahedralFault::Unsupported(text));
                }
                if words.integer("a file type")? != 0 {
                    return words.fault(TetrahedralFault::Unsupported("the file is binary; save it as ASCII".into()));
                }
                words.skip(1, "a data size")?;
            }
            "$Nodes" if version == "2.2" => {
                for _ in 0..words.count("vertices")? {
                    let number = words.integer("a vertex")?;
                    let position = words.position(number)?;
                    reading.vertex(words.line, number, position)?;
                }
            }
            "$Elements" if version == "2.2" => gmsh_2_elements(&mut words, &mut reading)?,
            "$Nodes" if version == "4.1" => gmsh_4_nodes(&mut words, &mut reading)?,
            "$Elements" if version == "4.1" => gmsh_4_elements(&mut words, &mut reading)?,
            "$Nodes" | "$Elements" => {
                return words.fault(TetrahedralFault::Unsupported("`$MeshFormat` must come first".into()));
            }
            _ if section.starts_with('$') => {}
            // Sections that are not read.
            _ => continue,
        }
        // To the end of the section.
        let end = format!("$End{}", section.trim_start_matches('$'));
        while words.word("the end of a section")? != end {}
    }
    let last = words.line;
    if version.is_empty() {
        return Err((last, TetrahedralFault::Without("`$MeshFormat`; is this a Gmsh file?")));
    }
    reading.finish(last)
}

/// The number of nodes of each of Gmsh's types of elements from 1.
const GMSH_NODES: [usize; 19] = [2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13];
const GMSH_TETRAHEDRON: i64 = 4;

fn gmsh_nodes(words: &Words, kind: i64) -> At<usize> {
    let known = usize::try_from(kind - 1).ok().and_then(|k| GMSH_NODES.get(k));
    match known {
        Some(&nodes) => Ok(nodes),
        None => words.fault(TetrahedralFault::Unsupported(format!("elements of type {kind} are not known"))),
    }
}

fn gmsh_2_elements(words: &mut Words, reading: &mut Reading) -> At<()> {
    for _ in 0..words.count("elements")? {
        let number = words.integer("an element")?;
        let kind = words.integer("a type")?;
        let tags = words.count("tags")?;
        words.skip(tags, "a tag")?;
        if kind == GMSH_TETRAHEDRON {
            let vertices = four(words)?;
            reading.cell(words.line, number, vertices);
        } else {
            let nodes = gmsh_nodes(words, kind)?;
            words.skip(nodes, "a node")?;
        }
    }
    Ok(())
}

fn gmsh_4_nodes(words: &mut Words, reading: &mut Reading) -> At<()> {
    let blocks = words.count("blocks")?;
    words.skip(3, "a count")?;
    for _ in 0..blocks {
        let dimension = words.count("a dimension")?;
        words.skip(1, "an entity")?;
        let parametric = words.integer("0 or 1")? != 0;
        let count = words.count("vertices")?;
        let numbers = (0..count).map(|_| words.integer("a vertex")).collect::<At<Vec<i64>>>()?;
        for number in numbers {
            let position = words.position(number)?;
            words.skip(if parametric { dimension } else { 0 }, "a parameter")?;
            reading.vertex(words.line, number, position)?;
        }
    }
    Ok(())
}

fn gmsh_4_elements(words: &mut Words, reading: &mut Reading) -> At<()> {
    let blocks = words.count("blocks")?;
    words.skip(3, "a count")?;
    for _ in 0..blocks {
        words.skip(2, "an entity")?;
        let kind = words.integer("a type")?;
        let nodes = gmsh_nodes(words, kind)?;
        for _ in 0..words.count("elements")? {
            let number = words.integer("an element")?;
            if kind == GMSH_TETRAHEDRON {
                let vertices = four(words)?;
                reading.cell(words.line, number, vertices);
            } else {
                words.skip(nodes, "a node")?;
            }
        }
    }
    Ok(())
}

fn four(words: &mut Words) -> At<[i64; 4]> {
    let mut vertices = [0; 4];
    for vertex in &mut vertices {
        *vertex = words.integer("a vertex")?;
    }
    Ok(vertices)
}

pub(super) fn write_medit(file: &mut impl Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    writeln!(file, "MeshVersionFormatted 1\nDimension 3\nVertices\n{}", mesh.positions.len())?;
    for p in &mesh.positions {
        writeln!(file, "{} {} {} 0", p.x, p.y, p.z)?;
    }
    writeln!(file, "Tetrahedra\n{}", mesh.cells.len())?;
    for cell in &mesh.cells {
        let [a, b, c, d] = cell.map(|v| v + 1);
        writeln!(file, "{a} {b} {c} {d} 0")?;
    }
    writeln!(file, "End")
}

pub(super) fn write_nodes(file: &mut impl Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    writeln!(file, "{} 3 0 0", mesh.positions.len())?;
    (0..).zip(&mesh.positions).try_for_each(|(i, p): (u32, _)| writeln!(file, "{i} {} {} {}", p.x, p.y, p.z))
}

pub(super) fn write_elements(file: &mut impl Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    writeln!(file, "{} 4 0", mesh.cells.len())?;
    (0..).zip(&mesh.cells).try_for_each(|(i, [a, b, c, d]): (u32, _)| writeln!(file, "{i} {a} {b} {c} {d}"))
}

pub(super) fn write_gmsh_2(file: &mut impl Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    writeln!(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}", mesh.positions.len())?;
    (1..).zip(&mesh.positions).try_for_each(|(i, p): (u32, _)| writeln!(file, "{i} {} {} {}", p.x, p.y, p.z))?;
    writeln!(file, "$EndNodes\n$Elements\n{}", mesh.cells.len())?;
    for (i, cell) in (1u32..).zip(&mesh.cells) {
        let [a, b, c, d] = cell.map(|v| v + 1);
        writeln!(file, "{i} 4 2 0 1 {a} {b} {c} {d}")?;
    }
    writeln!(file, "$EndElements")
}

pub(super) fn write_gmsh_4(file: &mut impl Write, mesh: &TetrahedralMesh) -> io::Result<()> {
    let (n, m) = (mesh.positions.len(), mesh.cells.len());
    writeln!(file, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {n} 1 {n}\n3 1 0 {n}")?;
    (1..=n).try_for_each(|i| writeln!(file, "{i}"))?;
    mesh.positions.iter().try_for_each(|p| writeln!(file, "{} {} {}", p.x, p.y, p.z))?;
    writeln!(file, "$EndNodes\n$Elements\n1 {m} 1 {m}\n3 1 4 {m}")?;
    for (i, cell) in (1u32..).zip(&mesh.cells) {
        let [a, b, c, d] = cell.map(|v| v + 1);
        writeln!(file, "{i} {a} {b} {c} {d}")?;
    }
    writeln!(file, "$EndElements")
}
