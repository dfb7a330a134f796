//! The verdict on a surface: closed or where not, turned outward or inward, in how many pieces.

use super::{TriangleMesh, measure};

/// An edge by its two points (vertex indices of the welded topology), the lower first.
pub type Edge = [u32; 2];

/// Which way the triangles of a surface face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// The signed volume is positive: triangles turn counter-clockwise seen from outside.
    Outward,
    /// The signed volume is negative.
    Inward,
    /// The surface encloses nothing.
    Flat,
}

/// What a surface is, judged on its welded topology. Triangles whose corners weld together, or that name a vertex which
/// does not exist, are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// Edges with one triangle only, in ascending order.
    pub open: Vec<Edge>,
    /// Edges with more than two triangles, in ascending order.
    pub non_manifold: Vec<Edge>,
    /// Edges that their triangles do not pass equally often in both directions, open ones left out, in ascending order.
    pub inconsistent: Vec<Edge>,
    /// Which way the triangles face.
    pub orientation: Orientation,
    /// Number of pieces that are not connected by an edge.
    pub components: usize,
}

impl Topology {
    /// Judges a mesh; O(n log n).
    pub fn of(mesh: &TriangleMesh) -> Self {
        let mut edges: Vec<(Edge, bool)> = Vec::with_capacity(3 * mesh.triangles.len());
        let mut pieces = Pieces::new(mesh.positions.len());
        let mut used = vec![false; mesh.positions.len()];
        for t in &mesh.triangles {
            let point = |i: u32| mesh.welded.get(i as usize).copied().filter(|&p| (p as usize) < used.len());
            let [Some(a), Some(b), Some(c)] = t.map(point) else { continue };
            if a == b || b == c || c == a {
                continue;
            }
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.push(([from.min(to), from.max(to)], from < to));
                pieces.join(from, to);
                used[from as usize] = true;
            }
        }
        edges.sort_unstable();
        let (mut open, mut non_manifold, mut inconsistent) = (Vec::new(), Vec::new(), Vec::new());
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            let forward = same.iter().filter(|e| e.1).count();
            if same.len() == 1 {
                open.push(same[0].0);
            } else if 2 * forward != same.len() {
                inconsistent.push(same[0].0);
            }
            if same.len() > 2 {
                non_manifold.push(same[0].0);
            }
        }
        let components = (0..mesh.positions.len() as u32).filter(|&v| used[v as usize] && pieces.root(v) == v).count();
        let volume = measure::signed_volume(&mesh.positions, &mesh.triangles);
        let orientation = match volume {
            v if v > 0.0 => Orientation::Outward,
            v if v < 0.0 => Orientation::Inward,
            _ => Orientation::Flat,
        };
        Self { open, non_manifold, inconsistent, orientation, components }
    }

    /// True when the surface encloses a volume: no open edge, and every edge is passed equally often both ways. Edges
    /// where two closed parts touch are allowed.
    pub fn is_closed(&self) -> bool {
        self.open.is_empty() && self.inconsistent.is_empty()
    }

    /// True when the surface is closed and every edge has exactly two triangles.
    pub fn is_closed_manifold(&self) -> bool {
        self.is_closed() && self.non_manifold.is_empty()
    }
}

/// Union-find over points; the root of a piece is its lowest index.
struct Pieces(Vec<u32>);

impl Pieces {
    fn new(points: usize) -> Self {
        Self((0..points as u32).collect())
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            self.0[v as usize] = self.0[self.0[v as usize] as usize];
            v = self.0[v as usize];
        }
        v
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::mesh::measure::tests::sphere;

    #[test]
    fn a_sphere_is_one_closed_outward_piece() {
        let topology = Topology::of(&sphere(1.0, 12, 8));
        assert!(topology.is_closed_manifold());
        assert_eq!((topology.orientation, topology.components), (Orientation::Outward, 1));
    }

    #[test]
    fn a_missing_triangle_leaves_three_open_edges() {
        let mut mesh = sphere(1.0, 12, 8);
        let gone = mesh.triangles.pop().unwrap();
        let topology = Topology::of(&mesh);
        assert!(!topology.is_closed());
        assert_eq!(topology.open.len(), 3);
        assert!(topology.open.iter().flatten().all(|v| gone.contains(v)));
    }

    #[test]
    fn triangles_that_name_no_vertex_are_holes() {
        let mut mesh = sphere(1.0, 12, 8);
        mesh.triangles[0][0] = 10_000;
        assert_eq!(Topology::of(&mesh).open.len(), 3);
        mesh.welded.clear();
        assert_eq!(Topology::of(&mesh).components, 0);
    }

    #[test]
    fn a_triangle_turned_over_is_inconsistent_along_its_edges() {
        let mut mesh = sphere(1.0, 12, 8);
        mesh.triangles[0].swap(1, 2);
        let topology = Topology::of(&mesh);
        assert_eq!((topology.open.len(), topology.inconsistent.len()), (0, 3));
    }

    #[test]
    fn a_surface_inside_out_is_inward_and_closed() {
        let mut mesh = sphere(1.0, 12, 8);
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        let topology = Topology::of(&mesh);
        assert!(topology.is_closed());
        assert_eq!(topology.orientation, Orientation::Inward);
    }

    #[test]
    fn two_tetrahedra_that_share_an_edge_are_closed_but_not_manifold() {
        let p = vec![Vec3::ZERO, Vec3::Y, Vec3::X, Vec3::Z, -Vec3::X, -Vec3::Z];
        let t = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [0, 1, 4], [0, 4, 5], [0, 5, 1], [1, 5, 4]];
        let topology = Topology::of(&TriangleMesh::from_triangles(p, t).unwrap());
        assert!(topology.is_closed() && !topology.is_closed_manifold());
        assert_eq!(topology.non_manifold, [[0, 1]]);
    }

    #[test]
    fn two_spheres_are_two_pieces_and_a_sheet_is_flat_and_open() {
        let ball = sphere(1.0, 8, 6);
        let n = ball.positions.len() as u32;
        let mut p = ball.positions.clone();
        p.extend(ball.positions.iter().map(|p| *p + Vec3::X * 5.0));
        let mut t = ball.triangles.clone();
        t.extend(ball.triangles.iter().map(|t| t.map(|i| i + n)));
        assert_eq!(Topology::of(&TriangleMesh::from_triangles(p, t).unwrap()).components, 2);
        let sheet = TriangleMesh::from_triangles(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]]).unwrap();
        assert_eq!(Topology::of(&sheet).orientation, Orientation::Flat);
    }
}
