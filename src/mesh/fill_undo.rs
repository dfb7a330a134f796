//! What a change touches, noted before it: a change that leaves cells too flat is undone without a copy of all of them.

use super::fill_cells::{Change, Filling};
use super::fill_target::Place;
use crate::math::Vec3;

/// The cells that a change makes anew or moves, and their vertices.
pub(super) struct Before {
    vertices: Vec<Vertex>,
    cells: Vec<(u32, [u32; 4])>,
    vertex_count: usize,
    cell_count: usize,
}

struct Vertex {
    name: u32,
    position: Vec3,
    place: Place,
    cells: Vec<u32>,
}

impl Before {
    /// Notes what `change`, and making room for it, can touch.
    pub fn of(change: Change, filling: &Filling) -> Self {
        let cells = match change {
            Change::Move(v) => filling.around(&[v]),
            Change::SplitEdge(edge) => filling.around(&edge),
            Change::SplitFace(face) => filling.around(&face),
        };
        let cells: Vec<(u32, [u32; 4])> = cells.into_iter().map(|c| (c, filling.cells[c as usize])).collect();
        let mut names: Vec<u32> = cells.iter().flat_map(|(_, cell)| *cell).collect();
        names.sort_unstable();
        names.dedup();
        let vertex = |name: u32| Vertex {
            name,
            position: filling.positions[name as usize],
            place: filling.places[name as usize],
            cells: filling.of_vertex[name as usize].clone(),
        };
        Self {
            vertices: names.into_iter().map(vertex).collect(),
            cells,
            vertex_count: filling.positions.len(),
            cell_count: filling.cells.len(),
        }
    }

    /// Makes all as it was.
    pub fn restore(self, filling: &mut Filling) {
        filling.cells.truncate(self.cell_count);
        filling.positions.truncate(self.vertex_count);
        filling.places.truncate(self.vertex_count);
        filling.outside.truncate(self.vertex_count);
        filling.of_vertex.truncate(self.vertex_count);
        for (c, cell) in self.cells {
            filling.cells[c as usize] = cell;
        }
        for Vertex { name, position, place, cells } in self.vertices {
            filling.positions[name as usize] = position;
            filling.places[name as usize] = place;
            filling.of_vertex[name as usize] = cells;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::fill_target::Target;
    use crate::mesh::measure::tests::sphere;

    #[test]
    fn a_change_that_is_undone_leaves_nothing_behind() {
        let surface = sphere(0.5, 24, 12);
        let target = Target::of(&surface).unwrap();
        let (positions, cells) =
            crate::mesh::fill_lattice::stuff(|p| target.signed_distance(p), [Vec3::splat(-0.5), Vec3::splat(0.5)], 0.2);
        let start = Filling::new(positions, cells);
        let [a, b, c] = start.boundary()[7];
        for change in [Change::Move(a), Change::SplitEdge([a, b]), Change::SplitFace([a, b, c])] {
            let mut filling = start.clone();
            let before = Before::of(change, &filling);
            let goal = 1.1 * filling.positions[a as usize];
            let vertex = filling.apply(change, goal, Place::Edge);
            filling.make_room(vertex, &target, 0.2);
            assert_ne!(filling.positions, start.positions, "{change:?}");
            before.restore(&mut filling);
            assert_eq!(filling.positions, start.positions, "{change:?}");
            assert_eq!(filling.cells, start.cells, "{change:?}");
            assert_eq!(filling.places, start.places, "{change:?}");
            assert_eq!(filling.outside, start.outside, "{change:?}");
            assert_eq!(filling.of_vertex, start.of_vertex, "{change:?}");
        }
    }
}
