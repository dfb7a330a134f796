//! The fields of bodies that move by themselves as colours, after the figures of the ProcDef paper.

use glam::Vec3;
use pliant::procdef::excitation_colour;

use crate::render::Paint;
use crate::simulation::SoftKind;

/// What is painted on bodies that move by themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Field {
    /// The material alone.
    Plain,
    /// Contraction in red, expansion in light blue.
    #[default]
    Excitation,
    /// Layers: outermost blue, innermost red.
    Layers,
    /// Primary directions as red lines, secondary ones green, tertiary ones blue.
    Directions,
    /// Phase shifts: the source of signals black, the sink green.
    Phase,
    /// Amplitudes: 1 red, 0 black, -1 blue.
    Amplitude,
}

impl Field {
    /// All of them, with their names in the panel.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Plain, "material"),
        (Self::Excitation, "excitation"),
        (Self::Layers, "layers"),
        (Self::Directions, "directions"),
        (Self::Phase, "phase"),
        (Self::Amplitude, "amplitude"),
    ];

    /// The value at each vertex of the cells; none where there is nothing to paint.
    pub fn values<'a>(self, kind: &'a SoftKind, excitations: &'a [f32]) -> Option<&'a [f32]> {
        let fields = kind.model.motion.fields();
        match self {
            Self::Plain | Self::Directions => None,
            Self::Excitation => Some(excitations),
            Self::Layers => kind.layers.as_deref(),
            Self::Phase => Some(&fields.phase),
            Self::Amplitude => Some(&fields.amplitude),
        }
    }

    /// The paint of a value.
    pub fn paint(self, value: f32) -> Paint {
        const OPAQUE: f32 = 0.94;
        const BLUE: Vec3 = Vec3::new(0.02, 0.10, 0.75);
        const RED: Vec3 = Vec3::new(0.80, 0.03, 0.02);
        const PALE: Vec3 = Vec3::new(0.80, 0.80, 0.76);
        const BLACK: Vec3 = Vec3::splat(0.012);
        let ramp = |from: Vec3, to: Vec3, share: f32| Paint::new(from.lerp(to, share.clamp(0.0, 1.0)), OPAQUE);
        match self {
            Self::Plain | Self::Directions => Paint::default(),
            Self::Excitation => {
                // The blend with the material is the opacity; the root makes faint excitations visible. In full light the
                // colours would be pale.
                let full = 0.6 * Vec3::from(excitation_colour(value.signum(), [0.0; 3]));
                Paint::new(full, 0.94 * value.abs().min(1.0).powf(0.5))
            }
            Self::Layers if value < 0.5 => ramp(BLUE, PALE, 2.0 * value),
            Self::Layers => ramp(PALE, RED, 2.0 * value - 1.0),
            Self::Phase => ramp(BLACK, Vec3::new(0.05, 0.70, 0.12), value),
            Self::Amplitude if value < 0.0 => ramp(BLACK, BLUE, -value),
            Self::Amplitude => ramp(BLACK, RED, value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(field: Field, value: f32) -> [f32; 4] {
        field.paint(value).0.to_le_bytes().map(|byte| f32::from(byte) / 255.0)
    }

    #[test]
    fn contraction_is_red_expansion_light_blue_and_rest_the_material() {
        let [red, rest, blue] = [-1.0, 0.0, 1.0].map(|value| parts(Field::Excitation, value));
        assert!(red[0] > 2.0 * red[2] && red[3] > 0.9);
        assert!(blue[2] > blue[0] && blue[1] > blue[0] && blue[3] > 0.9);
        assert_eq!(rest[3], 0.0);
    }

    #[test]
    fn layers_phases_and_amplitudes_have_the_colours_of_the_paper() {
        let [outer, inner] = [0.0, 1.0].map(|value| parts(Field::Layers, value));
        assert!(outer[2] > 2.0 * outer[0] && inner[0] > 2.0 * inner[2]);
        let [source, sink] = [0.0, 1.0].map(|value| parts(Field::Phase, value));
        assert!(source[..3].iter().all(|c| *c < 0.2) && sink[1] > 2.0 * sink[0]);
        let [less, none, more] = [-1.0, 0.0, 1.0].map(|value| parts(Field::Amplitude, value));
        assert!(less[2] > 2.0 * less[0] && more[0] > 2.0 * more[2] && none[..3].iter().all(|c| *c < 0.2));
    }
}
