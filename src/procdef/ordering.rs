//! An order of the vertices that serves both the sums over regions and the factorisation of the global solve.
//!
//! *Nested dissection* (George 1973): the body is halved at its longest side; the vertices of one half that touch the other
//! separate the two and come last. Done again in each half, it fills a sparse factor little, and vertices that are near in
//! the body are near in memory.

use crate::mesh::{TetrahedralMesh, VertexLists};

/// Parts of at most so many vertices are not cut further.
const LEAF: usize = 24;

/// The vertices of a mesh in the order of nested dissection.
pub(super) fn nested_dissection(mesh: &TetrahedralMesh, neighbours: &VertexLists) -> Vec<u32> {
    let mut order = Vec::with_capacity(mesh.vertex_count());
    let mut side = vec![0u32; mesh.vertex_count()];
    let mut mark = 0;
    dissect(mesh, neighbours, (0..mesh.vertex_count() as u32).collect(), &mut side, &mut mark, &mut order);
    order
}

/// Appends `part` to `order`. `side` marks the half that is being looked at, with a number of its own each time.
fn dissect(
    mesh: &TetrahedralMesh,
    neighbours: &VertexLists,
    mut part: Vec<u32>,
    side: &mut [u32],
    mark: &mut u32,
    order: &mut Vec<u32>,
) {
    if part.len() <= LEAF {
        order.extend(part);
        return;
    }
    let at = |v: u32| mesh.positions[v as usize];
    let (low, high) = part.iter().fold((at(part[0]), at(part[0])), |(l, h), &v| (l.min(at(v)), h.max(at(v))));
    let axis = (high - low).max_position();
    part.sort_by(|&a, &b| at(a)[axis].total_cmp(&at(b)[axis]).then(a.cmp(&b)));
    let upper = part.split_off(part.len() / 2);
    *mark += 1;
    part.iter().for_each(|&v| side[v as usize] = *mark);
    let (separator, rest): (Vec<u32>, Vec<u32>) =
        upper.into_iter().partition(|&v| neighbours.of(v as usize).iter().any(|&n| side[n as usize] == *mark));
    // A part that is all separator is not cut by taking it out.
    if rest.is_empty() {
        order.extend(part);
        order.extend(separator);
        return;
    }
    dissect(mesh, neighbours, part, side, mark, order);
    dissect(mesh, neighbours, rest, side, mark, order);
    order.extend(separator);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn every_vertex_comes_once_also_when_many_lie_in_one_place_along_an_axis() {
        // A row of cubes, each in six cells.
        let n = 40u32;
        let at = |i: u32| Vec3::new((i / 4) as f32, (i & 1) as f32, (i >> 1 & 1) as f32);
        let positions: Vec<Vec3> = (0..4 * (n + 1)).map(at).collect();
        let mut cells = Vec::new();
        for k in 0..n {
            let v = |x: u32, y: u32, z: u32| 4 * (k + x) + y + 2 * z;
            let path = [[(1, 0, 0), (1, 1, 0)], [(1, 1, 0), (0, 1, 0)], [(0, 1, 0), (0, 1, 1)]];
            let more = [[(0, 1, 1), (0, 0, 1)], [(0, 0, 1), (1, 0, 1)], [(1, 0, 1), (1, 0, 0)]];
            for [a, b] in path.into_iter().chain(more) {
                cells.push([v(0, 0, 0), v(a.0, a.1, a.2), v(b.0, b.1, b.2), v(1, 1, 1)]);
            }
        }
        let mesh = TetrahedralMesh::new(positions, cells).unwrap();
        let mut order = nested_dissection(&mesh, &mesh.neighbours());
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..mesh.vertex_count() as u32));
    }
}
