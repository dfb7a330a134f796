//! Runs of bodies that move by themselves: their files fit together, and threads change nothing.

use std::fs;
use std::path::Path;

use crate::common::{finish, program, repository, run};
use pliant::mesh::load_obj;
use pliant_demos::output::{SOFT_METRICS_HEADER, read_pc2};

const FRAMES: usize = 90;

#[test]
fn a_run_of_the_snail_writes_skin_shell_and_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let ran = run("snail", &out, &["--no-pictures", "--frames", &FRAMES.to_string()]);
    assert_eq!((ran.code, ran.complained.as_str()), (Some(0), ""));
    let last = ran.said.lines().last().unwrap();
    for word in [
        "90 frames",
        "1 moving by themselves",
        "volume",
        "at most 0 cells inside out",
        "way of all",
        "charts and matching",
    ] {
        assert!(last.contains(word), "{word}: {last}");
    }
    assert!(last.contains("cells at rest with angles of 9.2 to 155.8 degrees"), "{last}");
    let vertices = load_obj(out.join("snail.obj")).unwrap().vertex_count();
    let frames = read_pc2(out.join("snail.pc2")).unwrap().frames;
    assert_eq!((frames.len(), frames[0].len()), (FRAMES, vertices));
    let table = fs::read_to_string(out.join("soft_bodies.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!((rows[0].join(","), rows.len()), (SOFT_METRICS_HEADER.to_owned(), 1 + FRAMES));
    let column = |name: &str| rows[0].iter().position(|n| *n == name).unwrap();
    let value = |frame: usize, name: &str| rows[1 + frame][column(name)].parse::<f32>().unwrap();
    // It is touched after one second: frame 60.
    assert_eq!((value(50, "stimuli"), value(50, "contraction")), (0.0, 0.0));
    assert!(value(80, "stimuli") == 1.0 && value(80, "contraction") < -0.3);
    assert!((0..FRAMES).all(|frame| value(frame, "frozen") == 0.0 && value(frame, "on_ground") < 1000.0));
    // The shell is among the rigid parts, and stays where the snail is.
    let names = |text: &str| text.lines().filter(|line| line.starts_with("o part_")).count();
    let parts = names(&fs::read_to_string(out.join("obstacles.obj")).unwrap());
    let poses = fs::read_to_string(out.join("obstacles.csv")).unwrap();
    assert_eq!((parts, poses.lines().count()), (2, 1 + 2 * FRAMES));
    assert_eq!(fs::read_to_string(out.join("metrics.csv")).unwrap().lines().count(), 1, "no elastic body");
}

/// Vertices of all frames and all measurements but the times.
fn results(folder: &Path, threads: &str) -> (Vec<u8>, Vec<Vec<String>>) {
    let out = folder.join(threads);
    let words = ["run", "worm-crawl", "--headless", "--no-pictures", "--frames", "60", "--out"];
    let ran = finish(program().env("RAYON_NUM_THREADS", threads).args(words).arg(&out));
    assert_eq!(ran.code, Some(0), "{}", ran.complained);
    let table = fs::read_to_string(out.join("soft_bodies.csv")).unwrap();
    let untimed = |row: &str| {
        let mut columns: Vec<String> = row.split(',').map(str::to_owned).collect();
        columns.truncate(columns.len() - 4);
        columns
    };
    (fs::read(out.join("worm.pc2")).unwrap(), table.lines().map(untimed).collect())
}

#[test]
fn one_two_and_four_threads_move_a_worm_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let one = results(folder.path(), "1");
    for threads in ["2", "4"] {
        assert!(results(folder.path(), threads) == one, "{threads} threads");
    }
}

#[test]
fn how_well_cells_fill_a_surface_is_told_at_the_end_of_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
    let ball = repository().join("assets/meshes/ball.obj");
    write("rig.toml", format!("mesh = {:?}\ncell_size = 0.15\ndensity = 1000.0\n", ball.display().to_string()));
    write(
        "scene.toml",
        "name = \"filled\"\nduration = 1.0\ncamera = { eye = [0, 1, 5], target = [0, 0, 0] }\n[[soft_body]]\nname = \"ball\"\nrig = \"rig.toml\"\n"
            .into(),
    );
    let scene = folder.path().join("scene.toml").display().to_string();
    let ran = run(&scene, &folder.path().join("out"), &["--no-pictures", "--frames", "2"]);
    assert_eq!((ran.code, ran.complained.as_str()), (Some(0), ""));
    let last = ran.said.lines().last().unwrap();
    let percent = last.split("degrees, up to ").nth(1).and_then(|rest| rest.split(' ').next()).expect(last);
    assert!((0.01..=2.0).contains(&percent.parse::<f32>().expect(last)), "{last}");
}

#[test]
fn fields_cuts_and_wrong_cuts_are_understood() {
    let folder = tempfile::tempdir().unwrap();
    let ran =
        run("heart", &folder.path().join("a"), &["--frames", "2", "--no-pictures", "--show", "layers", "--cut", "z=0"]);
    assert_eq!((ran.code, ran.complained.as_str()), (Some(0), ""));
    let ran = run("heart", &folder.path().join("b"), &["--frames", "2", "--cut", "w=0"]);
    assert!(ran.code == Some(2) && ran.complained.contains("write it like x=0.1"), "{}", ran.complained);
    let ran = run("heart", &folder.path().join("c"), &["--frames", "2", "--show", "layer"]);
    assert!(ran.code == Some(2) && ran.complained.contains("layers"), "{}", ran.complained);
}
