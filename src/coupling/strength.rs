//! One pass of hugging fields: where each sits, and how strong it must be so that every contact ends touching.

use rapier3d::parry::bounding_volume::BoundingVolume;

use super::cancel::CancelSettings;
use super::contact::Proximity;
use super::gauge::{Bar, gauge_point, spread_between};
use super::magnitude::complementarity;
use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use super::probes::{Outcome, Probes};
use crate::elastic::{CollisionField, CollisionPass, ElasticBody, SegmentField, SegmentSkin};
use crate::field::{ConvexPart, HuggingField, Lipschitz, PartShape, Patch, PlacedPart, usual_steps};
use crate::math::{Pose, Vec3};

/// How passes go about their work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    /// Fields fade out over this many sizes of the segment.
    pub softness: f32,
    /// The way that is gone at least in one pass where contacts push against each other, in sizes of the body.
    pub stride: f32,
    /// Triangles that are pierced are looked at from the first pass on, not only where all that is left is small.
    pub tips: bool,
}

/// The fields of one pass, and their strengths, solved so that every contact ends touching or needs no push of its own.
///
/// `least` are the least strengths: 0, or minus what the contact's own fields have pushed before, which may be taken back.
pub(super) fn solve_pass(
    body: &ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    contacts: &[Contact],
    least: &[f32],
    way: Way,
    size: f32,
    settings: &CancelSettings,
) -> (CollisionPass, Vec<f32>) {
    let n = contacts.len();
    let mut pass = CollisionPass { fields: place_fields(body, parts, near, contacts, way.softness), steps: 1 };
    let mut strength: Vec<f32> = contacts.iter().map(Contact::depth).collect();
    // Aim a little outside: what the solve leaves open then does not end inside. Where contacts push against each other
    // only a stride of the way is gone at once.
    let part = stride_of(contacts, way.stride * size);
    let aim: Vec<f32> =
        contacts.iter().map(|contact| 0.5 * settings.depth_tolerance * size - (1.0 - part) * contact.depth()).collect();
    strength.iter_mut().for_each(|strength| *strength *= part);
    let depth_tolerance = settings.depth_tolerance * size;
    let gap_tolerance = settings.gap_tolerance * size;
    let slack = 0.5 * depth_tolerance;
    let deepest = contacts.iter().map(Contact::depth).chain(least.iter().map(|least| -least)).fold(0.0, f32::max);
    let mut probes = Probes::new(body, contacts);
    let mut best = (f32::INFINITY, strength.clone());
    let (mut target, mut fraction) = (strength.clone(), 1.0_f32);
    for _ in 0..settings.max_rounds {
        set_strengths(&mut pass, contacts, &strength, body, settings);
        let outcome = probes.outcomes(body, &pass, contacts, parts);
        let open = outcome
            .iter()
            .zip(&strength)
            .zip(&aim)
            .zip(least)
            .any(|(((o, s), aim), least)| o.gap < aim - slack || (o.gap > aim + gap_tolerance && s > least));
        let missed = !open && probes.extend(body, &pass, contacts, parts, &aim, depth_tolerance);
        if !open && !missed {
            best = (0.0, strength);
            break;
        }
        let score = if missed { f32::INFINITY } else { openness(&outcome, &strength, &aim, least) };
        if score < best.0 || missed {
            best = (score, strength.clone());
            let matrix = influence(body, &pass, contacts, &outcome, &strength);
            let wanted: Vec<f32> = (0..n)
                .map(|i| {
                    let row = &matrix[i * n..(i + 1) * n];
                    row.iter().zip(&strength).map(|(a, s)| a * s).sum::<f32>() + aim[i] - outcome[i].gap
                })
                .collect();
            complementarity(&matrix, &wanted, least, &mut strength);
            for (strength, contact) in strength.iter_mut().zip(contacts) {
                let strongest = if contact.pierced { STRONGEST_BETWEEN } else { STRONGEST };
                *strength = strength.min(strongest * deepest);
            }
            (target, fraction) = (strength.clone(), 1.0);
        } else {
            // Too far: the influences hold for a part of the way only.
            fraction *= SHORTER;
            if fraction < SHORTEST {
                break;
            }
            let between = best.1.iter().zip(&target).map(|(from, to)| from + (to - from) * fraction);
            strength = between.collect();
        }
    }
    let strength = best.1;
    set_strengths(&mut pass, contacts, &strength, body, settings);
    pass.fields.retain(|entry| entry.field.displacement() != Vec3::ZERO);
    (pass, strength)
}

/// A step of the solve that made it worse is tried anew with this part of its length, down to the least.
const SHORTER: f32 = 0.5;
const SHORTEST: f32 = 0.2;

