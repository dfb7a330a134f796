//! Triangles of the skin that came out turned over: the flow never folds, but a triangle that is coarse beside it may.

use rayon::prelude::*;

use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// The number of triangles whose three corners' normals, carried by the flow, all point against the triangle's own.
///
/// Only triangles that turned since they were at `before` by more than the angle with the cosine `turned` are looked at:
/// carrying normals is costly. `size` is the body's size.
pub fn count_folds(body: &ElasticBody, before: &[Vec3], size: f32, turned: f32) -> u32 {
    let (rig, palette, epsilon) = (body.rig(), body.palette(), NORMAL_STEP * size);
    let carried = |v: u32| {
        let v = v as usize;
        palette.deform_with_normal(rig.mesh.positions[v], rig.mesh.normals[v], &rig.weights[v], epsilon).1
    };
    let normal = |corner: [Vec3; 3]| (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    let folded = |t: &&[u32; 3]| {
        let (now, then) = (t.map(|v| body.positions()[v as usize]), t.map(|v| before[v as usize]));
        if now == then {
            return false;
        }
        let (now, then) = (normal(now), normal(then));
        let far = now.dot(then) < turned * now.length() * then.length();
        far && t.iter().all(|&v| carried(v).dot(now) < 0.0)
    };
    rig.mesh.triangles.par_iter().with_min_len(1024).filter(folded).count() as u32
}

/// Normals are carried by differences over this part of the size.
const NORMAL_STEP: f32 = 1.0e-4;
