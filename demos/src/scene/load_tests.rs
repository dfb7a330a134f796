//! Tests of scene files: a good one, and a table of bad ones with the line and the words of each complaint.

use super::*;
use pliant::math::Pose;
use std::fs;

/// Lines are counted in the table below.
const GOOD: &str = r#"name = "tower"
duration = 10.0
dt = 0.016666667
gravity = [0, -9.81, 0]
softness = 1.5
[camera]
eye = [0, 2, 8]
target = [0, 1, 0]
fov_degrees = 35.0
[[body]]
name = "camel"
rig = "../rigs/camel.toml"
position = [0, 8, 0]
rotation_degrees = [0, 90, 0]
velocity = [0, 0, 1]
angular_velocity = [0, 1, 0]
colour = [0.8, 0.6, 0.4]
[[body]]
name = "second"
rig = "../rigs/camel.toml"
[[obstacle]]
name = "floor"
shape = { kind = "cuboid", half_extents = [5, 0.5, 5] }
friction = 0.5
opacity = 0.5
[[obstacle]]
shape = { kind = "mesh", file = "../meshes/rock.obj", scale = 2, max_parts = 8 }
path = { points = [[0, 0, 0], [1, 0, 0]], period = 4.0, kind = "ping-pong" }
spin = { axis = [0, 2, 0], degrees_per_second = 90 }
[[obstacle]]
shape = { kind = "capsule", half_height = 1, radius = 0.5 }
"#;

