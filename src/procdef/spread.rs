//! What acts on the vertices from outside, each for itself, spreads through a stiff body within the step.
//!
//! The global solve gives the inner motion of a body the inertia `M + (h c)² K`: what would swing faster than the steps can follow is
//! slowed down by that. An impulse from outside that changes a light vertex by its own mass alone is then a push against the goals, and
//! water, which pushes in every step, makes stiff bodies tremble until cells turn inside out. With the same inertia for both it only
//! takes energy. Linear and angular momentum are those of the impulses.

use glam::{DMat3, DVec3};
use wide::f32x4;

use super::ProcDefBody;
use super::rigid::{vec3, wide};
use crate::math::Vec3;

impl ProcDefBody {
    /// Spreads what was added to the velocities since they were `before` through the body, with the inertia of its last goals. Bodies
    /// that are matched in passes are left as they are, as are those that had no goals yet, and velocities of another number.
    pub fn spread_changes(&mut self, before: &[Vec3]) {
        if !self.is_solved() || before.len() != self.velocities().len() {
            return;
        }
        let rig = std::sync::Arc::clone(self.rig());
        let regions = &rig.regions;
        let mut changes: Vec<f32x4> = Vec::with_capacity(before.len());
        for (&v, &mass) in regions.vertex.iter().zip(&regions.mass) {
            let change = self.velocities()[v as usize] - before[v as usize];
            changes.push(wide(change * mass));
        }
        let wanted = self.momenta(|place, mass| vec3(changes[place]) / mass);
        if !self.solve_changes(&mut changes) {
            return;
        }
        let found = self.momenta(|place, _| vec3(changes[place]));
        // What is missing is added as a rigid motion.
        let shift = (wanted.linear - found.linear) / found.mass;
        let spin = found.inertia.inverse() * (wanted.angular - found.angular);
        let spin = if spin.is_finite() { spin } else { DVec3::ZERO };
        for (&change, &v) in changes.iter().zip(&regions.vertex) {
            let r = self.positions()[v as usize].as_dvec3() - found.centre;
            self.velocities_mut()[v as usize] = before[v as usize] + vec3(change) + (shift + spin.cross(r)).as_vec3();
        }
    }

    /// The momenta of changes of the velocities, given for each place and its mass.
    fn momenta(&self, change: impl Fn(usize, f32) -> Vec3) -> Momenta {
        let regions = &self.rig().regions;
        let at = |place: usize| self.positions()[regions.vertex[place] as usize].as_dvec3();
        let masses = || regions.mass.iter().map(|m| f64::from(*m)).enumerate();
        let mass: f64 = masses().map(|(_, m)| m).sum();
        let centre = masses().map(|(place, m)| at(place) * m).sum::<DVec3>() / mass;
        let (mut linear, mut angular, mut squares) = (DVec3::ZERO, DVec3::ZERO, DMat3::ZERO);
        for (place, m) in masses() {
            let (r, p) = (at(place) - centre, change(place, m as f32).as_dvec3() * m);
            let mr = r * m;
            linear += p;
            angular += r.cross(p);
            squares += DMat3::from_cols(mr * r.x, mr * r.y, mr * r.z);
        }
        let spread = squares.x_axis.x + squares.y_axis.y + squares.z_axis.z;
        let inertia = DMat3::from_diagonal(DVec3::splat(spread * (1.0 + 1e-9))) - squares;
        Momenta { mass, centre, inertia, linear, angular }
    }
}

/// Mass, centre and inertia of a body, and the momenta of a change of its velocities about the centre.
struct Momenta {
    mass: f64,
    centre: DVec3,
    inertia: DMat3,
    linear: DVec3,
    angular: DVec3,
}
