//! Point caches (PC2): the positions of a body's vertices in every frame, as Blender and others read them.
//!
//! A header of 32 bytes (`POINTCACHE2\0`, version 1, points, first frame, frames a sample, samples) is followed by x, y
//! and z of each point of each sample, all little endian and of 32 bits.

use super::OutputError;
use super::error::at;
use pliant::math::Vec3;
use pliant::mesh::AtomicFile;
use std::fs;
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 12] = b"POINTCACHE2\0";
const HEADER: usize = 32;
/// Where the number of samples stands in the header.
const SAMPLES_AT: u64 = 28;

/// Writes a cache frame by frame.
#[derive(Debug)]
pub struct Pc2Writer {
    file: AtomicFile,
    path: PathBuf,
    points: usize,
    samples: usize,
    bytes: Vec<u8>,
}

impl Pc2Writer {
    /// Begins a cache of `points` vertices a frame, the first at `start_frame`, each `sample_rate` frames after the one
    /// before (1 for every frame).
    ///
    /// # Errors
    /// More points than the format counts, or a file that cannot be created.
    pub fn create(
        path: impl AsRef<Path>,
        points: usize,
        start_frame: f32,
        sample_rate: f32,
    ) -> Result<Self, OutputError> {
        let path = path.as_ref().to_path_buf();
        let count = counted(&path, "points", points)?;
        let mut file = AtomicFile::create(&path).map_err(at(&path))?;
        let mut header = MAGIC.to_vec();
        header.extend(1i32.to_le_bytes());
        header.extend(count.to_le_bytes());
        header.extend(start_frame.to_le_bytes());
        header.extend(sample_rate.to_le_bytes());
        header.extend(0i32.to_le_bytes());
        file.write_all(&header).map_err(at(&path))?;
        Ok(Self { file, path, points, samples: 0, bytes: Vec::new() })
    }

    /// Appends the positions of one frame.
    ///
    /// # Errors
    /// Another number of positions than the cache was begun with, or a failed write.
    pub fn write_frame(&mut self, positions: &[Vec3]) -> Result<(), OutputError> {
        if positions.len() != self.points {
            let (path, what) = (self.path.clone(), "positions");
            return Err(OutputError::Length { path, what, given: positions.len(), expected: self.points });
        }
        counted(&self.path, "frames", self.samples + 1)?;
        self.bytes.clear();
        for p in positions {
            p.to_array().iter().for_each(|c| self.bytes.extend(c.to_le_bytes()));
        }
        self.file.write_all(&self.bytes).map_err(at(&self.path))?;
        self.samples += 1;
        Ok(())
    }

    /// Writes the number of frames into the header and puts the file in its place.
    ///
    /// # Errors
    /// A failed write; what was there before stays.
    pub fn finish(mut self) -> Result<(), OutputError> {
        let samples = counted(&self.path, "frames", self.samples)?;
        let path = self.path;
        self.file.seek(SeekFrom::Start(SAMPLES_AT)).map_err(at(&path))?;
        self.file.write_all(&samples.to_le_bytes()).map_err(at(&path))?;
        self.file.finish().map_err(at(&path))
    }
}

fn counted(path: &Path, what: &'static str, count: usize) -> Result<i32, OutputError> {
    i32::try_from(count).map_err(|_| OutputError::TooMany { path: path.into(), what, count })
}

/// A cache that was read back.
#[derive(Clone, Debug, PartialEq)]
pub struct Pc2 {
    /// Frame of the first sample.
    pub start_frame: f32,
    /// Frames from one sample to the next.
    pub sample_rate: f32,
    /// Positions of each sample, all of one length.
    pub frames: Vec<Vec<Vec3>>,
}

