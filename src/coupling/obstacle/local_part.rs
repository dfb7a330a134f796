//! A convex part in the frame of its shape, in our form and in parry's.

use std::sync::Arc;

use rapier3d::parry::shape::{SharedShape, TriMesh, TriMeshFlags};

use super::outer_face::OuterFace;
use crate::field::{ConvexHull, ConvexPart, HullError, PartShape};
use crate::math::{Pose, Vec3};

/// One convex part of a shape, in the shape's frame, in our form and in parry's.
#[derive(Clone)]
pub struct LocalPart {
    /// Shape from part.
    pub pose: Pose,
    /// The part as the fields see it.
    pub part: ConvexPart,
    /// The part as parry sees it: for boxes around it and pictures of it.
    pub shape: SharedShape,
    /// The part without `border`, for parry's exact point queries.
    pub exact: SharedShape,
    /// Radius in metres by which the part reaches farther than `exact`.
    pub border: f32,
    /// The face that leads out, where the part is a piece of a surface.
    pub face: Option<OuterFace>,
}

impl LocalPart {
    /// The convex hull of `points` as a piece of a surface with this outer face, in the frame of the shape.
    ///
    /// # Errors
    /// [`HullError`] where the points span no volume.
    pub(super) fn piece(points: &[Vec3], face: &OuterFace) -> Result<Self, HullError> {
        let part = Self::hull(points, 0.0)?;
        let face = face.moved(&part.pose.inverse());
        Ok(Self { face: Some(face), ..part })
    }

    /// The convex hull of `points`, which are given in the frame of the shape, widened by `rounding`.
    ///
    /// The part's own frame lies in the middle of the points: coordinates stay small, and exact.
    ///
    /// # Errors
    /// [`HullError`] where the points span no volume.
    pub(super) fn hull(points: &[Vec3], rounding: f32) -> Result<Self, HullError> {
        let middle = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
        let centred: Vec<Vec3> = points.iter().map(|p| *p - middle).collect();
        let hull = ConvexHull::from_points(&centred)?;
        let error = HullError { points: points.len() };
        let exact = surface(&hull).ok_or(error.clone())?;
        let shape = match rounding > 0.0 {
            true => SharedShape::round_convex_hull(&centred, rounding).ok_or(error)?,
            false => exact.clone(),
        };
        let part = ConvexPart { shape: PartShape::Hull(Arc::new(hull)), rounding };
        Ok(Self { pose: Pose::from_translation(middle), part, shape, exact, border: rounding, face: None })
    }
}

/// The closed surface of a hull.
///
/// Parry projects a point onto a convex polyhedron by GJK and EPA, and takes points up to a millimetre outside of parts
/// of half a metre for up to six millimetres inside. The projection onto the triangles of its surface is exact.
pub(super) fn surface(hull: &ConvexHull) -> Option<SharedShape> {
    let corners = hull.triangles().as_flattened().to_vec();
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let flags = TriMeshFlags::ORIENTED | TriMeshFlags::MERGE_DUPLICATE_VERTICES;
    TriMesh::with_flags(corners, triangles, flags).ok().map(SharedShape::new)
}
