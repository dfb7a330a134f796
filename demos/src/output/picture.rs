//! Pictures: one PNG for each frame.

use super::OutputError;
use super::error::at;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use pliant::mesh::AtomicFile;
use std::io;
use std::path::{Path, PathBuf};

/// The path of a frame's picture: `frame_0042.png` in `folder`.
pub fn picture_path(folder: impl AsRef<Path>, frame: usize) -> PathBuf {
    folder.as_ref().join(format!("frame_{frame:04}.png"))
}

/// Writes a picture of `size` (width, height) pixels to `path`. `rgba` has 4 bytes a pixel, row by row from the top left.
///
/// # Errors
/// Another number of bytes than pixels need, or a failed write; what was there before stays.
pub fn write_picture(path: PathBuf, size: [u32; 2], rgba: &[u8]) -> Result<(), OutputError> {
    let [width, height] = size;
    let expected = 4 * width as usize * height as usize;
    if rgba.len() != expected || expected == 0 {
        return Err(OutputError::Length { path, what: "bytes of a picture", given: rgba.len(), expected });
    }
    let mut file = AtomicFile::create(&path).map_err(at(&path))?;
    PngEncoder::new(&mut file)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .map_err(|e| match e {
            ImageError::IoError(e) => e,
            other => io::Error::other(other.to_string()),
        })
        .and_then(|()| file.finish())
        .map_err(at(&path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_reads_back_pixel_by_pixel() {
        let folder = tempfile::tempdir().unwrap();
        let rgba: Vec<u8> = (0..3 * 2 * 4).map(|k| k * 10).collect();
        let path = picture_path(folder.path(), 7);
        assert!(path.ends_with("frame_0007.png"));
        write_picture(path.clone(), [3, 2], &rgba).unwrap();
        let back = image::open(&path).unwrap().into_rgba8();
        assert_eq!((back.dimensions(), back.into_raw()), ((3, 2), rgba));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn wrong_sizes_and_missing_folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert!(matches!(write_picture(at("a.png"), [3, 2], &[0; 23]), Err(OutputError::Length { .. })));
        assert!(write_picture(at("a.png"), [0, 0], &[]).is_err());
        assert!(write_picture(at("none/a.png"), [1, 1], &[0; 4]).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
