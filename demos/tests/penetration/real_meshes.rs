//! Meshes that others have modelled, with thin ears, trunks, horns and uneven triangles, go through ring and tower like those
//! of the project.
//!
//! They are no part of the project: they are looked for in `../shared/meshes` beside the workspace, or where
//! `PLIANT_MESHES` says, and without them the tests print a word and pass. Scenes are made in a temporary folder; with
//! `PLIANT_MESHES_OUT=folder` they are made there and stay: `pliant run folder/elephant/ring.toml` shows one.

use std::fs;
use std::path::{Path, PathBuf};

use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::{load_obj, write_obj};
use pliant_demos::scene::load_scene;
use pliant_demos::simulation::Simulation;
use rayon::prelude::*;

use crate::worst::{Limits, WorstFigures};
use crate::{full, number};

/// A mesh and a rig for it. The vertices are moved so that their mean is the origin, and scaled to [`SIZE`].
struct Model {
    name: &'static str,
    file: &'static str,
    rig: &'static str,
}

/// What goes through the ring, each as one rigid body.
const WHOLE: [Model; 3] = [
    Model { name: "spot", file: "spot.obj", rig: include_str!("rigs/spot.toml") },
    Model { name: "max", file: "decimated-max.obj", rig: include_str!("rigs/max.toml") },
    Model { name: "elephant", file: "elephant.obj", rig: include_str!("rigs/elephant.toml") },
];

/// What falls through the tower besides.
const RAGDOLLS: [Model; 2] = [
    Model { name: "spot ragdoll", file: "spot.obj", rig: include_str!("rigs/spot_parts.toml") },
    Model { name: "elephant ragdoll", file: "elephant.obj", rig: include_str!("rigs/elephant_parts.toml") },
];

/// Size of the bodies in metres: the bars of the tower are 1.3 m apart.
const SIZE: f32 = 1.3;

/// The assets of the project.
const ASSETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets");

/// Where the meshes are, if they are.
fn meshes() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/meshes");
    let folder = std::env::var("PLIANT_MESHES").map_or_else(|_| PathBuf::from(beside), PathBuf::from);
    let there = folder.is_dir();
    if !there {
        println!("skipped: there is no folder {}", folder.display());
    }
    there.then_some(folder)
}

/// A folder for the scenes: the one that is asked for, or a temporary one that lives as long as the second value.
fn folder() -> (PathBuf, Option<tempfile::TempDir>) {
    match std::env::var("PLIANT_MESHES_OUT") {
        Ok(folder) => {
            fs::create_dir_all(&folder).expect("a folder");
            (folder.into(), None)
        }
        Err(_) => {
            let folder = tempfile::tempdir().expect("a folder");
            (folder.path().into(), Some(folder))
        }
    }
}

/// Writes mesh and rig into a folder of their own below `folder`, and returns that folder and the vertices.
fn prepare(model: &Model, meshes: &Path, folder: &Path) -> (PathBuf, Vec<Vec3>) {
    let folder = folder.join(model.name.replace(' ', "_"));
    fs::create_dir_all(&folder).expect("a folder");
    let mesh = load_obj(meshes.join(model.file)).expect("a mesh");
    let centre = mesh.positions.iter().sum::<Vec3>() / mesh.positions.len() as f32;
    let positions: Vec<Vec3> = mesh.positions.iter().map(|x| (*x - centre) * (SIZE / mesh.size())).collect();
    let name = model.name.split(' ').next().unwrap_or_default();
    write_obj(folder.join(format!("{name}.obj")), &positions, &mesh.triangles).expect("a file");
    fs::write(folder.join("rig.toml"), model.rig).expect("a file");
    (folder, positions)
}

/// A ring whose opening is a fifth narrower than the body is wide, in the mean of its two widths, and a hand that leads the
/// body through it and back.
fn ring(model: &Model, meshes: &Path, folder: &Path) -> PathBuf {
    let (folder, positions) = prepare(model, meshes, folder);
    // The cow goes nose first.
    let upright = if model.name == "spot" { 90.0_f32 } else { 0.0 };
    let turn = Quat::from_rotation_x(upright.to_radians());
    let (low, high) = positions
        .into_iter()
        .map(|x| turn * x)
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let (width, centre) = (high - low, 0.5 * (low + high));
    let radius = 0.8 * 0.25 * (width.x + width.z);
    let text = format!(
        "name = \"{name} in a ring\"\nduration = 16.0\n\
         camera = {{ eye = [8.5, 4.2, 7.2], target = [0.0, 2.8, 0.0], fov_degrees = 24.0 }}\n\
         [[body]]\nname = \"{name}\"\nrig = \"rig.toml\"\nposition = [0.0, {LOW:?}, 0.0]\n\
         rotation_degrees = [{upright:?}, 0.0, 0.0]\ncolour = [0.6, 0.66, 0.75]\n\
         [[dragger]]\nbody = \"{name}\"\npulls = \"body\"\nfrequency = 4.0\nsteady = true\n\
         keys = [[0.0, 0.0, {LOW:?}, 0.0], [0.2, 0.0, {LOW:?}, 0.0], [5.6, 0.0, {HIGH:?}, 0.0],\n\
         [6.0, 0.0, {HIGH:?}, 0.0], [11.0, 0.0, {LOW:?}, 0.0], [17.0, 0.0, {LOW:?}, 0.0]]\n\
         [[obstacle]]\nname = \"floor\"\nshape = {{ kind = \"cuboid\", half_extents = [50.0, 5.0, 50.0] }}\n\
         position = [0.0, -5.0, 0.0]\n\
         [[obstacle]]\nname = \"ring\"\nshape = {{ kind = \"ring\", radius = {radius:?}, thickness = 0.1 }}\n\
         position = [{x:?}, {middle:?}, {z:?}]\nfriction = 0.1\n",
        name = model.name,
        middle = 0.5 * (LOW + HIGH),
        x = centre.x,
        z = centre.z,
    );
    let path = folder.join("ring.toml");
    fs::write(&path, text).expect("a file");
    path
}

