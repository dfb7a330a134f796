//! Water: drag on each triangle of the boundary, and buoyancy.
//!
//! A triangle of area `A` and outward normal `n` that moves at `u` relative to the water feels `-½ ρ A c_n (u·n)² n` when it
//! moves outwards (water is pushed by the side that comes towards it, so a thin plate has the drag coefficient `c_n` of tables), and
//! `-½ ρ A c_t |u_t| u_t` in its plane. A fast stroke and a slow return push differently, which is how a jellyfish swims.
//!
//! Each corner feels a third of it, at its own velocity and stepped implicitly: drag slows a vertex, and never turns it back.
//! (With the mean velocity of the triangle and a third of its impulse for each corner, a light corner beside heavy ones is thrown
//! back. No energy comes in by that, but it then moves against the goals that pull at it, farther in each step.)

use crate::math::Vec3;
use crate::procdef::{ProcDefBody, ProcDefModel, WaterDescription};

/// A box of water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterRegion {
    /// Its lowest corner, in metres.
    pub min: Vec3,
    /// Its highest corner, in metres.
    pub max: Vec3,
    /// Velocity of the water in m/s.
    pub flow: Vec3,
}

impl WaterRegion {
    /// Whether a point is in the water.
    pub fn contains(&self, point: Vec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }
}

/// Changes the velocities of a body by what the water around it does in a step of `h` seconds.
pub fn act_of_water(model: &ProcDefModel, regions: &[WaterRegion], gravity: Vec3, h: f32, body: &mut ProcDefBody) {
    let Some(water) = &model.water else { return };
    let region = |x: Vec3| regions.iter().find(|region| region.contains(x));
    let masses = model.rig.masses();
    let before = body.is_solved().then(|| body.velocities().to_vec());
    for (v, (volume, mass)) in model.volumes.iter().zip(masses).enumerate() {
        if region(body.positions()[v]).is_some() {
            body.velocities_mut()[v] -= gravity * (h * water.density * volume / mass);
        }
    }
    for triangle in &model.boundary {
        let at = triangle.map(|v| v as usize);
        let [a, b, c] = at.map(|v| body.positions()[v]);
        let Some(region) = region((a + b + c) / 3.0) else { continue };
        let normal = (b - a).cross(c - a);
        let area = normal.length() / 2.0;
        let normal = normal.normalize_or_zero();
        for v in at {
            let change = drag(water, body.velocities()[v] - region.flow, normal, area / 3.0 * h / masses[v]);
            body.velocities_mut()[v] += change;
        }
    }
    if let Some(before) = before {
        body.spread_changes(&before);
    }
}

/// The change of the velocity `u` relative to the water of a piece of surface, `exposure` its area times the time step over its mass.
fn drag(water: &WaterDescription, u: Vec3, normal: Vec3, exposure: f32) -> Vec3 {
    let outward = u.dot(normal);
    let tangential = u - normal * outward;
    let slowed = |speed: f32, coefficient: f32| {
        let rate = 0.5 * water.density * coefficient * speed * exposure;
        rate / (1.0 + rate)
    };
    let pressed = normal * (outward.max(0.0) * slowed(outward.max(0.0), water.normal_drag));
    -pressed - tangential * slowed(tangential.length(), water.tangential_drag)
}

#[cfg(test)]
mod tests {
    use super::drag;
    use crate::math::Vec3;
    use crate::procdef::WaterDescription;

    const WATER: WaterDescription = WaterDescription { density: 1000.0, normal_drag: 1.2, tangential_drag: 0.05 };

    #[test]
    fn drag_is_quadratic_only_on_the_side_that_comes_towards_the_water_and_never_turns_back() {
        let small = drag(&WATER, Vec3::Y * 0.01, Vec3::Y, 1e-4);
        // ½ ρ c v² A h / m, and 1 / (1 + 6e-4) of it.
        assert!((small.y + 0.5 * 1000.0 * 1.2 * 1e-4 * 1e-4 / 1.0006).abs() < 1e-10);
        assert_eq!(drag(&WATER, -Vec3::Y, Vec3::Y, 1e-4), Vec3::ZERO);
        let huge = drag(&WATER, Vec3::new(50.0, 40.0, 0.0), Vec3::Y, 1e3);
        assert!(huge.y >= -40.0 && huge.y < -39.9 && huge.x >= -50.0 && huge.x < -49.0);
    }
}
