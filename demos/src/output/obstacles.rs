//! Obstacles on disk: the convex parts once, each in its own frame, and where each part is in every frame.

use super::OutputError;
use super::error::at;
use pliant::math::{Pose, Vec3};
use pliant::mesh::{AtomicFile, MeshError};
use std::io::Write;
use std::path::{Path, PathBuf};

/// First line of the table of poses.
pub const OBSTACLES_HEADER: &str = "frame,part,tx,ty,tz,qx,qy,qz,qw";

/// A convex part of an obstacle in its own frame.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPart {
    /// Vertices in metres.
    pub vertices: Vec<Vec3>,
    /// Corner indices of its triangles.
    pub triangles: Vec<[u32; 3]>,
}

/// Writes the parts as one OBJ file with an object `part_N` for each, N counting from 0.
///
/// # Errors
/// A triangle that names a vertex which does not exist, or a failed write; what was there before stays.
pub fn write_obstacle_parts(path: impl AsRef<Path>, parts: &[ConvexPart]) -> Result<(), OutputError> {
    let path = path.as_ref();
    for part in parts {
        let vertices = part.vertices.len();
        for (triangle, t) in part.triangles.iter().enumerate() {
            if let Some(&index) = t.iter().find(|&&i| i as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange { triangle, index, vertices }.into());
            }
        }
    }
    let write = || {
        let mut file = AtomicFile::create(path)?;
        let mut before = 1u64;
        for (number, part) in parts.iter().enumerate() {
            writeln!(file, "o part_{number}")?;
            for v in &part.vertices {
                writeln!(file, "v {} {} {}", v.x, v.y, v.z)?;
            }
            for t in &part.triangles {
                let [a, b, c] = t.map(|i| u64::from(i) + before);
                writeln!(file, "f {a} {b} {c}")?;
            }
            before += part.vertices.len() as u64;
        }
        file.finish()
    };
    write().map_err(at(path))
}

/// Writes the table of poses row by row.
#[derive(Debug)]
pub struct ObstacleWriter {
    file: AtomicFile,
    path: PathBuf,
}

impl ObstacleWriter {
    /// Begins the table with its header.
    ///
    /// # Errors
    /// A file that cannot be created.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        let path = path.as_ref().to_path_buf();
        let mut file = AtomicFile::create(&path).map_err(at(&path))?;
        writeln!(file, "{OBSTACLES_HEADER}").map_err(at(&path))?;
        Ok(Self { file, path })
    }

    /// Appends the pose of a part in a frame.
    ///
    /// # Errors
    /// A failed write.
    pub fn write(&mut self, frame: usize, part: usize, pose: &Pose) -> Result<(), OutputError> {
        let (t, q) = (pose.translation, pose.rotation);
        writeln!(self.file, "{frame},{part},{},{},{},{},{},{},{}", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
            .map_err(at(&self.path))
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// A failed write; what was there before stays.
    pub fn finish(self) -> Result<(), OutputError> {
        self.file.finish().map_err(at(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pliant::mesh::load_obj;
    use std::fs;

    #[test]
    fn parts_follow_each_other_with_indices_that_go_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("obstacles.obj");
        let part = |x: f32| ConvexPart {
            vertices: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|v| v + Vec3::X * x).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        };
        write_obstacle_parts(&path, &[part(0.0), part(5.0)]).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains("o part_0\n") && text.contains("o part_1\nv 5 0 0\n") && text.ends_with("f 6 7 8\n"));
        assert!((load_obj(&path).unwrap().volume() - 1.0 / 3.0).abs() < 1e-6);
        let bad = ConvexPart { vertices: vec![Vec3::ZERO], triangles: vec![[0, 0, 1]] };
        assert!(write_obstacle_parts(&path, &[bad]).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn poses_are_one_row_each_under_the_header() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("obstacles.csv");
        let mut table = ObstacleWriter::create(&path).unwrap();
        table.write(0, 0, &Pose::from_translation(Vec3::new(1.0, 2.5, -3.0))).unwrap();
        table.write(12, 3, &Pose::IDENTITY).unwrap();
        table.finish().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text, "frame,part,tx,ty,tz,qx,qy,qz,qw\n0,0,1,2.5,-3,0,0,0,1\n12,3,0,0,0,0,0,0,1\n");
    }
}
