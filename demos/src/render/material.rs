//! What a surface does with light.

use glam::Vec3;

/// Parameters of a surface; colours are linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Base colour.
    pub colour: Vec3,
    /// Opacity; below one, the item is blended over what is behind it.
    pub alpha: f32,
    /// Zero is a mirror, one is chalk.
    pub roughness: f32,
    /// One for metals.
    pub metallic: f32,
    /// Strength of a thin layer of varnish.
    pub clearcoat: f32,
    /// Strength of a soft rim as of short hair.
    pub sheen: f32,
    /// How far light creeps under the skin around the terminator.
    pub subsurface: f32,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            colour: Vec3::splat(0.5),
            alpha: 1.0,
            roughness: 0.5,
            metallic: 0.0,
            clearcoat: 0.0,
            sheen: 0.0,
            subsurface: 0.0,
        }
    }
}

impl Material {
    /// A plain material of the given colour.
    pub fn plain(colour: Vec3) -> Self {
        Self { colour, ..Self::default() }
    }

    /// Warm, sandy skin with a coat of short hair.
    pub fn skin() -> Self {
        Self { colour: Vec3::new(0.52, 0.345, 0.20), roughness: 0.58, sheen: 0.35, subsurface: 0.6, ..Self::default() }
    }

    /// Cool, neutral stone for obstacles.
    pub fn slate() -> Self {
        Self { colour: Vec3::new(0.23, 0.26, 0.31), roughness: 0.5, ..Self::default() }
    }

    /// Brushed metal for bars.
    pub fn steel() -> Self {
        Self { colour: Vec3::new(0.42, 0.45, 0.50), roughness: 0.34, metallic: 1.0, ..Self::default() }
    }

    /// A pane through which the inside of a tower is seen.
    pub fn glass() -> Self {
        Self { colour: Vec3::new(0.34, 0.44, 0.54), alpha: 0.07, roughness: 0.12, ..Self::default() }
    }

    /// Varnished, for balls and toys.
    pub fn glossy(colour: Vec3) -> Self {
        Self { colour, roughness: 0.4, clearcoat: 1.0, ..Self::default() }
    }

    /// The same material, see-through.
    pub fn with_alpha(self, alpha: f32) -> Self {
        Self { alpha, ..self }
    }
}
