//! The orientation field of a body as short lines at the vertices of its cells. Directions have no sense: a line has no head.

use glam::{Mat3, Vec3};
use pliant::procdef::ProcDefModel;

use super::section::Place;
use crate::render::Overlay;
use crate::render::overlay::Line;

/// Colours and lengths, in edges of the boundary, of the primary, secondary and tertiary direction.
const LINES: [([f32; 4], f32); 3] =
    [([0.70, 0.02, 0.02, 1.0], 0.85), ([0.02, 0.40, 0.05, 0.9], 0.35), ([0.02, 0.10, 0.65, 0.9], 0.35)];

/// How far lines are lifted off the surface, in edges of the boundary.
const LIFT: f32 = 0.12;

/// Width of the lines in pixels of a picture that is 540 pixels high.
const WIDTH: f32 = 1.8;

/// Opacity of lines behind a surface, relative to those before it.
const HIDDEN: f32 = 0.05;

/// What carries the directions of a kind of body along.
pub struct Directions {
    /// For each vertex of the cells one cell around it, and the inverse of that cell's edges at rest.
    carriers: Vec<Option<([u32; 4], Mat3)>>,
    edge: f32,
}

impl Directions {
    /// Finds the largest cell around each vertex.
    pub fn new(model: &ProcDefModel) -> Self {
        let mesh = model.rig.mesh();
        let mut carriers = vec![None; mesh.vertex_count()];
        let mut largest = vec![0.0; mesh.vertex_count()];
        for (cell, volume) in mesh.cells.iter().zip(mesh.volumes()) {
            let inverse = edges(&mesh.positions, cell).inverse();
            for &v in cell {
                if volume > largest[v as usize] {
                    largest[v as usize] = volume;
                    carriers[v as usize] = Some((*cell, inverse));
                }
            }
        }
        Self { carriers, edge: model.boundary_edge() }
    }

    /// Adds the lines at the vertices of the boundary, for these positions of the cells.
    pub fn draw_boundary(&self, model: &ProcDefModel, cells: &[Vec3], overlay: &mut Overlay) {
        let normals = normals(&model.boundary, cells);
        let vertices = (0u32..).zip(normals).filter(|(_, normal)| *normal != Vec3::ZERO);
        self.draw(model, cells, vertices.map(|(v, normal)| ((v, v, 0.0), normal)), overlay);
    }

    /// Adds the lines at places on the edges of the cells, lifted along a normal each.
    pub fn draw(
        &self,
        model: &ProcDefModel,
        cells: &[Vec3],
        sites: impl Iterator<Item = (Place, Vec3)>,
        overlay: &mut Overlay,
    ) {
        overlay.hidden = HIDDEN;
        for ((a, b, share), normal) in sites {
            let [Some(first), Some(second)] = [a, b].map(|v| self.frame(model, cells, v)) else { continue };
            let place = cells[a as usize].lerp(cells[b as usize], share) + normal * (LIFT * self.edge);
            for (k, (colour, length)) in LINES.into_iter().enumerate() {
                let (from, to) = (first.col(k), second.col(k));
                let to = if from.dot(to) < 0.0 { -to } else { to };
                let half = from.lerp(to, share).normalize_or_zero() * (0.5 * length * self.edge);
                overlay.lines.push(Line { from: place - half, to: place + half, width: WIDTH, colour });
            }
        }
    }

    /// The directions at a vertex now, of unit length.
    fn frame(&self, model: &ProcDefModel, cells: &[Vec3], vertex: u32) -> Option<Mat3> {
        let (cell, inverse) = self.carriers[vertex as usize].as_ref()?;
        let frame = edges(cells, cell) * *inverse * model.motion.fields().orientation.frames[vertex as usize];
        Some(Mat3::from_cols(
            frame.x_axis.normalize_or_zero(),
            frame.y_axis.normalize_or_zero(),
            frame.z_axis.normalize_or_zero(),
        ))
    }
}

/// Unit normals of the boundary's vertices; zero for those inside.
fn normals(boundary: &[[u32; 3]], positions: &[Vec3]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for t in boundary {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        t.iter().for_each(|&v| normals[v as usize] += (b - a).cross(c - a));
    }
    normals.into_iter().map(Vec3::normalize_or_zero).collect()
}

fn edges(positions: &[Vec3], cell: &[u32; 4]) -> Mat3 {
    let [a, b, c, d] = cell.map(|v| positions[v as usize]);
    Mat3::from_cols(b - a, c - a, d - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::choose;

    #[test]
    fn lines_turn_with_the_body_and_lie_where_they_are_asked_for() {
        let simulation = choose::simulation("bending-bar", 0).unwrap();
        let model = &simulation.soft_actors[0].kind.model;
        let directions = Directions::new(model);
        let rest = &model.rig.mesh().positions;
        let turned: Vec<Vec3> = rest.iter().map(|p| Vec3::new(-p.y, p.x, p.z)).collect();
        let [before, after] = [rest, &turned].map(|cells| {
            let mut overlay = Overlay::default();
            directions.draw_boundary(model, cells, &mut overlay);
            overlay.lines
        });
        let surface = model.rig.mesh().surface_vertices().len();
        assert_eq!((before.len(), after.len()), (3 * surface, 3 * surface));
        for (before, after) in before.iter().zip(&after) {
            let (a, b) = (before.to - before.from, after.to - after.from);
            assert!((Vec3::new(-a.y, a.x, a.z) - b).length() < 1e-4, "{a} {b}");
        }
        // The primary direction of the bar runs along it.
        assert!(before.iter().step_by(3).all(|line| (line.to - line.from).normalize().x.abs() > 0.9));
        let [a, b, ..] = model.rig.mesh().cells[0];
        let mut overlay = Overlay::default();
        directions.draw(model, rest, [((a, b, 0.25), Vec3::ZERO)].into_iter(), &mut overlay);
        let place = rest[a as usize].lerp(rest[b as usize], 0.25);
        assert_eq!(overlay.lines.len(), 3);
        assert!(overlay.lines.iter().all(|line| (0.5 * (line.from + line.to)).distance(place) < 1e-5));
    }
}
