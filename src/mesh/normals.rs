//! Vertex normals of deformed positions: a gather over a table built once, with the same bits for any thread count.

use super::MeshError;
use crate::math::Vec3;
use rayon::prelude::*;

/// Below this number of vertices threads cost more than they save.
const PARALLEL_FROM: usize = 4096;

/// Which triangles meet at which point of the surface, built once for a mesh and used at every frame.
///
/// Each normal is summed by one thread in the order of the triangles, so that the result does not depend on the number
/// of threads.
#[derive(Clone, Debug)]
pub struct NormalTopology {
    triangles: Vec<[u32; 3]>,
    welded: Vec<u32>,
    /// Where the triangles of vertex `v` start in `incident`; vertices that are welded to another have none.
    starts: Vec<u32>,
    incident: Vec<u32>,
}

impl NormalTopology {
    /// Builds the table from a mesh's triangles and its `welded` map (one entry a vertex).
    ///
    /// # Errors
    /// A triangle or a weld that names a vertex which does not exist.
    pub fn new(triangles: &[[u32; 3]], welded: &[u32]) -> Result<Self, MeshError> {
        let vertices = welded.len();
        if let Some(vertex) = welded.iter().position(|&w| w as usize >= vertices) {
            return Err(MeshError::WeldOutOfRange { vertex, point: welded[vertex], vertices });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&i| i as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange { triangle, index, vertices });
            }
        }
        let points = |t: &[u32; 3]| t.map(|c| welded[c as usize] as usize);
        let mut starts = vec![0u32; vertices + 1];
        for t in triangles {
            for point in points(t) {
                starts[point + 1] += 1;
            }
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut cursor = starts.clone();
        let mut incident = vec![0u32; 3 * triangles.len()];
        for (index, t) in triangles.iter().enumerate() {
            for point in points(t) {
                incident[cursor[point] as usize] = index as u32;
                cursor[point] += 1;
            }
        }
        Ok(Self { triangles: triangles.to_vec(), welded: welded.to_vec(), starts, incident })
    }

    /// Writes the area-weighted unit normal of each vertex at `positions` into `normals` (resized to fit); vertices
    /// welded to one point share theirs. A point without any area gets the y axis.
    ///
    /// `faces` is scratch space that the caller keeps from frame to frame; nothing is allocated once both fit.
    ///
    /// # Errors
    /// Another number of positions than the table has vertices.
    pub fn normals_into(
        &self,
        positions: &[Vec3],
        faces: &mut Vec<Vec3>,
        normals: &mut Vec<Vec3>,
    ) -> Result<(), MeshError> {
        let vertices = self.welded.len();
        if positions.len() != vertices {
            return Err(MeshError::LengthMismatch { given: positions.len(), expected: vertices });
        }
        faces.resize(self.triangles.len(), Vec3::ZERO);
        normals.resize(vertices, Vec3::ZERO);
        let face = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            (b - a).cross(c - a)
        };
        if vertices >= PARALLEL_FROM {
            faces.par_iter_mut().zip(&self.triangles).with_min_len(1024).for_each(|(n, t)| *n = face(t));
            let faces = &*faces;
            normals.par_iter_mut().enumerate().with_min_len(1024).for_each(|(v, n)| *n = self.gather(faces, v));
        } else {
            faces.iter_mut().zip(&self.triangles).for_each(|(n, t)| *n = face(t));
            normals.iter_mut().enumerate().for_each(|(v, n)| *n = self.gather(faces, v));
        }
        Ok(())
    }

    /// The normal of one vertex. A welded vertex repeats its point's sum: cheaper than a second pass over all.
    fn gather(&self, faces: &[Vec3], vertex: usize) -> Vec3 {
        let point = self.welded[vertex] as usize;
        let around = &self.incident[self.starts[point] as usize..self.starts[point + 1] as usize];
        let mut sum = Vec3::ZERO;
        for &t in around {
            sum += faces[t as usize];
        }
        // Scaled first: the squares of tiny areas would vanish.
        let scale = sum.abs().max_element();
        if scale > 0.0 && scale.is_finite() { (sum / scale).normalize_or(Vec3::Y) } else { Vec3::Y }
    }
}

/// The area-weighted unit normals of `positions`, shared across welded vertices; one call of [`NormalTopology`], which
/// is what to keep when this is wanted for every frame.
///
/// # Errors
/// Indices out of range, or another number of positions than `welded` has entries.
pub fn vertex_normals(positions: &[Vec3], triangles: &[[u32; 3]], welded: &[u32]) -> Result<Vec<Vec3>, MeshError> {
    let mut normals = Vec::new();
    NormalTopology::new(triangles, welded)?.normals_into(positions, &mut Vec::new(), &mut normals)?;
    Ok(normals)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::measure::tests::sphere;

    #[test]
    fn normals_of_a_sphere_point_outward() {
        let mesh = sphere(1.0, 24, 16);
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(n.dot(p.normalize()) > 0.99 && (n.length() - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn the_number_of_threads_does_not_change_a_bit() {
        let mesh = sphere(1.0, 160, 100);
        assert!(mesh.positions.len() > PARALLEL_FROM);
        let table = NormalTopology::new(&mesh.triangles, &mesh.welded).unwrap();
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut normals = Vec::new();
            pool.install(|| table.normals_into(&mesh.positions, &mut Vec::new(), &mut normals)).unwrap();
            normals.iter().flat_map(|n| n.to_array().map(f32::to_bits)).collect::<Vec<_>>()
        };
        assert_eq!(run(1), run(4));
    }

    #[test]
    fn welded_vertices_share_their_normal_and_tiny_triangles_have_one() {
        let s = 1e-12;
        let p = [Vec3::ZERO, Vec3::X * s, Vec3::Y * s, Vec3::X * s, Vec3::Z * s, Vec3::ZERO];
        let n = vertex_normals(&p, &[[0, 1, 2], [5, 4, 3]], &[0, 1, 2, 1, 4, 0]).unwrap();
        assert_eq!(n[1], n[3]);
        assert!((n[2] - Vec3::Z).length() < 1e-6);
        assert!((n[0] - Vec3::new(0.0, 1.0, 1.0).normalize()).length() < 1e-6);
    }

    #[test]
    fn wrong_lengths_and_indices_are_refused() {
        assert!(vertex_normals(&[Vec3::ZERO; 2], &[[0, 1, 2]], &[0, 1, 2]).is_err());
        assert!(vertex_normals(&[Vec3::ZERO; 3], &[[0, 1, 3]], &[0, 1, 2]).is_err());
        assert!(vertex_normals(&[Vec3::ZERO; 3], &[[0, 1, 2]], &[0, 1, 7]).is_err());
        assert!(vertex_normals(&[Vec3::ZERO; 4], &[[0, 1, 2]], &[0, 1, 2, 4]).is_err());
    }
}
