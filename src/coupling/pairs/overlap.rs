//! How far two pieces of skin are in each other along a direction.

use super::height_map::HeightMap;
use crate::elastic::ElasticBody;
use crate::math::{Mat3, Vec2, Vec3};

/// A piece of skin: what one segment owns, and where all vertices of its body are.
#[derive(Clone, Copy)]
pub struct SkinSide<'a> {
    /// The vertices.
    pub vertices: &'a [u32],
    /// Indices of the triangles.
    pub members: &'a [u32],
    /// All triangles of the body.
    pub triangles: &'a [[u32; 3]],
    /// Positions of all vertices of the body.
    pub positions: &'a [Vec3],
}

impl<'a> SkinSide<'a> {
    /// All that a segment moves.
    pub fn whole(body: &'a ElasticBody, segment: usize, positions: &'a [Vec3]) -> Self {
        let skin = &body.skins()[segment];
        Self { vertices: &skin.vertices, members: &skin.triangles, triangles: &body.rig().mesh.triangles, positions }
    }

    /// What a segment moves alone: without the skin that it shares with its neighbours at the joints.
    pub fn inner(body: &'a ElasticBody, segment: usize, positions: &'a [Vec3]) -> Self {
        let skin = &body.skins()[segment];
        Self {
            vertices: &skin.own_vertices,
            members: &skin.own_triangles,
            triangles: &body.rig().mesh.triangles,
            positions,
        }
    }
}

/// A vertex of one skin inside the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlapPoint {
    /// The vertex, of the body that it belongs to.
    pub vertex: u32,
    /// Where it is.
    pub position: Vec3,
    /// How far it must move along its way out (the normal for the first skin, against it for the second), in metres; below 0
    /// for a vertex that is so far outside still.
    pub depth: f32,
}

/// Two skins in each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlap {
    /// Vertices of the first skin in the second.
    pub a: Vec<OverlapPoint>,
    /// Vertices of the second skin in the first.
    pub b: Vec<OverlapPoint>,
}

impl Overlap {
    /// Compares two skins along the unit direction `normal`, from the second to the first, in the frame that it makes
    /// with `along` (see `frame_of`).
    pub fn between(a: SkinSide<'_>, b: SkinSide<'_>, normal: Vec3, along: Vec3) -> Self {
        Self::within(a, b, normal, along, 0.0)
    }

    /// As [`Overlap::between`], with the vertices that would be inside if the skins were `margin` metres nearer to each other.
    pub fn within(a: SkinSide<'_>, b: SkinSide<'_>, normal: Vec3, along: Vec3, margin: f32) -> Self {
        let frame = frame_of(normal, along);
        let down = Mat3::from_cols(frame.x_axis, -frame.y_axis, -frame.z_axis);
        Self { a: inside(a, b, frame, margin), b: inside(b, a, down, margin) }
    }

    /// True where there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.a.is_empty() && self.b.is_empty()
    }

    /// Depth of the deepest vertex; 0 where none is inside.
    pub fn depth(&self) -> f32 {
        self.a.iter().chain(&self.b).map(|p| p.depth).fold(0.0, f32::max)
    }

    /// Depth of the deepest vertex, below 0 where the nearest is that far outside; minus infinity where there is none.
    pub fn closeness(&self) -> f32 {
        self.a.iter().chain(&self.b).map(|p| p.depth).fold(f32::NEG_INFINITY, f32::max)
    }

    /// The lowest height of the first skin and the highest of the second within the overlap, along `normal`.
    pub fn heights(&self, normal: Vec3) -> (f32, f32) {
        let mut range = (f32::INFINITY, f32::NEG_INFINITY);
        for p in &self.a {
            let height = p.position.dot(normal);
            range = (range.0.min(height), range.1.max(height + p.depth));
        }
        for p in &self.b {
            let height = p.position.dot(normal);
            range = (range.0.min(height - p.depth), range.1.max(height));
        }
        range
    }
}

/// An orthonormal, right-handed frame whose z axis is `normal` and whose x axis lies as near to `along` as it can.
pub fn frame_of(normal: Vec3, along: Vec3) -> Mat3 {
    let across = along - normal * along.dot(normal);
    let x = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    Mat3::from_cols(x, normal.cross(x), normal)
}

/// The vertices of `own` that `margin` brings inside `other`, whose surface faces along the frame's z axis where they come out.
fn inside(own: SkinSide<'_>, other: SkinSide<'_>, frame: Mat3, margin: f32) -> Vec<OverlapPoint> {
    let (low, high) = bounds(&other);
    let (low, high) = (low - margin, high + margin);
    let near: Vec<(u32, Vec3)> = own
        .vertices
        .iter()
        .map(|&v| (v, own.positions[v as usize]))
        .filter(|(_, x)| x.cmpge(low).all() && x.cmple(high).all())
        .collect();
    if near.is_empty() {
        return Vec::new();
    }
    let flat = |x: Vec3| Vec2::new(frame.x_axis.dot(x), frame.y_axis.dot(x));
    let (from, to) =
        near.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(l, h), (_, x)| (l.min(flat(*x)), h.max(flat(*x))));
    let corners = |&t: &u32| other.triangles[t as usize].map(|v| other.positions[v as usize]);
    let map = HeightMap::new(frame, from, to, other.members.iter().map(corners));
    let point = |(vertex, position)| {
        let depth = map.exit(position - frame.z_axis * margin)? - margin;
        Some(OverlapPoint { vertex, position, depth })
    };
    near.into_iter().filter_map(point).collect()
}

fn bounds(side: &SkinSide<'_>) -> (Vec3, Vec3) {
    let of = |(low, high): (Vec3, Vec3), &v: &u32| {
        let x = side.positions[v as usize];
        (low.min(x), high.max(x))
    };
    side.vertices.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), of)
}
