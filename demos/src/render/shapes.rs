//! Meshes of simple solids: balls, boxes with rounded edges, cylinders and capsules.

use glam::{Vec2, Vec3};

use super::MeshData;

/// A surface of revolution around the y axis: `profile` runs from the top to the bottom, each entry a place (radius,
/// height) and its normal.
fn lathe(profile: &[(Vec2, Vec2)], sectors: u32) -> MeshData {
    let mut mesh = MeshData::default();
    let rows = profile.len() as u32;
    for i in 0..=sectors {
        let angle = std::f32::consts::TAU * i as f32 / sectors as f32;
        let out = Vec3::new(angle.sin(), 0.0, angle.cos());
        for (place, normal) in profile {
            mesh.positions.push(out * place.x + Vec3::Y * place.y);
            mesh.normals.push(out * normal.x + Vec3::Y * normal.y);
        }
    }
    for i in 0..sectors {
        for j in 0..rows - 1 {
            let a = i * rows + j;
            let b = a + rows;
            mesh.indices.extend([a, a + 1, b, b, a + 1, b + 1]);
        }
    }
    mesh
}

/// A quarter circle of the profile, from the direction `start` to `end` (angles from the top).
fn bend(centre: Vec2, radius: f32, start: f32, end: f32, pieces: u32) -> impl Iterator<Item = (Vec2, Vec2)> {
    (0..=pieces).map(move |i| {
        let angle = start + (end - start) * i as f32 / pieces as f32;
        let normal = Vec2::new(angle.sin(), angle.cos());
        (centre + normal * radius, normal)
    })
}

use std::f32::consts::{FRAC_PI_2, PI};

/// A ball around the origin.
pub fn ball(radius: f32) -> MeshData {
    lathe(&bend(Vec2::ZERO, radius, 0.0, PI, 24).collect::<Vec<_>>(), 48)
}

/// A capsule along the y axis; `half_height` is that of its straight part.
pub fn capsule(half_height: f32, radius: f32) -> MeshData {
    let top = bend(Vec2::new(0.0, half_height), radius, 0.0, FRAC_PI_2, 10);
    let bottom = bend(Vec2::new(0.0, -half_height), radius, FRAC_PI_2, PI, 10);
    lathe(&top.chain(bottom).collect::<Vec<_>>(), 32)
}

/// A cylinder along the y axis with edges rounded by `bevel`.
pub fn cylinder(half_height: f32, radius: f32, bevel: f32) -> MeshData {
    let bevel = bevel.min(radius).min(half_height);
    let inner = Vec2::new(radius - bevel, half_height - bevel);
    let top = [(Vec2::new(0.0, half_height), Vec2::Y)];
    let bottom = [(Vec2::new(0.0, -half_height), Vec2::NEG_Y)];
    let profile: Vec<_> = top
        .into_iter()
        .chain(bend(inner, bevel, 0.0, FRAC_PI_2, 4))
        .chain(bend(Vec2::new(inner.x, -inner.y), bevel, FRAC_PI_2, PI, 4))
        .chain(bottom)
        .collect();
    lathe(&profile, 40)
}

/// A box with edges rounded by `bevel`; edges catch light as those of real things do.
pub fn cuboid(half_extents: Vec3, bevel: f32) -> MeshData {
    const PIECES: u32 = 4;
    let bevel = bevel.clamp(0.0, half_extents.min_element());
    let inner = half_extents - bevel;
    // Along a side of a face: the rounded part, the flat part, the rounded part. Each entry is the tangent of an angle
    // and the sign of the corner that it belongs to.
    let steps: Vec<(f32, f32)> = (0..=PIECES)
        .map(|i| ((-FRAC_PI_2 * 0.5 * (1.0 - i as f32 / PIECES as f32)).tan(), -1.0))
        .chain((0..=PIECES).map(|i| ((FRAC_PI_2 * 0.5 * i as f32 / PIECES as f32).tan(), 1.0)))
        .collect();
    let side = steps.len() as u32;
    let mut mesh = MeshData::default();
    for axis in 0..3 {
        for sign in [-1.0f32, 1.0] {
            let face = Vec3::AXES[axis] * sign;
            let u = Vec3::AXES[(axis + 1) % 3];
            let v = face.cross(u);
            let first = mesh.positions.len() as u32;
            for (tan_v, sign_v) in &steps {
                for (tan_u, sign_u) in &steps {
                    let corner = inner * (face + u * *sign_u + v * *sign_v);
                    let normal = (face + u * *tan_u + v * *tan_v).normalize();
                    mesh.positions.push(corner + normal * bevel);
                    mesh.normals.push(normal);
                }
            }
            for j in 0..side - 1 {
                for i in 0..side - 1 {
                    let a = first + j * side + i;
                    mesh.indices.extend([a, a + 1, a + side, a + side, a + 1, a + side + 1]);
                }
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume enclosed by a closed mesh; positive if its triangles run counterclockwise.
    fn volume(mesh: &MeshData) -> f32 {
        let p = |i: u32| mesh.positions[i as usize];
        mesh.indices.chunks_exact(3).map(|t| p(t[0]).dot(p(t[1]).cross(p(t[2]))) / 6.0).sum()
    }

    #[test]
    fn solids_are_closed_and_face_outwards() {
        let close = |a: f32, b: f32| assert!((a / b - 1.0).abs() < 0.02, "{a} instead of {b}");
        close(volume(&ball(2.0)), 4.0 / 3.0 * PI * 8.0);
        close(volume(&capsule(1.0, 0.5)), PI * 0.25 * 2.0 + 4.0 / 3.0 * PI * 0.125);
        close(volume(&cylinder(1.0, 0.5, 0.01)), PI * 0.25 * 2.0);
        close(volume(&cuboid(Vec3::new(1.0, 2.0, 3.0), 0.02)), 48.0);
        for mesh in [ball(1.0), capsule(1.0, 0.5), cylinder(1.0, 0.5, 0.1), cuboid(Vec3::ONE, 0.1)] {
            for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
                assert!((n.length() - 1.0).abs() < 1e-5);
                assert!(p.dot(*n) >= -1e-5);
            }
        }
    }
}
