//! Tetrahedra from swept triangles. Each prism is cut along diagonals that the order of its base vertices decides, so that
//! neighbouring prisms agree.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use glam::Vec3;
use pliant::mesh::TetrahedralMesh;

use crate::modeller::mesh::Mesh;

/// Vertices and cells that grow.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Where the vertices are.
    pub positions: Vec<Vec3>,
    /// Four vertices each, of positive volume.
    pub cells: Vec<[u32; 4]>,
}

impl Cells {
    /// Sweeps flat triangles, counter-clockwise seen from where the sweep goes, through `layers` layers of vertices. The prism on
    /// a triangle between a layer and the next is there where `solid` says so.
    pub fn sweep(
        triangles: &[[u32; 3]],
        layers: usize,
        solid: impl Fn(usize, usize) -> bool,
        place: impl Fn(u32, usize) -> Vec3,
    ) -> Self {
        let mut swept = Self::default();
        // Numbers go by base vertex, then layer: the diagonals need the order of the base alone.
        let mut numbers: BTreeMap<(usize, u32), u32> = BTreeMap::new();
        for layer in 0..layers - 1 {
            for (t, corners) in triangles.iter().enumerate() {
                if solid(t, layer) {
                    for l in [layer, layer + 1] {
                        numbers.extend(corners.map(|v| ((l, v), 0)));
                    }
                }
            }
        }
        for (&(layer, v), number) in &mut numbers {
            *number = swept.positions.len() as u32;
            swept.positions.push(place(v, layer));
        }
        for layer in 0..layers - 1 {
            for (t, &corners) in triangles.iter().enumerate() {
                if solid(t, layer) {
                    let row = |l| corners.map(|v| numbers[&(l, v)]);
                    swept.prism(row(layer), row(layer + 1));
                }
            }
        }
        swept
    }

    /// Grows `layers` more layers from triangles of the boundary. `place` tells where a vertex of the base goes in layer
    /// 1, 2, …
    pub fn extrude(&mut self, base: &[[u32; 3]], layers: usize, place: impl Fn(Vec3, usize) -> Vec3) -> Vec<[u32; 3]> {
        let mut vertices: Vec<u32> = base.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let rest: Vec<Vec3> = vertices.iter().map(|&v| self.positions[v as usize]).collect();
        let mut below = vertices.clone();
        let mut faces = base.to_vec();
        for layer in 1..=layers {
            let first = self.positions.len() as u32;
            self.positions.extend(rest.iter().map(|p| place(*p, layer)));
            let above: Vec<u32> = (0..vertices.len() as u32).map(|k| first + k).collect();
            let number = |v: u32| below.binary_search(&v).map_or(first, |k| above[k]);
            let next: Vec<[u32; 3]> = faces.iter().map(|t| t.map(number)).collect();
            faces.iter().zip(&next).for_each(|(a, b)| self.prism(*a, *b));
            (below, faces) = (above, next);
        }
        faces
    }

    /// Closes triangles of the boundary by a tip.
    pub fn tip(&mut self, base: &[[u32; 3]], tip: Vec3) {
        let number = self.positions.len() as u32;
        self.positions.push(tip);
        self.cells.extend(base.iter().map(|&[a, b, c]| [a, b, c, number]));
    }

    /// The prism between two triangles, in three cells.
    fn prism(&mut self, bottom: [u32; 3], top: [u32; 3]) {
        let mut order = [0, 1, 2];
        order.sort_by_key(|&k| bottom[k]);
        let [i, j, k] = order;
        let even = (i + 1) % 3 == j;
        let (a, b) = (bottom, top);
        for [p, q, r, s] in [[a[i], a[j], a[k], b[k]], [a[i], b[j], a[j], b[k]], [a[i], b[i], b[j], b[k]]] {
            self.cells.push(if even { [p, q, r, s] } else { [p, r, q, s] });
        }
    }

    /// The triangles of the boundary that `keep` keeps by their corners.
    pub fn boundary(&self, keep: impl Fn([Vec3; 3]) -> bool) -> Vec<[u32; 3]> {
        let mesh = TetrahedralMesh { positions: self.positions.clone(), cells: self.cells.clone() };
        mesh.boundary().into_iter().filter(|t| keep(t.map(|v| self.positions[v as usize]))).collect()
    }

    /// The two neighbouring triangles of the boundary nearest to a point: a place for a stalk.
    pub fn patch(&self, near: Vec3) -> Vec<[u32; 3]> {
        let all = self.boundary(|_| true);
        let middle = |t: &[u32; 3]| t.iter().map(|&v| self.positions[v as usize]).sum::<Vec3>() / 3.0;
        let by_distance = |a: &&[u32; 3], b: &&[u32; 3]| middle(a).distance(near).total_cmp(&middle(b).distance(near));
        let Some(first) = all.iter().min_by(by_distance) else { return Vec::new() };
        let shares = |t: &&[u32; 3]| t.iter().filter(|v| first.contains(v)).count() == 2;
        let second = all.iter().filter(shares).min_by(by_distance);
        [Some(first), second].into_iter().flatten().copied().collect()
    }

    /// The checked mesh.
    pub fn finish(self) -> Result<TetrahedralMesh> {
        TetrahedralMesh::new(self.positions, self.cells).context("a modelled body")
    }

    /// The boundary as a surface of its own.
    pub fn surface(&self) -> Mesh {
        let triangles = self.boundary(|_| true);
        let mut numbers: BTreeMap<u32, u32> = triangles.iter().flatten().map(|&v| (v, 0)).collect();
        let mut positions = Vec::new();
        for (&v, number) in &mut numbers {
            *number = positions.len() as u32;
            positions.push(self.positions[v as usize]);
        }
        Mesh { positions, triangles: triangles.iter().map(|t| t.map(|v| numbers[&v])).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modeller::soft::disc::Disc;

    #[test]
    fn a_swept_disc_fills_its_cylinder_without_gaps() {
        let disc = Disc::new(&[1, 6, 12]);
        let cells = Cells::sweep(&disc.triangles, 5, |_, _| true, |v, l| disc.point(v).extend(l as f32 * 0.3));
        assert_eq!(cells.positions.len(), 19 * 5);
        let surface = cells.surface();
        assert!(surface.is_closed());
        let mesh = cells.finish().unwrap();
        let volume = 1.2 * 6.0 * 30f32.to_radians().sin();
        assert!((mesh.volume() as f32 - volume).abs() < 1e-4, "{}", mesh.volume());
        assert!((surface.volume() - volume).abs() < 1e-4);
    }

    #[test]
    fn what_is_extruded_from_a_boundary_stays_connected_with_it() {
        let disc = Disc::new(&[1, 6]);
        let mut cells = Cells::sweep(&disc.triangles, 3, |_, _| true, |v, l| disc.point(v).extend(l as f32));
        let side = cells.patch(Vec3::new(1.0, 0.3, 0.5));
        assert_eq!(side.len(), 2);
        let end = cells.extrude(&side, 3, |p, l| p + Vec3::X * 0.5 * l as f32);
        cells.tip(&end, Vec3::new(4.0, 0.3, 0.5));
        let surface = cells.surface();
        assert!(surface.is_closed() && surface.component_count() == 1 && surface.euler_characteristic() == 2);
        assert!(cells.finish().is_ok());
    }
}
