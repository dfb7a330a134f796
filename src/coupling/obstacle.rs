//! Obstacles: rapier's colliders as placed convex parts.

use std::collections::HashMap;
use std::sync::Arc;

use rapier3d::geometry::{Collider, ColliderHandle};
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::query::Ray;
use rapier3d::parry::shape::{ShapeType, SharedShape, TriMesh, TriMeshFlags, TypedShape};
use rapier3d::parry::transformation::vhacd::{VHACD, VHACDParameters};

use crate::field::{ConvexHull, ConvexPart, HullError, PartShape, PlacedPart};
use crate::math::{Pose, Vec3};
use crate::mesh::TriangleMesh;
use crate::mesh::measure::bounding_box;

/// One convex part of a shape, in the shape's frame, in our form and in parry's.
#[derive(Clone)]
pub struct LocalPart {
    /// Shape from part.
    pub pose: Pose,
    /// The part as the fields see it.
    pub part: ConvexPart,
    /// The part as parry sees it: for rays.
    pub shape: SharedShape,
    /// The part for parry's exact point queries.
    pub exact: SharedShape,
}

/// A shape that has no convex parts of its own.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ObstacleError {
    /// Decompose it first (see [`decompose`]).
    #[error("a {0:?} collider is not convex: decompose it into convex parts first")]
    NotConvex(ShapeType),
    /// A mesh that VHACD finds no part of.
    #[error("no convex part came out of the mesh: it is empty, too flat, or its size is not between 1 mm and 100 km")]
    NoParts,
    /// A hull without a volume.
    #[error(transparent)]
    Flat(#[from] HullError),
}

/// The convex parts of a shape.
///
/// # Errors
/// [`ObstacleError`] where the shape, or a member of a compound, is not convex or has no volume.
pub fn convex_parts(shape: &SharedShape) -> Result<Vec<LocalPart>, ObstacleError> {
    if let TypedShape::Compound(compound) = shape.as_typed_shape() {
        let mut parts = Vec::new();
        for (pose, member) in compound.shapes() {
            parts.extend(convex_parts(member)?.into_iter().map(|part| LocalPart { pose: *pose * part.pose, ..part }));
        }
        return Ok(parts);
    }
    let part = convex_part(shape)?;
    let exact = exact_shape(&part, shape);
    Ok(vec![LocalPart { pose: Pose::IDENTITY, part, shape: shape.clone(), exact }])
}

/// The shape on which parry projects points exactly: the closed surface of a hull, any other shape itself.
///
/// Parry projects a point onto a convex polyhedron by GJK and EPA, and takes points up to a millimetre outside of parts
/// of half a metre for up to six millimetres inside. The projection onto the triangles of its surface is exact.
fn exact_shape(part: &ConvexPart, shape: &SharedShape) -> SharedShape {
    let PartShape::Hull(hull) = &part.shape else { return shape.clone() };
    let corners = hull.triangles().as_flattened().to_vec();
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let flags = TriMeshFlags::ORIENTED | TriMeshFlags::MERGE_DUPLICATE_VERTICES;
    TriMesh::with_flags(corners, triangles, flags).map_or_else(|_| shape.clone(), SharedShape::new)
}

