//! Pictures of a run, with a device and without one.

use std::fs;
use std::io::Write;
use std::path::Path;

use crate::common::{finish, program, run};
use image::RgbaImage;

const WORDS: [&str; 6] = ["--frames", "31", "--picture-every", "15", "--size", "320x180"];

/// False, with a line about it, where there is no device; that is a failure where `PLIANT_REQUIRE_GPU` is `1`.
fn has_device(complained: &str, test: &str) -> bool {
    let missing = complained.contains("no pictures:");
    assert!(!missing || std::env::var("PLIANT_REQUIRE_GPU").as_deref() != Ok("1"), "{test}: {complained}");
    if missing {
        // Straight to the stream: what is printed by macros shows only in failed tests.
        let _ = writeln!(std::io::stderr(), "skipped {test}: {complained}");
    }
    !missing
}

fn picture(out: &Path, frame: usize) -> RgbaImage {
    image::open(out.join(format!("frame_{frame:04}.png"))).unwrap().into_rgba8()
}

fn mean_difference(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    sum as f64 / a.as_raw().len() as f64
}

#[test]
fn pictures_show_a_falling_camel_the_same_by_both_ways_of_deforming() {
    let folder = tempfile::tempdir().unwrap();
    let [device, memory] = ["device", "memory"].map(|name| folder.path().join(name));
    let ran = run("tower", &device, &WORDS);
    assert_eq!(ran.code, Some(0), "{}", ran.complained);
    if !has_device(&ran.complained, "pictures_show_a_falling_camel_the_same_by_both_ways_of_deforming") {
        return;
    }
    let count = |out: &Path| {
        fs::read_dir(out).unwrap().filter(|f| f.as_ref().unwrap().path().extension().unwrap() == "png").count()
    };
    assert_eq!(count(&device), 3);
    let [first, last] = [0, 30].map(|frame| picture(&device, frame));
    assert_eq!(first.dimensions(), (320, 180));
    assert!(mean_difference(&first, &last) > 0.1, "something moves");
    assert_eq!(run("tower", &memory, &[&WORDS[..], &["--cpu"]].concat()).code, Some(0));
    let other = mean_difference(&last, &picture(&memory, 30));
    assert!(other < 0.1, "both ways of deforming show the same: {other}");
}

#[test]
fn without_a_device_all_but_the_pictures_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let none = folder.path().join("none.json");
    let out = folder.path().join("out");
    let words = ["run", "tower", "--headless", "--frames", "2", "--out"];
    let drivers = ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"].map(|name| (name, &none));
    let ran = finish(program().envs(drivers).env("WGPU_BACKEND", "vulkan").args(words).arg(&out));
    assert_eq!(ran.code, Some(0), "{}", ran.complained);
    assert_eq!(ran.complained.lines().count(), 1, "{}", ran.complained);
    assert!(ran.complained.contains("no Vulkan device"), "{}", ran.complained);
    assert!(out.join("camel.pc2").is_file() && out.join("metrics.csv").is_file());
    assert!(!out.join("frame_0000.png").exists());
}