/// Reads a whole cache.
///
/// # Errors
/// A file that cannot be read, is no point cache of version 1, or has another length than its header says.
pub fn read_pc2(path: impl AsRef<Path>) -> Result<Pc2, OutputError> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(at(path))?;
    let no = |why: String| OutputError::NotACache { path: path.into(), why };
    if bytes.len() < HEADER || &bytes[..12] != MAGIC {
        return Err(no("it does not begin with a header".into()));
    }
    let words: Vec<[u8; 4]> = bytes[12..].as_chunks().0.to_vec();
    let [version, points, samples] = [0, 1, 4].map(|k| i32::from_le_bytes(words[k]));
    let [start_frame, sample_rate] = [2, 3].map(|k| f32::from_le_bytes(words[k]));
    if version != 1 || points < 0 || samples < 0 {
        return Err(no(format!("version {version}, {points} points, {samples} samples")));
    }
    let expected = HEADER as u128 + 12 * points as u128 * samples as u128;
    if bytes.len() as u128 != expected {
        return Err(no(format!("{} bytes instead of {expected}", bytes.len())));
    }
    let coordinates: Vec<f32> = words[5..].iter().map(|w| f32::from_le_bytes(*w)).collect();
    let positions: Vec<Vec3> = coordinates.as_chunks().0.iter().map(|&p: &[f32; 3]| Vec3::from(p)).collect();
    let frames = match points {
        0 => vec![Vec::new(); samples as usize],
        n => positions.chunks(n as usize).map(<[Vec3]>::to_vec).collect(),
    };
    Ok(Pc2 { start_frame, sample_rate, frames })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_read_back_with_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pc2");
        let frames = vec![vec![Vec3::new(0.1, -2.0, 3e-8), Vec3::ONE], vec![Vec3::ZERO, Vec3::MAX], vec![Vec3::X; 2]];
        let mut cache = Pc2Writer::create(&path, 2, 0.0, 1.0).unwrap();
        frames.iter().for_each(|f| cache.write_frame(f).unwrap());
        assert!(!path.exists());
        cache.finish().unwrap();
        assert_eq!(read_pc2(&path).unwrap(), Pc2 { start_frame: 0.0, sample_rate: 1.0, frames });
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_header_is_what_the_format_says() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pc2");
        let mut cache = Pc2Writer::create(&path, 1, 5.0, 2.0).unwrap();
        cache.write_frame(&[Vec3::new(1.0, 2.0, 3.0)]).unwrap();
        cache.finish().unwrap();
        let mut expected = b"POINTCACHE2\0".to_vec();
        expected.extend([1, 0, 0, 0, 1, 0, 0, 0]);
        expected.extend([5.0f32, 2.0].iter().flat_map(|f| f.to_le_bytes()));
        expected.extend([1, 0, 0, 0]);
        expected.extend([1.0f32, 2.0, 3.0].iter().flat_map(|f| f.to_le_bytes()));
        assert_eq!(fs::read(&path).unwrap(), expected);
    }

    #[test]
    fn a_frame_of_another_length_is_refused_and_an_unfinished_cache_leaves_the_old_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pc2");
        fs::write(&path, "old").unwrap();
        let mut cache = Pc2Writer::create(&path, 2, 0.0, 1.0).unwrap();
        let error = cache.write_frame(&[Vec3::ZERO]).unwrap_err().to_string();
        assert!(error.contains("1 positions were given and 2 are needed"), "{error}");
        drop(cache);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert!(matches!(Pc2Writer::create(&path, 1 << 31, 0.0, 1.0), Err(OutputError::TooMany { .. })));
    }

    #[test]
    fn files_that_are_no_whole_cache_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.pc2");
        let mut cache = Pc2Writer::create(&path, 2, 0.0, 1.0).unwrap();
        cache.write_frame(&[Vec3::ZERO; 2]).unwrap();
        cache.finish().unwrap();
        let whole = fs::read(&path).unwrap();
        for bad in [&whole[..whole.len() - 1], &whole[..20], &[0; 100][..], &[]] {
            fs::write(&path, bad).unwrap();
            assert!(matches!(read_pc2(&path), Err(OutputError::NotACache { .. })));
        }
        assert!(read_pc2(folder.path().join("none.pc2")).is_err());
    }
}
