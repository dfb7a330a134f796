//! A film strip: moments of a run side by side in one picture, in one or more rows.

use image::RgbaImage;

/// Pixels between two moments.
const GAP: u32 = 4;

/// Moments of a run, evenly spread from its first frame to its last.
pub struct Strip {
    frames: Vec<usize>,
    columns: u32,
    picture: RgbaImage,
}

impl Strip {
    /// A strip of `count` moments out of `frames`, in so many `rows`, each of the given size in pixels; fewer where there are
    /// fewer frames.
    pub fn new(count: u32, rows: u32, frames: u64, size: [u32; 2]) -> Self {
        let count = u64::from(count).min(frames).max(1);
        let at = |k: u64| if count == 1 { 0 } else { (k * (frames - 1) + (count - 1) / 2) / (count - 1) };
        let columns = (count as u32).div_ceil(rows.max(1));
        let sides = [columns, (count as u32).div_ceil(columns)];
        let [width, height] = [0, 1].map(|k: usize| sides[k] * (size[k] + GAP) - GAP);
        let white = image::Rgba([255; 4]);
        Self {
            frames: (0..count).map(|k| at(k) as usize).collect(),
            columns,
            picture: RgbaImage::from_pixel(width, height, white),
        }
    }

    /// Whether a frame is one of the moments.
    pub fn wants(&self, frame: usize) -> bool {
        self.frames.contains(&frame)
    }

    /// Puts the picture of a frame in its place.
    pub fn add(&mut self, frame: usize, picture: &RgbaImage) {
        if let Some(place) = self.frames.iter().position(|&f| f == frame) {
            let (row, column) = (place as u32 / self.columns, place as u32 % self.columns);
            let [left, top] = [column * (picture.width() + GAP), row * (picture.height() + GAP)].map(i64::from);
            image::imageops::replace(&mut self.picture, picture, left, top);
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
        assert_eq!(Strip::new(4, 1, 100, [8, 8]).frames, [0, 33, 66, 99]);
        assert_eq!(Strip::new(8, 1, 3, [8, 8]).frames, [0, 1, 2], "no moment twice");
        assert_eq!(Strip::new(1, 1, 50, [8, 8]).frames, [0]);
    }

    #[test]
    fn each_picture_has_its_place() {
        let mut strip = Strip::new(3, 1, 3, [5, 2]);
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

    #[test]
    fn rows_are_filled_from_the_left() {
        let mut strip = Strip::new(3, 2, 3, [5, 2]);
        let colours = [10, 20, 30].map(|c| image::Rgba([c, c, c, 255]));
        (0..).zip(colours).for_each(|(frame, colour)| strip.add(frame, &RgbaImage::from_pixel(5, 2, colour)));
        assert_eq!(strip.picture().dimensions(), (2 * 5 + GAP, 2 * 2 + GAP));
        assert_eq!(strip.picture().get_pixel(5 + GAP, 1), &colours[1]);
        assert_eq!(strip.picture().get_pixel(1, 2 + GAP), &colours[2]);
        assert_eq!(strip.picture().get_pixel(5 + GAP, 2 + GAP).0, [255; 4], "there is no fourth");
    }
}
