//! A hand, or a mouse, that holds a body by the vertices around a point.

use crate::math::Vec3;
use crate::procdef::ProcDefBody;

/// A held place: a critically damped spring to a target, shared by the vertices around it.
#[derive(Clone, Debug)]
pub struct Grip {
    /// The held vertices and their weights, the sum of which is 1.
    vertices: Vec<(u32, f32)>,
    /// Where the held place is led to, in metres.
    pub target: Vec3,
    /// Frequency of the spring in Hz: how quickly the place follows.
    pub frequency: f32,
}

impl Grip {
    /// Holds a body by the vertices within `radius` of the vertex nearest to `point`, both as they are now. Their weights
    /// fall to 0 at the radius. None where the body has no finite vertex.
    pub fn new(body: &ProcDefBody, point: Vec3, radius: f32) -> Option<Self> {
        let positions = body.positions();
        let nearest = positions.iter().copied().filter(|x| x.is_finite());
        let centre = nearest.min_by(|a, b| a.distance(point).total_cmp(&b.distance(point)))?;
        let weight = |x: Vec3| (1.0 - x.distance_squared(centre) / (radius * radius).max(f32::MIN_POSITIVE)).max(0.0);
        let held: Vec<(u32, f32)> =
            (0u32..).zip(positions).map(|(v, &x)| (v, weight(x))).filter(|(_, w)| *w > 0.0).collect();
        let sum: f32 = held.iter().map(|(_, w)| w).sum();
        let vertices: Vec<(u32, f32)> = held.into_iter().map(|(v, w)| (v, w / sum)).collect();
        let mut grip = Self { vertices, target: centre, frequency: 5.0 };
        grip.target = grip.mean(positions);
        Some(grip)
    }

    /// Where the held place is, in metres.
    pub fn place(&self, body: &ProcDefBody) -> Vec3 {
        self.mean(body.positions())
    }

    /// Changes the velocities of the held vertices for a step of `h` seconds. A target that is not finite holds nothing.
    pub fn pull(&self, body: &mut ProcDefBody, h: f32) {
        if !(self.target.is_finite() && h > 0.0 && h.is_finite()) {
            return;
        }
        let (x, v) = (self.mean(body.positions()), self.mean(body.velocities()));
        let turn = std::f32::consts::TAU * self.frequency.max(0.0) * h;
        // The implicit step of a critically damped spring: v' = (v + ω² h (target - x)) / (1 + ω h)².
        let wanted = (v + (self.target - x) * (turn * turn / h)) / ((1.0 + turn) * (1.0 + turn));
        // The place moves by the weighted mean of the vertices' changes, each by its weight.
        let spread: f32 = self.vertices.iter().map(|(_, w)| w * w).sum();
        if spread <= 0.0 {
            return;
        }
        let change = (wanted - v) / spread;
        for &(vertex, w) in &self.vertices {
            body.velocities_mut()[vertex as usize] += change * w;
        }
    }

    fn mean(&self, values: &[Vec3]) -> Vec3 {
        self.vertices.iter().map(|&(v, w)| values[v as usize] * w).sum()
    }
}
