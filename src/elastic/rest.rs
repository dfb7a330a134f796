//! Rest data derived from a rig once: what each segment owns of the skin.

use super::rig::{ElasticRig, SegmentShape, SkinWeights};
use crate::math::Vec3;

/// The part of the skin that one segment moves.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentSkin {
    /// Vertices whose weight for the segment is at least `MEMBER_WEIGHT` (a quarter).
    pub vertices: Vec<u32>,
    /// Vertices that the segment moves alone: with a weight of at least `OWN_WEIGHT` (0.95).
    pub own_vertices: Vec<u32>,
    /// Triangles between such vertices.
    pub own_triangles: Vec<u32>,
    /// Triangles that belong to the segment: no other has a larger share of their corners.
    pub triangles: Vec<u32>,
    /// Longest edge of these triangles at rest.
    pub longest_edge: f32,
    /// Largest distance of these vertices from their mean: the paper's measure of the size of a body (section 4.2).
    pub size: f32,
    /// Mean of these vertices in the rest pose.
    pub centroid: Vec3,
    /// Points of the skin, thinned out, that feel the repelling impulse. As many of the first of them as one likes are spread
    /// evenly.
    pub samples: Vec<SkinSample>,
    /// The segment's axis: its bone shortened by the radius of its shape, in the rest pose. The axis lies deep inside,
    /// so that the way from an obstacle to the axis is the way out of the obstacle.
    pub axis: [Vec3; 2],
}

/// A point of the skin at rest with its outward normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinSample {
    /// Position in the rest pose.
    pub position: Vec3,
    /// Unit normal in the rest pose.
    pub normal: Vec3,
}

/// Skin with less weight than this is shared with a neighbour.
const OWN_WEIGHT: f32 = 0.95;

/// A vertex belongs to a segment's contacts from this weight on: with less, the segment's field hardly moves it.
pub const MEMBER_WEIGHT: f32 = 0.25;

/// Most skin samples of a segment. Where something large touches, the first of them are enough; a crate on a cushion, or
/// a bar a tenth of the segment thick, needs them closer together.
pub const SAMPLES_PER_SEGMENT: usize = 1024;

impl SegmentSkin {
    /// Collects what segment `index` of the rig owns.
    pub fn of(rig: &ElasticRig, index: usize) -> Self {
        let owns = |skin: &SkinWeights, least: f32| skin.weight_of(index as u16) >= least;
        let positions = &rig.mesh.positions;
        let vertices: Vec<u32> =
            (0..positions.len() as u32).filter(|&v| owns(&rig.weights[v as usize], MEMBER_WEIGHT)).collect();
        let sum: Vec3 = vertices.iter().map(|&v| positions[v as usize]).sum();
        let centroid = if vertices.is_empty() { Vec3::ZERO } else { sum / vertices.len() as f32 };
        let size = vertices.iter().map(|&v| positions[v as usize].distance(centroid)).fold(0.0, f32::max);
        let core: Vec<u32> = vertices.iter().copied().filter(|&v| owns(&rig.weights[v as usize], 0.5)).collect();
        let samples = thinned(positions, &core, SAMPLES_PER_SEGMENT)
            .into_iter()
            .map(|v| SkinSample { position: positions[v as usize], normal: rig.mesh.normals[v as usize] })
            .collect();
        let triangles: Vec<u32> = (0..rig.mesh.triangles.len() as u32)
            .filter(|&t| heaviest_segment(rig, &rig.mesh.triangles[t as usize]) == index as u16)
            .collect();
        let longest = |&t: &u32| {
            let [a, b, c] = rig.mesh.triangles[t as usize].map(|v| positions[v as usize]);
            a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
        };
        let longest_edge = triangles.iter().map(longest).fold(0.0, f32::max).sqrt();
        let own_vertices: Vec<u32> =
            vertices.iter().copied().filter(|&v| owns(&rig.weights[v as usize], OWN_WEIGHT)).collect();
        let own = |&t: &u32| rig.mesh.triangles[t as usize].iter().all(|&v| owns(&rig.weights[v as usize], OWN_WEIGHT));
        let own_triangles = triangles.iter().copied().filter(own).collect();
        Self {
            vertices,
            own_vertices,
            own_triangles,
            triangles,
            longest_edge,
            size,
            centroid,
            samples,
            axis: axis(rig, index),
        }
    }
}

/// The segment with the largest share of a triangle's corners; the first of several.
fn heaviest_segment(rig: &ElasticRig, triangle: &[u32; 3]) -> u16 {
    let share = |segment: u16| triangle.iter().map(|&v| rig.weights[v as usize].weight_of(segment)).sum::<f32>();
    let candidates = triangle.iter().flat_map(|&v| rig.weights[v as usize].segments);
    let better = |best: (f32, u16), segment: u16| {
        let share = share(segment);
        if share > best.0 || (share == best.0 && segment < best.1) { (share, segment) } else { best }
    };
    candidates.fold((f32::NEG_INFINITY, u16::MAX), better).1
}

/// The bone, shortened at both ends by the shape's radius.
fn axis(rig: &ElasticRig, index: usize) -> [Vec3; 2] {
    let segment = &rig.segments[index];
    let [a, b] = segment.bone;
    let middle = 0.5 * (a + b);
    let inset = match segment.shape {
        SegmentShape::Ball { .. } => return [middle, middle],
        SegmentShape::Capsule { radius } => radius,
        SegmentShape::Cuboid { half_extents } => {
            let half = half_extents.z - half_extents.x.min(half_extents.y);
            let along = (b - a).normalize_or(Vec3::Z) * half.max(0.0);
            return [middle - along, middle + along];
        }
    };
    let length = (b - a).length();
    if length <= 2.0 * inset {
        return [middle, middle];
    }
    let step = (b - a) * (inset / length);
    [a + step, b - step]
}

/// Farthest-point thinning: at most `count` of `vertices`, spread evenly, in a deterministic order.
fn thinned(positions: &[Vec3], vertices: &[u32], count: usize) -> Vec<u32> {
    let Some(&first) = vertices.first() else { return Vec::new() };
    let mut chosen = vec![first];
    let mut distance: Vec<f32> =
        vertices.iter().map(|&v| positions[v as usize].distance_squared(positions[first as usize])).collect();
    while chosen.len() < count {
        let (mut farthest, mut best) = (0, 0.0);
        for (i, &d) in distance.iter().enumerate() {
            if d > best {
                (farthest, best) = (i, d);
            }
        }
        if best <= 0.0 {
            break;
        }
        let next = vertices[farthest];
        chosen.push(next);
        for (d, &v) in distance.iter_mut().zip(vertices) {
            *d = d.min(positions[v as usize].distance_squared(positions[next as usize]));
        }
    }
    chosen
}
