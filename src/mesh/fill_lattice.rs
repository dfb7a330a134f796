//! Isosurface stuffing: a lattice of tetrahedra cut along a surface (Labelle and Shewchuk, *Isosurface Stuffing: Fast Tetrahedral
//! Meshes with Good Dihedral Angles*, 2007).
//!
//! The body-centred cubic lattice has corners and centres of cubes; two neighbouring centres and an edge of the square between
//! them make a cell. A lattice vertex that the surface passes closely is moved onto it; then the cells that the surface
//! still crosses are cut where it crosses their edges, and what is inside is kept.

use std::collections::HashMap;

use crate::math::Vec3;

/// A lattice vertex is moved onto the surface if that crosses one of its edges nearer than this part of the edge's length:
/// along the axes, and from centres to corners. The paper's values, found there by a search for the best angles.
const NEAR_LONG: f32 = 0.249_99;
const NEAR_SHORT: f32 = 0.411_89;

/// Halvings of an edge when the place is sought where the surface crosses it.
const HALVINGS: u32 = 16;

/// Positions and cells inside the surface, from the signed distance to it (positive inside) and its bounding box.
pub(super) fn stuff(
    signed_distance: impl Fn(Vec3) -> f32,
    [low, high]: [Vec3; 2],
    cell_size: f32,
) -> (Vec<Vec3>, Vec<[u32; 4]>) {
    let mut lattice = Lattice::new(low, high, cell_size);
    let cells = lattice.cells();
    let mut value: Vec<f32> = lattice.points.iter().map(|&p| signed_distance(p)).collect();

    let mut edges: Vec<[u32; 2]> = cells.iter().flat_map(|c| pairs(*c)).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut cuts: HashMap<[u32; 2], Vec3> = HashMap::new();
    for &[a, b] in &edges {
        if value[a as usize] * value[b as usize] < 0.0 {
            let ends = [a, b].map(|v| lattice.points[v as usize]);
            cuts.insert([a, b], crossing(&signed_distance, ends, value[a as usize] > 0.0));
        }
    }
    warp(&mut lattice, &mut value, &mut cuts, &edges);

    let mut clip = Clip { points: lattice.points, value, cuts, names: HashMap::new(), cells: Vec::new() };
    cells.into_iter().for_each(|cell| clip.cell(cell));
    clip.compacted()
}

/// Where the surface crosses an edge.
fn crossing(signed_distance: &impl Fn(Vec3) -> f32, [a, b]: [Vec3; 2], inside_first: bool) -> Vec3 {
    let (mut inside, mut outside) = if inside_first { (a, b) } else { (b, a) };
    for _ in 0..HALVINGS {
        let middle = (inside + outside) * 0.5;
        if signed_distance(middle) > 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    (inside + outside) * 0.5
}

/// Moves vertices onto the surface that it passes closely.
fn warp(lattice: &mut Lattice, value: &mut [f32], cuts: &mut HashMap<[u32; 2], Vec3>, edges: &[[u32; 2]]) {
    let mut of_vertex: Vec<Vec<[u32; 2]>> = vec![Vec::new(); lattice.points.len()];
    for &edge in edges.iter().filter(|e| cuts.contains_key(*e)) {
        edge.iter().for_each(|&v| of_vertex[v as usize].push(edge));
    }
    for v in 0..lattice.points.len() {
        let own = lattice.points[v];
        let mut nearest: Option<(f32, Vec3)> = None;
        for edge in &of_vertex[v] {
            let Some(&cut) = cuts.get(edge) else { continue };
            // Both ends of an axis edge are corners, or centres.
            let long = (edge[0] < lattice.corners) == (edge[1] < lattice.corners);
            let (near, length) = if long { (NEAR_LONG, 1.0) } else { (NEAR_SHORT, 0.75f32.sqrt()) };
            let part = cut.distance(own) / (length * lattice.size);
            if part < near && nearest.is_none_or(|(best, _)| part < best) {
                nearest = Some((part, cut));
            }
        }
        if let Some((_, cut)) = nearest {
            lattice.points[v] = cut;
            value[v] = 0.0;
            for edge in &of_vertex[v] {
                cuts.remove(edge);
            }
        }
    }
}

fn pairs([a, b, c, d]: [u32; 4]) -> [[u32; 2]; 6] {
    [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]].map(|[u, v]| [u.min(v), u.max(v)])
}

/// The points of the body-centred cubic lattice: first the corners of cubes, then their centres.
struct Lattice {
    points: Vec<Vec3>,
    /// Number of corners.
    corners: u32,
    /// Cubes along each axis.
    cubes: [u32; 3],
    size: f32,
}

impl Lattice {
    /// Covers a box with a margin of more than a cube.
    fn new(low: Vec3, high: Vec3, size: f32) -> Self {
        let cubes = ((high - low) / size).to_array().map(|n| n.ceil() as u32 + 3);
        let extent = Vec3::new(cubes[0] as f32, cubes[1] as f32, cubes[2] as f32) * size;
        let origin = (low + high - extent) * 0.5;
        let mut points = Vec::new();
        for (more, shift) in [(1, 0.0), (0, 0.5)] {
            for z in 0..cubes[2] + more {
                for y in 0..cubes[1] + more {
                    for x in 0..cubes[0] + more {
                        points.push(origin + (Vec3::new(x as f32, y as f32, z as f32) + shift) * size);
                    }
                }
            }
        }
        let corners = cubes.iter().map(|n| n + 1).product();
        Self { points, corners, cubes, size }
    }

