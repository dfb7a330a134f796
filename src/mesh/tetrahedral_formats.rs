//! Formats, each a parser of a text and a writer: Medit's `.mesh`, TetGen's `.node` and `.ele`; in ASCII.

use std::io::{self, Write};

use super::tetrahedral_scan::{At, Reading, Words, shown};
use super::{TetrahedralFault, TetrahedralMesh};

/// Medit: `Vertices n`, then `x y z reference`; `Tetrahedra n`, then four numbers from 1 and a reference. Other elements are
/// passed over.
pub(super) fn parse_medit(text: &str) -> At<TetrahedralMesh> {
    let mut words = Words::new(text);
    let mut reading = Reading::default();
    // What the section before was about.
    let mut before = "words";
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
                before = "vertices";
                continue;
            }
            "Tetrahedra" => {
                for number in 1..=words.count("tetrahedra")? as i64 {
                    let vertices = four(&mut words)?;
                    words.skip(1, "a reference")?;
                    reading.cell(words.line, number, vertices);
                }
                before = "tetrahedra";
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
            _ if word.parse::<f64>().is_ok() => {
                let (end, word) = ("the next section", shown(word));
                return words.fault(TetrahedralFault::Surplus { what: before, end, word });
            }
            _ => {
                let text = format!("`{}` is no section of a Medit file that is known here", shown(word));
                return words.fault(TetrahedralFault::Unsupported(text));
            }
        };
        let count = words.count("elements")?;
        words.skip(count * width, "an element")?;
        before = "elements";
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
        let line = words.line;
        let position = words.position(number)?;
        words.skip(rest, "an attribute")?;
        words.same_row(line, "vertex", number)?;
        reading.vertex(line, number, position)?;
    }
    words.end_of("vertices", "")
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
        let line = words.line;
        let vertices = four(words)?;
        words.skip(rest, "an attribute")?;
        words.same_row(line, "cell", number)?;
        reading.cell(line, number, vertices);
    }
    words.end_of("tetrahedra", "")
}

/// The four vertices of a cell.
pub(super) fn four(words: &mut Words) -> At<[i64; 4]> {
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
