//! What the rig files of all modelled bodies have in common, and the list of them.

use glam::Vec3;
use pliant::procdef::{PaintDescription, RegionDescription, RigDescription, SectionDescription, StrokeDescription};

use super::{rigs_animals, rigs_organs};

/// The rigs by the names of their files.
pub fn rigs() -> Vec<(&'static str, RigDescription)> {
    vec![
        ("jellyfish", rigs_animals::jellyfish("jellyfish")),
        ("small_jellyfish", rigs_animals::jellyfish("small_jellyfish")),
        ("worm", rigs_animals::worm("worm", 1.2)),
        ("worm_bend", rigs_animals::worm_bend()),
        ("short_worm", rigs_animals::worm("short_worm", 0.5)),
        ("snail", rigs_animals::snail()),
        ("bending_bar", rigs_organs::bending_bar()),
        ("propagation_bar", rigs_organs::propagation_bar()),
        ("heart", rigs_organs::heart()),
        ("bowel", rigs_organs::bowel()),
    ]
}

/// A rig of a mesh with its drawn surface.
pub fn rig_of(name: &str, skin: bool) -> RigDescription {
    RigDescription {
        mesh: format!("../meshes/{name}.mesh").into(),
        skin: skin.then(|| format!("../meshes/{name}_skin.obj").into()),
        density: Some(1000.0),
        ..RigDescription::default()
    }
}

/// Rounded to a tenth of a millimetre, so that files are read with pleasure.
pub fn rounded(p: Vec3) -> [f32; 3] {
    p.to_array().map(|c| (f64::from(c) * 1.0e4).round() as f32 / 1.0e4 + 0.0)
}

/// A line of points.
pub fn line(points: impl IntoIterator<Item = Vec3>) -> Vec<[f32; 3]> {
    points.into_iter().map(rounded).collect()
}

/// `count` values from `first` to `last`.
pub fn steps(first: f32, last: f32, count: usize) -> impl Iterator<Item = f32> {
    (0..count).map(move |i| first + (last - first) * i as f32 / (count - 1).max(1) as f32)
}

/// A region painted with a value.
pub fn region(value: f32, seed: Vec3, angle_degrees: f32) -> PaintDescription {
    let region = RegionDescription { seed: rounded(seed), angle_degrees };
    PaintDescription { value, region: Some(region), ..PaintDescription::default() }
}

/// A stroke on the surface painted with a value.
pub fn stroke(value: f32, points: Vec<[f32; 3]>) -> PaintDescription {
    PaintDescription { value, stroke: Some(points), ..PaintDescription::default() }
}

/// A cross-section painted with a value.
pub fn section(value: f32, origin: Vec3, normal: Vec3) -> PaintDescription {
    on_section(value, origin, normal, Vec::new())
}

/// A line on a cross-section painted with a value.
pub fn on_section(value: f32, origin: Vec3, normal: Vec3, stroke: Vec<[f32; 3]>) -> PaintDescription {
    let section = SectionDescription { origin: rounded(origin), normal: rounded(normal), stroke };
    PaintDescription { value, section: Some(section), ..PaintDescription::default() }
}

/// A stroke along the primary direction.
pub fn along(layer: Option<f32>, stroke: Vec<[f32; 3]>) -> StrokeDescription {
    StrokeDescription { layer, stroke }
}
