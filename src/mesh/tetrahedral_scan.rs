//! What the readers of tetrahedral files share: words with the lines they stand on, and the mesh that they fill.

use std::collections::HashMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use super::tetrahedral_mesh::{CELL_FACES, cell_volume, corners, is_flat};
use super::{TetrahedralError, TetrahedralFault, TetrahedralMesh};
use crate::math::Vec3;

/// Larger files are refused before they are read: 1 GiB.
pub const MAX_TETRAHEDRAL_BYTES: u64 = 1 << 30;

/// A fault and the line where it is.
pub(super) type At<T> = Result<T, (usize, TetrahedralFault)>;

/// The text of a file of at most [`MAX_TETRAHEDRAL_BYTES`]; bytes that are not UTF-8 are replaced.
pub(super) fn read_text(path: &Path) -> Result<String, TetrahedralError> {
    let unreadable = |source: std::io::Error| match source.kind() {
        ErrorKind::NotFound => TetrahedralError::Missing { path: path.into() },
        _ => TetrahedralError::Unreadable { path: path.into(), source },
    };
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(TetrahedralError::NotAFile { path: path.into() });
    }
    let (bytes, limit) = (metadata.len(), MAX_TETRAHEDRAL_BYTES);
    if bytes > limit {
        return Err(TetrahedralError::TooLarge { path: path.into(), bytes, limit });
    }
    let bytes = fs::read(path).map_err(unreadable)?;
    Ok(String::from_utf8(bytes).unwrap_or_else(|e| String::from_utf8_lossy(e.as_bytes()).into_owned()))
}

/// The words of a text, one after the other; what follows a `#` is a comment.
pub(super) struct Words<'a> {
    text: &'a str,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::str::SplitWhitespace<'a>,
    /// The line of the last word, from 1.
    pub line: usize,
}

impl<'a> Words<'a> {
    pub fn new(text: &'a str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self { text, lines: text.lines().enumerate(), words: "".split_whitespace(), line: 1 }
    }

    /// The next word of the file.
    pub fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            let (index, line) = self.lines.next()?;
            self.line = index + 1;
            self.words = line.split('#').next().unwrap_or(line).split_whitespace();
        }
    }

    /// What is wrong, with the line of the last word.
    pub fn fault<T>(&self, fault: TetrahedralFault) -> At<T> {
        Err((self.line, fault))
    }

    /// The next word, which must be there.
    pub fn word(&mut self, what: &'static str) -> At<&'a str> {
        match self.next() {
            Some(word) => Ok(word),
            None => self.fault(TetrahedralFault::Ended(what)),
        }
    }

    /// The next word as a whole number.
    pub fn integer(&mut self, what: &'static str) -> At<i64> {
        let word = self.word(what)?;
        word.parse().or_else(|_| self.fault(TetrahedralFault::NotANumber { what, word: shown(word) }))
    }

    /// The next word as a count of things that are in the file.
    pub fn count(&mut self, what: &'static str) -> At<usize> {
        let word = self.word(what)?;
        let count = word.parse().or_else(|_| self.fault(TetrahedralFault::NotACount { what, word: shown(word) }))?;
        match usize::try_from(count) {
            // Each thing is a character and a space at least.
            Ok(n) if n <= self.text.len() / 2 => Ok(n),
            _ => self.fault(TetrahedralFault::BadCount { what, count }),
        }
    }

    /// The three coordinates of a vertex.
    pub fn position(&mut self, vertex: i64) -> At<Vec3> {
        let mut out = [0.0f32; 3];
        for value in &mut out {
            let word = self.word("a coordinate")?;
            let what = "a coordinate";
            *value = word.parse().or_else(|_| self.fault(TetrahedralFault::NotANumber { what, word: shown(word) }))?;
            if !value.is_finite() {
                return self.fault(TetrahedralFault::NotFinite { vertex, word: shown(word) });
            }
        }
        Ok(Vec3::from(out))
    }

    /// What stands behind all `what` that were announced: `end`, or the end of the file where that is empty.
    pub fn end_of(&mut self, what: &'static str, end: &'static str) -> At<()> {
        let name = if end.is_empty() { "the end of the file" } else { end };
        match self.next() {
            None if end.is_empty() => Ok(()),
            None => self.fault(TetrahedralFault::Ended(end)),
            Some(word) if word == end => Ok(()),
            Some(word) => self.fault(TetrahedralFault::Surplus { what, end: name, word: shown(word) }),
        }
    }

    /// Checks that the last word is still on the line `from`, where the row of `what` with this number began.
    pub fn same_row(&self, from: usize, what: &'static str, number: i64) -> At<()> {
        if self.line == from { Ok(()) } else { Err((from, TetrahedralFault::RowLength { what, number })) }
    }

    /// Passes over `count` words.
    pub fn skip(&mut self, count: usize, what: &'static str) -> At<()> {
        (0..count).try_for_each(|_| self.word(what).map(drop))
    }
}

