//! Meshes that others have modelled, with thin ears, trunks, horns and uneven triangles, go through ring and tower like those
//! of the project.
//!
//! They are no part of the project: they are looked for in `../shared/meshes` beside the workspace, or where
//! `PLIANT_MESHES` says, and without them the tests print a word and pass. Scenes are made in a temporary folder; with
//! `PLIANT_MESHES_OUT=folder` they are made there and stay: `pliant run folder/elephant_ring.toml` shows one.

use std::fs;
use std::path::{Path, PathBuf};

use pliant::math::{Pose, Quat, Vec3};
use pliant::mesh::{load_obj, write_obj};
use pliant_demos::scene::load_scene;
use pliant_demos::simulation::Simulation;
use rayon::prelude::*;

use crate::number;
use crate::worst::{Limits, WorstFigures};

/// A mesh, and rigs for it. Its vertices are moved and scaled so that their mean is the origin and its size 1.
struct Model {
    name: &'static str,
    file: &'static str,
    /// The angle about x that puts the axis upright along which it goes through the ring, degrees.
    upright: f32,
    /// The rig of one rigid body.
    whole: &'static str,
    /// The rig that falls through the tower.
    parts: &'static str,
}

const MODELS: [Model; 3] = [
    Model {
        name: "spot",
        file: "spot.obj",
        upright: 90.0,
        whole: include_str!("rigs/spot.toml"),
        parts: include_str!("rigs/spot_parts.toml"),
    },
    Model {
        name: "max",
        file: "decimated-max.obj",
        upright: 0.0,
        whole: include_str!("rigs/max.toml"),
        parts: include_str!("rigs/max.toml"),
    },
    Model {
        name: "elephant",
        file: "elephant.obj",
        upright: 0.0,
        whole: include_str!("rigs/elephant.toml"),
        parts: include_str!("rigs/elephant_parts.toml"),
    },
];

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

/// Writes the mesh, moved and scaled, and returns its vertices.
fn prepare(model: &Model, meshes: &Path, folder: &Path) -> Vec<Vec3> {
    let mesh = load_obj(meshes.join(model.file)).expect("a mesh");
    let (centre, size) = (mesh.positions.iter().sum::<Vec3>() / mesh.positions.len() as f32, mesh.size());
    let positions: Vec<Vec3> = mesh.positions.iter().map(|x| (*x - centre) / size).collect();
    write_obj(folder.join(format!("{}.obj", model.name)), &positions, &mesh.triangles).expect("a file");
    positions
}

/// A ring whose opening is a fifth narrower than the body is wide, in the mean of its two widths, and a hand that leads the
/// body through it and back.
fn ring(model: &Model, meshes: &Path, folder: &Path) -> PathBuf {
    let turn = Quat::from_rotation_x(model.upright.to_radians());
    let positions = prepare(model, meshes, folder).into_iter().map(|x| turn * x);
    let (low, high) =
        positions.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let (width, centre) = (high - low, 0.5 * (low + high));
    let radius = 0.8 * 0.25 * (width.x + width.z);
    let text = format!(
        "name = \"{name} in a ring\"\nduration = 16.0\n\
         camera = {{ eye = [6.5, 3.2, 5.5], target = [0.0, 2.0, 0.0], fov_degrees = 32.0 }}\n\
         [[body]]\nname = \"{name}\"\nrig = \"{name}.rig.toml\"\nposition = [0.0, 1.05, 0.0]\n\
         rotation_degrees = [{upright:?}, 0.0, 0.0]\ncolour = [0.6, 0.66, 0.75]\n\
         [[dragger]]\nbody = \"{name}\"\npulls = \"body\"\nfrequency = 4.0\nsteady = true\n\
         keys = [[0.0, 0.0, 1.05, 0.0], [0.2, 0.0, 1.05, 0.0], [5.6, 0.0, {TOP:?}, 0.0], [6.0, 0.0, {TOP:?}, 0.0],\n\
         [11.0, 0.0, 1.05, 0.0], [17.0, 0.0, 1.05, 0.0]]\n\
         [[obstacle]]\nname = \"floor\"\nshape = {{ kind = \"cuboid\", half_extents = [50.0, 5.0, 50.0] }}\n\
         position = [0.0, -5.0, 0.0]\n\
         [[obstacle]]\nname = \"ring\"\nshape = {{ kind = \"ring\", radius = {radius:?}, thickness = 0.075 }}\n\
         position = [{x:?}, 2.1, {z:?}]\nfriction = 0.1\n",
        name = model.name,
        upright = model.upright,
        x = centre.x,
        z = centre.z,
    );
    fs::write(folder.join(format!("{}.rig.toml", model.name)), model.whole).expect("a file");
    let path = folder.join(format!("{}_ring.toml", model.name));
    fs::write(&path, text).expect("a file");
    path
}

