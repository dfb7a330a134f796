//! From a distance field to a first mesh: the field is sampled on a grid and surface nets put
//! one vertex into every cell that the surface passes through.

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::Vec3;

use super::field::Field;
use super::mesh::Mesh;

/// How many grids are tried.
const GRIDS: usize = 16;

/// Meshes the zero set of `field` between `low` and `high` with cells of size `cell` or a
/// little smaller.
///
/// Where a saddle of the surface lies flat in the grid, surface nets pinch the mesh. Then the
/// next, slightly finer grid is tried, until the mesh is one that could be blown up into a ball,
/// as all the models are. The last grid's mesh is given back if none was.
pub fn mesh_of(field: &impl Field, low: Vec3, high: Vec3, cell: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for grid in 0..GRIDS {
        let finer = cell * (1.0 - 0.013 * grid as f32);
        mesh = mesh_on_grid(field, low - Vec3::splat(0.37 * finer), high, finer);
        if mesh.is_closed() && mesh.component_count() == 1 && mesh.euler_characteristic() == 2 {
            break;
        }
    }
    mesh
}

/// Meshes the zero set of `field` on one grid.
fn mesh_on_grid(field: &impl Field, low: Vec3, high: Vec3, cell: f32) -> Mesh {
    let counts = ((high - low) / cell).ceil().as_uvec3() + glam::UVec3::splat(2);
    let shape = RuntimeShape::<u32, 3>::new(counts.to_array());
    let place = |index: [f32; 3]| low + Vec3::from_array(index) * cell;
    let mut samples: Vec<f32> =
        (0..shape.size()).map(|i| field.distance(place(shape.delinearize(i).map(|c| c as f32)))).collect();
    for stride in [1, counts.x as usize, (counts.x * counts.y) as usize] {
        blur(&mut samples, stride);
    }
    let mut nets = SurfaceNetsBuffer::default();
    let last = (counts - glam::UVec3::ONE).to_array();
    surface_nets(&samples, &shape, [0; 3], last, &mut nets);
    Mesh {
        positions: nets.positions.iter().map(|&p| place(p)).collect(),
        triangles: nets.indices.as_chunks::<3>().0.to_vec(),
    }
}

/// Blurs the samples along one axis, whose neighbours are `stride` apart: what is thinner than a
/// cell would otherwise tear the mesh or leave it pinched.
fn blur(samples: &mut [f32], stride: usize) {
    let sharp = samples.to_vec();
    for i in stride..samples.len() - stride {
        samples[i] = 0.5 * sharp[i] + 0.25 * (sharp[i - stride] + sharp[i + stride]);
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
        // The blur takes a little away from what is as small as ten cells.
        assert!((mesh.volume() - 4.19).abs() < 0.5, "{}", mesh.volume());
    }
}
