//! What can be wrong with a mesh or its file, each fault with the place where it is.

use std::path::PathBuf;

/// Why a mesh cannot be built, read or written.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The mesh has no vertex.
    #[error("the mesh has no vertices")]
    NoVertices,
    /// The mesh has no triangle.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// More vertices or triangles than 32-bit indices can name.
    #[error("the mesh has {count} {what}, more than the {limit} that indices of 32 bits can name")]
    TooMany {
        /// `"vertices"` or `"triangles"`.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not finite: {position:?}")]
    NotFinite {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// Its position.
        position: [f32; 3],
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} uses vertex {index}, but there are only {vertices}, counted from 0")]
    IndexOutOfRange {
        /// Index of the triangle, from 0.
        triangle: usize,
        /// The index that it holds.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// The `welded` map names a vertex that does not exist.
    #[error("vertex {vertex} is welded to vertex {point}, but there are only {vertices}, counted from 0")]
    WeldOutOfRange {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// What it is welded to.
        point: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// An array given beside the mesh has another length than the mesh has vertices.
    #[error("{given} positions were given for a mesh of {expected} vertices")]
    LengthMismatch {
        /// Length given.
        given: usize,
        /// Length wanted.
        expected: usize,
    },
    /// The file does not exist.
    #[error("{}: there is no such file", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// The path names a folder or something else that is not a file.
    #[error("{}: this is not a file (a folder?); give the path of an OBJ file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file is larger than any mesh that could be used.
    #[error("{}: the file has {bytes} bytes, more than the {limit} that are read; decimate the mesh", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
        /// The largest size that is read.
        limit: u64,
    },
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file cannot be written; what was there before is still there.
    #[error("{}: cannot be written: {source}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A line of an OBJ file is wrong.
    #[error("{}:{line}: {fault}", path.display())]
    Obj {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        fault: ObjFault,
    },
}

/// What is wrong with one line of an OBJ file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ObjFault {
    /// The file holds nothing at all.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// No `v` statement.
    #[error("the file ends without a vertex; an OBJ file has lines like `v 0.5 1.0 2.0`")]
    NoVertices,
    /// No `f` statement.
    #[error("the file ends without a face; export the mesh with its faces (lines like `f 1 2 3`)")]
    NoFaces,
    /// All faces have fewer than three different points.
    #[error("the file ends and every face was degenerate (fewer than three different points); scale the mesh up?")]
    OnlyDegenerateFaces,
    /// The file is no OBJ text: its first unknown statement.
    #[error("`{0}` is no OBJ statement and the file has no faces; is this an OBJ file?")]
    NotObj(String),
    /// Too few numbers after `v`, `vt` or `vn`.
    #[error("`{statement}` needs {needed} numbers and has {found}")]
    TooFewNumbers {
        /// `v`, `vt` or `vn`.
        statement: &'static str,
        /// How many it needs.
        needed: usize,
        /// How many there are.
        found: usize,
    },
    /// A word that should be a number.
    #[error("`{0}` is not a number; write it like 1.25")]
    NotANumber(String),
    /// NaN, infinite, or too large for 32 bits.
    #[error("`{0}` is not a finite number; the exporter divided by zero somewhere, clean the mesh")]
    NotFinite(String),
    /// A face with one or two corners.
    #[error("a face needs at least 3 corners and this one has {0}")]
    TooFewCorners(usize),
    /// A face with so many corners that it cannot be triangulated in useful time.
    #[error("this face has {corners} corners, more than {limit}; triangulate the mesh when exporting it")]
    TooManyCorners {
        /// Number of corners.
        corners: usize,
        /// The most that are taken.
        limit: usize,
    },
    /// A corner that is not `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[error("`{0}` is not a face corner; write v, v/vt, v//vn or v/vt/vn with whole numbers")]
    BadCorner(String),
    /// An index 0.
    #[error("index 0 in `{0}`; OBJ counts from 1 (or from -1 backwards)")]
    ZeroIndex(String),
    /// An index beyond what the file defines.
    #[error("{what} {index} does not exist; the file has {available} of them")]
    IndexOutOfRange {
        /// `vertex`, `texture coordinate` or `normal`.
        what: &'static str,
        /// The index as written.
        index: i64,
        /// How many the file defines (for a negative index: how many up to this line).
        available: usize,
    },
    /// What tobj said about a file in which no fault was found line by line.
    #[error("the file cannot be parsed: {0}")]
    Parser(String),
}