/// How high the hand lifts the body: above the ring, which is at 2.1 m.
const TOP: f32 = 3.3;

/// The shipped tower with the mesh in the place of the camel.
fn tower(model: &Model, meshes: &Path, folder: &Path) -> PathBuf {
    prepare(model, meshes, folder);
    let rig = format!("{}_parts.rig.toml", model.name);
    fs::write(folder.join(&rig), model.parts).expect("a file");
    let text = fs::read_to_string(format!("{ASSETS}/scenes/tower.toml")).expect("the tower");
    let text = text
        .replace("../rigs/camel.toml", &rig)
        .replace("\"../", &format!("\"{ASSETS}/"))
        .replace("position = [-0.4, 7.6, 0.0]", "position = [-0.4, 8.8, 0.0]");
    let path = folder.join(format!("{}_tower.toml", model.name));
    fs::write(&path, text).expect("a file");
    path
}

/// Runs a scene of one body; the figures are printed and judged.
fn run(path: &Path, frames: u64, limits: &Limits, faults: &mut Vec<String>) -> (Simulation, WorstFigures, f32) {
    let mut simulation = Simulation::new(load_scene(path).expect("a scene"), 0).expect("a scene that can be built");
    let mut worst = WorstFigures::default();
    let mut highest = f32::MIN;
    for frame in 0..frames.min(simulation.frames()) {
        simulation.step();
        worst.see(frame, &simulation.actors[0].name, &simulation.report(&simulation.actors[0]));
        highest = highest.max(pose(&simulation).translation.y);
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    println!("{name}: {worst}");
    faults.extend(worst.faults(limits).into_iter().map(|fault| format!("{name}: {fault}")));
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
fn models() -> impl ParallelIterator<Item = &'static Model> {
    let only = std::env::var("PLIANT_SUITE_SCENES").ok();
    let wanted = move |model: &&Model| only.as_ref().is_none_or(|only| only.split(',').any(|o| o == model.name));
    MODELS.par_iter().filter(wanted)
}

#[test]
fn real_meshes_go_through_a_ring_that_is_too_narrow_and_return_to_their_shape() {
    let Some(meshes) = meshes() else { return };
    let (folder, _kept) = folder();
    let run = |model: &Model| {
        let mut faults = Vec::new();
        let limits = Limits::of(&format!("{} ring", model.name));
        let (simulation, worst, highest) = run(&ring(model, &meshes, &folder), u64::MAX, &limits, &mut faults);
        let mut holds = |what: &str, value: f32, yes: bool| {
            if !yes {
                faults.push(format!("{} in a ring: {what}: {value}", model.name));
            }
        };
        let before = worst.before.value;
        holds("before the cancellation it is deeper than 8 % of its size", before, before > 0.08);
        holds("it has passed the ring", highest, highest > TOP - 0.15);
        holds("the volume is kept to 0.2 %", worst.volume[0], worst.volume[0] > 0.998);
        holds("the volume is kept to 0.2 %", worst.volume[1], worst.volume[1] < 1.002);
        let place = pose(&simulation).translation.y;
        holds("it is back", place, (place - 1.05).abs() < 0.05);
        let left = deformation(&simulation);
        println!("{} in a ring: {left:e} off its shape at the end", model.name);
        holds("5 s after it has its shape", left, left < 1.0e-4);
        faults
    };
    let faults: Vec<String> = models().flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn real_meshes_fall_through_the_tower_without_being_seen_in_an_obstacle() {
    let Some(meshes) = meshes() else { return };
    let (folder, _kept) = folder();
    let frames = number("PLIANT_SUITE_FRAMES", if crate::full() { u64::MAX } else { 150 });
    let run = |model: &Model| {
        let mut faults = Vec::new();
        let limits = Limits::of(&format!("{} tower", model.name));
        run(&tower(model, &meshes, &folder), frames, &limits, &mut faults);
        faults
    };
    let faults: Vec<String> = models().flat_map_iter(run).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
