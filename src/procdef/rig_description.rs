//! What a rig file of a body that moves by itself says, key by key. Written and read by serde; meaning and ranges are
//! checked where it is built.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A rig: all keys of the file. Lengths in metres, in the frame of the mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigDescription {
    /// The mesh: tetrahedra, or a closed surface in an OBJ file that is filled with them. Relative to the rig file.
    pub mesh: PathBuf,
    /// Edge length of the cells that a surface is filled with; without it the largest that follow the surface within 2 % of its
    /// size ([`crate::mesh::fill_closely`]).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell_size: Option<f32>,
    /// A detailed surface that is drawn in the place of the boundary; an OBJ file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin: Option<PathBuf>,
    /// Mass of the body in kg; instead of `density`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f32>,
    /// Density in kg/m³; instead of `mass`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<f32>,
    /// Iterations N of shape matching a step, 1 to 64; 2 without it and without `stiffness`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iterations: Option<u32>,
    /// Stiffness of the global solve, from 0 to 1; instead of `iterations`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f32>,
    /// Damping of what is not rigid motion, in 1/s: after a second `exp(-damping)` of it is left. 5 without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f32>,
    /// Whether the volume of the cells is kept; false without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keep_volume: Option<bool>,
    /// The part of its volume below which no cell comes by the body's own motion, 0 to 1; 0 without: cells are not looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_volume: Option<f32>,
    /// Colour of the body, linear RGB from 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<[f32; 3]>,
    /// The cycle that repeats by itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub charts: Option<ChartsDescription>,
    /// The answer to touches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stimulus: Option<StimulusDescription>,
    /// What touches do to the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactDescription>,
    /// What water does to the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub water: Option<WaterDescription>,
    /// Friction that differs along and against a direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundDescription>,
    /// Painted layers, 0 outermost to 1 innermost.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub layer: Vec<PaintDescription>,
    /// Strokes along the primary direction.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub direction: Vec<StrokeDescription>,
    /// Painted amplitudes, -1 to 1; 1 everywhere without.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub amplitude: Vec<PaintDescription>,
    /// Painted phase shifts, 0 to 1; 0 everywhere without.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub phase: Vec<PaintDescription>,
    /// Rigid things that the body holds or is held by.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attachment: Vec<AttachmentDescription>,
}

/// A painted value: one of `face`, `region`, `stroke` and `section`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaintDescription {
    /// The value.
    pub value: f32,
    /// A triangle of the boundary, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<u32>,
    /// A near-flat region of the boundary.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<RegionDescription>,
    /// A line on the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stroke: Option<Vec<[f32; 3]>>,
    /// A cross-section, or a line on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<SectionDescription>,
}

/// A near-flat region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RegionDescription {
    /// A point of it.
    pub seed: [f32; 3],
    /// Largest angle between the normals of neighbouring triangles, in degrees.
    pub angle_degrees: f32,
}

/// A cross-section.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectionDescription {
    /// A point of the plane.
    pub origin: [f32; 3],
    /// Normal of the plane.
    pub normal: [f32; 3],
    /// A line on the cross-section; all of it without.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stroke: Vec<[f32; 3]>,
}

/// A stroke along the primary direction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrokeDescription {
    /// The layer that it is moved onto.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer: Option<f32>,
    /// Its points.
    pub stroke: Vec<[f32; 3]>,
}

/// Three charts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartsDescription {
    /// Length of the cycle in seconds.
    pub cycle: f32,
    /// Largest rate A, above 1; 2 without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f32>,
    /// `"free"`, `"both"` (without it) or `"secondary"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<String>,
    /// `"linear"` (without it) or `"smooth"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
    /// Propagation speed v: phase shift 1 comes 1/v seconds later. Needed with painted phases; not for stimuli.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<f32>,
    /// Seconds in which the cycle of a new body grows smoothly from nothing; 0 without. Not for stimuli.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rise: Option<f32>,
    /// Control points `[phase, rate]`.
    pub primary: Vec<[f32; 2]>,
    /// The same of the secondary chart; only where `volume` is `"free"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub secondary: Option<Vec<[f32; 2]>>,
    /// The same of the tertiary chart; only where `volume` is `"free"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tertiary: Option<Vec<[f32; 2]>>,
}

/// The answer to touches.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StimulusDescription {
    /// Lengths of the body a second.
    pub speed: f32,
    /// The amplitude falls to 1/D over one length of the body; at least 1.
    pub damping: f32,
    /// Least impulse of a contact that is felt, in N s; 0.05 without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f32>,
    /// Seconds of rest after an answer; 0.5 without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refractory: Option<f32>,
    /// The charts of the answer; those of the cycle without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub charts: Option<ChartsDescription>,
}

/// What touches do to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactDescription {
    /// Coulomb coefficient.
    pub friction: f32,
    /// Whether the body touches itself.
    #[serde(default, skip_serializing_if = "is_false")]
    pub self_contact: bool,
    /// Whether its contacts are those of its vertices, made for crowds, instead of rapier's between surfaces.
    #[serde(default, skip_serializing_if = "is_false")]
    pub vertices: bool,
}

/// What water does to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaterDescription {
    /// Density of the water in kg/m³.
    pub density: f32,
    /// Drag coefficient of a triangle that moves along its normal.
    pub normal_drag: f32,
    /// Drag coefficient of a triangle that moves in its plane.
    pub tangential_drag: f32,
}

/// Friction that differs along and against a direction. While the cycle runs backwards, the two change places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroundDescription {
    /// The direction, in the frame of the mesh.
    pub direction: [f32; 3],
    /// Coulomb coefficient along it.
    pub forward: f32,
    /// Coulomb coefficient against it.
    pub backward: f32,
    /// Coulomb coefficient across it.
    pub sideways: f32,
}

impl GroundDescription {
    /// The least of the coefficients: what holds in all directions.
    pub fn least(&self) -> f32 {
        self.forward.min(self.backward).min(self.sideways)
    }
}

/// A rigid thing that the body is attached to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttachmentDescription {
    /// A unique name.
    pub name: String,
    /// Its shape, in the frame of the body's mesh: an OBJ file. None for a bone that a scene brings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<PathBuf>,
    /// Its mass in kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f32>,
    /// Vertices in this ball are attached.
    pub centre: [f32; 3],
    /// Radius of the ball.
    pub radius: f32,
    /// Colour, linear RGB from 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<[f32; 3]>,
}

/// For keys that are left out when they are not set.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
fn is_false(flag: &bool) -> bool {
    !flag
}
