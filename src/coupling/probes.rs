//! The points of the skin on which strengths are solved: a few at first, and those that the few left inside.

use rapier3d::parry::bounding_volume::BoundingVolume;
use rayon::prelude::*;

use super::find_contacts::{PIERCED, STRETCHED};
use super::obstacle::ObstaclePart;
use super::penetrations::{ASKEW, Contact, Penetration};
use super::piercing::{Height, pierced};
use super::skin_point::{SkinPoint, flow_all};
use crate::elastic::{CollisionPass, ElasticBody};
use crate::math::Vec3;

/// The few points on which the strengths are solved: for each contact the deepest, and some of the others.
pub(super) struct Probes {
    points: Vec<Vec<Penetration>>,
    /// The triangles of the skin around each contact: tips and edges may pierce them when their corners have been carried out.
    around: Vec<SkinPatch>,
}

/// Where a contact ended: the signed gap (negative inside) and the point that decides it.
#[derive(Clone, Copy)]
pub(super) struct Outcome {
    /// Distance from the part, negative inside.
    pub gap: f32,
    /// The point of the skin.
    pub point: SkinPoint,
}

impl Probes {
    pub fn new(body: &ElasticBody, contacts: &[Contact]) -> Self {
        let choose = |contact: &Contact| {
            let stride = (contact.points.len() / PROBES_SPREAD).max(1);
            let rest = contact.points.iter().skip(PROBES_DEEPEST).step_by(stride);
            contact.points.iter().take(PROBES_DEEPEST).chain(rest).copied().collect()
        };
        let around = contacts.par_iter().map(|contact| SkinPatch::of(body, contact)).collect();
        Self { points: contacts.iter().map(choose).collect(), around }
    }

    /// Where each contact ends under `pass`, judged by its probes.
    pub fn outcomes(
        &self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contacts: &[Contact],
        parts: &[ObstaclePart],
    ) -> Vec<Outcome> {
        let lists: Vec<&[Penetration]> = self.points.iter().map(Vec::as_slice).collect();
        let worst = |outcomes: Vec<Outcome>| {
            let none = Outcome { gap: f32::INFINITY, point: SkinPoint::vertex(0) };
            outcomes.into_iter().fold(none, |a, b| if b.gap < a.gap { b } else { a })
        };
        ends(body, pass, contacts, &lists, parts).into_iter().map(worst).collect()
    }

    /// Looks at all points of the contacts under `pass`, and at the triangles around them, and adds those that end deeper than
    /// their contact's `aim` (a gap) by more than `tolerance`: true if any.
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
        let missed = |(i, (contact, outcomes)): (usize, (&Contact, Vec<Outcome>))| {
            let ends = outcomes.into_iter().zip(contact.points.iter().copied());
            let mut inside: Vec<_> = ends.filter(|(outcome, _)| outcome.gap < aim[i] - tolerance).collect();
            if inside.is_empty() {
                let pierced = self.around[i].pierced(body, pass, contact, parts, PIERCED * tolerance);
                inside = pierced.into_iter().filter(|(outcome, _)| outcome.gap < aim[i] - tolerance).collect();
            }
            inside.sort_by(|(a, _), (b, _)| a.gap.total_cmp(&b.gap).then(a.point.vertices.cmp(&b.point.vertices)));
            inside.truncate(PROBES_SPREAD);
            inside
        };
        let missed: Vec<Vec<(Outcome, Penetration)>> = contacts.par_iter().zip(all).enumerate().map(missed).collect();
        let mut any = false;
        for (points, missed) in self.points.iter_mut().zip(missed) {
            for (_, missed) in missed {
                if !points.contains(&missed) {
                    points.push(missed);
                    any = true;
                }
            }
        }
        any
    }
}

/// The triangles of the skin around a contact.
struct SkinPatch {
    triangles: Vec<[u32; 3]>,
    vertices: Vec<SkinPoint>,
    /// No corner of a triangle that is pierced is farther from the part.
    margin: f32,
}

impl SkinPatch {
    /// None for a guard.
    fn of(body: &ElasticBody, contact: &Contact) -> Self {
        let skin = &body.skins()[usize::from(contact.near.segment)];
        let margin = STRETCHED * skin.longest_edge;
        let mut patch = Self { triangles: Vec::new(), vertices: Vec::new(), margin };
        if contact.depth() <= 0.0 {
            return patch;
        }
        let reach = contact.radius + contact.depth() + skin.longest_edge;
        let near = |&v: &u32| body.positions()[v as usize].distance_squared(contact.centre) < reach * reach;
        let corners = skin.triangles.iter().map(|&t| body.rig().mesh.triangles[t as usize]);
        patch.triangles = corners.filter(|corners| corners.iter().any(near)).collect();
        let mut vertices: Vec<u32> = patch.triangles.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        patch.vertices = vertices.into_iter().map(SkinPoint::vertex).collect();
        patch
    }

    /// The points of triangles that parts of the contact pierce under `pass`, and where they end.
    fn pierced(
        &self,
        body: &ElasticBody,
        pass: &CollisionPass,
        contact: &Contact,
        parts: &[ObstaclePart],
        tolerance: f32,
    ) -> Vec<(Outcome, Penetration)> {
        let carried = flow_all(body, pass, &self.vertices);
        let place = |v: u32| self.vertices.binary_search_by_key(&v, |point| point.vertices[0]).unwrap_or(0);
        let mut found = Vec::new();
        for part in contact.parts() {
            let placed = &parts[part].placed;
            let around = parts[part].aabb.loosened(self.margin);
            let height = |&x: &Vec3| around.contains_local_point(x).then(|| placed.signed_distance(x));
            let heights: Vec<Option<Height>> = carried.iter().map(height).collect();
            if heights.iter().flatten().all(|height| height.0 > self.margin) {
                continue;
            }
            for &vertices in &self.triangles {
                let at = vertices.map(place);
                let [Some(a), Some(b), Some(c)] = at.map(|i| heights[i]) else { continue };
                let (corners, ends) = (at.map(|i| carried[i]), [a, b, c]);
                let Some((point, depth)) = pierced(placed, vertices, corners, ends, tolerance) else { continue };
                let x = point.position_of(corners);
                let along = parts[part].exit(x, contact.near.normal, ASKEW * depth);
                if along.is_some_and(|along| along < ASKEW * depth) {
                    found.push((
                        Outcome { gap: -along.unwrap_or(depth), point },
                        Penetration { point, part, depth, counts: 1.0 },
                    ));
                }
            }
        }
        found
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
