//! The rigs of bars, heart and bowel.

use glam::Vec3;
use pliant::procdef::{ChartsDescription, ContactDescription, RigDescription};

use super::bar::{LENGTH, THICKNESS};
use super::bowel::{INNER, OUTER, middle};
use super::heart::{HEIGHT, in_left, outer, right};
use super::rigs::{along, line, region, rig_of, section, steps, stroke};
use super::rigs_animals::ring;

/// The bar with its primary direction along x, and layers from the bottom to the top.
fn bar() -> RigDescription {
    let mut rig = rig_of("bar", false);
    rig.iterations = Some(6);
    rig.colour = Some([0.5, 0.5, 0.52]);
    rig.contact = Some(ContactDescription { friction: 0.5, ..Default::default() });
    let half = 0.5 * THICKNESS;
    rig.layer = vec![region(0.0, Vec3::new(0.03, half, 0.02), 20.0), region(1.0, Vec3::new(0.03, -half, 0.02), 20.0)];
    rig.direction = vec![along(None, line([Vec3::X * -0.45 * LENGTH, Vec3::X * 0.45 * LENGTH]))];
    rig
}

/// One side of the bar grows longer while the other grows shorter, by an amplitude field (figure 5).
pub fn bending_bar() -> RigDescription {
    let mut rig = bar();
    let half = 0.5 * THICKNESS;
    rig.amplitude =
        vec![region(1.0, Vec3::new(0.03, half, 0.02), 20.0), region(-1.0, Vec3::new(0.03, -half, 0.02), 20.0)];
    rig.charts = Some(ChartsDescription {
        cycle: 4.0,
        limit: Some(2.0),
        volume: Some("both".into()),
        interpolation: Some("smooth".into()),
        primary: vec![[0.0, 1.0], [0.25, 1.5], [0.5, 1.0], [0.75, 0.667]],
        ..ChartsDescription::default()
    });
    rig
}

/// Contractions and expansions run along the bar, by a phase-shift field (figure 6).
pub fn propagation_bar() -> RigDescription {
    let mut rig = bar();
    rig.phase = vec![section(0.0, Vec3::X * -0.499 * LENGTH, Vec3::X), section(1.0, Vec3::X * 0.499 * LENGTH, Vec3::X)];
    rig.charts = Some(ChartsDescription {
        cycle: 2.0,
        limit: Some(2.0),
        volume: Some("both".into()),
        interpolation: Some("smooth".into()),
        speed: Some(0.4),
        primary: vec![[0.0, 1.0], [0.2, 0.6], [0.4, 1.0], [0.6, 1.5], [0.8, 1.0]],
        ..ChartsDescription::default()
    });
    rig
}

/// Fibres turn through the wall, from one spiral on the inside to the opposite one on the outside; they contract, and the wall
/// thickens (figures 11a to c).
pub fn heart() -> RigDescription {
    let mut rig = rig_of("heart", true);
    rig.iterations = Some(6);
    rig.colour = Some([0.55, 0.12, 0.1]);
    rig.contact = Some(ContactDescription { friction: 0.5, ..Default::default() });
    rig.charts = Some(ChartsDescription {
        cycle: 1.0,
        limit: Some(2.0),
        volume: Some("secondary".into()),
        interpolation: Some("smooth".into()),
        speed: Some(8.0),
        primary: vec![[0.0, 1.0], [0.28, 0.65], [0.4, 0.65], [0.7, 1.0]],
        ..ChartsDescription::default()
    });
    // The side away from the right ventricle, the septum, both cavities, and the outside of the right ventricle.
    let (free, septum) = (0.02, 3.13);
    rig.layer = vec![
        region(0.0, in_left(0.6, free, 1.0), 40.0),
        region(0.0, in_left(0.75, septum, 1.0), 40.0),
        region(0.0, right(0.7, 0.5, 1.0), 40.0),
        region(1.0, in_left(0.6, free, 0.0), 40.0),
        region(1.0, right(0.7, 0.5, 0.0), 40.0),
    ];
    for (depth, degrees) in [(0.05, 60.0f32), (0.5, 0.0), (0.95, -60.0)] {
        for s in [0.35, 0.75] {
            for k in 0..8 {
                let start = std::f32::consts::FRAC_PI_4 * k as f32;
                rig.direction.push(along(None, spiral(s, start, depth, degrees.to_radians())));
            }
        }
    }
    for u in [0.25, 0.5, 0.75] {
        let (s, (climb, step)) = (0.65, (30f32.to_radians().tan(), 0.08));
        let fibre = steps(-1.0, 1.0, 3).map(|t| right(s - t * step * climb * outer(s) / HEIGHT, u + t * step, 0.5));
        rig.direction.push(along(None, line(fibre)));
    }
    rig.phase =
        vec![section(0.0, Vec3::Y * (-0.97 * HEIGHT), Vec3::Y), section(1.0, Vec3::Y * (-0.01 * HEIGHT), Vec3::Y)];
    rig
}

/// A piece of a spiral in the wall of the left ventricle, at an angle to the rings.
fn spiral(s: f32, start: f32, depth: f32, angle: f32) -> Vec<[f32; 3]> {
    let place = |length: f32| {
        let climbed = s + length * angle.sin() / HEIGHT;
        let radius = in_left(s, 0.0, depth).x;
        in_left(climbed, start + length * angle.cos() / radius, depth)
    };
    line(steps(-0.09, 0.09, 5).map(place))
}

/// Rings contract one after the other: what is inside is carried on (figures 11d to g).
pub fn bowel() -> RigDescription {
    let mut rig = rig_of("bowel", true);
    rig.iterations = Some(6);
    rig.colour = Some([0.75, 0.42, 0.36]);
    rig.contact = Some(ContactDescription { friction: 0.2, ..Default::default() });
    rig.charts = Some(ChartsDescription {
        cycle: 3.0,
        limit: Some(2.0),
        volume: Some("secondary".into()),
        interpolation: Some("smooth".into()),
        speed: Some(0.25),
        // All of it is in the wave from the start: without a rise the first stroke would turn cells inside out.
        rise: Some(0.4),
        primary: vec![[0.0, 1.0], [0.12, 0.55], [0.2, 0.55], [0.35, 1.0], [0.5, 1.15], [0.7, 1.0]],
        ..ChartsDescription::default()
    });
    let (start, ahead) = middle(0.06);
    let up = Vec3::Z.cross(ahead);
    rig.layer = vec![region(0.0, start + up * OUTER, 40.0), region(1.0, start + up * INNER, 40.0)];
    for u in steps(0.04, 0.96, 9) {
        let (centre, ahead) = middle(u);
        let across = [Vec3::Z.cross(ahead), Vec3::Z];
        rig.direction.push(along(Some(0.5), ring(centre, across, 0.5 * (INNER + OUTER), 13)));
        let surface = ring(centre, across, OUTER, 13);
        rig.phase.push(stroke(u, surface));
    }
    rig
}
