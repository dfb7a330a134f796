//! Friction on fixed ground that differs along and against a direction of the body, as the bristles of a worm do.
//!
//! Coulomb's law with three coefficients: the impulse on a vertex lies in the ellipse whose half axes are the coefficients
//! along the direction (forward or backward, as the vertex slides) and across it, times the normal impulse. The normal impulse is
//! that of rapier's last step. A body whose cycle runs backwards turns its bristles, as earthworms do: forward and backward change
//! places. Rapier has the least of the coefficients itself; here the rest is added. What is fixed takes any
//! impulse, so that nothing has to be given back.

use super::GroundContact;
use crate::math::{Mat3, Vec3};
use crate::mesh::TetrahedralMesh;
use crate::procdef::{GroundDescription, ProcDefBody};

/// The direction field of the ground friction, carried along by the cells.
#[derive(Clone, Debug)]
pub struct GroundDirections {
    ground: GroundDescription,
    /// For each vertex one of its cells, and the direction in the coordinates of that cell's edges from its first corner.
    carriers: Vec<([u32; 4], Vec3)>,
}

impl GroundDirections {
    /// The direction of `ground` on each vertex of a mesh at rest.
    pub fn new(mesh: &TetrahedralMesh, ground: GroundDescription) -> Self {
        let direction = Vec3::from(ground.direction).normalize_or_zero();
        let mut carriers = vec![([0; 4], Vec3::ZERO); mesh.vertex_count()];
        let mut largest = vec![0.0f64; mesh.vertex_count()];
        for (cell, volume) in mesh.cells.iter().zip(mesh.volumes()) {
            let inverse = edges(&mesh.positions, cell).inverse();
            for &v in cell {
                if volume > largest[v as usize] {
                    largest[v as usize] = volume;
                    carriers[v as usize] = (*cell, inverse * direction);
                }
            }
        }
        Self { ground, carriers }
    }

    /// The direction at a vertex for these positions; not of unit length.
    pub fn at(&self, vertex: u32, positions: &[Vec3]) -> Vec3 {
        let (cell, direction) = self.carriers[vertex as usize];
        edges(positions, &cell) * direction
    }

    /// The coefficients ahead, back and sideways on a floor that allows `least` in all directions; `turned` exchanges the
    /// first two.
    pub fn coefficients(&self, least: f32, turned: bool) -> [f32; 3] {
        let ground = &self.ground;
        let lowest = ground.least();
        let [ahead, back] = if turned { [ground.backward, ground.forward] } else { [ground.forward, ground.backward] };
        [ahead, back, ground.sideways].map(|c| c - lowest + least)
    }

    /// Changes the velocities of the vertices on the ground. `impulses` are those of rapier's last step, `gravity_step` what
    /// gravity adds in the next one. `turned` exchanges forward and backward.
    pub fn brake(
        &self,
        body: &mut ProcDefBody,
        contacts: &[GroundContact],
        impulses: &[Vec3],
        gravity_step: Vec3,
        turned: bool,
    ) {
        let ground = &self.ground;
        let least = ground.least();
        for contact in contacts {
            let v = contact.vertex as usize;
            let mass = body.rig().masses()[v];
            let pressure = impulses[v].dot(contact.normal).max(0.0) / mass;
            let along = self.at(contact.vertex, body.positions());
            let along = (along - contact.normal * along.dot(contact.normal)).normalize_or_zero();
            let across = contact.normal.cross(along);
            let u = body.velocities()[v] + gravity_step;
            let slide = [u.dot(along), u.dot(across)];
            let ahead = if (slide[0] > 0.0) != turned { ground.forward } else { ground.backward };
            let limits = [ahead - least, ground.sideways - least].map(|mu| mu.max(0.0) * pressure);
            let [a, b] = within_ellipse(slide, limits);
            body.velocities_mut()[v] -= along * a + across * b;
        }
    }
}

/// The part of a sliding velocity that friction takes: all of it within the ellipse of these half axes, else shortened to it. An
/// axis of length 0 takes nothing along itself.
pub(super) fn within_ellipse(slide: [f32; 2], half_axes: [f32; 2]) -> [f32; 2] {
    let slide = [0, 1].map(|k| if half_axes[k] > 0.0 { slide[k] } else { 0.0 });
    let parts = [0, 1].map(|k| if half_axes[k] > 0.0 { slide[k] / half_axes[k] } else { 0.0 });
    let out = parts[0].hypot(parts[1]);
    let share = if out > 1.0 { 1.0 / out } else { 1.0 };
    slide.map(|s| s * share)
}

fn edges(positions: &[Vec3], cell: &[u32; 4]) -> Mat3 {
    let [a, b, c, d] = cell.map(|v| positions[v as usize]);
    Mat3::from_cols(b - a, c - a, d - a)
}

#[cfg(test)]
mod tests {
    use super::within_ellipse;

    #[test]
    fn friction_stops_what_is_within_its_ellipse_and_never_turns_it_back() {
        assert_eq!(within_ellipse([0.1, -0.2], [1.0, 1.0]), [0.1, -0.2]);
        let [a, b] = within_ellipse([3.0, 4.0], [1.0, 1.0]);
        assert!((a - 0.6).abs() < 1e-6 && (b - 0.8).abs() < 1e-6);
        assert_eq!(within_ellipse([5.0, 0.5], [0.0, 1.0]), [0.0, 0.5]);
        assert_eq!(within_ellipse([5.0, 0.5], [0.0, 0.0]), [0.0, 0.0]);
    }
}
