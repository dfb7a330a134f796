//! What meshing asks of a model: a signed distance at every point, and, derived from it, the
//! direction outward and the way back onto the surface.

use glam::Vec3;

/// A model: negative inside, positive outside, near its surface about the distance to it.
pub trait Field {
    /// The signed distance at `p`.
    fn distance(&self, p: Vec3) -> f32;

    /// The gradient at `p`, by central differences.
    fn gradient(&self, p: Vec3) -> Vec3 {
        const STEP: f32 = 1e-3;
        let slope = |axis: Vec3| (self.distance(p + axis * STEP) - self.distance(p - axis * STEP)) / (2.0 * STEP);
        Vec3::new(slope(Vec3::X), slope(Vec3::Y), slope(Vec3::Z))
    }

    /// The nearest point of the surface, by a few Newton steps of at most `farthest` each.
    fn onto_surface(&self, start: Vec3, farthest: f32) -> Vec3 {
        let mut p = start;
        for _ in 0..4 {
            let distance = self.distance(p);
            let gradient = self.gradient(p);
            let steepness = gradient.length_squared().max(0.05);
            let step = -gradient * (distance / steepness);
            p += step.clamp_length_max(farthest);
            if distance.abs() < 1e-5 {
                break;
            }
        }
        p
    }
}

impl<F: Fn(Vec3) -> f32> Field for F {
    fn distance(&self, p: Vec3) -> f32 {
        self(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_finds_its_way_back_onto_a_sphere() {
        let sphere = |p: Vec3| p.length() - 1.0;
        let found = sphere.onto_surface(Vec3::new(0.9, 0.3, 0.1), 0.1);
        assert!((found.length() - 1.0).abs() < 1e-4);
    }
}
