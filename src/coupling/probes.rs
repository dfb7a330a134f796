//! The vertices on which strengths are solved: a few at first, and those that the few left inside.

use rayon::prelude::*;

use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use crate::elastic::{CollisionPass, ElasticBody};

/// The few vertices on which the strengths are solved: for each contact the deepest, and some of the others.
pub(super) struct Probes(Vec<Vec<Penetration>>);

/// Where a contact ended: the signed gap (negative inside) and the vertex that decides it.
#[derive(Clone, Copy)]
pub(super) struct Outcome {
    /// Distance from the part, negative inside.
    pub gap: f32,
    /// The vertex.
    pub vertex: u32,
}

impl Probes {
    pub fn new(contacts: &[Contact]) -> Self {
        let choose = |contact: &Contact| {
            let stride = (contact.vertices.len() / PROBES_SPREAD).max(1);
            let rest = contact.vertices.iter().skip(PROBES_DEEPEST).step_by(stride);
            contact.vertices.iter().take(PROBES_DEEPEST).chain(rest).copied().collect()
        };
        Self(contacts.iter().map(choose).collect())
    }

    /// Where each contact ends under `pass`, judged by its probes.
    pub fn outcomes(
        &self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
    ) -> Vec<Outcome> {
        let judge = |(contact, probes): (&Contact, &Vec<Penetration>)| {
            let outcomes = probes.iter().map(|probe| outcome(body, pass, contact, parts, probe));
            outcomes.fold(Outcome { gap: f32::INFINITY, vertex: 0 }, |a, b| if b.gap < a.gap { b } else { a })
        };
        contacts.par_iter().zip(&self.0).map(judge).collect()
    }

    /// Looks at all vertices of the contacts under `pass` and adds those that the probes left inside: true if any.
    pub fn extend(
        &mut self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
        tolerance: f32,
    ) -> bool {
        let missed = |contact: &Contact| {
            let outcomes = contact.vertices.par_iter().with_min_len(32);
            let mut inside: Vec<(Outcome, Penetration)> = outcomes
                .map(|p| (outcome(body, pass, contact, parts, p), *p))
                .filter(|(outcome, _)| outcome.gap < -tolerance)
                .collect();
            inside.sort_by(|(a, _), (b, _)| a.gap.total_cmp(&b.gap).then(a.vertex.cmp(&b.vertex)));
            inside.truncate(PROBES_SPREAD);
            inside
        };
        let mut any = false;
        for (contact, probes) in contacts.iter().zip(&mut self.0) {
            for (_, missed) in missed(contact) {
                if !probes.contains(&missed) {
                    probes.push(missed);
                    any = true;
                }
            }
        }
        any
    }
}

/// Where one vertex of a contact ends under `pass`.
fn outcome(
    body: &ElasticBody,
    pass: &CollisionPass,
    contact: &Contact,
    parts: &[ObstaclePart],
    probe: &Penetration,
) -> Outcome {
    let Penetration { vertex, part, .. } = *probe;
    let start = body.positions()[vertex as usize];
    let x = pass.flow(start, &body.rig().weights[vertex as usize], body.settings.integrator);
    let gap = match parts[part].exit(x, contact.near.normal, 2.0 * contact.depth()) {
        Some(depth) => -depth,
        None => parts[part].placed.distance(x).0,
    };
    Outcome { gap, vertex }
}

const PROBES_DEEPEST: usize = 8;
const PROBES_SPREAD: usize = 8;
