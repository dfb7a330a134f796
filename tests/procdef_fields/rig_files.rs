//! Rig files: read, written, and told what is wrong with them.

use std::fs;
use std::path::Path;

use pliant::mesh::{TetrahedralFormat, write_tetrahedral};
use pliant::procdef::{
    AttachmentDescription, ChartsDescription, ContactDescription, GroundDescription, PaintDescription,
    RegionDescription, RigDescription, SectionDescription, StimulusDescription, StrokeDescription, WaterDescription,
    load_motion_rig, write_motion_rig,
};

use crate::meshes::bar;

/// A folder with a bar of 4 × 1 × 1 m and a rig file of it.
fn folder(rig: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write_tetrahedral(folder.path().join("bar.mesh"), &bar([8, 2, 2], 0.5), TetrahedralFormat::Medit).unwrap();
    fs::write(folder.path().join("rig.toml"), rig).unwrap();
    folder
}

fn error(rig: &str) -> String {
    load_motion_rig(folder(rig).path().join("rig.toml")).expect_err(rig).to_string()
}

/// A description that uses every key.
fn everything() -> RigDescription {
    let plain = PaintDescription::default;
    let region = RegionDescription { seed: [2.0, 1.0, 0.5], angle_degrees: 30.0 };
    let section =
        SectionDescription { origin: [0.1, 0.0, 0.0], normal: [1.0, 0.0, 0.0], stroke: vec![[0.1, 0.5, 0.3]] };
    RigDescription {
        mesh: "bar.mesh".into(),
        density: Some(1050.1),
        stiffness: Some(0.3),
        damping: Some(2.5),
        keep_volume: Some(true),
        least_volume: Some(0.05),
        colour: Some([0.1, 0.2, 0.7]),
        charts: Some(ChartsDescription {
            cycle: 1.7,
            limit: Some(1.5),
            volume: Some("free".into()),
            interpolation: Some("smooth".into()),
            speed: Some(-0.7),
            rise: Some(0.4),
            primary: vec![[0.0, 1.0], [0.3, 0.7]],
            secondary: Some(vec![[0.1, 1.2]]),
            tertiary: Some(vec![[0.0, 1.1], [0.9, 0.9]]),
        }),
        stimulus: Some(StimulusDescription {
            speed: 1.3,
            damping: 2.0,
            threshold: Some(0.1),
            refractory: Some(0.7),
            charts: Some(ChartsDescription { cycle: 0.6, primary: vec![[0.0, 1.0], [0.5, 0.5]], ..Default::default() }),
        }),
        contact: Some(ContactDescription { friction: 0.4, self_contact: true, vertices: true }),
        water: Some(WaterDescription { density: 1000.0, normal_drag: 1.1, tangential_drag: 0.01 }),
        ground: Some(GroundDescription { direction: [1.0, 0.0, 0.0], forward: 0.1, backward: 0.9, sideways: 0.5 }),
        layer: vec![
            PaintDescription { value: 0.0, region: Some(region), ..plain() },
            PaintDescription { value: 1.0, stroke: Some(vec![[0.1, 0.0, 0.5], [3.9, 0.0, 0.5]]), ..plain() },
        ],
        direction: vec![StrokeDescription { layer: Some(0.5), stroke: vec![[0.3, 0.5, 0.5], [3.1, 0.5, 0.5]] }],
        amplitude: vec![PaintDescription { value: -0.3, face: Some(7), ..plain() }],
        phase: vec![PaintDescription { value: 0.25, section: Some(section), ..plain() }],
        attachment: vec![AttachmentDescription {
            name: "shell".into(),
            mass: Some(3.0),
            centre: [1.0, 1.0, 0.5],
            radius: 0.6,
            colour: Some([0.3, 0.3, 0.3]),
            ..Default::default()
        }],
        ..RigDescription::default()
    }
}

#[test]
fn what_is_written_is_read_again() {
    let folder = folder("");
    let path = folder.path().join("rig.toml");
    write_motion_rig(&path, &everything()).unwrap();
    let read = load_motion_rig(&path).unwrap();
    assert_eq!(read.description, everything());
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("density = 1050.1\n"), "numbers are written as they were typed: {text}");
    write_motion_rig(&path, &read.description).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    // What it says has come to the motion.
    let motion = &read.built.motion;
    assert_eq!((motion.cyclic().unwrap().speed, motion.cyclic().unwrap().rise), (-0.7, 0.4));
    assert_eq!(motion.cyclic().unwrap().charts.at(0.3)[0], 0.7);
    assert_eq!(motion.response().unwrap().charts.cycle, 0.6);
    assert_eq!(read.built.trigger.unwrap().threshold, 0.1);
    assert!(motion.fields().amplitude.iter().all(|a| (*a + 0.3).abs() < 1e-4));
    assert!(read.built.layers.is_some());
}

