//! Convex decomposition of closed meshes by parry's VHACD.

use rapier3d::parry::shape::SharedShape;
use rapier3d::parry::transformation::vhacd::{VHACD, VHACDParameters};
use serde::{Deserialize, Serialize};

use super::error::ObstacleError;
use crate::math::{Pose, Vec3};
use crate::mesh::TriangleMesh;
use crate::mesh::measure::bounding_box;

/// A convex hull as VHACD gives it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Hull {
    pub points: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Decomposes a closed mesh into at most `max_parts` convex hulls with parry's VHACD: a compound shape for a collider.
///
/// It takes seconds for a mesh of some thousand triangles; [`super::decompose_cached`] keeps the result on disk.
///
/// # Errors
/// [`ObstacleError::NoParts`] where the mesh is empty, or so small, so large or so flat that no part comes out.
pub fn decompose(mesh: &TriangleMesh, max_parts: u32) -> Result<SharedShape, ObstacleError> {
    compound(&hulls(mesh, max_parts)).ok_or(ObstacleError::NoParts)
}

/// The hulls of a mesh; none where it cannot be decomposed.
pub(super) fn hulls(mesh: &TriangleMesh, max_parts: u32) -> Vec<Hull> {
    let bounds = bounding_box(&mesh.positions);
    let (least, most) = (bounds.extents().min_element(), bounds.extents().max_element());
    if mesh.triangles.is_empty() || !(most < LARGEST_MESH && least > THINNEST_MESH * most && most > SMALLEST_MESH) {
        return Vec::new();
    }
    let parameters = VHACDParameters { max_convex_hulls: max_parts.max(1), ..Default::default() };
    VHACD::decompose(&parameters, &mesh.positions, &mesh.triangles, true)
        .compute_exact_convex_hulls(&mesh.positions, &mesh.triangles)
        .into_iter()
        .map(|(points, triangles)| Hull { points: points.into_iter().map(|p| p.to_array()).collect(), triangles })
        .collect()
}

/// The compound of hulls; none where no hull has a volume.
pub(super) fn compound(hulls: &[Hull]) -> Option<SharedShape> {
    let shape = |hull: &Hull| {
        let points: Vec<Vec3> = hull.points.iter().copied().map(Vec3::from).collect();
        SharedShape::convex_mesh(points, &hull.triangles)
    };
    let members: Vec<(Pose, SharedShape)> = hulls.iter().filter_map(shape).map(|hull| (Pose::IDENTITY, hull)).collect();
    (!members.is_empty()).then(|| SharedShape::compound(members))
}

/// Meshes with a longest side outside of these lengths in metres, or thinner than this part of it, are not decomposed:
/// their voxels would be lost in rounding.
const SMALLEST_MESH: f32 = 1.0e-3;
const LARGEST_MESH: f32 = 1.0e5;
const THINNEST_MESH: f32 = 1.0e-4;
