//! Tests of soft bodies in scene files: a good scene, and a table of bad ones with line and words of each complaint.

use super::*;
use crate::scene::{Scene, load_scene};
use std::fs;

/// Lines are counted in the table below.
const GOOD: &str = r#"name = "creatures"
duration = 4.0
substeps = 2
camera = { eye = [0, 2, 8], target = [0, 1, 0] }
[[water]]
min = [-5, -5, -5]
max = [5, 0, 5]
flow = [0.1, 0, 0]
[[soft_body]]
name = "worm"
rig = "scene.toml"
position = [1, 2, 3]
pace = -1
rise = 0.5
iterations = 4
ground = { direction = [1, 0, 0], forward = 0.1, backward = 1, sideways = 0.5 }
opacity = 0.5
[[soft_body]]
name = "swarm"
rig = "scene.toml"
stiffness = 0.5
crowd = { count = 7, columns = [2, 2], spacing = [1, 2, 3], scatter = 0.2, turn_degrees = 90, clock = 0.25 }
[[obstacle]]
name = "bead"
shape = { kind = "ball", radius = 0.1 }
dynamic = true
linear_damping = 1.5
[[attachment]]
body = "worm"
centre = [0, 0, 0]
radius = 0.3
obstacle = "bead"
[[cue]]
body = "swarm"
time = 1.5
touch = [0, 1, 0]
[[cue]]
body = "swarm 3"
time = 2
strength = 0
"#;

fn load(text: &str) -> Result<Scene, TomlError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    load_scene(path)
}

#[test]
fn a_scene_of_soft_bodies_is_read_whole() {
    let scene = load(GOOD).unwrap();
    assert_eq!((scene.substeps, scene.soft_bodies.len()), (2, 8));
    let worm = &scene.soft_bodies[0];
    assert_eq!((worm.pace, worm.strength, worm.stiffness), (-1.0, 1.0, Some(Stiffness::Iterations(4))));
    assert_eq!((worm.pose.translation, worm.opacity), (Vec3::new(1.0, 2.0, 3.0), 0.5));
    assert_eq!((worm.rise, scene.soft_bodies[1].rise), (Some(0.5), None));
    assert_eq!(worm.ground.unwrap().sideways, 0.5);
    assert_eq!(scene.water, [Water { min: Vec3::splat(-5.0), max: Vec3::new(5.0, 0.0, 5.0), flow: Vec3::X * 0.1 }]);
    assert_eq!(scene.obstacles[0].dynamic.unwrap().linear_damping, 1.5);
    let attachment = &scene.attachments[0];
    assert_eq!((&attachment.bodies[..], attachment.obstacle, attachment.radius), (&[0][..], Some(0), 0.3));
    assert_eq!((&scene.cues[0].bodies[..], scene.cues[0].touch), (&[1, 2, 3, 4, 5, 6, 7][..], Some(Vec3::Y)));
    assert_eq!((&scene.cues[1].bodies[..], scene.cues[1].strength), (&[3][..], Some(0.0)));
}