fn load(text: &str) -> Result<Scene, TomlError> {
    let folder = tempfile::tempdir().unwrap();
    for name in ["rigs/camel.toml", "meshes/rock.obj", "scenes/scene.toml"] {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    load_scene(folder.path().join("scenes/scene.toml"))
}

#[test]
fn a_good_scene_is_read_whole() {
    let scene = load(GOOD).unwrap();
    assert_eq!((scene.name.as_str(), scene.duration, scene.softness), ("tower", 10.0, Some(1.5)));
    let camel = &scene.bodies[0];
    assert!((camel.pose.transform_point(Vec3::X) - Vec3::new(0.0, 8.0, -1.0)).length() < 1e-6);
    assert_eq!((camel.velocity, camel.angular_velocity), (Vec3::Z, Vec3::Y));
    assert!(camel.rig.ends_with("../rigs/camel.toml"));
    assert_eq!((scene.bodies[1].pose, scene.bodies[1].colour), (Pose::IDENTITY, None));
    assert_eq!((scene.obstacles[0].opacity, scene.obstacles[2].opacity), (0.5, 1.0));
    assert_eq!(scene.obstacles[2].shape, ObstacleShape::Capsule { half_height: 1.0, radius: 0.5 });
    let rock = &scene.obstacles[1];
    assert!(matches!(rock.shape, ObstacleShape::Mesh { scale: 2.0, max_parts: Some(8), .. }) && rock.is_moving());
    assert_eq!(rock.spin.unwrap().axis, Vec3::Y);
}

#[test]
fn a_path_runs_at_an_even_pace_and_comes_back() {
    let square = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let path = |kind, points: &[Vec3]| ObstaclePath { points: points.to_vec(), period: 4.0, kind };
    let round = path(PathKind::Loop, &square);
    assert!((round.at(1.5) - Vec3::new(1.0, 0.5, 0.0)).length() < 1e-5);
    assert!((round.at(3.5) - Vec3::Y * 0.5).length() < 1e-5 && (round.at(8.0) - Vec3::ZERO).length() < 1e-5);
    let there = path(PathKind::PingPong, &[Vec3::ZERO, Vec3::X, Vec3::X * 2.0]);
    assert!((there.at(2.0) - Vec3::X * 2.0).length() < 1e-5 && (there.at(3.0) - Vec3::X).length() < 1e-5);
    assert_eq!(path(PathKind::Loop, &[Vec3::ONE; 2]).at(1.0), Vec3::ONE);
}

#[test]
fn a_moving_obstacle_is_carried_and_turned() {
    let mut rock = load(GOOD).unwrap().obstacles[1].clone();
    rock.pose.translation = Vec3::Z;
    let pose = rock.pose_at(1.0);
    assert!((pose.translation - Vec3::new(0.5, 0.0, 1.0)).length() < 1e-5);
    assert!((pose.transform_vector(Vec3::X) - -Vec3::Z).length() < 1e-5);
}

#[test]
fn bad_scenes_are_refused_with_their_line_and_a_hint() {
    // What to replace in the good scene, the line of the complaint, words of it.
    let table: &[(&str, &str, usize, &[&str])] = &[
        ("duration", "duratoin", 2, &["unknown key `duratoin`", "did you mean `duration`?"]),
        ("friction", "frictoin", 24, &["unknown key `frictoin`", "`friction`"]),
        ("radius = 0.5 }", "radios = 0.5 }", 31, &["unknown key `radios`"]),
        ("name = \"tower\"", "", 1, &["`name` is missing"]),
        ("name = \"tower\"", "name = \" \"", 1, &["`name` is empty"]),
        ("name = \"tower\"", "name = tower", 1, &[]),
        ("duration = 10.0", "duration = 0", 2, &["`duration`", "at most 3600"]),
        ("duration = 10.0", "duration = 3601", 2, &["`duration`", "3601"]),
        ("dt = 0.016666667", "dt = 0.2", 3, &["`dt`", "at most 0.1"]),
        ("dt = 0.016666667", "dt = nan", 3, &["`dt`", "NaN"]),
        ("dt = 0.016666667", "dt = -1", 3, &["`dt`", "-1"]),
        ("[0, -9.81, 0]", "[0, -inf, 0]", 4, &["`gravity`", "finite"]),
        ("[0, -9.81, 0]", "[0, -9.81]", 4, &["length"]),
        ("softness = 1.5", "softness = 20", 5, &["`softness`", "at most 10"]),
        ("target = [0, 1, 0]", "target = [0, 2, 8]", 8, &["camera: `target`", "no direction"]),
        ("eye = [0, 2, 8]", "eye = [nan, 2, 8]", 7, &["`eye`", "finite"]),
        ("fov_degrees = 35.0", "fov_degrees = 180", 9, &["`fov_degrees`", "from 1 to 179"]),
        ("rig = \"../rigs/camel.toml\"", "rig = \"camal.toml\"", 12, &["body 0: `rig`", "camal.toml"]),
        ("rig = \"../rigs/camel.toml\"", "rig = \"../rigs\"", 12, &["`rig`", "not a file"]),
        ("position = [0, 8, 0]", "position = [0, nan, 0]", 13, &["`position`", "finite"]),
        ("[0, 90, 0]", "[0, inf, 0]", 14, &["`rotation_degrees`", "finite"]),
        ("velocity = [0, 0, 1]", "velocity = [0, 1e60, 1]", 15, &["`velocity`", "finite"]),
        ("[0.8, 0.6, 0.4]", "[255, 0, 0]", 17, &["`colour`", "from 0 to 1"]),
        ("name = \"second\"", "name = \"camel\"", 19, &["body 1: `name`", "`camel` is the name of body 0"]),
        ("\"cuboid\"", "\"cubiod\"", 23, &["`cubiod`", "did you mean `cuboid`?"]),
        ("[5, 0.5, 5]", "[5, 0, 5]", 23, &["obstacle 0, shape: `half_extents`", "above 0"]),
        ("half_extents = [5, 0.5, 5]", "radius = 1", 23, &["`radius` is no key of a cuboid"]),
        (", half_extents = [5, 0.5, 5]", "", 23, &["`half_extents` is missing"]),
        ("friction = 0.5", "friction = -1", 24, &["`friction`", "at least 0"]),
        ("opacity = 0.5", "opacity = 2", 25, &["`opacity`", "from 0 to 1"]),
        ("rock.obj", "rok.obj", 27, &["obstacle 1, shape: `file`", "meshes/rok.obj"]),
        ("scale = 2,", "scale = 0,", 27, &["`scale`", "above 0"]),
        ("max_parts = 8", "max_parts = 0", 27, &["`max_parts`", "at least 1"]),
        ("max_parts = 8", "max_parts = -1", 27, &["invalid"]),
        (", [1, 0, 0]]", "]", 28, &["`points`", "at least two"]),
        ("period = 4.0", "period = 0", 28, &["`period`", "above 0"]),
        ("\"ping-pong\"", "\"pingpong\"", 28, &["`pingpong`", "did you mean `ping-pong`?"]),
        ("axis = [0, 2, 0]", "axis = [0, 0, 0]", 29, &["`axis`", "no length"]),
        ("second = 90", "second = inf", 29, &["`degrees_per_second`", "finite"]),
        ("radius = 0.5 }", "radius = -0.5 }", 31, &["obstacle 2, shape: `radius`", "-0.5"]),
    ];
    for (from, to, line, words) in table {
        assert!(GOOD.contains(from), "{from}");
        let message = load(&GOOD.replacen(from, to, 1)).map(drop).expect_err(to).to_string();
        assert!(message.contains(&format!("scene.toml:{line}: ")), "{to}: {message}");
        assert!(words.iter().all(|w| message.contains(w)) && !message.contains('\n'), "{to}: {message}");
    }
}
