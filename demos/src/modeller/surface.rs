//! From a distance field to a first mesh: the field is sampled on a grid and surface nets put
//! one vertex into every cell that the surface passes through.

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::Vec3;

use super::field::Field;
use super::mesh::Mesh;

/// Meshes the zero set of `field` between `low` and `high` with cells of size `cell`.
pub fn mesh_of(field: &impl Field, low: Vec3, high: Vec3, cell: f32) -> Mesh {
    let counts = ((high - low) / cell).ceil().as_uvec3() + glam::UVec3::splat(2);
    let shape = RuntimeShape::<u32, 3>::new(counts.to_array());
    let place = |index: [f32; 3]| low + Vec3::from_array(index) * cell;
    let samples: Vec<f32> = (0..shape.size())
        .map(|i| field.distance(place(shape.delinearize(i).map(|c| c as f32))))
        .collect();
    let mut nets = SurfaceNetsBuffer::default();
    let last = (counts - glam::UVec3::ONE).to_array();
    surface_nets(&samples, &shape, [0; 3], last, &mut nets);
    Mesh {
        positions: nets.positions.iter().map(|&p| place(p)).collect(),
        triangles: nets.indices.as_chunks::<3>().0.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_of_a_sphere_is_closed_and_faces_outward() {
        let sphere = |p: Vec3| p.length() - 1.0;
        let mesh = mesh_of(&sphere, Vec3::splat(-1.3), Vec3::splat(1.3), 0.2);
        assert!(mesh.is_closed());
        assert_eq!(mesh.euler_characteristic(), 2);
        assert!((mesh.volume() - 4.19).abs() < 0.4, "{}", mesh.volume());
    }
}