/// A word of the file as it may be printed: short and without control characters.
pub(super) fn shown(word: &str) -> String {
    let short: String = word.chars().take(24).collect();
    let dots = if short.len() < word.len() { "…" } else { "" };
    format!("{}{dots}", short.escape_debug())
}

/// A mesh while it is read: vertices and cells by the numbers of the file.
#[derive(Default)]
pub(super) struct Reading {
    numbers: HashMap<i64, u32>,
    positions: Vec<Vec3>,
    cells: Vec<ReadCell>,
}

struct ReadCell {
    line: usize,
    number: i64,
    vertices: [i64; 4],
}

impl Reading {
    /// A vertex by its number in the file.
    pub fn vertex(&mut self, line: usize, number: i64, position: Vec3) -> At<()> {
        match self.numbers.insert(number, self.positions.len() as u32) {
            None => {
                self.positions.push(position);
                Ok(())
            }
            Some(_) => Err((line, TetrahedralFault::VertexTwice(number))),
        }
    }

    /// A cell by its number in the file; its vertices may be defined later.
    pub fn cell(&mut self, line: usize, number: i64, vertices: [i64; 4]) {
        self.cells.push(ReadCell { line, number, vertices });
    }

    /// The mesh: cells that are inside out are turned, since programs disagree about the order; vertices that no cell uses are
    /// left out. The order of the others is kept.
    pub fn finish(self, last: usize) -> At<TetrahedralMesh> {
        if self.positions.is_empty() {
            return Err((last, TetrahedralFault::Without("vertices")));
        }
        if self.cells.is_empty() {
            return Err((last, TetrahedralFault::Without("tetrahedra")));
        }
        let mut cells = Vec::with_capacity(self.cells.len());
        let mut used = vec![false; self.positions.len()];
        for read in &self.cells {
            let mut cell = [0u32; 4];
            for (k, (to, vertex)) in cell.iter_mut().zip(read.vertices).enumerate() {
                *to = *self.numbers.get(&vertex).ok_or_else(|| (read.line, self.unknown(read.number, vertex)))?;
                used[*to as usize] = true;
                if read.vertices[..k].contains(&vertex) {
                    return Err((read.line, TetrahedralFault::CornerTwice { cell: read.number, vertex }));
                }
            }
            let flat = TetrahedralFault::FlatCell { cell: read.number, vertices: read.vertices };
            let x = corners(&self.positions, &cell).ok_or((read.line, flat.clone()))?;
            let volume = cell_volume(x);
            if is_flat(x, volume) {
                return Err((read.line, flat));
            }
            if volume < 0.0 {
                cell.swap(2, 3);
            }
            cells.push(cell);
        }
        self.check_faces(&cells)?;
        let mut names = vec![0u32; used.len()];
        let mut positions = Vec::new();
        for ((name, &position), used) in names.iter_mut().zip(&self.positions).zip(used) {
            if used {
                *name = positions.len() as u32;
                positions.push(position);
            }
        }
        cells.iter_mut().flatten().for_each(|v| *v = names[*v as usize]);
        // All that this checks has been checked, with its line.
        TetrahedralMesh::new(positions, cells).map_err(|e| (last, TetrahedralFault::Unsupported(e.to_string())))
    }

    /// A cell names a vertex that there is not.
    fn unknown(&self, cell: i64, vertex: i64) -> TetrahedralFault {
        let first = self.numbers.keys().copied().min().unwrap_or_default();
        let last = self.numbers.keys().copied().max().unwrap_or_default();
        TetrahedralFault::UnknownVertex { cell, vertex, first, last }
    }

    /// Refuses a third cell at a face.
    fn check_faces(&self, cells: &[[u32; 4]]) -> At<()> {
        let mut faces: HashMap<[u32; 3], u32> = HashMap::with_capacity(2 * cells.len());
        for (cell, read) in cells.iter().zip(&self.cells) {
            for corners in CELL_FACES {
                let mut face = corners.map(|k| cell[k]);
                face.sort_unstable();
                let count = faces.entry(face).or_default();
                *count += 1;
                if *count > 2 {
                    return Err((read.line, TetrahedralFault::CrowdedFace { cell: read.number }));
                }
            }
        }
        Ok(())
    }
}
