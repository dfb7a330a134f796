//! A skin with several segments, and random palettes for it.

use fastrand::Rng;
use pliant::elastic::{
    CollisionField, CollisionPass, DragField, DragStage, Palette, SegmentEntry, SegmentField, SkinWeights, SpringStage,
};
use pliant::field::{
    ConvexPart, HuggingField, Integrator, PartShape, Patch, PlacedPart, SphereField, Spread, SpringField,
};
use pliant::math::{Pose, Quat, Vec3};

use crate::icosphere::icosphere;
use crate::random::{SHAPES, between, direction, in_cube, part, pose, rotation};

/// Rest data of a unit sphere.
pub struct Skin {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub weights: Vec<SkinWeights>,
}

/// The unit sphere, its skin shared by `segments` segments along x with smooth weights.
pub fn skin(subdivisions: u32, segments: usize) -> Skin {
    let (positions, _) = icosphere(subdivisions);
    let weights = positions.iter().map(|x| blend(x.x, segments)).collect();
    Skin { normals: positions.clone(), positions, weights }
}

/// Linear blending between the two segments that are nearest to `x` in `[-1, 1]`.
fn blend(x: f32, segments: usize) -> SkinWeights {
    let at = (x + 1.0) * 0.5 * (segments - 1) as f32;
    let low = (at.floor() as usize).min(segments - 1);
    let high = (low + 1).min(segments - 1);
    let share = at - low as f32;
    SkinWeights { segments: [low as u16, high as u16, 0, 0], weights: [1.0 - share, share, 0.0, 0.0] }
}

fn stage(rng: &mut Rng, integrator: Integrator, middle: Vec3, radius: f32) -> SpringStage {
    let fields = (0..rng.usize(0..4))
        .map(|_| {
            let p = middle + in_cube(rng, 0.6);
            let radius = radius * between(rng, 0.7, 1.3);
            SpringField { p, q: p + direction(rng) * (radius * between(rng, 0.1, 0.4)), radius }
        })
        .collect();
    SpringStage::certified(fields, integrator, 40)
}

/// A field that presses a part of the given kind into the unit sphere about `middle`.
fn press(rng: &mut Rng, kind: usize, middle: Vec3) -> HuggingField {
    let outward = direction(rng);
    let part = match part(rng, kind) {
        ConvexPart { shape: PartShape::HalfSpace { .. }, rounding } => {
            ConvexPart { shape: PartShape::HalfSpace { normal: -outward }, rounding }
        }
        other => other,
    };
    let contact = middle + outward * 0.8;
    let turned = if matches!(part.shape, PartShape::HalfSpace { .. }) { Quat::IDENTITY } else { rotation(rng) };
    let place = Pose::from_parts(contact + outward * 0.2, turned);
    HuggingField {
        part: PlacedPart::new(part, place),
        d: -outward * between(rng, 0.1, 0.4),
        gauge: contact,
        width: between(rng, 0.8, 2.0),
        spread: match rng.bool() {
            true => Spread::EVEN,
            false => Spread { along: outward.any_orthonormal_vector(), share: rng.f32() },
        },
        patch: match rng.bool() {
            true => Patch::EVERYWHERE,
            false => Patch { centre: contact, radius: between(rng, 0.0, 0.4), width: between(rng, 0.4, 1.0) },
        },
        extent: 2.0,
    }
}

/// `segments` segments a little apart with both stages, and three passes with spheres and parts of every kind.
pub fn random_palette(rng: &mut Rng, segments: usize, integrator: Integrator) -> Palette {
    let place = pose(rng, 3.0);
    let entries = (0..segments).map(|_| {
        let motion = Pose::from_parts(
            place.translation + in_cube(rng, 0.1),
            Quat::IDENTITY.slerp(rotation(rng), 0.1) * place.rotation,
        );
        SegmentEntry {
            motion,
            local: stage(rng, integrator, motion.translation, 0.5),
            global: stage(rng, integrator, motion.translation, 1.2),
        }
    });
    let entries: Vec<_> = entries.collect();
    let passes = (0..3).map(|pass| {
        let fields = (0..4).map(|i| {
            let kind = (pass * 4 + i) % (SHAPES + 1);
            let field = if kind == SHAPES {
                let centre = place.translation + direction(rng);
                let (d, inner) = (direction(rng) * 0.3, between(rng, 0.0, 0.4));
                CollisionField::Sphere(SphereField { centre, d, inner, outer: inner + between(rng, 0.5, 1.5) })
            } else {
                CollisionField::Hugging(press(rng, kind, place.translation))
            };
            let shares = if i == 3 { Box::default() } else { (0..segments).map(|_| rng.f32()).collect() };
            SegmentField { shares, field, owner: 0 }
        });
        CollisionPass { fields: fields.collect(), steps: 8 }
    });
    let passes: Vec<_> = passes.collect();
    let count = rng.usize(0..4);
    let drags = (0..count).map(|_| {
        let p = place.translation + direction(rng);
        let field = SpringField { p, q: p + direction(rng) * between(rng, 0.1, 0.5), radius: between(rng, 0.4, 1.2) };
        let held = blend(between(rng, -1.0, 1.0), segments);
        DragField::new(field, &held)
    });
    let drags = DragStage::certified(drags.collect(), integrator, 40);
    Palette { segments: entries, drags, passes, integrator }
}

/// One segment at rest and one hugging field with a part of the given kind.
pub fn single_part(rng: &mut Rng, kind: usize) -> Palette {
    let stage = SpringStage { fields: Vec::new(), steps: 6 };
    let entry = SegmentEntry { motion: pose(rng, 1.0), local: stage.clone(), global: stage };
    let field = CollisionField::Hugging(press(rng, kind, entry.motion.translation));
    let passes =
        vec![CollisionPass { fields: vec![SegmentField { shares: [1.0].into(), field, owner: 0 }], steps: 12 }];
    Palette { segments: vec![entry], passes, ..Palette::default() }
}
