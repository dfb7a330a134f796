//! Why an output file is not there.

use pliant::mesh::MeshError;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file cannot be written or read back.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The system refused; what was there before is still there.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A frame, a picture or a body of another size than the file was begun with.
    #[error("{}: {given} {what} were given and {expected} are needed", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// What was counted.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are needed.
        expected: usize,
    },
    /// More than the file format can count.
    #[error("{}: {count} {what} are more than the format can count", path.display())]
    TooMany {
        /// The file.
        path: PathBuf,
        /// What was counted.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// A cache that is read back is none, or is cut off.
    #[error("{}: this is no point cache: {why}", path.display())]
    NotACache {
        /// The file.
        path: PathBuf,
        /// In what way.
        why: String,
    },
    /// A surface cannot be written.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// Gives an error of the system the path it is about.
pub(super) fn at(path: &Path) -> impl Fn(io::Error) -> OutputError {
    let path = path.to_path_buf();
    move |source| OutputError::Io { path: path.clone(), source }
}