fn convex_part(shape: &SharedShape) -> Result<ConvexPart, ObstacleError> {
    let hull = |points: &[Vec3]| ConvexHull::from_points(points).map(|hull| PartShape::Hull(Arc::new(hull)));
    let (shape, rounding) = match shape.as_typed_shape() {
        TypedShape::Ball(s) => (PartShape::Point, s.radius),
        TypedShape::Capsule(s) => (PartShape::Segment { a: s.segment.a, b: s.segment.b }, s.radius),
        TypedShape::Cuboid(s) => (PartShape::Cuboid { half_extents: s.half_extents }, 0.0),
        TypedShape::RoundCuboid(s) => (PartShape::Cuboid { half_extents: s.inner_shape.half_extents }, s.border_radius),
        TypedShape::Cylinder(s) => (PartShape::Cylinder { half_height: s.half_height, radius: s.radius }, 0.0),
        TypedShape::RoundCylinder(s) => {
            let inner = &s.inner_shape;
            (PartShape::Cylinder { half_height: inner.half_height, radius: inner.radius }, s.border_radius)
        }
        TypedShape::Cone(s) => (PartShape::Cone { half_height: s.half_height, radius: s.radius }, 0.0),
        TypedShape::RoundCone(s) => {
            let inner = &s.inner_shape;
            (PartShape::Cone { half_height: inner.half_height, radius: inner.radius }, s.border_radius)
        }
        TypedShape::HalfSpace(s) => (PartShape::HalfSpace { normal: s.normal }, 0.0),
        TypedShape::ConvexPolyhedron(s) => (hull(s.points())?, 0.0),
        TypedShape::RoundConvexPolyhedron(s) => (hull(s.inner_shape.points())?, s.border_radius),
        _ => return Err(ObstacleError::NotConvex(shape.shape_type())),
    };
    Ok(ConvexPart { shape, rounding })
}

/// Decomposes a closed mesh into at most `max_parts` convex hulls with parry's VHACD: a compound shape for a collider.
///
/// # Errors
/// [`ObstacleError::NoParts`] where the mesh is empty, or so small, so large or so flat that no part comes out.
pub fn decompose(mesh: &TriangleMesh, max_parts: u32) -> Result<SharedShape, ObstacleError> {
    let bounds = bounding_box(&mesh.positions);
    let (least, most) = (bounds.extents().min_element(), bounds.extents().max_element());
    if mesh.triangles.is_empty() || !(most < LARGEST_MESH && least > THINNEST_MESH * most && most > SMALLEST_MESH) {
        return Err(ObstacleError::NoParts);
    }
    let parameters = VHACDParameters { max_convex_hulls: max_parts.max(1), ..Default::default() };
    let parts = VHACD::decompose(&parameters, &mesh.positions, &mesh.triangles, true)
        .compute_exact_convex_hulls(&mesh.positions, &mesh.triangles);
    let hulls = parts.into_iter().filter_map(|(points, triangles)| SharedShape::convex_mesh(points, &triangles));
    let members: Vec<(Pose, SharedShape)> = hulls.map(|hull| (Pose::IDENTITY, hull)).collect();
    if members.is_empty() { Err(ObstacleError::NoParts) } else { Ok(SharedShape::compound(members)) }
}

/// Meshes with a longest side outside of these lengths in metres, or thinner than this part of it, are not decomposed:
/// their voxels would be lost in rounding.
const SMALLEST_MESH: f32 = 1.0e-3;
const LARGEST_MESH: f32 = 1.0e5;
const THINNEST_MESH: f32 = 1.0e-4;

/// Names a convex part of a collider for as long as the collider keeps its shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PartId {
    /// The collider, by index and generation.
    pub collider: (u32, u32),
    /// The part in it.
    pub part: u32,
}

/// A convex part in the world.
#[derive(Clone)]
pub struct ObstaclePart {
    /// Its name.
    pub id: PartId,
    /// Its collider.
    pub collider: ColliderHandle,
    /// As the fields see it.
    pub placed: PlacedPart,
    /// As parry sees it: for rays.
    pub shape: SharedShape,
    /// For parry's exact point queries.
    pub exact: SharedShape,
    /// Bounding box in the world.
    pub aabb: Aabb,
    /// A box around a part of many faces, in the part's own frame.
    pub simpler: Option<PlacedPart>,
}

/// A hull with more triangles than this is given a simpler stand-in.
const MANY_TRIANGLES: usize = 32;

/// A part counts as small where the diagonal of its box is below this many widths of the field.
const SMALL: f32 = 2.0;

