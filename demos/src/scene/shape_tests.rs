//! Tests of the shapes in scene files: one of each kind, and a table of bad ones with the words of each complaint.

use super::super::{ObstacleMass, load_scene};
use super::*;
use crate::scene::Obstacle;
use std::fs;

/// The obstacle is on line 6, its shape on line 7, further keys from line 8.
fn load(shape: &str, more: &str) -> Result<Obstacle, TomlError> {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "name = \"s\"\nduration = 1\n[camera]\neye = [0, 2, 8]\ntarget = [0, 0, 0]\n[[obstacle]]\nshape = {{ {shape} }}\n{more}\n"
    );
    fs::write(folder.path().join("rock.obj"), "").unwrap();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    load_scene(folder.path().join("scene.toml")).map(|mut scene| scene.obstacles.remove(0))
}

#[test]
fn every_kind_of_shape_is_read() {
    let good = [
        "kind = 'ball', radius = 1",
        "kind = 'cuboid', half_extents = [1, 2, 3], rounding = 0.1",
        "kind = 'capsule', half_height = 1, radius = 1",
        "kind = 'cylinder', half_height = 1, radius = 1, rounding = 0.1",
        "kind = 'cone', half_height = 1, radius = 1, rounding = 0",
        "kind = 'ring', radius = 1, thickness = 0.1",
        "kind = 'half_space'",
        "kind = 'half_space', normal = [1, 1, 0]",
        "kind = 'triangle', points = [[0, 0, 0], [1, 0, 0], [0, 0, 1]], rounding = 0.1",
        "kind = 'polyline', points = [[0, 0, 0], [1, 0, 0]]",
        "kind = 'hull', points = [[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, 1, 0]]",
        "kind = 'hull', file = 'rock.obj', scale = 2, rounding = 0.1",
        "kind = 'mesh', file = 'rock.obj', max_parts = 3",
        "kind = 'triangle_mesh', file = 'rock.obj', one_sided = true",
        "kind = 'heightfield', heights = [[0, 1], [1, 0], [0, 0]], size = [4, 5]",
        "kind = 'voxels', voxel_size = 0.1, cells = [[0, 0, 0], [-1, 2, 3]]",
        "kind = 'voxels', voxel_size = 0.1, file = 'rock.obj'",
        "kind = 'compound', shapes = [{ kind = 'ball', radius = 1, position = [0, 1, 0] }, { kind = 'cone', half_height = 1, radius = 1 }]",
    ];
    for shape in good {
        load(shape, "").map(drop).unwrap_or_else(|error| panic!("{shape}: {error}"));
    }
    for (kind, ..) in KINDS {
        assert!(good.iter().any(|shape| shape.contains(&format!("'{kind}'"))), "{kind} is not tried");
    }
    let ObstacleShape::Compound { members } = load(good[17], "").unwrap().shape else { panic!("a compound") };
    assert_eq!(members[0].pose.translation, Vec3::Y);
    assert_eq!(members[1].shape, ObstacleShape::Cone { half_height: 1.0, radius: 1.0, rounding: 0.0 });
}

