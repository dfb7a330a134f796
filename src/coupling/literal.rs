//! The paper's literal placement of the collision field (section 4.2), kept for comparison.

use super::contact::Proximity;
use super::obstacle::ObstaclePart;
use crate::elastic::{CollisionField, CollisionPass, ElasticBody, SegmentField};
use crate::field::SphereField;

/// For every part that a segment penetrates: `r_i` the bounding sphere of the part, `r_o = r_i + s · size`, the
/// direction along the line of centres, the depth the largest along it. Fields are summed in one pass.
pub fn place(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], softness: f32) -> CollisionPass {
    let mut fields = Vec::new();
    for near in near {
        let part = &parts[near.part];
        let segment = usize::from(near.segment);
        let skin = &body.skins()[segment];
        let sphere = part.shape.compute_bounding_sphere(part.placed.pose());
        let body_centre = body.motions()[segment].transform_point(skin.centroid);
        let Some(out) = (body_centre - sphere.center).try_normalize() else { continue };
        let reach = 2.0 * skin.size;
        let inside = skin.vertices.iter().map(|&v| body.positions()[v as usize]).filter(|&x| part.contains(x));
        let depth = inside.filter_map(|x| part.exit(x, out, reach)).fold(0.0, f32::max);
        if depth > 0.0 {
            let inner = sphere.radius;
            let field = SphereField {
                centre: sphere.center - out * depth,
                d: out * depth,
                inner,
                outer: inner + softness * skin.size,
            };
            let shares = (0..body.motions().len()).map(|s| if s == segment { 1.0 } else { 0.0 }).collect();
            fields.push(SegmentField { shares, field: CollisionField::Sphere(field), owner: near.part as u32 });
        }
    }
    CollisionPass { fields, steps: body.settings.integrator.default_steps() }
}
