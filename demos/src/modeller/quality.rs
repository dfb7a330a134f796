//! How even a mesh is: the lengths of its edges and the smallest angles of its triangles.

use super::mesh::Mesh;

/// Numbers about the triangles of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Quality {
    /// The median edge length.
    pub median_edge: f32,
    /// The longest edge.
    pub longest_edge: f32,
    /// The shortest edge.
    pub shortest_edge: f32,
    /// The median over the triangles of longest by shortest side.
    pub median_ratio: f32,
    /// The worst ratio of longest to shortest side.
    pub worst_ratio: f32,
    /// The smallest angle of all, in degrees.
    pub smallest_angle: f32,
    /// The smallest angle that 99.9 % of the triangles keep, in degrees.
    pub usual_smallest_angle: f32,
}

impl Quality {
    /// Measures `mesh`.
    pub fn of(mesh: &Mesh) -> Self {
        let lengths = sorted(
            mesh.edges().into_iter().map(|(a, b)| mesh.positions[a as usize].distance(mesh.positions[b as usize])),
        );
        let ratios = sorted(mesh.triangles.iter().map(|&t| {
            let sides = side_lengths(mesh, t);
            sides[2] / sides[0]
        }));
        let angles = sorted(mesh.triangles.iter().map(|&t| smallest_angle(mesh, t)));
        Self {
            median_edge: lengths[lengths.len() / 2],
            longest_edge: lengths[lengths.len() - 1],
            shortest_edge: lengths[0],
            median_ratio: ratios[ratios.len() / 2],
            worst_ratio: ratios[ratios.len() - 1],
            smallest_angle: angles[0],
            usual_smallest_angle: angles[angles.len() / 1000],
        }
    }
}

/// The sides of a triangle, shortest first.
fn side_lengths(mesh: &Mesh, triangle: [u32; 3]) -> [f32; 3] {
    let [a, b, c] = mesh.corners(triangle);
    let mut sides = [a.distance(b), b.distance(c), c.distance(a)];
    sides.sort_by(f32::total_cmp);
    sides
}

/// The smallest angle of a triangle in degrees: the one opposite its shortest side.
fn smallest_angle(mesh: &Mesh, triangle: [u32; 3]) -> f32 {
    let [short, middle, long] = side_lengths(mesh, triangle);
    let cos = (middle * middle + long * long - short * short) / (2.0 * middle * long);
    cos.clamp(-1.0, 1.0).acos().to_degrees()
}

/// The numbers in order.
fn sorted(numbers: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut numbers: Vec<f32> = numbers.collect();
    numbers.sort_by(f32::total_cmp);
    numbers
}
