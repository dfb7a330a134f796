//! A bent tube: a smooth curve through a few points, each with a radius of its own. Necks,
//! tails and other long soft things.

use glam::Vec3;

/// How many straight pieces stand for the curve between two given points.
const PIECES: usize = 8;
/// From this distance on, the ball around a tube stands for the tube.
const FAR: f32 = 0.3;

/// A tube along a curve, thick as its points say.
pub struct Tube {
    spine: Vec<(Vec3, f32)>,
    flatness: f32,
    ball: (Vec3, f32),
}

impl Tube {
    /// A tube through `points`, each given as (x, y, z, radius).
    pub fn through(points: &[[f32; 4]]) -> Self {
        let mut spine = Vec::with_capacity(points.len() * PIECES);
        for segment in 0..points.len() - 1 {
            for piece in 0..PIECES {
                spine.push(point_on_curve(points, segment, piece as f32 / PIECES as f32));
            }
        }
        spine.push(point_on_curve(points, points.len() - 2, 1.0));
        Self { ball: ball_around(&spine), spine, flatness: 1.0 }
    }

    /// The same tube squeezed sideways: its extent in z times `flatness`.
    pub fn flattened(mut self, flatness: f32) -> Self {
        self.flatness = flatness;
        for (center, _) in &mut self.spine {
            center.z /= flatness;
        }
        self.ball = ball_around(&self.spine);
        self
    }

    /// Distance of `p` to the surface of the tube; far away, a little less.
    pub fn distance(&self, p: Vec3) -> f32 {
        let p = Vec3::new(p.x, p.y, p.z / self.flatness);
        let (center, radius) = self.ball;
        let to_ball = p.distance(center) - radius;
        if to_ball > FAR {
            return to_ball;
        }
        self.spine.windows(2).map(|pair| distance_to_piece(p, pair[0], pair[1])).fold(f32::INFINITY, f32::min)
    }
}

/// A ball that holds the whole spine with its radii.
fn ball_around(spine: &[(Vec3, f32)]) -> (Vec3, f32) {
    let sum: Vec3 = spine.iter().map(|&(center, _)| center).sum();
    let middle = sum / spine.len() as f32;
    let farthest = spine.iter().map(|&(center, r)| center.distance(middle) + r);
    (middle, farthest.fold(0.0, f32::max))
}

/// Distance to the segment between two spine points, with the radius interpolated along it.
fn distance_to_piece(p: Vec3, a: (Vec3, f32), b: (Vec3, f32)) -> f32 {
    let axis = b.0 - a.0;
    let t = ((p - a.0).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    p.distance(a.0 + axis * t) - (a.1 + (b.1 - a.1) * t)
}

/// A Catmull-Rom curve through `points`, at `t` between `segment` and the point after it.
fn point_on_curve(points: &[[f32; 4]], segment: usize, t: f32) -> (Vec3, f32) {
    let last = points.len() - 1;
    let before = points[segment.saturating_sub(1)];
    let (from, to) = (points[segment], points[segment + 1]);
    let after = points[(segment + 2).min(last)];
    let value = |i: usize| {
        let (a, b, c, d) = (before[i], from[i], to[i], after[i]);
        b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
    };
    (Vec3::new(value(0), value(1), value(2)), value(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_passes_through_its_points_with_their_radii() {
        let tube = Tube::through(&[[0.0, 0.0, 0.0, 0.2], [1.0, 0.5, 0.0, 0.1], [2.0, 0.0, 0.0, 0.1]]);
        assert!((tube.distance(Vec3::new(0.0, 0.0, 0.0)) + 0.2).abs() < 0.02);
        assert!((tube.distance(Vec3::new(1.0, 0.5, 0.0)) + 0.1).abs() < 0.02);
        assert!(tube.distance(Vec3::new(1.0, 0.0, 0.0)) > 0.2);
    }
}