/// Between these heights the hand leads the body, in metres; the ring is in the middle.
const LOW: f32 = 1.05 * SIZE;
const HIGH: f32 = 3.3 * SIZE;

/// The shipped tower with the mesh in the place of the camel.
fn tower(model: &Model, meshes: &Path, folder: &Path) -> PathBuf {
    let (folder, _) = prepare(model, meshes, folder);
    let text = fs::read_to_string(format!("{ASSETS}/scenes/tower.toml")).expect("the tower");
    let text = text
        .replace("../rigs/camel.toml", "rig.toml")
        .replace("\"../", &format!("\"{ASSETS}/"))
        .replace("position = [-0.4, 7.6, 0.0]", "position = [-0.4, 9.2, 0.0]");
    let path = folder.join("tower.toml");
    fs::write(&path, text).expect("a file");
    path
}

/// Runs a scene of one body; the figures are printed and judged.
fn run(name: &str, path: &Path, frames: u64, faults: &mut Vec<String>) -> (Simulation, WorstFigures, f32) {
    let mut simulation = Simulation::new(load_scene(path).expect("a scene"), 0).expect("a scene that can be built");
    let mut worst = WorstFigures::default();
    let mut highest = f32::MIN;
    let log = std::env::var("PLIANT_SUITE_LOG").is_ok();
    for frame in 0..frames.min(simulation.frames()) {
        simulation.step();
        let (actor, bad) = (&simulation.actors[0], worst.bad);
        let report = simulation.report(actor);
        worst.see(frame, &actor.name, &report);
        if log && worst.bad > bad {
            println!("{name} frame {frame}: {:?} {} passes", report.penetration, report.passes);
        }
        highest = highest.max(pose(&simulation).translation.y);
    }
    println!("{name}: {worst}");
    faults.extend(worst.faults(&Limits::of(name)).into_iter().map(|fault| format!("{name}: {fault}")));
    (simulation, worst, highest)
}

fn pose(simulation: &Simulation) -> Pose {
    simulation.deformation.get(simulation.actors[0].handle).expect("it is there").motions()[0]
}

/// The largest distance of a vertex from where its rigid body puts it, as a fraction of the body's size.
fn deformation(simulation: &Simulation) -> f32 {
    let body = simulation.deformation.get(simulation.actors[0].handle).expect("it is there");
    let rest = body.rig().mesh.positions.iter().map(|x| pose(simulation).transform_point(*x));
    rest.zip(body.positions()).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max) / body.rig().mesh.size()
}

/// The models, or those of `PLIANT_SUITE_SCENES`.
fn chosen(models: &[Model]) -> impl ParallelIterator<Item = &Model> {
    let only = std::env::var("PLIANT_SUITE_SCENES").ok();
    models.par_iter().filter(move |model| only.as_ref().is_none_or(|only| only.split(',').any(|o| o == model.name)))
}

#[test]
fn real_meshes_go_through_a_ring_that_is_too_narrow_and_return_to_their_shape() {
    let Some(meshes) = meshes() else { return };
    let (folder, _kept) = folder();
    let run = |model: &Model| {
        let mut faults = Vec::new();
        let name = format!("{} in a ring", model.name);
        let (simulation, worst, highest) = run(&name, &ring(model, &meshes, &folder), u64::MAX, &mut faults);
        let mut holds = |what: &str, value: f32, yes: bool| {
            if !yes {
                faults.push(format!("{name}: {what}: {value}"));
            }
        };
        let before = worst.before.value;
        holds("before the cancellation it is deeper than 8 % of its size", before, before > 0.08);
        holds("it has passed the ring", highest, highest > HIGH - 0.1 * SIZE);
        holds("the volume is kept to 0.2 %", worst.volume[0], worst.volume[0] > 0.998);
        holds("the volume is kept to 0.2 %", worst.volume[1], worst.volume[1] < 1.002);
        let place = pose(&simulation).translation.y;
        holds("it is back", place, (place - LOW).abs() < 0.05 * SIZE);
        let left = deformation(&simulation);
        holds("5 s after it has its shape", left, left < 1.0e-4);
        faults
    };
    let faults: Vec<String> = chosen(&WHOLE).flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn real_meshes_fall_through_the_tower_without_being_seen_in_an_obstacle() {
    let Some(meshes) = meshes() else { return };
    let (folder, _kept) = folder();
    let frames = number("PLIANT_SUITE_FRAMES", if full() { u64::MAX } else { 200 });
    let run = |model: &Model| {
        let mut faults = Vec::new();
        let name = format!("{} in the tower", model.name);
        let (simulation, worst, _) = run(&name, &tower(model, &meshes, &folder), frames, &mut faults);
        let place = pose(&simulation).translation;
        if place.y > 2.0 || worst.before.value < 0.08 {
            faults.push(format!("{name}: it meets the bars and falls past them: {place}, {}", worst.before.value));
        }
        faults
    };
    let faults: Vec<String> = chosen(&WHOLE).chain(chosen(&RAGDOLLS)).flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