#[test]
fn the_smallest_rig_is_three_lines_and_rests() {
    let folder = folder("mesh = \"bar.mesh\"\ndensity = 1000.0\n");
    let read = load_motion_rig(folder.path().join("rig.toml")).unwrap();
    assert!(read.built.motion.cyclic().is_none() && read.built.motion.response().is_none());
}

#[test]
fn every_fault_is_told_with_its_line_and_key() {
    let head = "mesh = \"bar.mesh\"\ndensity = 1000.0\n";
    let charts = "[charts]\ncycle = 1.0\nprimary = [[0.0, 1.0]]\n";
    let cases: &[(String, &str)] = &[
        (String::new(), "rig.toml:1: the key `mesh` is missing here"),
        ("mesh = \"bar.mesh\"\ndencity = 1.0\n".into(), "rig.toml:2: unknown key `dencity`, did you mean `density`?"),
        ("mesh = \"none.mesh\"\ndensity = 1.0\n".into(), "none.mesh"),
        ("mesh = \"bar.mesh\"\n".into(), "needs one of `mass` and `density` and has neither"),
        (format!("{head}mass = 3.0\n"), "rig.toml:2: `density` needs one of `mass` and `density` and has both"),
        (format!("{head}cell_size = 0.1\n"), "rig.toml:3: `cell_size` is for a closed surface"),
        (format!("{head}iterations = 0\n"), "rig.toml:3: `iterations` must be from 1 to 64 and is 0"),
        (format!("{head}iterations = 2\nstiffness = 0.5\n"), "rig.toml:4: `stiffness` and `iterations` are two ways"),
        (format!("{head}damping = -1.0\n"), "rig.toml:3: `damping` must be"),
        (format!("{head}least_volume = 1.5\n"), "rig.toml:3: `least_volume` must be from 0 to 1 and is 1.5"),
        (format!("{head}colour = [0.0, 2.0, 0.0]\n"), "rig.toml:3: `colour` must be from 0 to 1 and is 2"),
        (format!("{head}\n[[layer]]\nvalue = 0.5\n"), "rig.toml:4: layer 0: needs one of `face`"),
        (format!("{head}[[layer]]\nvalue = 0.5\nface = 3\nstroke = [[0.0, 0.0, 0.0]]\n"), "and has 2"),
        (format!("{head}[[layer]]\nvalue = 0.5\nface = 999\n"), "rig.toml:5: layer 0: `face` is triangle 999"),
        (
            format!("{head}[[layer]]\nvalue = 1.5\nface = 3\n"),
            "rig.toml:4: layer 0: `value` must be from 0 to 1 and is 1.5",
        ),
        (
            format!("{head}[[amplitude]]\nvalue = -1.5\nface = 3\n"),
            "rig.toml:4: amplitude 0: `value` must be from -1 to 1",
        ),
        (
            format!(
                "{head}[[phase]]\nvalue = 0.0\nface = 1\n[[phase]]\nvalue = 1.0\nstroke = [[0.0, 9.0, 0.0]]\n{charts}speed = 1.0\n"
            ),
            "rig.toml:8: phase 1: `stroke` has point 0 at [0.0, 9.0, 0.0], which is 8 m away from the surface",
        ),
        (
            format!(
                "{head}[[layer]]\nvalue = 0.0\nsection = {{ origin = [9.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0] }}\n"
            ),
            "rig.toml:5: layer 0: `section` does not cut the body",
        ),
        (
            format!("{head}[[direction]]\nstroke = [[0.0, 0.0, 0.0]]\n"),
            "rig.toml:4: direction 0: `stroke` needs at least 2",
        ),
        (
            format!("{head}[[direction]]\nlayer = 0.5\nstroke = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\n"),
            "rig.toml:4: direction 0: `layer` is 0.5; layers go from 0 to 1",
        ),
        (
            format!("{head}[charts]\ncycle = 0.0\nprimary = [[0.0, 1.0]]\n"),
            "rig.toml:4: charts: `cycle` the cycle takes 0 s",
        ),
        (format!("{head}{charts}limit = 0.5\n"), "rig.toml:6: charts: `limit` the largest rate is 0.5"),
        (format!("{head}{charts}volume = \"boht\"\n"), "rig.toml:6: charts: `volume` is `boht`, did you mean `both`?"),
        (
            format!("{head}{charts}interpolation = \"x\"\n"),
            "rig.toml:6: charts: `interpolation` is `x`; there are: linear, smooth",
        ),
        (
            format!("{head}{charts}secondary = [[0.0, 1.0]]\n"),
            "rig.toml:6: charts: `secondary` follows from the primary chart",
        ),
        (format!("{head}{charts}rise = -0.5\n"), "rig.toml:6: charts: `rise` must be from 0 to 1e6 s and is -0.5"),
        (format!("{head}{charts}speed = 0.0\n"), "the propagation speed is 0"),
        (
            format!("{head}[charts]\ncycle = 1.0\nprimary = [[0.0, 3.0]]\n"),
            "rig.toml:5: charts: `primary` primary chart: control point 0",
        ),
        (
            format!("{head}[charts]\ncycle = 1.0\nprimary = []\n"),
            "rig.toml:5: charts: `primary` primary chart: a chart needs",
        ),
        (
            format!("{head}{charts}[[phase]]\nvalue = 1.0\nface = 3\n"),
            "rig.toml:3: charts: `speed` is missing, but phases are painted",
        ),
        (format!("{head}[stimulus]\nspeed = 1.0\ndamping = 2.0\n"), "rig.toml:3: stimulus: has no `charts`"),
        (format!("{head}[stimulus]\nspeed = 1.0\ndamping = 0.5\n"), "rig.toml:5: stimulus: `damping` must be from 1"),
        (
            format!(
                "{head}[stimulus]\nspeed = 1.0\ndamping = 2.0\n[stimulus.charts]\ncycle = 1.0\nprimary = [[0.0, 1.0]]\nspeed = 1.0\n"
            ),
            "rig.toml:9: stimulus: charts: `speed` belongs to the stimulus itself",
        ),
        (
            format!(
                "{head}[stimulus]\nspeed = 1.0\ndamping = 2.0\n[stimulus.charts]\ncycle = 1.0\nprimary = [[0.0, 1.0]]\nrise = 1.0\n"
            ),
            "rig.toml:9: stimulus: charts: `rise` is for the cycle",
        ),
        (format!("{head}[contact]\nfriction = -1.0\n"), "rig.toml:4: contact: `friction` must be"),
        (
            format!("{head}[ground]\ndirection = [0.0, 0.0, 0.0]\nforward = 0.1\nbackward = 0.1\nsideways = 0.1\n"),
            "rig.toml:4: ground: `direction` must be",
        ),
        (
            format!("{head}[water]\ndensity = 1.0\nnormal_drag = nan\ntangential_drag = 0.0\n"),
            "rig.toml:5: water: `normal_drag`",
        ),
        (
            format!("{head}[[attachment]]\nname = \"a\"\ncentre = [0.0, 5.0, 0.0]\nradius = 0.1\n"),
            "rig.toml:6: attachment 0: `radius` holds no vertex of the body; the nearest is 4 m away",
        ),
        (
            format!("{head}[[attachment]]\nname = \"\"\ncentre = [0.0, 0.0, 0.0]\nradius = 0.1\n"),
            "rig.toml:4: attachment 0: `name` is empty",
        ),
        (format!("{head}skin = \"none.obj\"\n"), "rig.toml:3: `skin` cannot be used"),
        ("mesh = \"bar.stl\"\ndensity = 1.0\n".into(), "rig.toml:1: `mesh` cannot be used"),
        ("mesh = \"\"\ndensity = 1.0\n".into(), "rig.toml:1: `mesh` cannot be used"),
        ("mesh = 3\ndensity = 1.0\n".into(), "rig.toml:1: "),
        ("mesh = \"bar.mesh\"\ndensity = \"heavy\"\n".into(), "rig.toml:2: "),
        ("mesh = \"bar.mesh\"\ndensity = 0.0\n".into(), "rig.toml:2: `density` must be"),
        ("mesh = \"bar.mesh\"\ndensity = inf\n".into(), "rig.toml:2: `density` must be"),
        ("mesh = \"bar.mesh\"\nmass = -1.0\n".into(), "rig.toml:2: `mass` must be"),
        ("mesh = \"bar.mesh\"\nmass = 1.0\nmass = 2.0\n".into(), "rig.toml:3: "),
        ("mesh = \"bar.mesh\"\ndensity = 1.0\n[charts\n".into(), "rig.toml:3: "),
        (format!("{head}iterations = 65\n"), "rig.toml:3: `iterations` must be from 1 to 64 and is 65"),
        (format!("{head}iterations = 2.5\n"), "rig.toml:3: "),
        (format!("{head}iterations = -2\n"), "rig.toml:3: "),
        (format!("{head}stiffness = nan\n"), "rig.toml:3: `stiffness` must be from 0 to 1 and is NaN"),
        (format!("{head}stiffness = 1.01\n"), "rig.toml:3: `stiffness` must be from 0 to 1"),
        (format!("{head}damping = inf\n"), "rig.toml:3: `damping` must be"),
        (format!("{head}keep_volume = 1\n"), "rig.toml:3: "),
        (format!("{head}colour = [0.1, 0.2]\n"), "rig.toml:3: "),
        (format!("{head}[contact]\nfriction = 0.1\nself_contacts = true\n"), "did you mean `self_contact`?"),
        (format!("{head}[contact]\nself_contact = true\n"), "rig.toml:3: "),
        (
            format!("{head}[stimulus]\nspeed = 0.0\ndamping = 2.0\n{charts}"),
            "rig.toml:4: stimulus: `speed` must be from 1e-3",
        ),
        (
            format!("{head}[stimulus]\nspeed = 1.0\ndamping = 2.0\nthreshold = -0.1\n{charts}"),
            "rig.toml:6: stimulus: `threshold` must be",
        ),
        (
            format!("{head}[stimulus]\nspeed = 1.0\ndamping = 2.0\nrefractory = nan\n{charts}"),
            "rig.toml:6: stimulus: `refractory` must be",
        ),
        (format!("{head}[charts]\ncycle = 1.0\n"), "rig.toml:3: the key `primary` is missing"),
        (format!("{head}[charts]\ncycle = 1.0\nprimary = [[0.0]]\n"), "rig.toml:5: "),
        (
            format!("{head}[charts]\ncycle = 1.0\nprimary = [[0.5, 1.0], [0.2, 1.0]]\n"),
            "rig.toml:5: charts: `primary` primary chart: control point 1",
        ),
        (
            format!("{head}[charts]\ncycle = 1.0\nprimary = [[nan, 1.0]]\n"),
            "rig.toml:5: charts: `primary` primary chart: control point 0",
        ),
        (
            format!("{head}[[layer]]\nvalue = 0.0\nregion = {{ seed = [9.0, 0.0, 0.0], angle_degrees = 30.0 }}\n"),
            "rig.toml:5: layer 0: `region`",
        ),
        (
            format!("{head}[[layer]]\nvalue = 0.0\nregion = {{ seed = [nan, 0.0, 0.0], angle_degrees = 30.0 }}\n"),
            "rig.toml:5: layer 0: `region`",
        ),
        (format!("{head}[[layer]]\nvalue = 0.0\nface = -1\n"), "rig.toml:5: "),
        (format!("{head}[[layer]]\nvalue = nan\nface = 1\n"), "rig.toml:4: layer 0: `value` must be from 0 to 1"),
        (format!("{head}[[layer]]\nvalue = 0.0\nstroke = []\n"), "rig.toml:5: layer 0: `stroke`"),
        (
            format!(
                "{head}[[layer]]\nvalue = 0.0\nsection = {{ origin = [1.0, 0.0, 0.0], normal = [0.0, 0.0, 0.0] }}\n"
            ),
            "rig.toml:5: layer 0: `section`",
        ),
        (
            format!("{head}[water]\ndensity = -1.0\nnormal_drag = 1.0\ntangential_drag = 0.0\n"),
            "rig.toml:4: water: `density`",
        ),
        (
            format!("{head}[ground]\ndirection = [1.0, 0.0, 0.0]\nforward = 0.1\nbackward = -0.1\nsideways = 0.1\n"),
            "rig.toml:6: ground: `backward` must be",
        ),
        (
            format!("{head}[[attachment]]\nname = \"a\"\ncentre = [1.0, 0.5, 0.5]\nradius = -0.6\n"),
            "rig.toml:6: attachment 0: `radius` must be",
        ),
        (
            format!("{head}[[attachment]]\nname = \"a\"\ncentre = [inf, 0.5, 0.5]\nradius = 0.6\n"),
            "rig.toml:5: attachment 0: `centre` must be finite",
        ),
        (
            format!("{head}[[attachment]]\nname = \"a\"\nmesh = \"no.obj\"\ncentre = [1.0, 0.5, 0.5]\nradius = 0.6\n"),
            "rig.toml:5: attachment 0: `mesh` cannot be used",
        ),
        (
            format!(
                "{head}[[attachment]]\nname = \"a\"\ncentre = [1.0, 0.5, 0.5]\nradius = 0.6\n[[attachment]]\nname = \"a\"\ncentre = [1.0, 0.5, 0.5]\nradius = 0.6\n"
            ),
            "rig.toml:8: attachment 1: `name` is empty or the name of an earlier",
        ),
    ];
    let mut failed = Vec::new();
    for (text, expected) in cases {
        let message = error(text);
        if !message.contains(expected) || message.contains('\n') {
            failed.push(format!("{text}\n{message}\nshould contain {expected}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

#[test]
fn what_is_no_rig_file_and_skins_with_faults_are_told_with_file_and_line() {
    let folder = folder("mesh = \"bar.mesh\"\ndensity = 1000.0\nskin = \"skin.obj\"\n");
    let folder = folder.path();
    let message = |name: &str| load_motion_rig(folder.join(name)).expect_err(name).to_string();
    assert!(message("none.toml").contains("none.toml: "));
    fs::create_dir(folder.join("folder.toml")).unwrap();
    assert!(message("folder.toml").contains("folder.toml: "));
    fs::write(folder.join("latin.toml"), b"mesh = \"caf\xe9.mesh\"\n").unwrap();
    assert!(message("latin.toml").contains("latin.toml"), "{}", message("latin.toml"));
    for (skin, told) in [
        ("", "skin.obj:1: "),
        ("v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", "skin.obj:3: "),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "skin.obj:4: "),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "skin.obj:4: "),
    ] {
        fs::write(folder.join("skin.obj"), skin).unwrap();
        let message = message("rig.toml");
        assert!(message.contains("rig.toml:3: `skin` cannot be used: ") && message.contains(told), "{message}");
    }
}

#[test]
fn a_wrong_cell_of_the_mesh_is_told_with_file_and_line() {
    let folder = folder("mesh = \"bad.mesh\"\ndensity = 1000.0\n");
    let mesh = "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 9 0\nEnd\n";
    fs::write(folder.path().join("bad.mesh"), mesh).unwrap();
    let message = load_motion_rig(folder.path().join("rig.toml")).unwrap_err().to_string();
    assert!(message.contains("rig.toml:1: `mesh` cannot be used") && message.contains("bad.mesh:11: "), "{message}");
}

#[test]
fn a_closed_surface_is_filled_with_cells() {
    let folder = folder("mesh = \"ball.obj\"\ncell_size = 0.15\ndensity = 1000.0\n");
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/meshes/ball.obj"), folder.path().join("ball.obj"))
        .unwrap();
    let read = load_motion_rig(folder.path().join("rig.toml")).unwrap();
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
    // The boundary follows the surface to a few percent of the radius.
    assert!((read.mesh.volume() - exact).abs() < 0.06 * exact, "{}", read.mesh.volume());
    // Without a size the largest cells are taken that follow the surface.
    fs::write(folder.path().join("rig.toml"), "mesh = \"ball.obj\"\ndensity = 1000.0\n").unwrap();
    let chosen = load_motion_rig(folder.path().join("rig.toml")).unwrap();
    assert!((chosen.mesh.volume() - exact).abs() < 0.03 * exact, "{}", chosen.mesh.volume());
}

#[test]
fn cells_that_do_not_follow_their_surface_are_refused_with_the_distance() {
    let folder = folder("mesh = \"needle.obj\"\ncell_size = 0.5\ndensity = 1000.0\n");
    // A box of 1 m with a needle on it, much thinner than the cells.
    let needle = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n\
                v 0.5 1 0.47\nv 0.53 1 0.5\nv 0.5 1 0.53\nv 0.47 1 0.5\nv 0.5 2.5 0.5\n\
                f 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n\
                f 5 9 6\nf 6 9 10\nf 6 10 7\nf 7 10 11\nf 7 11 8\nf 8 11 12\nf 8 12 5\nf 5 12 9\n\
                f 9 13 10\nf 10 13 11\nf 11 13 12\nf 12 13 9\n";
    fs::write(folder.path().join("needle.obj"), needle).unwrap();
    let message = load_motion_rig(folder.path().join("rig.toml")).unwrap_err().to_string();
    let expected = ["rig.toml:2: `cell_size` cannot be used: cells of 0.5 m are up to 0.14", "where 2 % are allowed"];
    assert!(expected.iter().all(|part| message.contains(part)), "{message}");
}
