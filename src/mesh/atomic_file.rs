//! A file that is there whole or not at all: written beside its place and renamed into it at the end.

use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A buffered writer to `name.tmp` beside the target; [`AtomicFile::finish`] renames it onto the target.
///
/// Dropped before that, or after a failure, it removes the temporary file and leaves the target as it was.
#[derive(Debug)]
pub struct AtomicFile {
    /// None once finished.
    writer: Option<BufWriter<File>>,
    beside: PathBuf,
    target: PathBuf,
    /// A write has failed: the file is not whole and must not take its place.
    failed: bool,
}

impl AtomicFile {
    /// Starts to write `target`. Its folder must exist.
    ///
    /// # Errors
    /// The temporary file cannot be created, or `target` is a folder.
    pub fn create(target: impl AsRef<Path>) -> io::Result<Self> {
        let target = target.as_ref().to_path_buf();
        if target.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "this is a folder"));
        }
        let Some(name) = target.file_name() else {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"));
        };
        let mut name = name.to_os_string();
        name.push(".tmp");
        let beside = target.with_file_name(name);
        let writer = Some(BufWriter::with_capacity(1 << 16, File::create(&beside)?));
        Ok(Self { writer, beside, target, failed: false })
    }

    /// Writes what is buffered and puts the file in its place.
    ///
    /// # Errors
    /// The last bytes or any before them cannot be written, or the file cannot be renamed; the target stays as it was.
    pub fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        if self.failed {
            return Err(io::Error::other("an earlier write to this file failed"));
        }
        self.writer = None;
        fs::rename(&self.beside, &self.target).inspect_err(|_| drop(fs::remove_file(&self.beside)))
    }

    fn tried<T>(&mut self, act: impl FnOnce(&mut BufWriter<File>) -> io::Result<T>) -> io::Result<T> {
        let writer = self.writer.as_mut().ok_or_else(|| io::Error::other("the file is finished"))?;
        act(writer).inspect_err(|e| self.failed |= e.kind() != io::ErrorKind::Interrupted)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.tried(|w| w.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.tried(|w| w.flush())
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.tried(|w| w.seek(position))
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some(writer) = self.writer.take() {
            // What is buffered is unwanted: the file goes away.
            drop(writer.into_parts());
            drop(fs::remove_file(&self.beside));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finished_file_replaces_the_old_one_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        file.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn an_abandoned_file_leaves_what_was_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        AtomicFile::create(&path).unwrap().write_all(b"half").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn after_a_failed_write_the_file_does_not_take_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        assert!(file.seek(SeekFrom::Current(-1)).is_err());
        assert!(file.finish().is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_and_a_missing_folder_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(AtomicFile::create(folder.path()).is_err());
        assert!(AtomicFile::create(folder.path().join("none/a.txt")).is_err());
    }
}
