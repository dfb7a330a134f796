//! Triangle meshes as thick faces.
//!
//! Behind each flat face lies a convex part whose sides run along the bisectors of the mesh's vertices, so that the parts
//! of neighbours fit together without a gap. How deep it goes is found by rays: never farther than to the middle between
//! the face and what is behind it, so that a thin plate does not stick out at its back.

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::query::{Ray, RayCast};
use rapier3d::parry::shape::{ShapeType, SharedShape, TriMesh, TriMeshFlags};

use super::error::ObstacleError;
use super::flat_faces::{Face, flat_faces};
use super::local_part::LocalPart;
use super::outer_face::OuterFace;
use crate::math::Vec3;
use crate::mesh::{Topology, TriangleMesh};

/// Points nearer than this part of the box's diagonal to a plane lie in it.
const FLAT: f32 = 2.0e-6;

/// Rays start this part of the box's diagonal behind the surface.
const BEHIND: f32 = 1.0e-5;

/// A part goes at most this part of the way to what is behind it.
const MIDDLE: f32 = 0.5;

/// Least cosine between a face's normal and that of a corner: past it the face has a side of its own.
const STEEP: f32 = 0.1;

/// A triangle mesh with its flat faces.
pub struct SurfaceFaces {
    shape: SharedShape,
    points: Vec<Vec3>,
    /// Unit normal of each point, the mean of its triangles' by their angles.
    normals: Vec<Vec3>,
    faces: Vec<Face>,
    /// The face of each triangle, `u32::MAX` for those without an area.
    face_of: Vec<u32>,
    /// Solid behind its faces; a sheet with two outer sides otherwise.
    solid: bool,
    behind: f32,
}

impl SurfaceFaces {
    /// Finds the flat faces, and whether the mesh is closed: O(n log n).
    ///
    /// # Errors
    /// [`ObstacleError::NoArea`] where no triangle has an area, or a corner is not finite.
    pub(super) fn new(mesh: &TriMesh, shape: &SharedShape) -> Result<Self, ObstacleError> {
        let error = ObstacleError::NoArea(ShapeType::TriMesh);
        let Ok(skin) = TriangleMesh::from_triangles(mesh.vertices().to_vec(), mesh.indices().to_vec()) else {
            return Err(error);
        };
        let diagonal = mesh.local_aabb().extents().length();
        let welded: Vec<[u32; 3]> = skin.triangles.iter().map(|t| t.map(|i| skin.welded[i as usize])).collect();
        let faces = flat_faces(&skin.positions, &welded, FLAT * diagonal);
        if faces.is_empty() {
            return Err(error);
        }
        let mut face_of = vec![u32::MAX; welded.len()];
        for (index, face) in faces.iter().enumerate() {
            face.triangles.iter().for_each(|&t| face_of[t as usize] = index as u32);
        }
        let flags = mesh.flags();
        let oriented = flags.contains(TriMeshFlags::ORIENTED) || flags.contains(TriMeshFlags::FIX_INTERNAL_EDGES);
        let oriented = oriented && !flags.contains(TriMeshFlags::FIX_INTERNAL_EDGES_TWO_SIDED);
        Ok(Self {
            shape: shape.clone(),
            normals: normals(&skin.positions, &welded),
            solid: oriented || Topology::of(&skin).is_closed(),
            points: skin.positions,
            faces,
            face_of,
            behind: BEHIND * diagonal,
        })
    }

    /// See [`super::PartSource::cells_near`].
    pub(super) fn cells_near(&self, region: &Aabb, thickness: f32, cells: &mut Vec<u64>) {
        let Some(mesh) = self.shape.as_trimesh() else { return };
        let region = region.loosened(thickness);
        let faces = mesh.bvh().intersect_aabb(&region).filter_map(|t| self.face_of.get(t as usize));
        cells.extend(faces.filter(|&&face| face != u32::MAX).map(|&face| u64::from(face)));
    }