    fn corner(&self, [x, y, z]: [u32; 3]) -> u32 {
        x + (self.cubes[0] + 1) * (y + (self.cubes[1] + 1) * z)
    }

    fn centre(&self, [x, y, z]: [u32; 3]) -> u32 {
        self.corners + x + self.cubes[0] * (y + self.cubes[1] * z)
    }

    fn cells(&self) -> Vec<[u32; 4]> {
        let mut cells = Vec::new();
        for z in 0..self.cubes[2] {
            for y in 0..self.cubes[1] {
                for x in 0..self.cubes[0] {
                    let here = [x, y, z];
                    for axis in 0..3 {
                        let mut there = here;
                        there[axis] += 1;
                        if there[axis] < self.cubes[axis] {
                            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                            let round = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[du, dv]| {
                                let mut at = there;
                                at[u] += du;
                                at[v] += dv;
                                self.corner(at)
                            });
                            for k in 0..4 {
                                cells.push([self.centre(here), self.centre(there), round[k], round[(k + 1) % 4]]);
                            }
                        }
                    }
                }
            }
        }
        cells
    }
}

/// Cuts cells along the surface.
struct Clip {
    points: Vec<Vec3>,
    value: Vec<f32>,
    cuts: HashMap<[u32; 2], Vec3>,
    /// The points made at cuts.
    names: HashMap<[u32; 2], u32>,
    cells: Vec<[u32; 4]>,
}

impl Clip {
    fn cell(&mut self, cell: [u32; 4]) {
        let side =
            |s: fn(f32) -> bool| cell.iter().copied().filter(|&v| s(self.value[v as usize])).collect::<Vec<u32>>();
        let (inside, on, outside) = (side(|f| f > 0.0), side(|f| f == 0.0), side(|f| f < 0.0));
        match (inside.len(), outside.len()) {
            (0, _) => {}
            (_, 0) => self.push(cell),
            (1, _) => {
                let mut corners = vec![inside[0]];
                corners.extend(&on);
                outside.iter().for_each(|&o| corners.push(self.cut(inside[0], o)));
                self.push([corners[0], corners[1], corners[2], corners[3]]);
            }
            (2, 1) => {
                let [a, b] = [inside[0], inside[1]];
                let (ca, cb) = (self.cut(a, outside[0]), self.cut(b, outside[0]));
                self.solid(&[
                    vec![a, b, cb, ca],
                    vec![a, b, on[0]],
                    vec![b, cb, on[0]],
                    vec![cb, ca, on[0]],
                    vec![ca, a, on[0]],
                ]);
            }
            (2, _) => {
                let (near, far) = (inside[0], inside[1]);
                let one = [near, self.cut(near, outside[0]), self.cut(near, outside[1])];
                let two = [far, self.cut(far, outside[0]), self.cut(far, outside[1])];
                self.prism(one, two);
            }
            _ => {
                let one = [inside[0], inside[1], inside[2]];
                let two = one.map(|v| self.cut(v, outside[0]));
                self.prism(one, two);
            }
        }
    }

    /// The point where the surface cuts the edge of two vertices.
    fn cut(&mut self, a: u32, b: u32) -> u32 {
        let edge = [a.min(b), a.max(b)];
        if let Some(&name) = self.names.get(&edge) {
            return name;
        }
        let name = self.points.len() as u32;
        let middle = (self.points[a as usize] + self.points[b as usize]) * 0.5;
        self.points.push(self.cuts.get(&edge).copied().unwrap_or(middle));
        self.names.insert(edge, name);
        name
    }

    fn prism(&mut self, [a, b, c]: [u32; 3], [d, e, f]: [u32; 3]) {
        self.solid(&[vec![a, b, c], vec![d, e, f], vec![a, b, e, d], vec![b, c, f, e], vec![c, a, d, f]]);
    }

    /// Cells of a convex solid from its faces, triangles and quadrangles: all faces are cut from their vertex of the lowest
    /// number, so that neighbours agree, and joined to the solid's lowest one.
    fn solid(&mut self, faces: &[Vec<u32>]) {
        let lowest = |face: &[u32]| face.iter().copied().min().unwrap_or(0);
        let apex = faces.iter().map(|f| lowest(f)).min().unwrap_or(0);
        for face in faces.iter().filter(|face| !face.contains(&apex)) {
            let start = face.iter().position(|&v| v == lowest(face)).unwrap_or(0);
            let at = |k: usize| face[(start + k) % face.len()];
            for k in 1..face.len() - 1 {
                self.push([apex, at(0), at(k), at(k + 1)]);
            }
        }
    }

    fn push(&mut self, cell: [u32; 4]) {
        let [a, b, c, d] = cell.map(|v| self.points[v as usize]);
        let turned = (b - a).dot((c - a).cross(d - a)) < 0.0;
        self.cells.push(if turned { [cell[0], cell[2], cell[1], cell[3]] } else { cell });
    }

    /// Without the points that no cell uses.
    fn compacted(self) -> (Vec<Vec3>, Vec<[u32; 4]>) {
        let mut name = vec![u32::MAX; self.points.len()];
        let mut points = Vec::new();
        let mut cells = self.cells;
        for v in cells.iter_mut().flatten() {
            let old = *v as usize;
            if name[old] == u32::MAX {
                name[old] = points.len() as u32;
                points.push(self.points[old]);
            }
            *v = name[old];
        }
        (points, cells)
    }
}
