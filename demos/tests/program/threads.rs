//! The number of threads changes times, and nothing else.

use std::fs;
use std::path::Path;

use crate::common::{finish, program};

/// Columns of the measurements that are times.
const TIMES: usize = 4;

fn results(folder: &Path, threads: &str) -> (Vec<u8>, Vec<u8>, Vec<Vec<String>>) {
    let out = folder.join(threads);
    let words = ["run", "tower", "--headless", "--no-pictures", "--frames", "120", "--out"];
    let ran = finish(program().env("RAYON_NUM_THREADS", threads).args(words).arg(&out));
    assert_eq!(ran.code, Some(0), "{}", ran.complained);
    let metrics = fs::read_to_string(out.join("metrics.csv")).unwrap();
    let untimed = |row: &str| {
        let mut columns: Vec<String> = row.split(',').map(str::to_owned).collect();
        columns.truncate(columns.len() - TIMES);
        columns
    };
    let read = |name| fs::read(out.join(name)).unwrap();
    (read("camel.pc2"), read("obstacles.csv"), metrics.lines().map(untimed).collect())
}

#[test]
fn one_two_and_four_threads_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let one = results(folder.path(), "1");
    assert!(one.2.iter().skip(1).any(|row| row[3] != "0.0"), "something is touched");
    for threads in ["2", "4"] {
        let other = results(folder.path(), threads);
        assert_eq!(one.2, other.2, "measurements with {threads} threads");
        assert!(one.0 == other.0 && one.1 == other.1, "vertices with {threads} threads");
    }
}
