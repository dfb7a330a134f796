//! A rock about a metre across: a few boulders grown together, with dents, so that it is not
//! convex and has to be cut into convex pieces before anything can bounce off it.

use glam::Vec3;

use super::blend::{carve, intersect, unite_all};
use super::mesh::Mesh;
use super::remesh::remesh_to_count;
use super::shapes::{ellipsoid, rounded_box};
use super::smooth::smooth;
use super::surface::mesh_of;

/// The planes along which pieces have broken off: a direction outward and a distance.
const CLEAVAGE: [[f32; 4]; 7] = [
    [0.9, 0.7, 0.3, 0.47],
    [-0.3, 1.0, 0.2, 0.66],
    [0.3, 0.9, -0.7, 0.50],
    [-0.9, 0.6, 0.4, 0.56],
    [0.6, 0.1, -1.0, 0.42],
    [0.5, 0.3, 1.0, 0.44],
    [-0.5, 0.4, -1.0, 0.46],
];

/// The rock, lying on the ground y = 0.
pub fn rock() -> Mesh {
    let low = Vec3::new(-0.8, -0.15, -0.7);
    let high = Vec3::new(0.8, 0.95, 0.7);
    let mut mesh = mesh_of(&rock_distance, low, high, 0.04);
    smooth(&mut mesh, 2);
    remesh_to_count(mesh, &rock_distance, &|_| 1.0, 1500)
}

/// The distance field of the rock.
fn rock_distance(p: Vec3) -> f32 {
    let body = unite_all(
        &[
            rounded_box(tilted(p), Vec3::new(-0.16, 0.27, 0.04), Vec3::new(0.33, 0.26, 0.30), 0.1),
            ellipsoid(p, Vec3::new(0.28, 0.22, -0.08), Vec3::new(0.30, 0.22, 0.32)),
            ellipsoid(p, Vec3::new(-0.12, 0.55, 0.06), Vec3::new(0.20, 0.22, 0.17)),
            ellipsoid(p, Vec3::new(0.18, 0.18, 0.30), Vec3::new(0.18, 0.17, 0.16)),
        ],
        0.025,
    );
    let dented = carve(body, ellipsoid(p, Vec3::new(0.22, 0.60, 0.02), Vec3::splat(0.22)), 0.06);
    let notched = carve(dented, ellipsoid(p, Vec3::new(-0.22, 0.30, 0.52), Vec3::new(0.16, 0.30, 0.22)), 0.06);
    let split = CLEAVAGE
        .iter()
        .fold(notched, |rock, &[x, y, z, far]| intersect(rock, p.dot(Vec3::new(x, y, z).normalize()) - far, 0.04));
    let grain = (p.x * 17.0 + p.y * 5.0).sin() * (p.y * 13.0 - p.z * 7.0).sin() * (p.z * 15.0).cos();
    intersect(split + 0.012 * grain, -p.y, 0.05)
}

/// The point as seen by a slab that leans a little.
fn tilted(p: Vec3) -> Vec3 {
    let (sin, cos) = 0.22f32.sin_cos();
    Vec3::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rock_is_one_closed_piece_that_faces_outward() {
        let rock = rock();
        assert!(rock.is_closed());
        assert_eq!(rock.component_count(), 1);
        assert_eq!(rock.euler_characteristic(), 2);
        assert!(rock.volume() > 0.1, "{}", rock.volume());
        assert!(rock.triangles.len().abs_diff(1500) <= 40);
    }

    #[test]
    fn the_rock_is_the_same_each_time() {
        assert_eq!(rock(), rock());
    }
}
