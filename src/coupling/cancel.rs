//! Penetration cancellation: passes of hugging fields that push the skin out until it touches (design of section 4).
//!
//! One pass: gather the contacts of the deformed skin, choose their gauge points together, solve for their strengths so
//! that each ends touching, then carry the whole skin along. Passes are concatenated until nothing is left.

use std::collections::HashMap;

use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::contact::{Proximity, penetration};
use super::gauge::gauge_point;
use super::magnitude::complementarity;
use super::obstacle::ObstaclePart;
use crate::elastic::{CollisionField, CollisionPass, ElasticBody, SegmentField};
use crate::field::{HuggingField, Lipschitz, usual_steps};
use crate::math::Vec3;

/// Tolerances and limits of the cancellation; lengths as fractions of the body's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CancelSettings {
    /// Softness `s`: fields fade out over `s` times the segment's size. `None` takes the rig's.
    pub softness: Option<f32>,
    /// Depth that may be left over.
    pub depth_tolerance: f32,
    /// Gap that may be left at a contact.
    pub gap_tolerance: f32,
    /// Most passes.
    pub max_passes: u32,
    /// Most rounds of the solve for the strengths in each pass.
    pub max_rounds: u32,
    /// Most integration steps of a pass; a field whose bound asks for more is weakened and the next pass goes on.
    pub max_steps: u32,
    /// Where the fields are placed.
    pub placement: Placement,
}

/// Where collision fields are placed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placement {
    /// Fields hug the part, gauge points and strengths are solved for.
    #[default]
    Hugging,
    /// The paper's literal placement (section 4.2): bounding sphere of the part, direction along the line of centres,
    /// one pass, plain sum. For comparison.
    Literal,
}

impl Default for CancelSettings {
    fn default() -> Self {
        Self {
            softness: None,
            depth_tolerance: 5.0e-4,
            gap_tolerance: 2.0e-3,
            max_passes: 4,
            max_rounds: 6,
            max_steps: 24,
            placement: Placement::Hugging,
        }
    }
}

/// A vertex that has gone into a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// The vertex.
    pub vertex: u32,
    /// How far it must move along the contact's direction.
    pub depth: f32,
}

/// One segment's penetration of one part.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Segment, part and direction.
    pub near: Proximity,
    /// The penetrating vertices, deepest first.
    pub vertices: Vec<Penetration>,
    /// Depth-weighted mean of the penetrating vertices, moved out to the part's surface.
    pub point: Vec3,
}

impl Contact {
    /// Depth of the deepest vertex.
    pub fn depth(&self) -> f32 {
        self.vertices.first().map_or(0.0, |p| p.depth)
    }
}

/// What the cancellation of one body did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CancelReport {
    /// The contacts as they were before the first pass.
    pub contacts: Vec<Contact>,
    /// Number of passes.
    pub passes: u32,
    /// Largest number of integration steps in a pass.
    pub steps: u32,
}

/// The contacts of a skin with the parts near it, vertices deeper than `tolerance` only.
///
/// A vertex that several segments share belongs to the contact that leads it out of the part on the shortest way.
pub fn find_contacts(body: &ElasticBody, parts: &[ObstaclePart], near: &[Proximity], tolerance: f32) -> Vec<Contact> {
    let found: Vec<Vec<Penetration>> =
        near.par_iter().map(|near| find_penetrations(body, &parts[near.part], near, tolerance)).collect();
    let mut shortest: HashMap<(usize, u32), (f32, usize)> = HashMap::new();
    for (contact, (near, vertices)) in near.iter().zip(&found).enumerate() {
        for p in vertices {
            let best = shortest.entry((near.part, p.vertex)).or_insert((p.depth, contact));
            if p.depth < best.0 {
                *best = (p.depth, contact);
            }
        }
    }
    let mut contacts = Vec::new();
    for (contact, (near, mut vertices)) in near.iter().zip(found).enumerate() {
        vertices.retain(|p| shortest[&(near.part, p.vertex)].1 == contact);
        if !vertices.is_empty() {
            contacts.push(Contact::new(body, *near, vertices));
        }
    }
    contacts
}

impl Contact {
    fn new(body: &ElasticBody, near: Proximity, mut vertices: Vec<Penetration>) -> Self {
        vertices.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.vertex.cmp(&b.vertex)));
        let mut sum = Vec3::ZERO;
        let mut weight = 0.0;
        for p in &vertices {
            sum += (body.positions()[p.vertex as usize] + near.normal * p.depth) * p.depth;
            weight += p.depth;
        }
        Self { near, vertices, point: sum / weight }
    }
}

fn find_penetrations(body: &ElasticBody, part: &ObstaclePart, near: &Proximity, tolerance: f32) -> Vec<Penetration> {
    let skin = &body.skins()[usize::from(near.segment)];
    let motion = body.motions()[usize::from(near.segment)];
    let reach = 2.0 * skin.size;
    // Nothing outside the part's box and its shadow, on the far side from the segment, can have gone in.
    let shadow =
        part.aabb.merged(&Aabb::new(part.aabb.mins - near.normal * reach, part.aabb.maxs - near.normal * reach));
    let inward = motion.rotation.inverse() * near.normal;
    let mut vertices = Vec::new();
    for &vertex in &skin.vertices {
        let x = body.positions()[vertex as usize];
        if !shadow.contains_local_point(x) {
            continue;
        }
        let facing = body.rig().mesh.normals[vertex as usize].dot(inward);
        if let Some(depth) = penetration(part, near, x, facing, reach)
            && depth > tolerance
        {
            vertices.push(Penetration { vertex, depth });
        }
    }
    vertices
}

