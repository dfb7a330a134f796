//! Tests of rig files: a good one, and a table of bad ones with the line and the words of each complaint.

use super::*;
use crate::elastic::rest_pose;
use std::fs;

/// Two cubes' worth of a box, 2 m long along x, closed and outward.
const BOX: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// Lines are counted in the table below.
const GOOD: &str = r#"mesh = "meshes/box.obj"
softness = 1.5
local_threshold = 0.25
[contact]
frequency = 4.0
damping_ratio = 0.5
friction = 0.7
[[segment]]
name = "torso"
bone = [[0, 0.5, 0.5], [1.0, 0.5, 0.5]]
shape = { kind = "capsule", radius = 0.4 }
mass = 20.0
[[segment]]
name = "neck"
bone = [[1.0, 0.5, 0.5], [2.0, 0.5, 0.5]]
shape = { kind = "cuboid", half_extents = [0.4, 0.4, 0.5] }
density = 1000
[[joint]]
parent = "torso"
child = "neck"
anchor = [1.0, 0.5, 0.5]
limit_degrees = 40.0
frequency = 2.0
damping_ratio = 0.7
[[mass_spring_set]]
segment = "torso"
anchor = [0, 1.0, 0]
radius = 0.6
frequency = 2.5
damping_ratio = 0.15
[[mass_spring_set]]
segment = "neck"
anchor = [2, 1.0, 0]
radius = 0.2
mass = 2.0
stiffness = 800.0
damping = 8.0
"#;

fn load(rig: &str, mesh: &str) -> Result<ElasticRig, RigError> {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    fs::write(folder.path().join("meshes/box.obj"), mesh).unwrap();
    let path = folder.path().join("rig.toml");
    fs::write(&path, rig).unwrap();
    load_rig(path)
}

#[test]
fn a_good_rig_is_read_whole() {
    let rig = load(GOOD, BOX).unwrap();
    assert_eq!((rig.softness, rig.local_threshold), (1.5, 0.25));
    assert_eq!(rig.contact, ContactSettings { spring: SpringCoefficients::new(4.0, 0.5), friction: 0.7 });
    assert_eq!(rig.segments[0].mass, SegmentMass::Mass(20.0));
    assert_eq!(rig.segments[1].shape, SegmentShape::Cuboid { half_extents: Vec3::new(0.4, 0.4, 0.5) });
    assert_eq!((rig.joints[0].parent, rig.joints[0].child), (0, 1));
    assert!((rig.joints[0].limit.unwrap() - 40f32.to_radians()).abs() < 1e-6);
    assert!((rig.sets[1].spring.angular_frequency() - 20.0).abs() < 1e-4 && rig.sets[1].segment == 1);
    assert!((rig.sets[1].spring.damping_ratio - 0.1).abs() < 1e-6);
    assert_eq!(rig.weights.len(), rig.mesh.positions.len());
    assert_eq!(rig.rest_poses.len(), 2);
}

#[test]
fn what_is_left_out_gets_its_default() {
    let short: String = GOOD.lines().take(1).chain(GOOD.lines().skip(7).take(5)).map(|l| format!("{l}\n")).collect();
    let rig = load(&short, BOX).unwrap();
    assert_eq!((rig.softness, rig.contact), (1.2, ContactSettings::default()));
    assert!((rig.local_threshold - 0.5 * rig.mesh.size()).abs() < 1e-6);
    assert!(rig.joints.is_empty() && rig.sets.is_empty());
}

#[test]
fn frames_sit_in_the_middle_of_the_bone_with_z_along_it() {
    for end in [Vec3::X, -Vec3::Z, Vec3::Z, Vec3::new(1.0, -2.0, 0.5)] {
        let frame = rest_pose([Vec3::ONE, Vec3::ONE + 2.0 * end]);
        assert!((frame.transform_point(Vec3::Z * end.length()) - (Vec3::ONE + 2.0 * end)).length() < 1e-5);
        assert!((frame.transform_point(Vec3::ZERO) - (Vec3::ONE + end)).length() < 1e-6);
    }
    assert_eq!(rest_pose([Vec3::X; 2]).transform_vector(Vec3::Y), Vec3::Y);
}