impl ObstaclePart {
    /// A convex part of a collider, in the world.
    pub fn new(id: PartId, collider: ColliderHandle, local: &LocalPart, pose: Pose) -> Self {
        let placed = PlacedPart::new(local.part.clone(), pose);
        let simpler = match &local.part.shape {
            PartShape::Hull(hull) if hull.triangles().len() > MANY_TRIANGLES => {
                let bounds = local.shape.compute_local_aabb();
                let shape = PartShape::Cuboid { half_extents: bounds.half_extents() };
                let centre = pose * Pose::from_translation(bounds.center());
                Some(PlacedPart::new(ConvexPart { shape, rounding: 0.0 }, centre))
            }
            _ => None,
        };
        let aabb = local.shape.compute_aabb(&pose);
        Self { id, collider, placed, shape: local.shape.clone(), exact: local.exact.clone(), aabb, simpler }
    }

    /// The region of constant velocity of a field of this width: the part itself, or, for a small part of many faces,
    /// the box around it.
    ///
    /// The region need only contain the part for the field to carry the skin out of it. Next to a wide field a box
    /// hugs a small part well enough, at a small part of the cost.
    pub fn region(&self, width: f32) -> &PlacedPart {
        match &self.simpler {
            Some(region) if (self.aabb.maxs - self.aabb.mins).length() < SMALL * width => region,
            _ => &self.placed,
        }
    }

    /// How far `x` must move along `direction` (unit) to leave the part, if the part meets the segment from `x` to
    /// `x + reach · direction`: positive both where `x` is inside the part and where the part lies before it.
    pub fn exit(&self, x: Vec3, direction: Vec3, reach: f32) -> Option<f32> {
        let end = x + direction * reach;
        if !self.aabb.intersects(&Aabb::new(x.min(end), x.max(end))) {
            return None;
        }
        let ray = Ray::new(end, -direction);
        let hit = self.shape.cast_ray(self.placed.pose(), &ray, reach, true)?;
        Some(reach - hit)
    }

    /// True where `x` is inside the part.
    pub fn contains(&self, x: Vec3) -> bool {
        self.aabb.contains_local_point(x) && self.placed.distance(x).0 == 0.0
    }

    /// From `x` to the nearest point of the part's surface where `x` is inside, zero outside.
    pub fn way_to_surface(&self, x: Vec3) -> Vec3 {
        let projection = self.exact.project_point(self.placed.pose(), x, false);
        if projection.is_inside { projection.point - x } else { Vec3::ZERO }
    }

    /// Exact depth of `x` below the part's surface by parry's point projection, 0 outside.
    pub fn exact_depth(&self, x: Vec3) -> f32 {
        if !self.aabb.contains_local_point(x) {
            return 0.0;
        }
        self.way_to_surface(x).length()
    }

    /// Exact distance of `x` from the part by parry's point projection, 0 inside.
    pub fn exact_distance(&self, x: Vec3) -> f32 {
        let projection = self.exact.project_point(self.placed.pose(), x, true);
        if projection.is_inside { 0.0 } else { projection.point.distance(x) }
    }
}

/// Convex parts by collider, kept as long as a collider keeps its shape: a cache, nothing more.
#[derive(Default)]
pub struct PartCache {
    known: HashMap<ColliderHandle, (SharedShape, KnownParts)>,
}

type KnownParts = Result<Arc<[LocalPart]>, ObstacleError>;

impl PartCache {
    /// The convex parts of a collider.
    ///
    /// # Errors
    /// The same [`ObstacleError`] each time for a collider that has none.
    pub fn parts(&mut self, handle: ColliderHandle, collider: &Collider) -> KnownParts {
        let shape = collider.shared_shape();
        match self.known.get(&handle) {
            Some((known, parts)) if Arc::ptr_eq(&known.0, &shape.0) => parts.clone(),
            _ => {
                let parts = convex_parts(shape).map(Arc::from);
                self.known.insert(handle, (shape.clone(), parts.clone()));
                parts
            }
        }
    }

    /// Forgets colliders that are gone.
    pub fn retain(&mut self, exists: impl Fn(ColliderHandle) -> bool) {
        self.known.retain(|&handle, _| exists(handle));
    }
}
