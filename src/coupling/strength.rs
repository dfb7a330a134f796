//! One pass of hugging fields: where each sits, and how strong it must be so that every contact ends touching.

use super::cancel::CancelSettings;
use super::gauge::gauge_point;
use super::magnitude::complementarity;
use super::obstacle::ObstaclePart;
use super::penetrations::Contact;
use super::probes::{Outcome, Probes};
use crate::elastic::{CollisionField, CollisionPass, ElasticBody, SegmentField};
use crate::field::{HuggingField, Lipschitz, usual_steps};
use crate::math::Vec3;

/// The fields of one pass, their strengths solved so that every contact ends touching.
pub(super) fn solve_pass(
    body: &ElasticBody,
    parts: &[ObstaclePart],
    contacts: &[Contact],
    softness: f32,
    size: f32,
    settings: &CancelSettings,
) -> CollisionPass {
    let n = contacts.len();
    let mut pass = CollisionPass { fields: place_fields(body, parts, contacts, softness), steps: 1 };
    let mut strength: Vec<f32> = contacts.iter().map(Contact::depth).collect();
    // Aim a little outside: what the solve leaves open then does not end inside.
    let aim = 0.5 * settings.depth_tolerance * size;
    let gap_tolerance = settings.gap_tolerance * size;
    let mut probes = Probes::new(contacts);
    for _ in 0..settings.max_rounds {
        set_strengths(&mut pass, contacts, &strength, body, settings);
        let outcome = probes.outcomes(body, &pass, contacts, parts);
        let open = outcome.iter().zip(&strength).any(|(o, &s)| o.gap < 0.0 || (o.gap > gap_tolerance && s > 0.0));
        if !open && !probes.extend(body, &pass, contacts, parts, settings.depth_tolerance * size) {
            break;
        }
        let matrix = influence(body, &pass, contacts, &outcome, &strength);
        let wanted: Vec<f32> = (0..n)
            .map(|i| {
                let row = &matrix[i * n..(i + 1) * n];
                row.iter().zip(&strength).map(|(a, s)| a * s).sum::<f32>() + aim - outcome[i].gap
            })
            .collect();
        complementarity(&matrix, &wanted, &mut strength);
        for (strength, contact) in strength.iter_mut().zip(contacts) {
            *strength = strength.min(STRONGEST * contact.depth());
        }
    }
    set_strengths(&mut pass, contacts, &strength, body, settings);
    pass.fields.retain(|entry| entry.field.displacement() != Vec3::ZERO);
    pass
}

/// A field is at most this many times as strong as its contact is deep: more would mean that it works against others,
/// and the next pass, with new contacts, does better.
const STRONGEST: f32 = 2.0;

/// One hugging field a contact, of strength zero.
fn place_fields(body: &ElasticBody, parts: &[ObstaclePart], contacts: &[Contact], softness: f32) -> Vec<SegmentField> {
    let field = |(j, contact): (usize, &Contact)| {
        let segment = contact.near.segment;
        let others = contacts
            .iter()
            .enumerate()
            .filter(|&(i, other)| i != j && other.near.segment == segment)
            .map(|(_, other)| (other.point, other.near.normal));
        let gauge = gauge_point(contact.point, others);
        let skin = &body.skins()[usize::from(segment)];
        let width = softness * skin.size;
        let centre = body.motions()[usize::from(segment)].transform_point(skin.centroid);
        SegmentField {
            segment,
            field: CollisionField::Hugging(HuggingField {
                part: parts[contact.near.part].region(width).clone(),
                d: Vec3::ZERO,
                gauge,
                width,
                extent: skin.size + centre.distance(gauge),
            }),
        }
    };
    contacts.iter().enumerate().map(field).collect()
}

/// Gives each field its displacement, certifies the steps, and weakens all of them together past the step limit.
fn set_strengths(
    pass: &mut CollisionPass,
    contacts: &[Contact],
    strength: &[f32],
    body: &ElasticBody,
    settings: &CancelSettings,
) {
    let mut bounds = vec![0.0; body.motions().len()];
    for ((entry, contact), &strength) in pass.fields.iter_mut().zip(contacts).zip(strength) {
        if let CollisionField::Hugging(field) = &mut entry.field {
            field.d = contact.near.normal * strength;
        }
        bounds[usize::from(entry.segment)] += entry.field.lipschitz();
    }
    let bound = bounds.into_iter().fold(0.0, f32::max);
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
        let vertex = outcome[i].vertex as usize;
        let x = body.positions()[vertex];
        for (j, entry) in pass.fields.iter().enumerate() {
            let weight = body.rig().weights[vertex].weight_of(entry.segment);
            let CollisionField::Hugging(field) = &entry.field else { continue };
            if weight <= 0.0 {
                continue;
            }
            // A field that is off is felt as if it were on a little.
            let unit = strength[j].max(1.0e-4 * field.width);
            let probe = HuggingField { d: contacts[j].near.normal * unit, ..field.clone() };
            let halfway = x + contact.near.normal * (0.5 * strength[i]);
            let share = weight * probe.velocity(halfway, 0.5).dot(contact.near.normal) / unit;
            // A field that pushes another contact deeper is not made up for by a stronger one, which would push back in
            // turn: the next pass sees what is left.
            matrix[i * n + j] = share.max(0.0);
        }
    }
    matrix
}
