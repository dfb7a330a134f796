//! Random numbers that are the same for the same seed, everywhere.

use glam::Vec3;

/// SplitMix64.
pub(crate) struct Random(pub u64);

impl Random {
    /// A number in [-1, 1).
    pub fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    }

    /// Three such numbers.
    pub fn point(&mut self) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| self.next()))
    }
}
