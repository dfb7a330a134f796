//! Bad input ends in one line on standard error that names the place, never in a panic.

use std::fs;
use std::path::Path;

use crate::common::{finish, program, repository, run};

/// A scene and a rig like those of the tower, in a folder of their own, with one thing replaced in each.
fn tower(folder: &Path, scene: [&str; 2], rig: [&str; 2]) -> String {
    let assets = repository().join("assets");
    let read = |name: &str| fs::read_to_string(assets.join(name)).unwrap();
    let meshes = format!("{}/meshes/", assets.display());
    let replaced = |text: String, [from, to]: [&str; 2]| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let rig = replaced(read("rigs/camel.toml"), rig).replace("../meshes/", &meshes);
    let scene = replaced(read("scenes/tower.toml"), scene).replace("../meshes/", &meshes);
    fs::create_dir_all(folder.join("rigs")).unwrap();
    fs::create_dir_all(folder.join("scenes")).unwrap();
    fs::write(folder.join("rigs/camel.toml"), rig).unwrap();
    let path = folder.join("scenes/tower.toml");
    fs::write(&path, scene).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Expects exit code 1 and one line with these words, and nothing simulated.
fn refused(scene: &str, out: &Path, words: &[&str]) {
    let ran = run(scene, out, &["--no-pictures", "--frames", "2"]);
    let line = ran.complained.trim_end();
    assert_eq!((ran.code, ran.said.as_str()), (Some(1), ""), "{scene}: {line}");
    assert!(line.starts_with("error: ") && line.lines().count() == 1, "{scene}: {line}");
    assert!(!line.contains("panicked"), "{line}");
    for word in words {
        assert!(line.contains(word), "{word}: {line}");
    }
}

#[test]
fn scenes_that_are_none_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (at, out) = (|name: &str| folder.path().join(name).to_str().unwrap().to_owned(), folder.path().join("out"));
    fs::create_dir(at("folder")).unwrap();
    fs::create_dir(at("folder.toml")).unwrap();
    fs::write(at("empty.toml"), "").unwrap();
    fs::write(at("bytes.toml"), [0xff, 0xfe, 0x00]).unwrap();
    refused(&at("folder"), &out, &["folder", "this is a folder"]);
    refused(&at("folder.toml"), &out, &["folder.toml", "this is a folder"]);
    refused(&at("towr.toml"), &out, &["towr.toml", "there is no such file", "did you mean `tower`?"]);
    refused("towr", &out, &["there is no scene `towr`", "did you mean `tower`?"]);
    refused(&at("empty.toml"), &out, &["empty.toml:1:", "missing"]);
    refused(&at("bytes.toml"), &out, &["bytes.toml:1:", "UTF-8"]);
    assert!(!out.exists(), "nothing is written");
}

#[test]
fn faults_in_scenes_and_rigs_are_told_with_file_and_line() {
    const SAME: [&str; 2] = ["#", "#"];
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let scenes: [([&str; 2], &[&str]); 4] = [
        (["duration", "duratoin"], &["tower.toml:3:", "duratoin", "did you mean `duration`?"]),
        (["dt = 0.016666667", "dt = nan"], &["tower.toml:4:", "`dt`", "NaN"]),
        (["camel.toml", "camal.toml"], &["tower.toml:", "`rig`", "camal.toml"]),
        (["radius = 0.13", "radius = -0.13"], &["tower.toml:", "`radius`", "-0.13"]),
    ];
    for (change, words) in scenes {
        refused(&tower(folder.path(), change, SAME), &out, words);
    }
    let open = folder.path().join("open.obj");
    let mesh = fs::read_to_string(repository().join("assets/meshes/camel.obj")).unwrap();
    let hole: Vec<&str> = mesh.trim_end().lines().collect();
    fs::write(&open, hole[..hole.len() - 1].join("\n")).unwrap();
    let rigs: [([&str; 2], &[&str]); 4] = [
        (["radius = 0.24", "radius = -0.24"], &["camel.toml:", "`radius`", "-0.24"]),
        (["softness", "sofness"], &["camel.toml:3:", "sofness"]),
        (["meshes/camel.obj", "meshes/camle.obj"], &["camle.obj"]),
        (["../meshes/camel.obj", open.to_str().unwrap()], &["camel.toml", "open"]),
    ];
    for (change, words) in rigs {
        refused(&tower(folder.path(), SAME, change), &out, words);
    }
    assert!(!out.exists(), "nothing is written");
}

#[test]
fn an_output_folder_that_is_a_file_is_told_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out");
    fs::write(&file, "mine").unwrap();
    refused("tower", &file, &["out", "this is a file"]);
    refused("tower", &file.join("below"), &["below", "cannot be made"]);
    assert_eq!(fs::read_to_string(file).unwrap(), "mine");
}

#[test]
fn a_command_line_that_is_not_understood_ends_with_2() {
    for words in [&["run"][..], &["fly"], &["run", "tower", "--size", "0x0"], &["run", "tower", "--frames", "-1"]] {
        let ran = finish(program().args(words));
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.complained);
        assert!(ran.complained.contains("error:") && !ran.complained.contains("panicked"));
    }
}