/// Cancels the penetration of `body` into `parts`: adds passes to its palette and carries its skin along.
///
/// `size` is the body's size, the unit of the tolerances.
pub fn cancel(
    body: &mut ElasticBody,
    parts: &[ObstaclePart],
    near: &[Proximity],
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let mut report = CancelReport::default();
    let tolerance = settings.depth_tolerance * size;
    let softness = settings.softness.unwrap_or(body.rig().softness);
    while report.passes < settings.max_passes {
        let contacts = find_contacts(body, parts, near, tolerance);
        if contacts.is_empty() {
            break;
        }
        let pass = match settings.placement {
            Placement::Hugging => solve_pass(body, parts, &contacts, softness, size, settings),
            Placement::Literal => super::literal::place(body, parts, near, softness),
        };
        report.passes += 1;
        report.steps = report.steps.max(pass.steps);
        if report.passes == 1 {
            report.contacts = contacts;
        }
        body.deform_collision(pass);
        if settings.placement == Placement::Literal {
            break;
        }
    }
    report
}

/// The fields of one pass, their strengths solved so that every contact ends touching.
fn solve_pass(
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
        let centre = body.motions()[usize::from(segment)].transform_point(skin.centroid);
        SegmentField {
            segment,
            field: CollisionField::Hugging(HuggingField {
                part: parts[contact.near.part].placed.clone(),
                d: Vec3::ZERO,
                gauge,
                width: softness * skin.size,
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

/// The few vertices on which the strengths are solved: for each contact the deepest, and some of the others.
struct Probes(Vec<Vec<u32>>);

/// Where a contact ended: the signed gap (negative inside) and the vertex that decides it.
#[derive(Clone, Copy)]
struct Outcome {
    gap: f32,
    vertex: u32,
}

impl Probes {
    fn new(contacts: &[Contact]) -> Self {
        let choose = |contact: &Contact| {
            let stride = (contact.vertices.len() / PROBES_SPREAD).max(1);
            let rest = contact.vertices.iter().skip(PROBES_DEEPEST).step_by(stride);
            contact.vertices.iter().take(PROBES_DEEPEST).chain(rest).map(|p| p.vertex).collect()
        };
        Self(contacts.iter().map(choose).collect())
    }

    /// Where each contact ends under `pass`, judged by its probes.
    fn outcomes(
        &self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
    ) -> Vec<Outcome> {
        let judge = |(contact, probes): (&Contact, &Vec<u32>)| {
            let outcomes = probes.iter().map(|&v| outcome(body, pass, contact, &parts[contact.near.part], v));
            outcomes.fold(Outcome { gap: f32::INFINITY, vertex: 0 }, |a, b| if b.gap < a.gap { b } else { a })
        };
        contacts.par_iter().zip(&self.0).map(judge).collect()
    }

    /// Looks at all vertices of the contacts under `pass` and adds those that the probes left inside: true if any.
    fn extend(
        &mut self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
        tolerance: f32,
    ) -> bool {
        let missed = |contact: &Contact| {
            let part = &parts[contact.near.part];
            let outcomes = contact.vertices.par_iter().with_min_len(32);
            let mut inside: Vec<Outcome> = outcomes
                .map(|p| outcome(body, pass, contact, part, p.vertex))
                .filter(|outcome| outcome.gap < -tolerance)
                .collect();
            inside.sort_by(|a, b| a.gap.total_cmp(&b.gap).then(a.vertex.cmp(&b.vertex)));
            inside.truncate(PROBES_SPREAD);
            inside
        };
        let mut any = false;
        for (contact, probes) in contacts.iter().zip(&mut self.0) {
            for outcome in missed(contact) {
                if !probes.contains(&outcome.vertex) {
                    probes.push(outcome.vertex);
                    any = true;
                }
            }
        }
        any
    }
}

/// Where one vertex of a contact ends under `pass`.
fn outcome(body: &ElasticBody, pass: &CollisionPass, contact: &Contact, part: &ObstaclePart, vertex: u32) -> Outcome {
    let start = body.positions()[vertex as usize];
    let x = pass.flow(start, &body.rig().weights[vertex as usize], body.settings.integrator);
    let gap = match part.exit(x, contact.near.normal, 2.0 * contact.depth()) {
        Some(depth) => -depth,
        None => part.placed.distance(x).0,
    };
    Outcome { gap, vertex }
}

const PROBES_DEEPEST: usize = 8;
const PROBES_SPREAD: usize = 8;

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
            matrix[i * n + j] = weight * probe.velocity(halfway, 0.5).dot(contact.near.normal) / unit;
        }
    }
    matrix
}
