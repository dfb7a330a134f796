//! Which segments come close to each other: a tree over the boxes around all of them, nothing quadratic.

use std::collections::BTreeSet;

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::partitioning::{Bvh, BvhBuildStrategy};

use super::overlap::{Overlap, SkinSide};
use crate::coupling::contact::moved_axis;
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// A segment of one of several bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SegmentRef {
    /// Index of the body in the list that was given.
    pub body: usize,
    /// The segment.
    pub segment: usize,
}

/// Two segments whose boxes meet: of two bodies, or of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentPair {
    /// The first, the smaller of the two references.
    pub a: SegmentRef,
    /// The second.
    pub b: SegmentRef,
    /// Unit direction from the axis of the second to that of the first.
    pub normal: Vec3,
    /// The nearest points of the two axes.
    pub axis_points: [Vec3; 2],
    /// The direction that the overlap follows: the longer axis, unless both are short.
    pub along: Option<Vec3>,
}

/// The box around one segment's skin as it is now.
pub fn segment_bounds(body: &ElasticBody, segment: usize) -> Aabb {
    let x = body.positions();
    let skin = &body.skins()[segment];
    let (low, high) = skin
        .vertices
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), &v| (l.min(x[v as usize]), h.max(x[v as usize])));
    Aabb::new(low, high)
}

/// All pairs of segments that are nearer to each other than `within`, a part of the smaller body's size, as far as their boxes tell,
/// and that `collide`, sorted; of two segments of one body the one with the smaller index stands first.
pub fn pairs_of(
    bodies: &[&ElasticBody],
    within: f32,
    collide: impl Fn(SegmentRef, SegmentRef) -> bool,
) -> Vec<SegmentPair> {
    let mut segments = Vec::new();
    let mut boxes = Vec::new();
    for (index, body) in bodies.iter().enumerate() {
        for segment in 0..body.skins().len() {
            // The boxes of both are wider by half of it.
            let bounds = segment_bounds(body, segment).loosened(0.5 * within * body.rig().mesh.size());
            if bounds.mins.is_finite() && bounds.maxs.is_finite() {
                segments.push(SegmentRef { body: index, segment });
                boxes.push(bounds);
            }
        }
    }
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut pairs = Vec::new();
    for (i, (&a, bounds)) in segments.iter().zip(&boxes).enumerate() {
        for j in tree.intersect_aabb(bounds) {
            let j = j as usize;
            let b = segments[j];
            if j <= i || !bounds.intersects_box(&boxes[j]) {
                continue;
            }
            if collide(a, b)
                && let Some(pair) = SegmentPair::of(bodies, a, b)
            {
                pairs.push(pair);
            }
        }
    }
    pairs.sort_by_key(|pair| (pair.a, pair.b));
    pairs
}

trait IntersectsBox {
    fn intersects_box(&self, other: &Self) -> bool;
}

impl IntersectsBox for Aabb {
    fn intersects_box(&self, other: &Self) -> bool {
        self.mins.cmple(other.maxs).all() && other.mins.cmple(self.maxs).all()
    }
}

/// The pairs of segments of one body that may touch: no joint ties them, and their skins are apart at rest. The body is
/// taken as it is, which must be at rest.
pub fn self_pairs(body: &ElasticBody) -> BTreeSet<(usize, usize)> {
    let rig = body.rig();
    let joined = |a: usize, b: usize| {
        rig.joints.iter().any(|joint| (joint.parent, joint.child) == (a, b) || (joint.parent, joint.child) == (b, a))
    };
    let mut pairs = BTreeSet::new();
    for i in 0..body.skins().len() {
        for j in i + 1..body.skins().len() {
            let (a, b) = (SegmentRef { body: 0, segment: i }, SegmentRef { body: 0, segment: j });
            let Some(pair) = SegmentPair::of(&[body], a, b).filter(|_| !joined(i, j)) else { continue };
            let [first, second] = [i, j].map(|segment| SkinSide::inner(body, segment, body.positions()));
            if Overlap::between(first, second, pair.normal, pair.along.unwrap_or(Vec3::ZERO)).is_empty() {
                pairs.insert((i, j));
            }
        }
    }
    pairs
}

impl SegmentPair {
    /// The direction between two segments: from axis to axis at their nearest points. None where they cross.
    fn of(bodies: &[&ElasticBody], a: SegmentRef, b: SegmentRef) -> Option<Self> {
        let axis = |at: SegmentRef| {
            let body = bodies[at.body];
            let skin = &body.skins()[at.segment];
            (moved_axis(&body.motions()[at.segment], skin.axis), skin.size)
        };
        let ((p, size_p), (q, size_q)) = (axis(a), axis(b));
        let (x, y) = nearest_points(p, q);
        let normal = (x - y).try_normalize()?;
        let longer = [(p, size_p), (q, size_q)]
            .map(|(axis, size)| (axis[1] - axis[0], size))
            .into_iter()
            .filter(|(axis, size)| axis.length() > SHORT * size)
            .max_by(|(a, s), (b, t)| (a.length() / s).total_cmp(&(b.length() / t)));
        Some(Self { a, b, normal, axis_points: [x, y], along: longer.map(|(axis, _)| axis) })
    }
}

/// An axis is short below this part of the size of the segment's skin.
const SHORT: f32 = 0.3;

/// The nearest points of two segments (Ericson, *Real-Time Collision Detection*, section 5.1.9).
fn nearest_points([p1, q1]: [Vec3; 2], [p2, q2]: [Vec3; 2]) -> (Vec3, Vec3) {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.length_squared(), d2.length_squared(), d2.dot(r));
    let c = d1.dot(r);
    let (s, t);
    if a <= f32::EPSILON && e <= f32::EPSILON {
        (s, t) = (0.0, 0.0);
    } else if a <= f32::EPSILON {
        (s, t) = (0.0, (f / e).clamp(0.0, 1.0));
    } else if e <= f32::EPSILON {
        (s, t) = ((-c / a).clamp(0.0, 1.0), 0.0);
    } else {
        let b = d1.dot(d2);
        let denominator = a * e - b * b;
        // Nearly parallel axes have no single nearest pair: the middle of the range in which they face each other.
        let first = if denominator > PARALLEL * a * e {
            ((b * f - c * e) / denominator).clamp(0.0, 1.0)
        } else {
            let ends = [-c / a, (b - c) / a].map(|s| s.clamp(0.0, 1.0));
            0.5 * (ends[0] + ends[1])
        };
        let second = (b * first + f) / e;
        (s, t) = if second < 0.0 {
            ((-c / a).clamp(0.0, 1.0), 0.0)
        } else if second > 1.0 {
            (((b - c) / a).clamp(0.0, 1.0), 1.0)
        } else {
            (first, second)
        };
    }
    (p1 + d1 * s, p2 + d2 * t)
}

/// Axes count as parallel below this squared sine of the angle between them.
const PARALLEL: f32 = 1.0e-4;
