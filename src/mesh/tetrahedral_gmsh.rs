//! Gmsh's format `.msh` in the versions 2.2 and 4.1, in ASCII: a parser of a text and writers.

use std::io::{self, Write};

use super::tetrahedral_formats::four;
use super::tetrahedral_scan::{At, Reading, Words, shown};
use super::{TetrahedralFault, TetrahedralMesh};

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
                words.end_of("vertices", "$EndNodes")?;
                continue;
            }
            "$Elements" if version == "2.2" => {
                gmsh_2_elements(&mut words, &mut reading)?;
                continue;
            }
            "$Nodes" if version == "4.1" => {
                gmsh_4_nodes(&mut words, &mut reading)?;
                continue;
            }
            "$Elements" if version == "4.1" => {
                gmsh_4_elements(&mut words, &mut reading)?;
                continue;
            }
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
    let known = kind.checked_sub(1).and_then(|k| GMSH_NODES.get(usize::try_from(k).ok()?));
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
    words.end_of("elements", "$EndElements")
}

/// The number of blocks and the number of all that is in them.
fn gmsh_4_counts(words: &mut Words, what: &'static str) -> At<[usize; 2]> {
    let counts = [words.count("blocks")?, words.count(what)?];
    words.skip(2, "the least and the largest number")?;
    Ok(counts)
}

fn gmsh_4_nodes(words: &mut Words, reading: &mut Reading) -> At<()> {
    let [blocks, announced] = gmsh_4_counts(words, "vertices")?;
    let (line, mut given) = (words.line, 0);
    for _ in 0..blocks {
        let dimension = words.count("dimensions")?;
        words.skip(1, "an entity")?;
        let parametric = words.integer("0 or 1")? != 0;
        let count = words.count("vertices")?;
        given += count;
        let numbers = (0..count).map(|_| words.integer("a vertex")).collect::<At<Vec<i64>>>()?;
        for number in numbers {
            let position = words.position(number)?;
            words.skip(if parametric { dimension } else { 0 }, "a parameter")?;
            reading.vertex(words.line, number, position)?;
        }
    }
    words.end_of("vertices", "$EndNodes")?;
    same_count("vertices", given, announced).map_err(|fault| (line, fault))
}

fn same_count(what: &'static str, given: usize, announced: usize) -> Result<(), TetrahedralFault> {
    if given == announced { Ok(()) } else { Err(TetrahedralFault::WrongCount { what, given, announced }) }
}

fn gmsh_4_elements(words: &mut Words, reading: &mut Reading) -> At<()> {
    let [blocks, announced] = gmsh_4_counts(words, "elements")?;
    let (line, mut given) = (words.line, 0);
    for _ in 0..blocks {
        words.skip(2, "an entity")?;
        let kind = words.integer("a type")?;
        let nodes = gmsh_nodes(words, kind)?;
        let count = words.count("elements")?;
        given += count;
        for _ in 0..count {
            let number = words.integer("an element")?;
            if kind == GMSH_TETRAHEDRON {
                let vertices = four(words)?;
                reading.cell(words.line, number, vertices);
            } else {
                words.skip(nodes, "a node")?;
            }
        }
    }
    words.end_of("elements", "$EndElements")?;
    same_count("elements", given, announced).map_err(|fault| (line, fault))
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