#[test]
fn bad_shapes_are_refused_with_the_key_at_fault() {
    let bad: &[(&str, &[&str])] = &[
        ("kind = 'heigthfield'", &["`heigthfield`", "did you mean `heightfield`?"]),
        ("kind = 'ball', radius = 1, rounding = 0.1", &["`rounding` is no key of a ball"]),
        ("kind = 'cuboid', half_extents = [1, 1, 1], rounding = -1", &["`rounding`", "-1"]),
        ("kind = 'half_space', normal = [0, 0, 0]", &["`normal` has no length"]),
        ("kind = 'triangle', points = [[0, 0, 0], [1, 0, 0]]", &["`points` needs at least 3 points and has 2"]),
        ("kind = 'triangle', points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1]]", &["must be three"]),
        ("kind = 'polyline', points = [[0, 0, 0], [nan, 0, 0]]", &["`points`", "finite"]),
        ("kind = 'hull'", &["`points` is missing", "or `file`"]),
        ("kind = 'hull', points = [[0, 0, 0]], file = 'rock.obj'", &["`file` is given beside `points`"]),
        ("kind = 'hull', file = 'rok.obj'", &["`file` cannot be opened", "rok.obj"]),
        ("kind = 'triangle_mesh'", &["`file` is missing"]),
        ("kind = 'triangle_mesh', file = 'rock.obj', one_sided = 1", &["expected a boolean"]),
        ("kind = 'heightfield', heights = [[0, 1]], size = [1, 1]", &["`heights` needs at least two rows"]),
        ("kind = 'heightfield', heights = [[0, 1], [0]], size = [1, 1]", &["`heights` has 2", "1 in row 1"]),
        ("kind = 'heightfield', heights = [[0, 1], [0, inf]], size = [1, 1]", &["`heights`", "inf"]),
        ("kind = 'heightfield', heights = [[0, 1], [0, 1]], size = [1, 0]", &["`size`", "above 0"]),
        ("kind = 'heightfield', heights = [[0, 1], [0, 1]]", &["`size` is missing"]),
        ("kind = 'voxels', voxel_size = 0.1", &["`cells` is missing", "or `file`"]),
        ("kind = 'voxels', voxel_size = 0.1, cells = []", &["`cells` is empty"]),
        ("kind = 'voxels', voxel_size = 0, cells = [[0, 0, 0]]", &["`voxel_size`", "above 0"]),
        ("kind = 'voxels', voxel_size = 1, cells = [[0, 0, 99999]]", &["`cells` must lie"]),
        ("kind = 'compound', shapes = []", &["`shapes` is empty"]),
        (
            "kind = 'compound', shapes = [{ kind = 'mesh', file = 'rock.obj' }]",
            &["shapes 0: `kind`", "parts of its own"],
        ),
        ("kind = 'compound', shapes = [{ kind = 'ball' }]", &["shapes 0: `radius` is missing"]),
        ("kind = 'ball', radius = 1, position = [0, 0, 0]", &["`position` is a key of the obstacle"]),
    ];
    for (shape, words) in bad {
        let message = load(shape, "").map(drop).expect_err(shape).to_string();
        assert!(message.contains("scene.toml:7: "), "{shape}: {message}");
        assert!(words.iter().all(|w| message.contains(w)) && !message.contains('\n'), "{shape}: {message}");
    }
}

#[test]
fn a_dynamic_obstacle_has_a_mass_and_a_velocity() {
    let ball = "kind = 'ball', radius = 1";
    let fixed = load(ball, "").unwrap();
    assert!(fixed.is_fixed() && fixed.dynamic.is_none() && fixed.restitution.is_none());
    let moved = load(ball, "dynamic = true\nmass = 3\nvelocity = [1, 0, 0]\nrestitution = 0.5").unwrap();
    let dynamic = moved.dynamic.unwrap();
    assert_eq!((dynamic.mass, dynamic.velocity), (ObstacleMass::Mass(3.0), Vec3::X));
    assert_eq!((moved.restitution, moved.is_fixed(), moved.is_moving()), (Some(0.5), false, false));
    assert!(matches!(load(ball, "dynamic = true").unwrap().dynamic.unwrap().mass, ObstacleMass::Density(d) if d > 0.0));
    let bad: &[(&str, &str, usize, &str)] = &[
        (ball, "mass = 3", 8, "`mass` is a key of dynamic obstacles"),
        (ball, "dynamic = false\nvelocity = [1, 0, 0]", 9, "`velocity` is a key of dynamic obstacles"),
        (ball, "dynamic = true\nmass = 0", 9, "`mass` must be"),
        (ball, "dynamic = true\nmass = 1\ndensity = 1", 10, "`density` is given beside `mass`"),
        (
            ball,
            "dynamic = true\nspin = { axis = [0, 1, 0], degrees_per_second = 1 }",
            9,
            "`spin` is given for a dynamic",
        ),
        (ball, "restitution = 2", 8, "`restitution` must be from 0 to 1"),
        ("kind = 'half_space'", "dynamic = true", 8, "`dynamic` is given for a shape without a volume"),
    ];
    for (shape, more, line, words) in bad {
        let message = load(shape, more).map(drop).expect_err(more).to_string();
        assert!(message.contains(&format!("scene.toml:{line}: ")) && message.contains(words), "{more}: {message}");
    }
}
