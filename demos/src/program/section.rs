//! A body cut open by a plane of its mesh at rest: the cells' boundary on one side of it, and the cut through the cells.
//!
//! Every vertex lies on an edge of a cell (or at its end), so that the cut goes along when the body deforms.

use std::collections::BTreeMap;
use std::str::FromStr;

use glam::Vec3;
use pliant::mesh::{MeshError, NormalTopology, TetrahedralMesh};

/// A plane of the mesh at rest: one coordinate has one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// 0, 1 or 2 for x, y or z.
    pub axis: usize,
    /// The value in metres.
    pub at: f32,
}

impl FromStr for Cut {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('=').map(|(axis, at)| (axis.trim(), at.trim().parse::<f32>()));
        let axis = parts.as_ref().and_then(|(axis, _)| ["x", "y", "z"].iter().position(|name| name == axis));
        match (axis, parts) {
            (Some(axis), Some((_, Ok(at)))) if at.is_finite() => Ok(Self { axis, at }),
            _ => Err("write it like x=0.1: a coordinate of the mesh and its value in metres".into()),
        }
    }
}

/// A place on an edge between two vertices of the cells: the share of the way from the first to the second.
pub type Place = (u32, u32, f32);

/// A body cut open.
#[derive(Clone, Debug)]
pub struct Section {
    places: Vec<Place>,
    triangles: Vec<[u32; 3]>,
    topology: NormalTopology,
}

impl Section {
    /// Cuts the cells of a body; what is on the side of the `eye`, in the frame of the mesh, is taken away.
    pub fn new(mesh: &TetrahedralMesh, boundary: &[[u32; 3]], cut: Cut, eye: Vec3) -> Result<Self, MeshError> {
        let side = if eye[cut.axis] >= cut.at { 1.0 } else { -1.0 };
        // Positive on the side that is taken away.
        let height: Vec<f32> = mesh.positions.iter().map(|x| side * (x[cut.axis] - cut.at)).collect();
        let mut shell = Patch::new(&height);
        boundary.iter().for_each(|&t| shell.add_clipped(t));
        let mut inside = Patch::new(&height);
        let outward = Vec3::AXES[cut.axis] * side;
        mesh.cells.iter().for_each(|&cell| inside.add_cut(cell, &mesh.positions, outward));
        // The two have vertices of their own, so that the edge between them is sharp.
        let first = shell.places.len() as u32;
        let mut triangles = shell.triangles;
        triangles.extend(inside.triangles.iter().map(|t| t.map(|v| v + first)));
        let mut places = shell.places;
        places.extend(inside.places);
        let welded: Vec<u32> = (0..places.len() as u32).collect();
        let topology = NormalTopology::new(&triangles, &welded)?;
        Ok(Self { places, triangles, topology })
    }

    /// Corners of the triangles, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Where its vertices lie on the edges of the cells.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Positions and normals for these positions of the cells' vertices.
    pub fn deform(&self, cells: &[Vec3], positions: &mut Vec<Vec3>, normals: &mut Vec<Vec3>) -> Result<(), MeshError> {
        positions.clear();
        positions.extend(self.places.iter().map(|&(a, b, share)| cells[a as usize].lerp(cells[b as usize], share)));
        self.topology.normals_into(positions, &mut Vec::new(), normals)
    }

    /// Values of the cells' vertices at the vertices of the section.
    pub fn spread(&self, values: &[f32], out: &mut Vec<f32>) {
        out.clear();
        out.extend(self.places.iter().map(|&(a, b, share)| {
            let (a, b) = (values[a as usize], values[b as usize]);
            a + share * (b - a)
        }));
    }
}

/// Triangles that share vertices.
struct Patch<'a> {
    height: &'a [f32],
    places: Vec<Place>,
    triangles: Vec<[u32; 3]>,
    known: BTreeMap<(u32, u32), u32>,
}

impl<'a> Patch<'a> {
    fn new(height: &'a [f32]) -> Self {
        Self { height, places: Vec::new(), triangles: Vec::new(), known: BTreeMap::new() }
    }

    fn is_kept(&self, vertex: u32) -> bool {
        self.height[vertex as usize] < 0.0
    }

    fn vertex(&mut self, place: Place) -> u32 {
        let next = self.places.len() as u32;
        let known = *self.known.entry((place.0, place.1)).or_insert(next);
        if known == next {
            self.places.push(place);
        }
        known
    }

    /// Where the edge between two vertices on different sides meets the plane.
    fn crossing(&mut self, a: u32, b: u32) -> u32 {
        let (a, b) = (a.min(b), a.max(b));
        let (from, to) = (self.height[a as usize], self.height[b as usize]);
        self.vertex((a, b, (from / (from - to)).clamp(0.0, 1.0)))
    }