#[test]
fn bad_rigs_are_refused_with_their_line_and_a_hint() {
    // What to replace in the good rig, the line of the complaint, words of it.
    let table: &[(&str, &str, usize, &[&str])] = &[
        ("density = 1000", "dencity = 1000", 17, &["unknown key `dencity`", "did you mean `density`?"]),
        ("softness", "sofness", 2, &["unknown key `sofness`", "`softness`"]),
        ("radius = 0.4 }", "radios = 0.4 }", 11, &["unknown key `radios`", "`radius`"]),
        ("mesh = \"meshes/box.obj\"", "", 1, &["`mesh` is missing"]),
        ("mesh = \"meshes/box.obj\"", "mesh = 3", 1, &["invalid type"]),
        ("name = \"neck\"", "", 13, &["`name` is missing"]),
        ("mass = 20.0", "mass = \"heavy\"", 12, &["invalid type", "heavy"]),
        ("mass = 20.0", "mass = ", 12, &[]),
        ("mass = 20.0", "mass = 0", 12, &["`mass`", "above 0", "is 0"]),
        ("mass = 20.0", "mass = -2.5", 12, &["segment 0", "`mass`", "-2.5"]),
        ("mass = 20.0", "mass = nan", 12, &["`mass`", "finite"]),
        ("mass = 20.0", "mass = 1e300", 12, &["`mass`", "finite"]),
        ("mass = 20.0", "mass = 2.0\ndensity = 1", 13, &["exactly one", "both"]),
        ("mass = 20.0", "", 8, &["exactly one", "neither"]),
        ("density = 1000", "density = -1", 17, &["`density`", "above 0"]),
        ("radius = 0.4 }", "radius = -0.4 }", 11, &["`radius`", "-0.4"]),
        ("radius = 0.4 }", "half_extents = [1, 1, 1] }", 11, &["capsule", "has no `half_extents`"]),
        (", radius = 0.4 }", "}", 11, &["capsule", "needs `radius`"]),
        ("[0.4, 0.4, 0.5]", "[0.4, 0, 0.5]", 16, &["`half_extents`", "above 0"]),
        ("[0.4, 0.4, 0.5]", "[0.4, 0.5]", 16, &["length"]),
        ("\"capsule\"", "\"capsul\"", 11, &["no known shape", "`capsul`", "did you mean `capsule`?"]),
        ("[[0, 0.5, 0.5], [1.0, 0.5, 0.5]]", "[[1, 1, 1], [1, 1, 1]]", 10, &["`bone`", "no length"]),
        ("[[0, 0.5, 0.5]", "[[inf, 0.5, 0.5]", 10, &["`bone`", "finite"]),
        ("name = \"neck\"", "name = \"torso\"", 14, &["`torso`", "segment 0 too"]),
        ("name = \"neck\"", "name = \" \"", 14, &["`name` is empty"]),
        ("name = \"torso\"", "name = \"\"", 9, &["`name` is empty"]),
        ("parent = \"torso\"", "parent = \"torsoo\"", 19, &["`torsoo`", "did you mean `torso`?"]),
        ("child = \"neck\"", "child = \"tail\"", 20, &["names no segment", "torso, neck"]),
        ("child = \"neck\"", "child = \"torso\"", 20, &["is the parent too"]),
        ("segment = \"torso\"", "segment = \"torsi\"", 26, &["`torsi`", "`torso`"]),
        ("anchor = [1.0, 0.5, 0.5]", "anchor = [nan, 0, 0]", 21, &["`anchor`", "finite"]),
        ("limit_degrees = 40.0", "limit_degrees = 190", 22, &["`limit_degrees`", "at most 180"]),
        ("frequency = 2.0", "frequency = 0", 23, &["`frequency`", "1000 Hz"]),
        ("frequency = 2.0", "frequency = 1001", 23, &["`frequency`", "1001"]),
        ("damping_ratio = 0.7", "damping_ratio = -1", 24, &["`damping_ratio`", "at least 0"]),
        ("frequency = 2.5", "frequency = inf", 29, &["mass-spring set 0", "`frequency`"]),
        ("radius = 0.6", "radius = 0", 28, &["`radius`", "above 0"]),
        ("anchor = [0, 1.0, 0]", "anchor = [0, -inf, 0]", 27, &["`anchor`", "finite"]),
        ("stiffness = 800.0\n", "", 31, &["either `frequency`", "`stiffness`"]),
        ("frequency = 2.5", "frequency = 2.5\nmass = 1", 25, &["either `frequency`"]),
        ("stiffness = 800.0", "stiffness = 0", 36, &["`stiffness`", "above 0"]),
        ("mass = 2.0\n", "mass = -1\n", 35, &["`mass`", "above 0"]),
        ("damping = 8.0", "damping = -8.0", 37, &["`damping`", "at least 0"]),
        ("stiffness = 800.0", "stiffness = 1e12", 31, &["`frequency`", "1000 Hz"]),
        ("friction = 0.7", "friction = -0.1", 7, &["contact", "`friction`", "-0.1"]),
        ("damping_ratio = 0.5", "restitution = 1.5", 6, &["contact", "`restitution`", "from 0 to 1"]),
        ("damping_ratio = 0.5", "damping_ratio = 0.5\nrestitution = 0.5", 7, &["`restitution`", "`damping_ratio`"]),
        ("frequency = 4.0", "frequency = 0", 5, &["contact", "`frequency`"]),
        ("softness = 1.5", "softness = 0", 2, &["`softness`", "at most 10"]),
        ("softness = 1.5", "softness = 11", 2, &["`softness`", "11"]),
        ("local_threshold = 0.25", "local_threshold = -1", 3, &["`local_threshold`"]),
        ("box.obj", "camel.obj", 1, &["`mesh`", "meshes/camel.obj", "no such file"]),
        ("meshes/box.obj", "meshes", 1, &["meshes", "not a file"]),
        (
            "damping_ratio = 0.7\n",
            "damping_ratio = 0.7\n[[joint]]\nparent = \"neck\"\nchild = \"torso\"\nanchor = [0,0,0]\nfrequency = 1\ndamping_ratio = 1\n",
            27,
            &["cycle", "`neck`", "`torso`"],
        ),
        (
            "damping_ratio = 0.7\n",
            "damping_ratio = 0.7\n[[joint]]\nparent = \"torso\"\nchild = \"neck\"\nanchor = [0,0,0]\nfrequency = 1\ndamping_ratio = 1\n",
            27,
            &["`neck` already has a parent", "joint 0"],
        ),
        (
            "[[joint]]",
            "[[segment]]\nname = \"tail\"\nbone = [[0,0,0],[0,0,0]]\nshape = { kind = \"ball\", radius = 0.1 }\nmass = 1\n[[joint]]",
            19,
            &["`tail` is not connected with `torso`"],
        ),
    ];
    for (from, to, line, words) in table {
        assert!(GOOD.contains(from), "{from}");
        let message = load(&GOOD.replacen(from, to, 1), BOX).map(drop).expect_err(to).to_string();
        assert!(message.contains(&format!("rig.toml:{line}: ")), "{to}: {message}");
        assert!(words.iter().all(|w| message.contains(w)) && !message.contains('\n'), "{to}: {message}");
    }
}

