//! A film strip: moments of a run side by side in one picture.

use image::RgbaImage;

/// Pixels between two moments.
const GAP: u32 = 4;

/// Moments of a run, evenly spread from its first frame to its last.
pub struct Strip {
    frames: Vec<usize>,
    picture: RgbaImage,
}

impl Strip {
    /// A strip of `count` moments out of `frames`, each of the given size in pixels; fewer where there are fewer frames.
    pub fn new(count: u32, frames: u64, size: [u32; 2]) -> Self {
        let count = u64::from(count).min(frames).max(1);
        let at = |k: u64| if count == 1 { 0 } else { (k * (frames - 1) + (count - 1) / 2) / (count - 1) };
        let width = count as u32 * (size[0] + GAP) - GAP;
        let white = image::Rgba([255; 4]);
        Self {
            frames: (0..count).map(|k| at(k) as usize).collect(),
            picture: RgbaImage::from_pixel(width, size[1], white),
        }
    }

    /// Whether a frame is one of the moments.
    pub fn wants(&self, frame: usize) -> bool {
        self.frames.contains(&frame)
    }

    /// Puts the picture of a frame in its place.
    pub fn add(&mut self, frame: usize, picture: &RgbaImage) {
        if let Some(place) = self.frames.iter().position(|&f| f == frame) {
            let left = place as i64 * i64::from(picture.width() + GAP);
            image::imageops::replace(&mut self.picture, picture, left, 0);
        }
    }

    /// The strip as far as it has come.
    pub fn picture(&self) -> &RgbaImage {
        &self.picture
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moments_go_from_the_first_frame_to_the_last_at_even_distances() {
        assert_eq!(Strip::new(4, 100, [8, 8]).frames, [0, 33, 66, 99]);
        assert_eq!(Strip::new(8, 3, [8, 8]).frames, [0, 1, 2], "no moment twice");
        assert_eq!(Strip::new(1, 50, [8, 8]).frames, [0]);
    }

    #[test]
    fn each_picture_has_its_place() {
        let mut strip = Strip::new(3, 3, [5, 2]);
        let colours = [10, 20, 30].map(|c| image::Rgba([c, c, c, 255]));
        for (frame, colour) in colours.into_iter().enumerate() {
            assert!(strip.wants(frame));
            strip.add(frame, &RgbaImage::from_pixel(5, 2, colour));
        }
        strip.add(7, &RgbaImage::new(5, 2));
        let picture = strip.picture();
        assert_eq!(picture.dimensions(), (3 * 5 + 2 * GAP, 2));
        for (k, colour) in colours.into_iter().enumerate() {
            assert_eq!(*picture.get_pixel(k as u32 * (5 + GAP) + 2, 1), colour);
        }
        assert_eq!(picture.get_pixel(5, 0).0, [255; 4], "white between");
    }
}
