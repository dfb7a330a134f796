//! Regions of bones on the surface: nearest bone with a facing criterion, then islands given to what surrounds them.

use super::weights::{Distance, distance_to_bone};
use crate::math::Vec3;
use crate::mesh::{NormalTopology, TriangleMesh};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// How much farther a bone counts, in its own distances, that lies straight in front of the surface instead of under it.
const FACING_PENALTY: f64 = 4.0;

/// On a separate piece of the mesh a region is kept when its area is at least this part of the bone's largest one:
/// clothes over a body have regions of their own, the spot where a leg touches the other has not.
const SEPARATE_PART: f64 = 0.25;

/// The graph of the surface's edges between welded points, with lengths; and the area about each point.
pub(super) struct Surface {
    starts: Vec<u32>,
    neighbours: Vec<(u32, f64)>,
    area: Vec<f64>,
}

impl Surface {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let mut edges = Vec::with_capacity(6 * mesh.triangles.len());
        let mut area = vec![0.0; mesh.positions.len()];
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.welded[i as usize]);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                if p != q {
                    edges.extend([(p, q), (q, p)]);
                }
            }
            let [p, q, r] = [a, b, c].map(|i| mesh.positions[i as usize].as_dvec3());
            let third = (q - p).cross(r - p).length() / 6.0;
            [a, b, c].iter().for_each(|&i| area[i as usize] += third);
        }
        edges.sort_unstable();
        edges.dedup();
        let mut starts = vec![0u32; mesh.positions.len() + 1];
        for &(p, _) in &edges {
            starts[p as usize + 1] += 1;
        }
        for v in 0..mesh.positions.len() {
            starts[v + 1] += starts[v];
        }
        let at = |i: u32| mesh.positions[i as usize].as_dvec3();
        let neighbours = edges.iter().map(|&(p, q)| (q, at(p).distance(at(q)))).collect();
        Self { starts, neighbours, area }
    }

    /// The neighbours of a point with the lengths of the edges.
    pub(super) fn around(&self, point: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[point] as usize..self.starts[point + 1] as usize;
        self.neighbours[range].iter().map(|&(q, length)| (q as usize, length))
    }

    /// Numbers the connected parts among points that `joined` connects; also their areas.
    fn parts(&self, joined: impl Fn(usize, usize) -> bool) -> (Vec<usize>, Vec<f64>) {
        let mut part = vec![usize::MAX; self.area.len()];
        let mut areas = Vec::new();
        let mut stack = Vec::new();
        for start in 0..part.len() {
            if part[start] != usize::MAX {
                continue;
            }
            let number = areas.len();
            areas.push(0.0);
            part[start] = number;
            stack.push(start);
            while let Some(p) = stack.pop() {
                areas[number] += self.area[p];
                for (q, _) in self.around(p) {
                    if part[q] == usize::MAX && joined(p, q) {
                        part[q] = number;
                        stack.push(q);
                    }
                }
            }
        }
        (part, areas)
    }
}

/// The bone of each point, and the cost of any bone at a point (comparable between bones).
///
/// Welded duplicates carry no region of their own: look up their point.
pub(super) fn regions<'a>(
    mesh: &'a TriangleMesh,
    surface: &Surface,
    bones: &'a [[Vec3; 2]],
    radii: &'a [f32],
) -> (Vec<u16>, impl Fn(usize, u16) -> f64 + 'a) {
    let mut normals = Vec::new();
    let smooth = NormalTopology::new(&mesh.triangles, &mesh.welded)
        .and_then(|table| table.normals_into(&mesh.positions, &mut Vec::new(), &mut normals));
    if smooth.is_err() {
        normals = vec![Vec3::ZERO; mesh.positions.len()];
    }
    let outward = if mesh.volume() < 0.0 { -1.0 } else { 1.0 };
    let cost_of = move |v: usize, bone: u16| {
        let (nearest, distance) = distance_to_bone(mesh.positions[v], &bones[bone as usize]);
        let towards = (nearest - mesh.positions[v]).normalize_or_zero();
        let facing = f64::from(normals[v].dot(towards) * outward).max(0.0);
        let radius = radii.get(bone as usize).copied().unwrap_or(0.0);
        distance - f64::from(radius) + FACING_PENALTY * distance * facing
    };
    let count = bones.len() as u16;
    let mut label: Vec<u16> = (0..mesh.positions.len())
        .map(|v| {
            let v = mesh.welded[v] as usize;
            (0..count).min_by(|&a, &b| cost_of(v, a).total_cmp(&cost_of(v, b))).unwrap_or(0)
        })
        .collect();
    give_islands_away(surface, &mut label);
    (label, cost_of)
}

/// Keeps of each bone's region the largest part on each piece of the mesh (on other pieces than that of the largest of
/// all only if it is not small), and lets what surrounds the rest grow over it along the surface.
fn give_islands_away(surface: &Surface, label: &mut [u16]) {
    let (piece, _) = surface.parts(|_, _| true);
    let (island, areas) = surface.parts(|p, q| label[p] == label[q]);
    // For each bone and piece its largest island; ties go to the first.
    let mut largest: BTreeMap<(u16, usize), usize> = BTreeMap::new();
    let mut seen = vec![false; areas.len()];
    for v in 0..label.len() {
        let i = island[v];
        if !std::mem::replace(&mut seen[i], true) {
            let best = largest.entry((label[v], piece[v])).or_insert(i);
            if areas[i] > areas[*best] {
                *best = i;
            }
        }
    }
    let mut largest_of_all: BTreeMap<u16, f64> = BTreeMap::new();
    for (&(bone, _), &i) in &largest {
        let most = largest_of_all.entry(bone).or_insert(0.0);
        *most = most.max(areas[i]);
    }
    let mut kept = vec![false; areas.len()];
    let mut has_kept = BTreeMap::new();
    let mut best_of_piece: BTreeMap<usize, usize> = BTreeMap::new();
    for (&(bone, piece), &i) in &largest {
        if areas[i] >= SEPARATE_PART * largest_of_all[&bone] {
            kept[i] = true;
            has_kept.insert(piece, true);
        }
        let best = best_of_piece.entry(piece).or_insert(i);
        if areas[i] > areas[*best] {
            *best = i;
        }
    }
    for (piece, &i) in &best_of_piece {
        if !has_kept.contains_key(piece) {
            kept[i] = true;
        }
    }

    let mut queue: BinaryHeap<Reverse<(Distance, u16, usize)>> = BinaryHeap::new();
    let mut done: Vec<bool> = island.iter().map(|&i| kept[i]).collect();
    let push_around = |queue: &mut BinaryHeap<_>, from: usize, distance: f64, bone: u16, done: &[bool]| {
        for (to, length) in surface.around(from) {
            if !done[to] {
                queue.push(Reverse((Distance(distance + length), bone, to)));
            }
        }
    };
    for v in 0..label.len() {
        if done[v] {
            push_around(&mut queue, v, 0.0, label[v], &done);
        }
    }
    while let Some(Reverse((Distance(distance), bone, at))) = queue.pop() {
        if !std::mem::replace(&mut done[at], true) {
            label[at] = bone;
            push_around(&mut queue, at, distance, bone, &done);
        }
    }
}
