//! The points of the skin on which strengths are solved: a few at first, and those that the few left inside.

use rayon::prelude::*;

use super::obstacle::ObstaclePart;
use super::penetrations::{Contact, Penetration};
use super::skin_point::{SkinPoint, flow_all};
use crate::elastic::{CollisionPass, ElasticBody};
use crate::math::Vec3;

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
        let lists: Vec<&[Penetration]> = self.0.iter().map(Vec::as_slice).collect();
        let worst = |outcomes: Vec<Outcome>| {
            let none = Outcome { gap: f32::INFINITY, point: SkinPoint::vertex(0) };
            outcomes.into_iter().fold(none, |a, b| if b.gap < a.gap { b } else { a })
        };
        ends(body, pass, contacts, &lists, parts).into_iter().map(worst).collect()
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
        let lists: Vec<&[Penetration]> = contacts.iter().map(|contact| contact.points.as_slice()).collect();
        let all = ends(body, pass, contacts, &lists, parts);
        let mut any = false;
        for (((contact, outcomes), probes), &aim) in contacts.iter().zip(all).zip(&mut self.0).zip(aim) {
            let ends = outcomes.into_iter().zip(&contact.points);
            let mut inside: Vec<_> = ends.filter(|(outcome, _)| outcome.gap < aim - tolerance).collect();
            inside.sort_by(|(a, _), (b, _)| a.gap.total_cmp(&b.gap).then(a.point.vertices.cmp(&b.point.vertices)));
            inside.truncate(PROBES_SPREAD);
            for (_, missed) in inside {
                if !probes.contains(missed) {
                    probes.push(*missed);
                    any = true;
                }
            }
        }
        any
    }
}

/// Where the points of each contact's list end under `pass`.
fn ends(
    body: &ElasticBody,
    pass: &CollisionPass,
    contacts: &[Contact],
    lists: &[&[Penetration]],
    parts: &[ObstaclePart],
) -> Vec<Vec<Outcome>> {
    let points: Vec<SkinPoint> = lists.iter().flat_map(|list| list.iter().map(|p| p.point)).collect();
    let carried = flow_all(body, pass, &points);
    let mut rest = carried.as_slice();
    let own = lists.iter().map(|list| {
        let (own, others) = rest.split_at(list.len());
        rest = others;
        own
    });
    let own: Vec<&[Vec3]> = own.collect();
    let judge = |((contact, list), own): ((&Contact, &&[Penetration]), &&[Vec3])| {
        list.iter().zip(*own).map(|(probe, &x)| outcome(contact, parts, probe, x)).collect()
    };
    contacts.par_iter().zip(lists).zip(&own).map(judge).collect()
}

/// How far from its part a point of a contact is that ended at `x`.
fn outcome(contact: &Contact, parts: &[ObstaclePart], probe: &Penetration, x: Vec3) -> Outcome {
    let Penetration { point, part, .. } = *probe;
    let gap = match parts[part].exit(x, contact.near.normal, 2.0 * (contact.depth() + contact.guards)) {
        Some(depth) => -depth,
        None => parts[part].placed.distance(x).0,
    };
    Outcome { gap, point }
}

const PROBES_DEEPEST: usize = 8;
const PROBES_SPREAD: usize = 16;