#[test]
fn a_crowd_keeps_its_distances_and_each_body_starts_later_and_turned() {
    let scene = load(GOOD).unwrap();
    let swarm = &scene.soft_bodies[1..];
    for (i, a) in swarm.iter().enumerate() {
        assert_eq!((a.name.as_str(), a.clock), (format!("swarm {}", i + 1).as_str(), 0.25 * i as f32));
        let turned = a.pose.transform_vector(Vec3::X);
        assert!((turned - Quat::from_rotation_y(std::f32::consts::FRAC_PI_2 * i as f32) * Vec3::X).length() < 1e-5);
        for b in &swarm[..i] {
            // Two scatterings of a tenth of the spacing each are left out of the distance.
            let apart = ((a.pose.translation - b.pose.translation) / Vec3::new(1.0, 2.0, 3.0)).abs();
            assert!(apart.max_element() > 0.79, "{} {}", a.name, b.name);
        }
    }
    let layers: Vec<f32> = swarm.iter().map(|b| (b.pose.translation.y / 2.0).round()).collect();
    assert_eq!(layers, [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
}

#[test]
fn bad_soft_bodies_are_refused_with_their_line_and_a_hint() {
    let table: &[(&str, &str, usize, &str)] = &[
        ("substeps = 2", "substeps = 0", 3, "`substeps` must be from 1 to 64"),
        ("[[water]]", "[[watr]]", 5, "unknown key `watr`"),
        ("max = [5, 0, 5]", "max = [5, -5, 5]", 7, "water 0: `max` must be above `min`"),
        ("flow = [0.1, 0, 0]", "flow = [nan, 0, 0]", 8, "`flow` must be finite"),
        ("name = \"worm\"", "name = \" \"", 10, "soft_body 0: `name` is empty"),
        ("rig = \"scene.toml\"", "rig = \"wurm.toml\"", 11, "wurm.toml"),
        ("pace = -1", "paec = -1", 13, "did you mean `pace`?"),
        ("rise = 0.5", "rise = -1", 14, "soft_body 0: `rise` must be from 0"),
        ("pace = -1", "pace = inf", 13, "`pace` must be from -1000 to 1000"),
        ("iterations = 4", "iterations = 65", 15, "`iterations` must be from 1 to 64 and is 65"),
        ("iterations = 4", "iterations = 4\nstiffness = 0.5", 15, "`iterations` is given beside `stiffness`"),
        ("direction = [1, 0, 0]", "direction = [0, 0, 0]", 16, "soft_body 0, ground: `direction` has no length"),
        ("forward = 0.1", "forward = -0.1", 16, "`forward`"),
        ("forward = 0.1", "foreward = 0.1", 16, "did you mean `forward`?"),
        ("opacity = 0.5", "opacity = 2", 17, "`opacity` must be from 0 to 1"),
        ("name = \"swarm\"", "name = \"worm\"", 19, "`worm` is the name of soft body 0 too"),
        ("name = \"worm\"", "name = \"swarm 2\"", 19, "`swarm 2` is the name of soft body 0 too"),
        ("stiffness = 0.5", "stiffness = 1.5", 21, "soft_body 1: `stiffness` must be from 0 to 1"),
        ("count = 7", "count = 0", 22, "soft_body 1, crowd: `count` must be from 1"),
        ("columns = [2, 2]", "columns = [2, 0]", 22, "`columns`"),
        ("scatter = 0.2", "scatter = 2", 22, "`scatter` must be from 0 to 1"),
        ("linear_damping = 1.5", "linear_damping = -1", 27, "`linear_damping`"),
        ("dynamic = true\nlinear", "linear", 26, "`linear_damping` is a key of dynamic obstacles"),
        (
            "body = \"worm\"",
            "body = \"wrom\"",
            29,
            "attachment 0: `body` is no soft body's name: `wrom`, did you mean `worm`?",
        ),
        ("radius = 0.3", "radius = 0", 31, "`radius` must be above 0"),
        ("obstacle = \"bead\"", "obstacle = \"beat\"", 32, "did you mean `bead`?"),
        (
            "body = \"swarm\"",
            "body = \"swam\"",
            34,
            "cue 0: `body` is no soft body's name: `swam`, did you mean `swarm`?",
        ),
        ("time = 1.5", "time = -1", 35, "`time` must be from 0"),
        ("touch = [0, 1, 0]", "", 35, "give `touch`, `pace` or `strength`"),
        ("touch = [0, 1, 0]", "touch = [0, inf, 0]", 36, "`touch` must be finite"),
        ("strength = 0", "strength = 1.1", 40, "`strength` must be from 0 to 1"),
    ];
    for (from, to, line, words) in table {
        assert!(GOOD.contains(from), "{from}");
        let message = load(&GOOD.replacen(from, to, 1)).map(drop).expect_err(to).to_string();
        assert!(message.contains(&format!("scene.toml:{line}: ")) && message.contains(words), "{to}: {message}");
        assert!(!message.contains('\n'), "{message}");
    }
}