#[test]
fn contacts_may_be_given_by_their_restitution() {
    let rig = load(&GOOD.replacen("damping_ratio = 0.5", "restitution = 0.8", 1), BOX).unwrap();
    assert!((rig.contact.restitution() - 0.8).abs() < 1e-5);
    assert_eq!((rig.contact.spring.natural_frequency, rig.contact.friction), (4.0, 0.7));
}

#[test]
fn meshes_that_enclose_nothing_are_refused_at_the_line_that_names_them() {
    let open = BOX.replace("f 4 1 5 8\n", "");
    let turned = BOX.replace("f 4 1 5 8", "f 8 5 1 4");
    let inward: String = BOX
        .lines()
        .map(|l| match l.strip_prefix("f ") {
            Some(f) => format!("f {}\n", f.split(' ').rev().collect::<Vec<_>>().join(" ")),
            None => format!("{l}\n"),
        })
        .collect();
    let table: &[(&str, &[&str])] = &[
        (&open, &["is open: 4 edges", "vertex", "close the holes"]),
        (&turned, &["opposite ways along 4 edges"]),
        (&inward, &["faces inward", "flip the normals"]),
        ("v 0 0 nan\n", &["box.obj:1: `nan`"]),
        ("", &["box.obj:1: the file is empty"]),
    ];
    for (mesh, words) in table {
        let message = load(GOOD, mesh).map(drop).unwrap_err().to_string();
        assert!(message.contains("rig.toml:1: `mesh` "), "{message}");
        assert!(words.iter().all(|w| message.contains(w)), "{message}");
    }
}

#[test]
fn a_rig_without_segments_and_files_that_are_no_rig_are_refused() {
    let message = |text: &str| load(text, BOX).map(drop).unwrap_err().to_string();
    assert!(message("mesh = \"meshes/box.obj\"\n").contains("rig.toml:1: the rig has no segments"));
    assert!(message("").contains("rig.toml:1: the key `mesh` is missing"));
    assert!(message("lorem ipsum").contains("rig.toml:1: "));
    assert!(load_rig("/nonexistent/rig.toml").map(drop).unwrap_err().to_string().contains("/nonexistent/rig.toml"));
}
