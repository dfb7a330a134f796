//! Several obstacles at once, at several depths: corners, wedges, funnels, presses, rings, crossing bars.

use std::f32::consts::TAU;

use pliant::math::{Pose, Quat, Vec3};

use crate::kinds::{Placed, Shape};
use crate::poses::{Case, Subject};

/// A named arrangement of obstacles around a body at the origin.
pub struct Arrangement {
    pub name: String,
    pub case: Case,
}

/// All arrangements for a body.
pub fn arrangements(subject: &Subject) -> Vec<Arrangement> {
    let size = subject.size;
    let mut all = Vec::new();
    let mut add = |name: String, obstacles: Vec<Placed>| {
        all.push(Arrangement { name, case: Case::new(subject, Pose::IDENTITY, obstacles) });
    };
    for depth in [0.05, 0.15, 0.3] {
        let walls = |normals: &[Vec3]| -> Vec<Placed> { normals.iter().map(|n| wall(subject, *n, depth)).collect() };
        add(format!("corner of two walls, depth {depth}"), walls(&[Vec3::X, Vec3::Y]));
        add(format!("corner of three walls, depth {depth}"), walls(&[Vec3::X, Vec3::Y, Vec3::Z]));
        for degrees in [40.0_f32, 70.0, 110.0, 140.0] {
            let tilt = 0.5 * degrees.to_radians();
            let normal = |side: f32| Vec3::new(side * tilt.cos(), tilt.sin(), 0.0);
            add(format!("wedge of {degrees} degrees, depth {depth}"), walls(&[normal(1.0), normal(-1.0)]));
        }
        let funnel: Vec<Vec3> = around(8).map(|(way, _)| (way + Vec3::Y).normalize()).collect();
        add(format!("funnel, depth {depth}"), walls(&funnel));
        let crossing = |sides: [f32; 2]| {
            vec![bar(subject, Vec3::Y * sides[0], depth, 0.0), bar(subject, Vec3::Y * sides[1], depth, 0.25 * TAU)]
        };
        add(format!("bars crossing above and below, depth {depth}"), crossing([1.0, -1.0]));
        add(format!("bars crossing below, depth {depth}"), crossing([1.0, 1.0]));
    }
    for depth in [0.1, 0.25, 0.4, 0.5] {
        add(format!("press, depth {depth} on each side"), [Vec3::Y, -Vec3::Y].map(|n| wall(subject, n, depth)).into());
    }
    for (height, narrower) in [(0.05, 0.1), (0.05, 0.2), (0.2, 0.1), (0.2, 0.2)] {
        add(format!("ring of 16, {height} high, {narrower} narrower"), ring(subject, height * size, narrower));
    }
    all
}

/// A box without room for the body, the walls of a cuboid equally deep in it, and how deep they are.
pub fn pinned(subject: &Subject, share: f32) -> (Case, f32) {
    let normals = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    let reach = normals.map(|normal| reach(subject, normal));
    let volume = subject.template.rig().mesh.volume() as f32;
    let room = |depth: f32| {
        let side = |axis: usize| (reach[2 * axis] + reach[2 * axis + 1] - 2.0 * depth * subject.size).max(0.0);
        side(0) * side(1) * side(2)
    };
    let depth = (1..100).map(|i| 0.01 * i as f32).find(|depth| room(*depth) < share * volume).expect("no room at last");
    let walls = normals.map(|normal| wall(subject, normal, depth));
    (Case::new(subject, Pose::IDENTITY, walls.into()), depth)
}

/// How far the body reaches against `normal`.
fn reach(subject: &Subject, normal: Vec3) -> f32 {
    subject.template.positions().iter().map(|x| -normal.dot(*x)).fold(f32::NEG_INFINITY, f32::max)
}

/// A wide wall that leads out along `normal`, `depth` sizes deep in the body.
fn wall(subject: &Subject, normal: Vec3, depth: f32) -> Placed {
    let half = 3.0 * subject.size;
    let centre = -normal * (reach(subject, normal) - depth * subject.size + half);
    let pose = Pose::from_parts(centre, Quat::from_rotation_arc(Vec3::Y, normal));
    Placed { shape: Shape::cuboid(Vec3::splat(half)), pose }
}

/// A thin bar across `normal`, `depth` sizes deep in the body, turned about the normal.
fn bar(subject: &Subject, normal: Vec3, depth: f32, turn: f32) -> Placed {
    let radius = 0.08 * subject.size;
    let centre = -normal * (reach(subject, normal) - depth * subject.size + radius);
    let rotation = Quat::from_rotation_y(turn) * Quat::from_rotation_z(0.25 * TAU);
    Placed { shape: Shape::capsule(2.0 * subject.size, radius), pose: Pose::from_parts(centre, rotation) }
}

/// A ring of 16 boxes about the y axis whose opening is narrower than the body by this part of its size.
fn ring(subject: &Subject, half_height: f32, narrower: f32) -> Vec<Placed> {
    let half_thickness = 0.15 * subject.size;
    let middle = |normal: Vec3| {
        let near = subject.template.positions().iter().filter(|x| x.y.abs() < 0.3 * subject.size);
        near.map(|x| -normal.dot(*x)).fold(f32::NEG_INFINITY, f32::max)
    };
    let widest = around(16).map(|(way, _)| middle(way)).fold(0.0, f32::max);
    let opening = widest * (1.0 - narrower);
    let place = |(way, turn): (Vec3, f32)| {
        let half_width = (opening + 2.0 * half_thickness) * (TAU / 32.0).tan();
        let pose = Pose::from_parts(-way * (opening + half_thickness), Quat::from_rotation_y(turn));
        Placed { shape: Shape::cuboid(Vec3::new(half_thickness, half_height, half_width)), pose }
    };
    around(16).map(place).collect()
}

/// Evenly spaced directions about the y axis with their angles.
fn around(count: u32) -> impl Iterator<Item = (Vec3, f32)> {
    (0..count).map(move |i| {
        let turn = TAU * i as f32 / count as f32;
        (Quat::from_rotation_y(turn) * Vec3::X, turn)
    })
}
