//! Convex parts of the collision geometry: canonical shapes, rounded, placed in the world.

use std::sync::Arc;

use crate::math::{Mat3, Pose, Vec3};

/// A convex shape in its own frame. The axis of a cylinder and a cone is y, as in parry.
#[derive(Clone, Debug, PartialEq)]
pub enum PartShape {
    /// A single point; with rounding a ball.
    Point,
    /// A segment; with rounding a capsule.
    Segment {
        /// First end.
        a: Vec3,
        /// Second end.
        b: Vec3,
    },
    /// A box about the origin.
    Cuboid {
        /// Half extents in metres.
        half_extents: Vec3,
    },
    /// A cylinder about the y axis.
    Cylinder {
        /// Half of the height in metres.
        half_height: f32,
        /// Radius in metres.
        radius: f32,
    },
    /// A cone about the y axis, its apex up.
    Cone {
        /// Half of the height in metres.
        half_height: f32,
        /// Radius of the base in metres.
        radius: f32,
    },
    /// Everything on the inner side of a plane through the origin.
    HalfSpace {
        /// Unit normal, out of the solid side.
        normal: Vec3,
    },
    /// A convex polyhedron.
    Hull(Arc<ConvexHull>),
}

/// A convex shape with an optional rounding radius (0 for sharp edges).
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPart {
    /// The shape before rounding.
    pub shape: PartShape,
    /// Rounding radius in metres, not negative.
    pub rounding: f32,
}

/// A convex polyhedron by its triangles, with the plane of each.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexHull {
    triangles: Vec<[Vec3; 3]>,
    planes: Vec<(Vec3, f32)>,
}

/// Why points have no convex hull.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{points} points span no volume: a convex part needs four points that do not lie in one plane")]
pub struct HullError {
    /// How many points there were.
    pub points: usize,
}

impl ConvexHull {
    /// The convex hull of `points`.
    ///
    /// # Errors
    /// [`HullError`] where the points span no volume or are not finite.
    pub fn from_points(points: &[Vec3]) -> Result<Self, HullError> {
        let error = HullError { points: points.len() };
        if points.len() < 4 || points.iter().any(|p| !p.is_finite()) {
            return Err(error);
        }
        let (hull, indices) = parry3d::transformation::try_convex_hull(points).map_err(|_| error.clone())?;
        let triangles: Vec<[Vec3; 3]> =
            indices.iter().map(|t| t.map(|i| hull[i as usize])).filter(|t| plane(t).is_some()).collect();
        if triangles.len() < 4 || is_flat(&triangles) {
            return Err(error);
        }
        let planes = triangles.iter().filter_map(plane).collect();
        Ok(Self { triangles, planes })
    }

    /// Corners of each face triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[Vec3; 3]] {
        &self.triangles
    }

    /// Outward unit normal `n` and offset `o` of each triangle: inside is `n · x ≤ o`.
    pub fn planes(&self) -> &[(Vec3, f32)] {
        &self.planes
    }
}

/// True where a closed surface holds no more than rounding: its volume is below a millionth of its area times its size.
fn is_flat(triangles: &[[Vec3; 3]]) -> bool {
    let origin = triangles[0][0];
    let (mut volume, mut area, mut size) = (0.0_f32, 0.0_f32, 0.0_f32);
    for [a, b, c] in triangles.iter().map(|t| t.map(|corner| corner - origin)) {
        volume += a.dot(b.cross(c)) / 6.0;
        area += 0.5 * (b - a).cross(c - a).length();
        size = size.max(a.length());
    }
    volume <= 1.0e-6 * area * size
}

fn plane(&[a, b, c]: &[Vec3; 3]) -> Option<(Vec3, f32)> {
    let normal = (b - a).cross(c - a).try_normalize()?;
    Some((normal, normal.dot(a)))
}

/// A convex part in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPart {
    /// The part in its own frame.
    pub part: ConvexPart,
    /// World from part.
    pub pose: Pose,
    /// Rotation of `pose`, kept as a matrix: the distance is asked for many times a frame.
    rotation: Mat3,
}

impl PlacedPart {
    /// Places a part.
    pub fn new(part: ConvexPart, pose: Pose) -> Self {
        Self { part, pose, rotation: Mat3::from_quat(pose.rotation) }
    }

    /// Euclidean distance of the world point `x` from the part (0 inside) and its gradient, the unit vector away from
    /// the part (zero inside).
    #[inline]
    pub fn distance(&self, x: Vec3) -> (f32, Vec3) {
        let local = self.rotation.transpose() * (x - self.pose.translation);
        let (distance, direction) = self.part.distance(local);
        (distance, self.rotation * direction)
    }
}
