//! The local regions of a body (section 5): each vertex with its 1-ring, laid out for fast sums.
//!
//! Vertices are taken in an order in which neighbours lie near each other in memory ([`super::ordering`]), and each region is one row of
//! contiguous entries. Masses are divided by the number of regions that a vertex belongs to (`m̃ᵢ = mᵢ / |Nᵢ|`), so that
//! vertices in many regions do not weigh more than others.

use glam::{DVec3, Vec3};

use wide::{f32x4, f32x8};

use super::ordering::nested_dissection;
use super::rotation_wide::LANES;
use crate::mesh::TetrahedralMesh;

/// The regions of a body at rest.
#[derive(Clone, Debug)]
pub(super) struct Regions {
    /// For each place in the order, the vertex of the mesh.
    pub vertex: Vec<u32>,
    /// The place of each vertex of the mesh.
    pub place: Vec<u32>,
    /// Where each region's row starts; one more than there are regions.
    pub starts: Vec<u32>,
    /// The places of the vertices of each region, ascending.
    pub items: Vec<u32>,
    /// Beside each item `m̃ᵢ (xᵢ⁰ - c_r⁰)`, divided by the region's sum of `m̃ᵢ |xᵢ⁰ - c_r⁰|²`, and `m̃ᵢ / M_r`.
    pub weights: Vec<f32x4>,
    /// `c_r⁰` of each region, relative to the centre of mass at rest, eight a block; 0 where there is no region.
    pub rest_centre: Vec<[f32x8; 3]>,
    /// Rest position of each place, relative to the centre of mass at rest.
    pub rest: Vec<Vec3>,
    /// Mass of each place, in kilograms.
    pub mass: Vec<f32>,
}

impl Regions {
    /// The regions of a mesh whose vertices have these masses (all positive).
    pub fn new(mesh: &TetrahedralMesh, masses: &[f32]) -> Self {
        let neighbours = mesh.neighbours();
        let vertex = nested_dissection(mesh, &neighbours);
        let mut place = vec![0u32; vertex.len()];
        for (p, &v) in (0u32..).zip(&vertex) {
            place[v as usize] = p;
        }
        let total: f64 = masses.iter().map(|&m| f64::from(m)).sum();
        let moment: DVec3 = mesh.positions.iter().zip(masses).map(|(x, &m)| x.as_dvec3() * f64::from(m)).sum();
        let centre = moment / total;
        let rest: Vec<DVec3> = vertex.iter().map(|&v| mesh.positions[v as usize].as_dvec3() - centre).collect();
        let mass: Vec<f32> = vertex.iter().map(|&v| masses[v as usize]).collect();
        let shared: Vec<f64> = vertex
            .iter()
            .zip(&mass)
            .map(|(&v, &m)| f64::from(m) / (neighbours.of(v as usize).len() + 1) as f64)
            .collect();

        let mut regions = Self {
            starts: vec![0],
            items: Vec::new(),
            weights: Vec::new(),
            rest_centre: Vec::new(),
            rest: rest.iter().map(|x| x.as_vec3()).collect(),
            mass,
            vertex,
            place,
        };
        let mut centres: Vec<Vec3> = Vec::new();
        for p in 0..rest.len() {
            let v = regions.vertex[p];
            let mut members: Vec<u32> = neighbours.of(v as usize).iter().map(|&n| regions.place[n as usize]).collect();
            members.push(p as u32);
            members.sort_unstable();
            let sum: f64 = members.iter().map(|&i| shared[i as usize]).sum();
            let c: DVec3 = members.iter().map(|&i| rest[i as usize] * shared[i as usize]).sum::<DVec3>() / sum;
            let spread: f64 =
                members.iter().map(|&i| shared[i as usize] * (rest[i as usize] - c).length_squared()).sum();
            for &i in &members {
                let q = (rest[i as usize] - c) * (shared[i as usize] / spread);
                let part = (shared[i as usize] / sum) as f32;
                regions.weights.push(f32x4::new([q.x as f32, q.y as f32, q.z as f32, part]));
            }
            regions.items.extend(members);
            regions.starts.push(regions.items.len() as u32);
            centres.push(c.as_vec3());
        }
        for block in centres.chunks(LANES) {
            let lanes = |axis: usize| f32x8::new(std::array::from_fn(|lane| block.get(lane).map_or(0.0, |c| c[axis])));
            regions.rest_centre.push([lanes(0), lanes(1), lanes(2)]);
        }
        regions
    }

    /// Number of regions, which is the number of vertices.
    pub fn len(&self) -> usize {
        self.vertex.len()
    }

    /// The row of a region.
    #[inline]
    pub fn row(&self, region: usize) -> std::ops::Range<usize> {
        self.starts[region] as usize..self.starts[region + 1] as usize
    }
}
