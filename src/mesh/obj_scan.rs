//! A validating pass over the text of an OBJ file: every fault with its line, and a plain text for the parser.
//!
//! The parser behind it reports no line numbers, trips over comments at the end of a line and over continued lines, and
//! starts a new mesh at every object or material. So this pass hands it only the `v`, `vt`, `vn` and `f` statements,
//! one a line, already known to be right.

use super::ObjFault;
use super::polygon::MAX_CORNERS;
use std::fmt::Write;

/// Checks `text` and returns the statements of its one mesh, or the line at fault (from 1).
pub(super) fn scan(text: &str) -> Result<String, (usize, ObjFault)> {
    let mut scan = Scan { plain: String::with_capacity(text.len()), ..Scan::default() };
    let mut lines = text.lines().enumerate();
    let mut last = 1;
    while let Some((index, line)) = lines.next() {
        last = index + 1;
        let line = without_comment(line);
        if let Some(start) = line.trim_end().strip_suffix('\\') {
            let mut whole = format!("{start} ");
            for (_, more) in lines.by_ref() {
                let more = without_comment(more).trim_end();
                whole.push_str(more.strip_suffix('\\').unwrap_or(more));
                whole.push(' ');
                if !more.ends_with('\\') {
                    break;
                }
            }
            scan.statement(index + 1, &whole).map_err(|fault| (index + 1, fault))?;
        } else {
            scan.statement(index + 1, line).map_err(|fault| (index + 1, fault))?;
        }
    }
    if text.trim().is_empty() {
        return Err((1, ObjFault::Empty));
    }
    if scan.faces == 0 {
        return Err(match scan.unknown {
            Some((line, word)) => (line, ObjFault::NotObj(word)),
            None if scan.defined[0] == 0 => (last, ObjFault::NoVertices),
            None => (last, ObjFault::NoFaces),
        });
    }
    scan.check_forward()?;
    Ok(scan.plain)
}

/// What an index of a face names, in the order in which they stand.
const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

#[derive(Default)]
struct Scan {
    plain: String,
    /// Vertices, texture coordinates and normals so far.
    defined: [usize; 3],
    faces: usize,
    /// Indices beyond what was defined when they were read: line, kind, index. They may be defined later.
    forward: Vec<(usize, usize, i64)>,
    unknown: Option<(usize, String)>,
}

impl Scan {
    fn statement(&mut self, line: usize, text: &str) -> Result<(), ObjFault> {
        let mut words = text.split_whitespace();
        match words.next() {
            Some("v") => self.numbers("v", 0, 3, 3, words),
            Some("vt") => self.numbers("vt", 1, 1, 2, words),
            Some("vn") => self.numbers("vn", 2, 3, 3, words),
            Some("f" | "fo") => self.face(line, words),
            Some(
                "vp" | "p" | "l" | "o" | "g" | "s" | "mg" | "usemtl" | "mtllib" | "usemap" | "maplib" | "cstype"
                | "deg" | "bmat" | "step" | "curv" | "curv2" | "surf" | "parm" | "trim" | "hole" | "scrv" | "sp"
                | "end" | "con" | "bevel" | "c_interp" | "d_interp" | "lod" | "shadow_obj" | "trace_obj" | "ctech"
                | "stech",
            )
            | None => Ok(()),
            Some(word) => {
                self.unknown.get_or_insert_with(|| (line, shown(word)));
                Ok(())
            }
        }
    }

    /// One `v`, `vt` or `vn` with at least `needed` numbers; `kept` of them go on to the parser, missing ones as 0.
    fn numbers<'a>(
        &mut self,
        statement: &'static str,
        kind: usize,
        needed: usize,
        kept: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ObjFault> {
        let mut values = [0.0f32; 3];
        let mut found = 0;
        for word in words {
            let value: f32 = word.parse().map_err(|_| ObjFault::NotANumber(shown(word)))?;
            if !value.is_finite() {
                return Err(ObjFault::NotFinite(shown(word)));
            }
            if found < kept {
                values[found] = value;
            }
            found += 1;
        }
        if found < needed {
            return Err(ObjFault::TooFewNumbers { statement, needed, found });
        }
        self.defined[kind] += 1;
        self.plain.push_str(statement);
        for value in &values[..kept] {
            // Writing to a string cannot fail.
            let _ = write!(self.plain, " {value}");
        }
        self.plain.push('\n');
        Ok(())
    }

    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        self.plain.push('f');
        let mut corners = 0;
        for word in words {
            self.corner(line, word)?;
            self.plain.push(' ');
            self.plain.push_str(word);
            corners += 1;
        }
        self.plain.push('\n');
        self.faces += 1;
        match corners {
            0..3 => Err(ObjFault::TooFewCorners(corners)),
            3..=MAX_CORNERS => Ok(()),
            _ => Err(ObjFault::TooManyCorners { corners, limit: MAX_CORNERS }),
        }
    }

    fn corner(&mut self, line: usize, word: &str) -> Result<(), ObjFault> {
        let bad = || ObjFault::BadCorner(shown(word));
        for (kind, part) in word.split('/').enumerate() {
            if kind > 2 {
                return Err(bad());
            }
            if part.is_empty() && kind > 0 {
                continue;
            }
            let index: i64 = part.parse().map_err(|_| bad())?;
            let available = self.defined[kind];
            if index == 0 {
                return Err(ObjFault::ZeroIndex(shown(word)));
            }
            if index < 0 && index.unsigned_abs() > available as u64 {
                return Err(ObjFault::IndexOutOfRange { what: KINDS[kind], index, available });
            }
            if index > available as i64 {
                self.forward.push((line, kind, index));
            }
        }
        Ok(())
    }

    /// Indices that ran ahead of their definitions must be defined by the end of the file.
    fn check_forward(&self) -> Result<(), (usize, ObjFault)> {
        for &(line, kind, index) in &self.forward {
            let available = self.defined[kind];
            if index > available as i64 {
                return Err((line, ObjFault::IndexOutOfRange { what: KINDS[kind], index, available }));
            }
        }
        Ok(())
    }
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or(line)
}

/// A word of the file as it may be printed: short and without control characters.
fn shown(word: &str) -> String {
    let short: String = word.chars().take(24).collect();
    let dots = if short.len() < word.len() { "…" } else { "" };
    format!("{}{dots}", short.escape_debug())
}
