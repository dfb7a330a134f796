//! What can be wrong with a tetrahedral mesh or its file, each fault with the place where it is.

use std::path::PathBuf;

/// Why a tetrahedral mesh cannot be built, read, written or filled into a surface.
#[derive(Debug, thiserror::Error)]
pub enum TetrahedralError {
    /// The mesh has no vertex.
    #[error("the mesh has no vertices")]
    NoVertices,
    /// The mesh has no cell.
    #[error("the mesh has no tetrahedra")]
    NoCells,
    /// More vertices or cells than 32-bit indices can name.
    #[error("the mesh has {count} {what}, more than the {limit} that indices of 32 bits can name")]
    TooMany {
        /// `"vertices"` or `"tetrahedra"`.
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
    /// A cell names a vertex that does not exist.
    #[error("cell {cell} uses vertex {index}, but there are only {vertices}, counted from 0")]
    IndexOutOfRange {
        /// Index of the cell, from 0.
        cell: usize,
        /// The index that it holds.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A cell without volume, or one that is inside out.
    #[error("cell {cell} has the volume {volume:e}; its four vertices must span a positive one")]
    BadVolume {
        /// Index of the cell, from 0.
        cell: usize,
        /// Its signed volume in cubic metres.
        volume: f64,
    },
    /// A vertex that belongs to no cell.
    #[error("vertex {vertex} belongs to no cell; remove it")]
    UnusedVertex {
        /// Index of the vertex, from 0.
        vertex: usize,
    },
    /// A face with more than two cells: the cells overlap.
    #[error("the face {face:?} belongs to more than two cells, the last of them cell {cell}")]
    CrowdedFace {
        /// Index of one of the cells, from 0.
        cell: usize,
        /// The vertices of the face.
        face: [u32; 3],
    },
    /// An array given beside the mesh has another length than the mesh has vertices.
    #[error("{given} values were given for a mesh of {expected} vertices")]
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
    #[error("{}: this is not a file (a folder?)", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The name's ending tells no format that is read here.
    #[error("{}: the ending names no tetrahedral format; give .mesh, .node, .ele or .msh", path.display())]
    UnknownFormat {
        /// The path.
        path: PathBuf,
    },
    /// The file is larger than any mesh that could be used.
    #[error("{}: the file has {bytes} bytes, more than the {limit} that are read", path.display())]
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
    /// A line of a file is wrong.
    #[error("{}:{line}: {fault}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        fault: TetrahedralFault,
    },
    /// The surface to be filled is not closed or not turned outward.
    #[error("the surface cannot be filled: {0}")]
    Surface(&'static str),
    /// The surface is filled by so many cells, or so few, that the size of a cell must be a mistake.
    #[error("cells of {cell_size} m would be {cells} in number; choose another size of the cells")]
    CellSize {
        /// The size asked for, in metres.
        cell_size: f32,
        /// About how many cells that makes.
        cells: f64,
    },
    /// The cells do not follow the surface that they fill.
    #[error(
        "cells of {cell_size} m are up to {distance} m away from the surface, {percent} % of its size, where 2 % are allowed; \
         choose smaller cells"
    )]
    NotFollowed {
        /// The size of the cells, in metres.
        cell_size: f32,
        /// The Hausdorff distance that was reached, in metres.
        distance: f32,
        /// The same in hundredths of the surface's size.
        percent: f32,
    },
}

/// What is wrong with one line of a tetrahedral file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TetrahedralFault {
    /// The file ends within something.
    #[error("the file ends where {0} was expected")]
    Ended(&'static str),
    /// A word that should be a number.
    #[error("`{word}` is not {what}")]
    NotANumber {
        /// What was expected.
        what: &'static str,
        /// The word.
        word: String,
    },
    /// A word that should be a count.
    #[error("`{word}` is not a number of {what}")]
    NotACount {
        /// What is counted.
        what: &'static str,
        /// The word.
        word: String,
    },
    /// A row that does not end with its line.
    #[error("the row of {what} {number} has another length than the first line announces")]
    RowLength {
        /// `"vertex"` or `"cell"`.
        what: &'static str,
        /// Its number in the file.
        number: i64,
    },
    /// More of something than was announced.
    #[error("`{word}` stands where {end} was expected: there are more {what} than the file announces")]
    Surplus {
        /// What there is more of.
        what: &'static str,
        /// What should come.
        end: &'static str,
        /// The word.
        word: String,
    },
    /// Fewer or more of something than was announced.
    #[error("there are {given} {what}, the file announces {announced}")]
    WrongCount {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        given: usize,
        /// How many there should be.
        announced: usize,
    },
    /// NaN, infinite, or too large for 32 bits.
    #[error("vertex {vertex} has a coordinate that is not finite: `{word}`")]
    NotFinite {
        /// The vertex as the file names it.
        vertex: i64,
        /// The word.
        word: String,
    },
    /// A count that is negative or greater than the file could hold.
    #[error("{count} {what} cannot be in a file of this length")]
    BadCount {
        /// What is counted.
        what: &'static str,
        /// The count.
        count: i64,
    },
    /// A cell names a vertex that the file does not define.
    #[error("cell {cell} uses vertex {vertex}, which the file does not define: its vertices are {first} to {last}")]
    UnknownVertex {
        /// The cell as the file names it.
        cell: i64,
        /// The vertex as the file names it.
        vertex: i64,
        /// The first number that a vertex of the file has.
        first: i64,
        /// The last one.
        last: i64,
    },
    /// A cell names a vertex twice.
    #[error("cell {cell} uses vertex {vertex} twice")]
    CornerTwice {
        /// The cell as the file names it.
        cell: i64,
        /// The vertex as the file names it.
        vertex: i64,
    },
    /// A vertex is defined twice.
    #[error("vertex {0} is defined twice")]
    VertexTwice(i64),
    /// A cell without volume.
    #[error("cell {cell} has no volume: its vertices {vertices:?} lie in a plane")]
    FlatCell {
        /// The cell as the file names it.
        cell: i64,
        /// Its vertices as the file names them.
        vertices: [i64; 4],
    },
    /// A face with more than two cells.
    #[error("cell {cell} is the third one at a face: cells overlap")]
    CrowdedFace {
        /// The cell as the file names it.
        cell: i64,
    },
    /// The file has no section of that kind.
    #[error("the file ends without {0}")]
    Without(&'static str),
    /// Something that these readers do not know.
    #[error("{0}")]
    Unsupported(String),
}
