//! Measurements: one row of numbers for each body in each frame.

use super::OutputError;
use super::error::at;
use pliant::mesh::AtomicFile;
use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};

/// First line of the table.
pub const METRICS_HEADER: &str = "frame,body,volume_ratio,max_depth_before,max_depth_after,max_piercing,max_gap,max_pair_depth,vertices_inside,time_coherence,passes,steps,ms_rigid,ms_springs,ms_contact,ms_deform";

/// What is measured of one body in one frame, in the order of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MetricsRow {
    /// Number of the frame.
    pub frame: usize,
    /// Name of the body; commas and quotes are escaped.
    pub body: String,
    /// Volume of the deformed surface as a part of that at rest.
    pub volume_ratio: f64,
    /// Deepest penetration of a vertex before it is cancelled, as a part of the body's size.
    pub max_depth_before: f32,
    /// Deepest penetration that is left, as a part of the body's size.
    pub max_depth_after: f32,
    /// Deepest point of a triangle that is left, as a part of the body's size.
    pub max_piercing: f32,
    /// Widest gap to an obstacle that is touched, as a part of the body's size.
    pub max_gap: f32,
    /// Deepest overlap with another elastic body, or of two segments of its own, that is left, as a part of the body's size.
    pub max_pair_depth: f32,
    /// Vertices that are still inside an obstacle.
    pub vertices_inside: usize,
    /// Change of the cancellation since the frame before, over the relative motion.
    pub time_coherence: f32,
    /// Passes of the deformation.
    pub passes: usize,
    /// Integration steps along the path lines.
    pub steps: usize,
    /// Time for the rigid bodies in milliseconds.
    pub ms_rigid: f64,
    /// Time for the mass-spring sets in milliseconds.
    pub ms_springs: f64,
    /// Time for contacts in milliseconds.
    pub ms_contact: f64,
    /// Time for the deformation of the surface in milliseconds.
    pub ms_deform: f64,
}

/// Writes a table row by row.
#[derive(Debug)]
pub struct MetricsWriter {
    table: csv::Writer<AtomicFile>,
    path: PathBuf,
}

impl MetricsWriter {
    /// Begins a table with its first line.
    ///
    /// # Errors
    /// A file that cannot be created.
    pub fn create(path: impl AsRef<Path>, header: &str) -> Result<Self, OutputError> {
        let path = path.as_ref().to_path_buf();
        let file = AtomicFile::create(&path).map_err(at(&path))?;
        let mut table = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        table.write_record(header.split(',')).map_err(|e| at(&path)(plain(e)))?;
        Ok(Self { table, path })
    }

    /// Appends a row.
    ///
    /// # Errors
    /// A failed write.
    pub fn write(&mut self, row: &impl Serialize) -> Result<(), OutputError> {
        self.table.serialize(row).map_err(|e| at(&self.path)(plain(e)))
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// A failed write; what was there before stays.
    pub fn finish(self) -> Result<(), OutputError> {
        let file = self.table.into_inner().map_err(|e| at(&self.path)(io::Error::other(e.to_string())))?;
        file.finish().map_err(at(&self.path))
    }
}

fn plain(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(e) => e,
        other => io::Error::other(format!("{other:?}")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{SOFT_METRICS_HEADER, SoftMetricsRow};
    use super::*;
    use std::fs;

    #[test]
    fn rows_stand_under_the_header_and_names_are_escaped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.csv");
        let mut table = MetricsWriter::create(&path, METRICS_HEADER).unwrap();
        table
            .write(&MetricsRow { frame: 3, body: "a \"b\", c".into(), volume_ratio: 1.0, ..Default::default() })
            .unwrap();
        let row = MetricsRow { body: "d".into(), max_gap: 0.25, passes: 2, ms_deform: 1.5, ..Default::default() };
        table.write(&row).unwrap();
        table.finish().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let rows = "3,\"a \"\"b\"\", c\",1.0,0.0,0.0,0.0,0.0,0.0,0,0.0,0,0,0.0,0.0,0.0,0.0\n0,d,0.0,0.0,0.0,0.0,0.25,0.0,0,0.0,2,0,0.0,0.0,0.0,1.5\n";
        assert_eq!(text, format!("{METRICS_HEADER}\n{rows}"));
    }

    #[test]
    fn each_column_of_a_row_has_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        let mut table = MetricsWriter::create(&path, SOFT_METRICS_HEADER).unwrap();
        let row = SoftMetricsRow {
            frame: 2,
            body: "worm 7".into(),
            y: 0.5,
            inverted: 3,
            ms_drive: 1.5,
            ..Default::default()
        };
        table.write(&row).unwrap();
        table.finish().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let [names, values] = [0, 1].map(|line| text.lines().nth(line).unwrap().split(',').collect::<Vec<_>>());
        assert_eq!(names.len(), values.len());
        for (name, value) in [("frame", "2"), ("body", "worm 7"), ("y", "0.5"), ("inverted", "3"), ("ms_drive", "1.5")]
        {
            assert_eq!(values[names.iter().position(|n| *n == name).unwrap()], value, "{name}");
        }
    }

    #[test]
    fn a_table_without_rows_has_its_header_and_a_dropped_one_leaves_the_old() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.csv");
        MetricsWriter::create(&path, METRICS_HEADER).unwrap().finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().trim_end(), METRICS_HEADER);
        let mut table = MetricsWriter::create(&path, METRICS_HEADER).unwrap();
        table.write(&MetricsRow::default()).unwrap();
        drop(table);
        assert_eq!(fs::read_to_string(&path).unwrap().trim_end(), METRICS_HEADER);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
