//! Lines and small balls over a picture, for what is felt but not seen: springs, influence spheres, collision shapes.

use glam::{Mat4, Vec3};

/// Linear colour and opacity.
pub type Colour = [f32; 4];

/// A line from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end.
    pub from: Vec3,
    /// Other end.
    pub to: Vec3,
    /// Width in pixels of a picture that is 540 pixels high.
    pub width: f32,
    /// Colour.
    pub colour: Colour,
}

/// A small ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Middle.
    pub centre: Vec3,
    /// Radius in metres.
    pub radius: f32,
    /// Colour.
    pub colour: Colour,
}

/// All lines and balls of a picture.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// Lines.
    pub lines: Vec<Line>,
    /// Balls.
    pub balls: Vec<Ball>,
    /// Opacity of what lies behind a surface, relative to what lies before it.
    pub hidden: f32,
    /// Width of the lines that the helpers add.
    pub width: f32,
}

impl Default for Overlay {
    fn default() -> Self {
        Self { lines: Vec::new(), balls: Vec::new(), hidden: 0.35, width: 1.5 }
    }
}

/// Straight pieces of a circle.
const PIECES: usize = 40;

impl Overlay {
    /// Adds a line.
    pub fn line(&mut self, from: Vec3, to: Vec3, colour: Colour) {
        self.lines.push(Line { from, to, width: self.width, colour });
    }

    /// Adds a ball.
    pub fn ball(&mut self, centre: Vec3, radius: f32, colour: Colour) {
        self.balls.push(Ball { centre, radius, colour });
    }

    /// Adds a spring: a line between its goal and its mass, and a ball at the mass.
    pub fn spring(&mut self, goal: Vec3, mass: Vec3, radius: f32, colour: Colour) {
        self.line(goal, mass, colour);
        self.ball(mass, radius, colour);
        self.ball(goal, 0.5 * radius, colour);
    }

    /// Adds straight pieces through the points.
    pub fn path(&mut self, points: &[Vec3], colour: Colour) {
        for pair in points.windows(2) {
            self.line(pair[0], pair[1], colour);
        }
    }

    /// Adds an arc from `a` towards `b`, both of them radii from the centre, over the given share of a turn.
    fn arc(&mut self, centre: Vec3, a: Vec3, b: Vec3, turn: f32, colour: Colour) {
        let pieces = (PIECES as f32 * turn).ceil() as usize;
        let points: Vec<Vec3> = (0..=pieces)
            .map(|i| {
                let angle = std::f32::consts::TAU * turn * i as f32 / pieces as f32;
                centre + a * angle.cos() + b * angle.sin()
            })
            .collect();
        self.path(&points, colour);
    }

    /// Adds three circles that stand for a sphere; `transform` may stretch it.
    pub fn sphere(&mut self, transform: Mat4, radius: f32, colour: Colour) {
        let centre = transform.transform_point3(Vec3::ZERO);
        let [x, y, z] = Vec3::AXES.map(|axis| transform.transform_vector3(axis * radius));
        for (a, b) in [(x, y), (y, z), (z, x)] {
            self.arc(centre, a, b, 1.0, colour);
        }
    }

    /// Adds the twelve edges of a box.
    pub fn cuboid(&mut self, transform: Mat4, half_extents: Vec3, colour: Colour) {
        let corner = |i: usize| {
            let sign = Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0;
            transform.transform_point3(half_extents * sign)
        };
        for i in 0..8 {
            for bit in [1, 2, 4] {
                if i & bit == 0 {
                    self.line(corner(i), corner(i | bit), colour);
                }
            }
        }
    }

    /// Adds the outline of a capsule between two points.
    pub fn capsule(&mut self, from: Vec3, to: Vec3, radius: f32, colour: Colour) {
        let along = (to - from).normalize_or(Vec3::Y);
        let (x, z) = along.any_orthonormal_pair();
        let (x, y, z) = (x * radius, along * radius, z * radius);
        for centre in [from, to] {
            self.arc(centre, x, z, 1.0, colour);
        }
        for side in [x, z] {
            self.arc(to, side, y, 0.5, colour);
            self.arc(from, side, -y, 0.5, colour);
            self.line(from + side, to + side, colour);
            self.line(from - side, to - side, colour);
        }
    }

    /// Adds the outline of a cylinder between two points.
    pub fn cylinder(&mut self, from: Vec3, to: Vec3, radius: f32, colour: Colour) {
        let (x, z) = (to - from).normalize_or(Vec3::Y).any_orthonormal_pair();
        let (x, z) = (x * radius, z * radius);
        for centre in [from, to] {
            self.arc(centre, x, z, 1.0, colour);
        }
        for side in [x, -x, z, -z] {
            self.line(from + side, to + side, colour);
        }
    }

    /// Adds the edges of triangles, each once.
    pub fn triangles(&mut self, transform: Mat4, points: &[Vec3], triangles: &[[u32; 3]], colour: Colour) {
        let mut edges: Vec<(u32, u32)> = triangles
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        for (a, b) in edges {
            let [a, b] = [a, b].map(|i| transform.transform_point3(points[i as usize]));
            self.line(a, b, colour);
        }
    }

    /// Adds the axes of a transform in red, green and blue.
    pub fn axes(&mut self, transform: Mat4, length: f32) {
        let origin = transform.transform_point3(Vec3::ZERO);
        for (axis, colour) in
            Vec3::AXES.into_iter().zip([[0.9, 0.1, 0.1, 1.0], [0.1, 0.7, 0.1, 1.0], [0.1, 0.2, 0.9, 1.0]])
        {
            self.line(origin, transform.transform_point3(axis * length), colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_have_the_expected_edges() {
        let mut overlay = Overlay::default();
        overlay.cuboid(Mat4::IDENTITY, Vec3::ONE, [1.0; 4]);
        assert_eq!(overlay.lines.len(), 12);
        assert!(overlay.lines.iter().all(|line| (line.from.distance(line.to) - 2.0).abs() < 1e-6));

        let mut overlay = Overlay::default();
        overlay.triangles(
            Mat4::IDENTITY,
            &[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE],
            &[[0, 1, 2], [2, 1, 3]],
            [1.0; 4],
        );
        assert_eq!(overlay.lines.len(), 5);

        let mut overlay = Overlay::default();
        overlay.sphere(Mat4::from_translation(Vec3::X), 0.5, [1.0; 4]);
        assert!(overlay.lines.iter().all(|line| (line.from.distance(Vec3::X) - 0.5).abs() < 1e-5));
    }
}
