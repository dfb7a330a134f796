//! What is measured of the shipped heart: the volume of its left ventricle, and how far its apex turns against its base.

use std::collections::{BTreeMap, BTreeSet};

use pliant::math::Vec3;

/// A point of the left ventricle's wall, in the frame of the mesh.
const SEED: Vec3 = Vec3::new(0.2598, -0.503, -0.0052);

/// The parts of a heart that are measured.
pub struct Heart {
    rest: Vec<Vec3>,
    left: Vec<[u32; 3]>,
    apex: Vec<usize>,
    base: Vec<usize>,
}

impl Heart {
    /// By its boundary and its vertices at rest: the apex is the lowest fifth, the base the highest.
    pub fn of(boundary: &[[u32; 3]], rest: &[Vec3]) -> Self {
        let (low, high) = rest.iter().fold((f32::MAX, f32::MIN), |(l, h), x| (l.min(x.y), h.max(x.y)));
        let band = |from: f32, to: f32| -> Vec<usize> {
            let share = |v: usize| (rest[v].y - low) / (high - low);
            (0..rest.len()).filter(|&v| (from..=to).contains(&share(v))).collect()
        };
        let left = cavity(boundary, rest, SEED);
        Self { left, apex: band(0.0, 0.2), base: band(0.8, 1.0), rest: rest.to_vec() }
    }

    /// The volume of the left ventricle at rest, in cubic metres.
    pub fn volume_at_rest(&self) -> f32 {
        volume(&self.left, &self.rest)
    }

    /// The volume of the left ventricle, beside that at rest.
    pub fn volume(&self, now: &[Vec3]) -> f32 {
        volume(&self.left, now) / self.volume_at_rest()
    }

    /// By how many degrees the apex has turned against the base.
    pub fn twist(&self, now: &[Vec3]) -> f32 {
        turn(&self.apex, &self.rest, now) - turn(&self.base, &self.rest, now)
    }
}

/// The triangles of the cavity around a point of its wall: those that turn by no more than 40° from neighbour to neighbour.
fn cavity(boundary: &[[u32; 3]], positions: &[Vec3], seed: Vec3) -> Vec<[u32; 3]> {
    let corner = |t: usize| boundary[t].map(|v| positions[v as usize]);
    let normal = |t: usize| {
        let [a, b, c] = corner(t);
        (b - a).cross(c - a).normalize()
    };
    let mut at_edge: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (t, &[a, b, c]) in boundary.iter().enumerate() {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            at_edge.entry((p.min(q), p.max(q))).or_default().push(t);
        }
    }
    let near = |t: usize| corner(t).into_iter().sum::<Vec3>().distance(seed * 3.0);
    let first = (0..boundary.len()).min_by(|&a, &b| near(a).total_cmp(&near(b))).expect("a triangle");
    let (mut found, mut open) = (BTreeSet::from([first]), vec![first]);
    while let Some(t) = open.pop() {
        let [a, b, c] = boundary[t];
        for (p, q) in [(a, b), (b, c), (c, a)] {
            for &other in &at_edge[&(p.min(q), p.max(q))] {
                if normal(t).dot(normal(other)) > 40f32.to_radians().cos() && found.insert(other) {
                    open.push(other);
                }
            }
        }
    }
    found.into_iter().map(|t| boundary[t]).collect()
}

/// The volume that the triangles enclose together with a lid over their open edge, fanned from its middle.
fn volume(triangles: &[[u32; 3]], positions: &[Vec3]) -> f32 {
    let mut edges: BTreeSet<(u32, u32)> = BTreeSet::new();
    for &[a, b, c] in triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if !edges.remove(&(q, p)) {
                edges.insert((p, q));
            }
        }
    }
    let rim: Vec<Vec3> = edges.iter().map(|&(p, _)| positions[p as usize]).collect();
    let middle = rim.iter().copied().sum::<Vec3>() / rim.len() as f32;
    // Seen from the middle of the lid, the lid itself has no volume. The wall's normals point into the cavity.
    let cone = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize] - middle);
        -a.dot(b.cross(c)) / 6.0
    };
    triangles.iter().map(cone).sum()
}

/// By how many degrees some vertices have turned about the vertical through their middle.
fn turn(vertices: &[usize], rest: &[Vec3], now: &[Vec3]) -> f32 {
    let middle = |x: &[Vec3]| vertices.iter().map(|&v| x[v]).sum::<Vec3>() / vertices.len() as f32;
    let (c0, c) = (middle(rest), middle(now));
    let (mut sine, mut cosine) = (0.0, 0.0);
    for &v in vertices {
        let (a, b) = (rest[v] - c0, now[v] - c);
        sine += a.z * b.x - a.x * b.z;
        cosine += a.x * b.x + a.z * b.z;
    }
    sine.atan2(cosine).to_degrees()
}