    /// Adds what is left of a triangle.
    fn add_clipped(&mut self, corners: [u32; 3]) {
        let mut polygon = Vec::with_capacity(4);
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % 3];
            if self.is_kept(a) {
                polygon.push(self.vertex((a, a, 0.0)));
            }
            if self.is_kept(a) != self.is_kept(b) {
                polygon.push(self.crossing(a, b));
            }
        }
        self.add_fan(&polygon);
    }

    /// Adds the cut through a cell, facing `outward`.
    fn add_cut(&mut self, cell: [u32; 4], rest: &[Vec3], outward: Vec3) {
        let (kept, gone): (Vec<u32>, Vec<u32>) = cell.into_iter().partition(|&v| self.is_kept(v));
        let edges: &[(u32, u32)] = &match (&kept[..], &gone[..]) {
            (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => vec![(a, b), (a, c), (a, d)],
            (&[a, b], &[c, d]) => vec![(a, c), (a, d), (b, d), (b, c)],
            _ => return,
        };
        let mut polygon: Vec<u32> = edges.iter().map(|&(a, b)| self.crossing(a, b)).collect();
        let corner = |v: u32| {
            let (a, b, share) = self.places[v as usize];
            rest[a as usize].lerp(rest[b as usize], share)
        };
        let [a, b, c] = [0, 1, 2].map(|k| corner(polygon[k]));
        if (b - a).cross(c - a).dot(outward) < 0.0 {
            polygon.reverse();
        }
        self.add_fan(&polygon);
    }

    fn add_fan(&mut self, polygon: &[u32]) {
        if let Some((&first, rest)) = polygon.split_first() {
            self.triangles.extend(rest.windows(2).map(|pair| [first, pair[0], pair[1]]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pliant::mesh::measure::signed_volume;

    /// A block of two by one by one cubes, each of six cells.
    fn block() -> TetrahedralMesh {
        let vertex = |x: u32, y: u32, z: u32| x + 3 * (y + 2 * z);
        let positions = (0..12).map(|i| Vec3::new((i % 3) as f32, (i / 3 % 2) as f32, (i / 6) as f32)).collect();
        let mut cells = Vec::new();
        for x in 0..2 {
            // Along the diagonal from one corner to the opposite one, six ways over the edges.
            for [i, j, k] in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
                let mut at = [x, 0, 0];
                let mut cell = [vertex(at[0], at[1], at[2]); 4];
                for (step, axis) in [i, j, k].into_iter().enumerate() {
                    at[axis] += 1;
                    cell[step + 1] = vertex(at[0], at[1], at[2]);
                }
                // Every other way runs around the diagonal the other way.
                if (j + 3 - i) % 3 == 2 {
                    cell.swap(1, 2);
                }
                cells.push(cell);
            }
        }
        TetrahedralMesh::new(positions, cells).unwrap()
    }

    #[test]
    fn a_cut_body_encloses_what_is_left_of_it_and_faces_outward() {
        let mesh = block();
        let boundary = mesh.boundary();
        let cuts =
            [(0, 0.7, 5.0, 0.7), (0, 0.7, -5.0, 1.3), (1, 0.25, 5.0, 0.5), (2, 0.5, -5.0, 1.0), (0, 9.0, 10.0, 2.0)];
        for (axis, at, eye, volume) in cuts {
            let section = Section::new(&mesh, &boundary, Cut { axis, at }, Vec3::splat(eye)).unwrap();
            let (mut positions, mut normals) = (Vec::new(), Vec::new());
            section.deform(&mesh.positions, &mut positions, &mut normals).unwrap();
            let enclosed = signed_volume(&positions, section.triangles());
            assert!((enclosed - volume).abs() < 1e-5, "{axis} {at} {eye}: {enclosed} instead of {volume}");
            // Bent, it still encloses as much as is left of the bent cells: the cut goes along.
            let sheared: Vec<Vec3> = mesh.positions.iter().map(|p| *p + Vec3::Y * p.x + Vec3::Z * p.y).collect();
            section.deform(&sheared, &mut positions, &mut normals).unwrap();
            assert!((signed_volume(&positions, section.triangles()) - volume).abs() < 1e-5, "{axis} {at} {eye}");
        }
    }

    #[test]
    fn values_are_spread_along_the_edges() {
        let mesh = block();
        let section = Section::new(&mesh, &mesh.boundary(), Cut { axis: 0, at: 1.3 }, Vec3::X * 9.0).unwrap();
        let values: Vec<f32> = mesh.positions.iter().map(|p| 2.0 * p.x - p.y + 0.5 * p.z).collect();
        let (mut positions, mut spread) = (Vec::new(), Vec::new());
        section.deform(&mesh.positions, &mut positions, &mut Vec::new()).unwrap();
        section.spread(&values, &mut spread);
        // Linear between the vertices, so that it is met everywhere.
        assert!(positions.iter().zip(&spread).all(|(p, v)| (2.0 * p.x - p.y + 0.5 * p.z - v).abs() < 1e-5));
    }

    #[test]
    fn a_cut_is_a_coordinate_and_a_value() {
        assert_eq!("x=0.1".parse(), Ok(Cut { axis: 0, at: 0.1 }));
        assert_eq!("z = -2".parse(), Ok(Cut { axis: 2, at: -2.0 }));
        for bad in ["", "x", "w=1", "x=", "x=a", "x=nan", "x=inf", "x:1"] {
            assert!(bad.parse::<Cut>().is_err(), "{bad}");
        }
    }
}
