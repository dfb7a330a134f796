//! Colour painted over the material of single vertices.

use glam::Vec3;

/// A colour and how much of the material it covers, in four bytes. The default covers nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Paint(pub u32);

impl Paint {
    /// A linear colour over `opacity`, 0 to 1, of the material. Roots of the colour's parts are stored: dark ones keep
    /// their steps.
    pub fn new(colour: Vec3, opacity: f32) -> Self {
        let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let [r, g, b] = colour.to_array().map(|c| byte(c.max(0.0).sqrt()));
        Self(u32::from_le_bytes([r, g, b, byte(opacity)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paint_is_stored_within_half_a_step_and_nothing_is_no_paint() {
        assert_eq!(Paint::new(Vec3::ZERO, 0.0), Paint::default());
        for value in [0.003, 0.1, 0.5, 1.0] {
            let [r, _, _, a] = Paint::new(Vec3::splat(value), 0.4).0.to_le_bytes().map(|b| f32::from(b) / 255.0);
            assert!((r - value.sqrt()).abs() < 0.002 && (a - 0.4).abs() < 0.002);
        }
        assert_eq!(Paint::new(Vec3::splat(f32::NAN), f32::NAN), Paint::default(), "what is no number is no paint");
    }
}
