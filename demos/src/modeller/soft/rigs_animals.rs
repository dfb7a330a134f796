//! The rigs of jellyfish, worms and snail.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::Vec3;
use pliant::procdef::{
    AttachmentDescription, ChartsDescription, ContactDescription, GroundDescription, RigDescription,
    StimulusDescription, WaterDescription,
};

use super::rigs::{along, line, on_section, region, rig_of, rounded, section, steps, stroke};
use super::{jellyfish as jelly, shell, snail as body, worm as worms};

/// Rings contract, from the top to the rim and on into the tentacles (figure 1).
pub fn jellyfish(name: &str) -> RigDescription {
    let mut rig = rig_of(name, true);
    // A crowd needs no strong strokes.
    rig.stiffness = Some(0.5);
    let (mut cycle, mut limit) = (1.6, 2.5);
    let mut primary = vec![[0.0, 1.0], [0.12, 0.45], [0.25, 0.5], [0.9, 1.0]];
    if name == "jellyfish" {
        rig.stiffness = Some(0.6);
        (cycle, limit) = (1.8, 3.0);
        primary = vec![[0.0, 1.0], [0.11, 0.36], [0.22, 0.42], [0.9, 1.0]];
        // At each stroke the flat cells where the tentacles begin would bend through themselves.
        rig.least_volume = Some(0.05);
    }
    rig.colour = Some([0.55, 0.45, 0.75]);
    rig.charts = Some(ChartsDescription {
        cycle,
        limit: Some(limit),
        volume: Some("both".into()),
        interpolation: Some("smooth".into()),
        speed: Some(1.6),
        primary,
        ..ChartsDescription::default()
    });
    rig.stimulus = Some(StimulusDescription { speed: 2.0, damping: 2.0, ..StimulusDescription::default() });
    rig.contact = Some(ContactDescription { friction: 0.2, vertices: name.starts_with("small"), ..Default::default() });
    rig.water = Some(WaterDescription { density: 1000.0, normal_drag: 1.2, tangential_drag: 0.03 });
    rig.layer =
        vec![region(0.0, jelly::in_wall(0.4, 0.3, 1.0), 30.0), region(1.0, jelly::in_wall(0.5, 0.3, 0.0), 30.0)];
    for v in [0.35, 0.85] {
        for k in 0..4 {
            let start = FRAC_PI_2 * k as f32;
            let arc = steps(start, start + 0.8 * FRAC_PI_2, 5).map(|angle| jelly::in_wall(v, angle, 0.5));
            rig.direction.push(along(Some(0.5), line(arc)));
        }
    }
    let level = |value, y: f32| section(value, Vec3::Y * y, Vec3::Y);
    // The bell contracts most at its rim; the tentacles are carried along.
    rig.amplitude = vec![
        level(0.2, 0.46),
        level(0.75, 0.2),
        level(1.0, 0.02),
        level(0.0, -0.3),
        level(0.0, -0.7),
        level(0.0, -1.15),
    ];
    rig.phase = vec![level(0.0, 0.45), level(0.12, 0.2), level(0.25, 0.0), level(0.6, -0.4), level(1.0, -0.85)];
    rig
}

/// Lengthwise contractions run from the head to the tail (figure 9). `half` is half the length.
pub fn worm(name: &str, half: f32) -> RigDescription {
    let mut rig = rig_of(name, true);
    let short = name.starts_with("short");
    rig.iterations = Some(if short { 1 } else { 6 });
    rig.colour = Some([0.62, 0.25, 0.2]);
    rig.charts = Some(ChartsDescription {
        cycle: 1.6,
        limit: Some(2.0),
        volume: Some("both".into()),
        interpolation: Some("smooth".into()),
        speed: Some(0.6),
        primary: vec![[0.0, 1.0], [0.25, 0.62], [0.5, 1.0], [0.75, 1.25]],
        ..ChartsDescription::default()
    });
    rig.stimulus = Some(StimulusDescription { speed: 1.5, damping: 3.0, ..StimulusDescription::default() });
    rig.contact = Some(ContactDescription { friction: 0.6, vertices: short, ..Default::default() });
    rig.ground = Some(GroundDescription { direction: [1.0, 0.0, 0.0], forward: 0.1, backward: 1.0, sideways: 0.8 });
    rig.layer = round_layers(half, worms::LONG.radius);
    rig.direction = vec![along(None, line(steps(-0.9 * half, 0.9 * half, 2).map(|x| Vec3::X * x)))];
    rig.phase = steps(1.0, -1.0, 5).map(|u| section(0.5 - 0.5 * u, Vec3::X * (0.98 * half * u), Vec3::X)).collect();
    rig
}