    /// See [`super::PartSource::expand`].
    pub(super) fn expand(&self, face: u32, thickness: f32, sheet: f32) -> Option<LocalPart> {
        let face = self.faces.get(face as usize)?;
        let corners = face.corners.iter().map(|&i| self.points[i as usize]);
        let points: Vec<Vec3> = if self.solid {
            let depths: Vec<Vec3> = face.corners.iter().map(|&i| self.depth_at(i, face.normal, thickness)).collect();
            let share = self.share(face, &depths, thickness);
            corners.zip(depths).flat_map(|(p, depth)| [p, p - depth * share]).collect()
        } else {
            let half = face.normal * (0.5 * sheet);
            corners.flat_map(|p| [p + half, p - half]).collect()
        };
        LocalPart::piece(&points, &self.outer_face(face)).ok()
    }

    fn outer_face(&self, face: &Face) -> OuterFace {
        let corner = |i: usize| self.points[face.corners[i % face.corners.len()] as usize];
        let edge = |(i, &neighbour): (usize, &Option<Vec3>)| {
            let way = (corner(i + 1) - corner(i)).cross(face.normal).try_normalize()?;
            // A way out may lead halfway to the neighbour's normal, where the surface bends away. Past a right angle,
            // or where there is no neighbour, any will do.
            let tilt = neighbour.map_or(f32::INFINITY, |neighbour| {
                let halfway = face.normal + neighbour;
                let (aside, up) = (halfway.dot(way), halfway.dot(face.normal));
                let bend = if self.solid { aside.max(0.0) } else { aside.abs() };
                bend / up.max(f32::MIN_POSITIVE)
            });
            Some((way, tilt))
        };
        OuterFace {
            normal: face.normal,
            offset: face.normal.dot(corner(0)),
            area: 0.5 * face.area,
            two_sided: !self.solid,
            edges: face.neighbours.iter().enumerate().filter_map(edge).collect(),
        }
    }

    /// The way from a corner into the solid, against its normal, at most `thickness` deep.
    fn depth_at(&self, corner: u32, face_normal: Vec3, thickness: f32) -> Vec3 {
        let bisector = self.normals[corner as usize];
        let normal = if bisector.dot(face_normal) < STEEP { face_normal } else { bisector };
        normal * self.room(self.points[corner as usize], normal, thickness)
    }

    /// What of the corners' depths a face may take, so that it does not come out at the back between them.
    fn share(&self, face: &Face, depths: &[Vec3], thickness: f32) -> f32 {
        let Some(mesh) = self.shape.as_trimesh() else { return 1.0 };
        let deepest = depths.iter().map(|depth| depth.dot(face.normal)).fold(f32::MIN_POSITIVE, f32::max);
        let room = |&t: &u32| self.room(mesh.triangle(t).center(), face.normal, thickness);
        let room = face.triangles.iter().map(room).fold(f32::INFINITY, f32::min);
        (room / deepest).min(1.0)
    }

    /// How deep a part may go at `point`, against `normal`.
    fn room(&self, point: Vec3, normal: Vec3, thickness: f32) -> f32 {
        let Some(mesh) = self.shape.as_trimesh() else { return thickness };
        let ray = Ray::new(point - normal * self.behind, -normal);
        let hit = mesh.cast_local_ray(&ray, thickness / MIDDLE, false);
        hit.map_or(thickness, |way| ((way + self.behind) * MIDDLE).min(thickness))
    }
}

/// The normal of each point: the sum of its triangles' normals, each by the angle that it has there.
fn normals(points: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; points.len()];
    for t in triangles {
        let p = t.map(|i| points[i as usize]);
        let Some(normal) = (p[1] - p[0]).cross(p[2] - p[0]).try_normalize() else { continue };
        for k in 0..3 {
            let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            sums[t[k] as usize] += normal * a.angle_between(b);
        }
    }
    sums.into_iter().map(Vec3::normalize_or_zero).collect()
}
