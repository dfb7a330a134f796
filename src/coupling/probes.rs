//! The points of the skin on which strengths are solved: a few at first, and those that the few left inside.

use rayon::prelude::*;

use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use super::skin_point::SkinPoint;
use crate::elastic::{CollisionPass, ElasticBody};

/// The few points on which the strengths are solved: for each contact the deepest, and some of the others.
pub(super) struct Probes(Vec<Vec<Penetration>>);

/// Where a contact ended: the signed gap (negative inside) and the point that decides it.
#[derive(Clone, Copy)]
pub(super) struct Outcome {
    /// Distance from the part, negative inside.
    pub gap: f32,
    /// The point of the skin.
    pub point: SkinPoint,
}

impl Probes {
    pub fn new(contacts: &[Contact]) -> Self {
        let choose = |contact: &Contact| {
            let stride = (contact.points.len() / PROBES_SPREAD).max(1);
            let rest = contact.points.iter().skip(PROBES_DEEPEST).step_by(stride);
            contact.points.iter().take(PROBES_DEEPEST).chain(rest).copied().collect()
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
            outcomes.fold(Outcome { gap: f32::INFINITY, point: SkinPoint::vertex(0) }, |a, b| {
                if b.gap < a.gap { b } else { a }
            })
        };
        contacts.par_iter().zip(&self.0).map(judge).collect()
    }

    /// Looks at all points of the contacts under `pass` and adds those that end deeper than their contact's `aim` (a gap) by
    /// more than `tolerance`: true if any.
    pub fn extend(
        &mut self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
        aim: &[f32],
        tolerance: f32,
    ) -> bool {
        let missed = |contact: &Contact, aim: f32| {
            let outcomes = contact.points.par_iter().with_min_len(32);
            let mut inside: Vec<(Outcome, Penetration)> = outcomes
                .map(|p| (outcome(body, pass, contact, parts, p), *p))
                .filter(|(outcome, _)| outcome.gap < aim - tolerance)
                .collect();
            inside.sort_by(|(a, _), (b, _)| a.gap.total_cmp(&b.gap).then(a.point.vertices.cmp(&b.point.vertices)));
            inside.truncate(PROBES_SPREAD);
            inside
        };
        let mut any = false;
        for ((contact, probes), &aim) in contacts.iter().zip(&mut self.0).zip(aim) {
            for (_, missed) in missed(contact, aim) {
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
    let Penetration { point, part, .. } = *probe;
    let x = point.flow(body, pass);
    let gap = match parts[part].exit(x, contact.near.normal, 2.0 * (contact.depth() + contact.guards)) {
        Some(depth) => -depth,
        None => parts[part].placed.distance(x).0,
    };
    Outcome { gap, point }
}

const PROBES_DEEPEST: usize = 8;
const PROBES_SPREAD: usize = 8;