/// How far the contacts are from touching: the worst depth that is left, and to a part the widest gap.
fn openness(outcome: &[Outcome], strength: &[f32], aim: &[f32], least: &[f32]) -> f32 {
    let of = |(((o, s), aim), least): (((&Outcome, &f32), &f32), &f32)| {
        let gap = o.gap - aim;
        if gap < 0.0 {
            -gap
        } else if s > least {
            GAP_COUNTS * gap
        } else {
            0.0
        }
    };
    outcome.iter().zip(strength).zip(aim).zip(least).map(of).fold(0.0, f32::max)
}

/// How much a gap counts beside a depth.
const GAP_COUNTS: f32 = 0.5;

/// The part of the way that is gone in one pass: all of it, unless contacts push against each other. What is squeezed out of
/// one of them then flows towards the next, and the strengths are right for a short way only.
fn stride_of(contacts: &[Contact], stride: f32) -> f32 {
    let against = |a: &Contact| contacts.iter().any(|b| a.near.normal.dot(b.near.normal) < AGAINST_EACH_OTHER);
    if contacts.len() < 3 || !contacts.iter().any(against) {
        return 1.0;
    }
    let deepest = contacts.iter().map(Contact::depth).fold(0.0, f32::max);
    (stride / deepest.max(f32::MIN_POSITIVE)).min(1.0)
}

/// Contacts push against each other below this cosine of the angle between their directions.
const AGAINST_EACH_OTHER: f32 = -0.3;

/// A field is at most this many times as strong as the deepest contact is deep: more would mean that it works against others,
/// and the next pass, with new contacts, does better.
const STRONGEST: f32 = 2.0;

/// As [`STRONGEST`], and of the deepest contact's depth too, for what pierces triangles: the corners are beside the narrow field and go less far than their triangle must.
const STRONGEST_BETWEEN: f32 = 3.5;

/// What a tip or an edge pierces is pushed out by fields that are narrower by this factor: the displacement is small, and the rest
/// of the contact is to stay where it is.
const NARROW: f32 = 0.25;

/// One hugging field a contact, of strength zero.
fn place_fields(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    contacts: &[Contact],
    softness: f32,
) -> Vec<SegmentField> {
    let field = |(j, contact): (usize, &Contact)| {
        let bar = |other: &Contact| Bar {
            point: other.centre,
            normal: other.near.normal,
            weight: other.closeness() * parts[other.near.part].presence,
        };
        let others = || contacts.iter().enumerate().filter(|&(i, _)| i != j).map(|(_, other)| bar(other));
        let gauge = gauge_point(contact.centre, others(), body.skins()[usize::from(contact.near.segment)].size);
        let spread = spread_between(contact.near.normal, others());
        let skin = &body.skins()[usize::from(contact.near.segment)];
        let width = softness * skin.size * if contact.pierced { NARROW } else { 1.0 };
        let beside = width + contact.radius;
        let patch = Patch { centre: contact.centre, radius: contact.radius, width: beside };
        SegmentField {
            shares: shares(body, parts, contact, near),
            field: CollisionField::Hugging(HuggingField {
                part: region_of(body, parts, contact, width),
                d: Vec3::ZERO,
                gauge,
                width,
                spread,
                patch,
                extent: reach_of(body, gauge),
            }),
            owner: contact.near.part as u32,
        }
    };
    contacts.iter().enumerate().map(field).collect()
}

/// The region of constant velocity of a contact's field: the part, or, where the contact is with pieces of a surface, all that
/// lies below the highest of the places where its points come out.
///
/// A contact with a surface is one with many pieces; a region about one of them would move the skin over the others less, and
/// would jump when another piece becomes the deepest.
fn region_of(body: &ElasticBody, parts: &[ObstaclePart], contact: &Contact, width: f32) -> PlacedPart {
    let part = &parts[contact.near.part];
    if contact.pierced || !part.is_piece() {
        return part.region(width).clone();
    }
    let normal = contact.near.normal;
    let height = |p: &Penetration| (p.point.position(body.positions()) - contact.centre).dot(normal) + p.depth;
    let top = contact.points.iter().map(height).fold(0.0, f32::max);
    let pose = Pose::from_translation(contact.centre + normal * top);
    PlacedPart::new(ConvexPart { shape: PartShape::HalfSpace { normal }, rounding: 0.0 }, pose)
}

/// How much of a contact's field each segment takes: all of it, but for segments that the same part, or one that touches
/// it, pushes another way. They would be carried into the part.
fn shares(body: &ElasticBody, parts: &[ObstaclePart], contact: &Contact, near: &[Proximity]) -> Box<[f32]> {
    let mut shares = vec![1.0_f32; body.motions().len()];
    let own = &parts[contact.near.part];
    for other in near.iter().filter(|other| other.segment != contact.near.segment) {
        if other.part == contact.near.part || parts[other.part].aabb.intersects(&own.aabb) {
            let along = (other.normal.dot(contact.near.normal) - AGAINST) / (ALONG - AGAINST);
            let along = along.clamp(0.0, 1.0);
            let share = &mut shares[usize::from(other.segment)];
            *share = share.min(along * along * (3.0 - 2.0 * along));
        }
    }
    if shares.iter().all(|&share| share == 1.0) { Box::default() } else { shares.into() }
}

