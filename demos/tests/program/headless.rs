//! A run without a window writes all its files, and they fit together.

use std::collections::BTreeSet;
use std::fs;

use crate::common::{finish, program, run};
use pliant::mesh::load_obj;
use pliant_demos::output::{METRICS_HEADER, OBSTACLES_HEADER, read_pc2};

const FRAMES: usize = 30;

#[test]
fn a_run_of_the_tower_writes_files_that_fit_together() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("deep/er");
    let ran = run("tower", &out, &["--no-pictures", "--frames", &FRAMES.to_string()]);
    assert_eq!((ran.code, ran.complained.as_str()), (Some(0), ""));
    let last = ran.said.lines().last().unwrap();
    for word in ["30 frames", "0.5 s", "depth", "gap", "inside", "volume", "ms a frame", "rest", out.to_str().unwrap()]
    {
        assert!(last.contains(word), "{word}: {last}");
    }

    let vertices = load_obj(out.join("camel.obj")).unwrap().vertex_count();
    let cache = fs::read(out.join("camel.pc2")).unwrap();
    assert_eq!(&cache[..12], b"POINTCACHE2\0");
    assert_eq!(cache[16..20], (vertices as u32).to_le_bytes());
    assert_eq!(cache[28..32], (FRAMES as u32).to_le_bytes());
    assert_eq!(cache.len(), 32 + FRAMES * vertices * 12);
    let height = |frame: &[glam::Vec3]| frame.iter().map(|p| p.y).sum::<f32>() / vertices as f32;
    let frames = read_pc2(out.join("camel.pc2")).unwrap().frames;
    assert!(height(&frames[FRAMES - 1]) < height(&frames[0]) - 0.5, "the camel falls");

    let metrics = fs::read_to_string(out.join("metrics.csv")).unwrap();
    let rows: Vec<&str> = metrics.lines().collect();
    assert_eq!((rows[0], rows.len()), (METRICS_HEADER, 1 + FRAMES));
    assert!(rows[1].starts_with("0,camel,") && rows[FRAMES].starts_with(&format!("{},camel,", FRAMES - 1)));
    let columns = METRICS_HEADER.split(',').count();
    assert!(rows.iter().all(|row| row.split(',').count() == columns));

    let parts = fs::read_to_string(out.join("obstacles.obj")).unwrap();
    let parts: BTreeSet<String> =
        parts.lines().filter_map(|line| line.strip_prefix("o part_")).map(str::to_owned).collect();
    let poses = fs::read_to_string(out.join("obstacles.csv")).unwrap();
    assert_eq!(poses.lines().next(), Some(OBSTACLES_HEADER));
    let placed: BTreeSet<String> = poses.lines().skip(1).map(|row| row.split(',').nth(1).unwrap().to_owned()).collect();
    assert!(parts.len() >= 10, "{parts:?}");
    assert_eq!(parts, placed);
    assert_eq!(poses.lines().count(), 1 + FRAMES * parts.len());
    let left: Vec<_> = fs::read_dir(&out).unwrap().map(|f| f.unwrap().file_name()).collect();
    assert_eq!(left.len(), 5, "nothing else is left: {left:?}");
}

#[test]
fn a_seed_changes_the_start_and_the_same_seed_repeats_it() {
    let folder = tempfile::tempdir().unwrap();
    let cache = |name: &str, seed: &str| {
        let out = folder.path().join(name);
        assert_eq!(run("tower", &out, &["--no-pictures", "--frames", "2", "--seed", seed]).code, Some(0));
        fs::read(out.join("camel.pc2")).unwrap()
    };
    let first = cache("a", "7");
    assert!(first == cache("b", "7"));
    assert!(first != cache("c", "8") && first != cache("d", "0"));
}

#[test]
fn without_words_and_display_the_help_names_the_scenes() {
    let ran = finish(&mut program());
    assert_eq!((ran.code, ran.complained.as_str()), (Some(0), ""));
    assert!(ran.said.contains("Usage") && ran.said.contains("tower"), "{}", ran.said);
}