/// Layers of a round body about x: 0 on the outside, 1 on the axis.
fn round_layers(half: f32, radius: f32) -> Vec<pliant::procdef::PaintDescription> {
    let mut layers = vec![region(0.0, Vec3::new(0.05 * half, radius, 0.01), 40.0)];
    for x in steps(-0.85 * half, 0.85 * half, 7) {
        layers.push(on_section(1.0, Vec3::X * x, Vec3::X, line([Vec3::X * x])));
    }
    layers
}

/// The worm bends to the left and to the right: its sides contract in turn (figures 9c and 9e).
pub fn worm_bend() -> RigDescription {
    let (half, radius) = (0.5 * worms::LONG.length, worms::LONG.radius);
    let mut rig = worm("worm", half);
    rig.charts = Some(ChartsDescription {
        cycle: 2.0,
        limit: Some(2.0),
        volume: Some("both".into()),
        interpolation: Some("smooth".into()),
        speed: Some(0.7),
        primary: vec![[0.0, 1.0], [0.25, 0.62], [0.5, 1.0], [0.75, 1.6]],
        ..ChartsDescription::default()
    });
    let side = |z: f32| line(steps(-0.9 * half, 0.9 * half, 7).map(|x| Vec3::new(x, 0.0, z)));
    rig.amplitude = vec![stroke(1.0, side(radius)), stroke(-1.0, side(-radius))];
    for x in steps(-0.8 * half, 0.8 * half, 5) {
        rig.amplitude.push(on_section(
            0.0,
            Vec3::X * x,
            Vec3::X,
            line([Vec3::new(x, -0.9 * radius, 0.0), Vec3::new(x, 0.9 * radius, 0.0)]),
        ));
    }
    rig
}

/// Touched, the snail draws in (figure 7). Its shell is a rigid thing on its back.
pub fn snail() -> RigDescription {
    let mut rig = rig_of("snail", true);
    rig.stiffness = Some(0.7);
    rig.colour = Some([0.62, 0.5, 0.33]);
    rig.stimulus = Some(StimulusDescription {
        speed: 0.8,
        damping: 2.5,
        threshold: Some(0.2),
        refractory: Some(1.5),
        charts: Some(ChartsDescription {
            cycle: 2.0,
            limit: Some(2.5),
            volume: Some("both".into()),
            interpolation: Some("smooth".into()),
            primary: vec![[0.0, 1.0], [0.2, 0.5], [0.45, 0.55], [0.95, 1.0]],
            ..ChartsDescription::default()
        }),
    });
    rig.contact = Some(ContactDescription { friction: 0.9, ..Default::default() });
    let spine = |u: f32, up: f32| body::middle(u) + Vec3::Y * up;
    rig.layer = vec![region(0.0, Vec3::new(0.1, 0.3, 0.02), 50.0)];
    for u in steps(0.15, 0.9, 7) {
        let (at, ahead) = (spine(u, 0.09), (body::middle(u + 0.02) - body::middle(u - 0.02)).normalize());
        rig.layer.push(on_section(1.0, at, ahead, line([at])));
    }
    rig.direction = vec![along(None, line(steps(0.06, 0.94, 12).map(|u| spine(u, 0.09))))];
    rig.attachment = vec![AttachmentDescription {
        name: "shell".into(),
        mesh: Some("../meshes/snail_shell.obj".into()),
        mass: Some(15.0),
        centre: rounded(shell::CENTRE - Vec3::Y * 0.36),
        radius: 0.2,
        colour: Some([0.45, 0.27, 0.14]),
    }];
    rig
}

/// A ring about an axis in the plane of two vectors.
pub fn ring(centre: Vec3, across: [Vec3; 2], radius: f32, count: usize) -> Vec<[f32; 3]> {
    line(steps(0.0, TAU, count).map(|angle| centre + radius * (across[0] * angle.cos() + across[1] * angle.sin())))
}