/// Cosines between the ways of two segments out of a part: below the first the one takes nothing of the other's field,
/// above the second all of it.
const AGAINST: f32 = -0.5;
const ALONG: f32 = 0.1;

/// Largest distance of the skin from a point, by the bounds of the segments.
pub(super) fn reach_of(body: &ElasticBody, point: Vec3) -> f32 {
    let reach =
        |(skin, motion): (&SegmentSkin, &Pose)| motion.transform_point(skin.centroid).distance(point) + skin.size;
    body.skins().iter().zip(body.motions()).map(reach).fold(0.0, f32::max)
}

/// Gives each field its displacement, and certifies the steps.
fn set_strengths(
    pass: &mut CollisionPass,
    contacts: &[Contact],
    strength: &[f32],
    body: &ElasticBody,
    settings: &CancelSettings,
) {
    for ((entry, contact), &strength) in pass.fields.iter_mut().zip(contacts).zip(strength) {
        if let CollisionField::Hugging(field) = &mut entry.field {
            field.d = contact.near.normal * strength;
        }
    }
    certify(pass, body, settings);
}

/// Gives a pass the steps that its fields' bounds ask for, and past the step limit weakens all of them together.
pub(super) fn certify(pass: &mut CollisionPass, body: &ElasticBody, settings: &CancelSettings) {
    let bound = bound_of_sum(&pass.fields);
    let needed = usual_steps(bound, body.settings.integrator.default_steps());
    pass.steps = needed.min(settings.max_steps).max(1);
    if needed > pass.steps {
        let weaken = pass.steps as f32 / needed as f32;
        for entry in &mut pass.fields {
            if let CollisionField::Hugging(field) = &mut entry.field {
                field.d *= weaken;
            }
        }
    }
}

/// A bound on the gradient of the sum: at any point only the fields count whose patches reach it.
fn bound_of_sum(fields: &[SegmentField]) -> f32 {
    let ball = |field: &CollisionField| match field {
        CollisionField::Hugging(f) => (f.patch.centre, f.patch.radius + f.patch.width + f.d.length()),
        CollisionField::Sphere(f) => (f.centre, f.outer + f.d.length()),
    };
    let balls: Vec<(Vec3, f32, f32)> = fields
        .iter()
        .map(|entry| {
            let (centre, radius) = ball(&entry.field);
            (centre, radius, entry.field.lipschitz())
        })
        .collect();
    let around = |&(centre, radius, _): &(Vec3, f32, f32)| {
        balls.iter().filter(|(c, r, _)| c.distance(centre) < r + radius).map(|(_, _, bound)| bound).sum::<f32>()
    };
    balls.iter().map(around).fold(0.0, f32::max)
}

/// Fields that push a contact deeper are made up for by a stronger one, which pushes back in turn: that ends only where all
/// of them together do less than the contact's own field.
fn tame(row: &mut [f32], own: usize) {
    row[own] = row[own].max(0.0);
    let against: f32 = row.iter().filter(|share| **share < 0.0).sum();
    let most = -TAMED * row[own];
    if against < most {
        let factor = most / against;
        row.iter_mut().filter(|share| **share < 0.0).for_each(|share| *share *= factor);
    }
}

/// The part of a contact's own field that the others may undo.
const TAMED: f32 = 0.7;

/// `A[i][j]`: how far field `j` of unit strength moves the deciding vertex of contact `i` along its direction, from the
/// velocities halfway.
fn influence(
    body: &ElasticBody,
    pass: &CollisionPass,
    contacts: &[Contact],
    outcome: &[Outcome],
    strength: &[f32],
) -> Vec<f32> {
    let n = contacts.len();
    let mut matrix = vec![0.0; n * n];
    for (i, contact) in contacts.iter().enumerate() {
        let point = outcome[i].point;
        let x = point.position(body.positions());
        for (j, entry) in pass.fields.iter().enumerate() {
            let weight = point.share_of(body.rig(), &entry.shares);
            let CollisionField::Hugging(field) = &entry.field else { continue };
            if weight <= 0.0 {
                continue;
            }
            // A field that is off is felt as if it were on a little.
            let unit = strength[j].max(1.0e-4 * field.width).max(f32::MIN_POSITIVE);
            let probe = HuggingField { d: contacts[j].near.normal * unit, ..field.clone() };
            let halfway = x + contact.near.normal * (0.5 * strength[i]);
            let share = weight * probe.velocity(halfway, 0.5).dot(contact.near.normal) / unit;
            matrix[i * n + j] = share;
        }
        tame(&mut matrix[i * n..(i + 1) * n], i);
    }
    matrix
}
