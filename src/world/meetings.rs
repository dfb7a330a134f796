//! Elastic bodies that meet each other or themselves: impulses that push them apart, and interfaces for their skins.

use std::collections::BTreeMap;

use rapier3d::dynamics::RigidBodySet;
use rayon::prelude::*;

use super::deformation_world::DeformationWorld;
use super::encounter::Encounter;
use crate::coupling::{
    ElasticSide, FoundationContact, Interface, Overlap, PairPoint, PartId, Proximity, SegmentPair, SegmentRef,
    SkinSide, interface_part, pair_contacts, pairs_of,
};
use crate::elastic::ElasticBody;
use crate::math::Vec3;

/// Overlaps below this part of the smaller body's size are left.
const TOLERANCE: f32 = 1.0e-3;

/// The box behind an interface is deeper than the overlap by this part of the smaller segment's size.
const MARGIN: f32 = 0.15;

/// An interface comes into being where skins are nearer to each other than this part of the smaller body's size, and is fully
/// there where they touch.
const NEARING: f32 = 0.03;

/// As [`NEARING`], for two segments of one body: their skins are near each other most of the time.
const OWN_NEARING: f32 = 0.01;

/// Most points at which two segments push each other.
const MOST_POINTS: usize = 96;

/// The interfaces of a step by the pairs that they part: as they were found, and as they are.
pub(super) type Parted = BTreeMap<(SegmentRef, SegmentRef), [Interface; 2]>;

/// A segment of a body for longer than a step.
pub(super) type SegmentName = ((u32, u32), usize);

fn name_of(encounters: &[Encounter], at: SegmentRef) -> SegmentName {
    (encounters[at.body].handle.into_raw_parts(), at.segment)
}

/// The name of the part that keeps the skin of a segment out of the other one's.
pub(super) fn interface_name(encounters: &[Encounter], at: SegmentRef, other: SegmentRef) -> PartId {
    let body = encounters[other.body].handle.into_raw_parts().0;
    PartId::interface(at.segment as u16, (body, other.segment as u16))
}

/// So much of what an interface was widened by in a step is left in the next.
const LASTS: f32 = 0.9;

impl DeformationWorld {
    /// The pairs of segments, of two bodies or of one, that come close; their bodies are indices of `encounters`.
    pub(super) fn find_pairs(&self, encounters: &[Encounter]) -> Vec<SegmentPair> {
        let there: Vec<usize> = (0..encounters.len()).filter(|&i| encounters[i].frozen.is_none()).collect();
        let entries: Vec<_> = there.iter().filter_map(|&i| self.entries.get(encounters[i].handle.0)).collect();
        if entries.len() != there.len() {
            return Vec::new();
        }
        let bodies: Vec<&ElasticBody> = entries.iter().map(|entry| &entry.body).collect();
        let mut pairs = pairs_of(&bodies, NEARING, |a, b| {
            if a.body == b.body {
                entries[a.body].self_pairs.contains(&(a.segment, b.segment))
            } else {
                entries[a.body].groups.test(entries[b.body].groups)
            }
        });
        for pair in &mut pairs {
            pair.a.body = there[pair.a.body];
            pair.b.body = there[pair.b.body];
        }
        pairs
    }

    /// The contacts of the elastic foundation between segments whose rigid skins overlap.
    pub(super) fn pair_foundation(
        &self,
        encounters: &[Encounter],
        pairs: &[SegmentPair],
        bodies: &RigidBodySet,
    ) -> Vec<FoundationContact> {
        let mut rigid: BTreeMap<usize, Vec<Vec3>> = BTreeMap::new();
        for at in pairs.iter().flat_map(|pair| [pair.a, pair.b]) {
            if let Some(body) = self.body_at(encounters, at.body) {
                rigid.entry(at.body).or_insert_with(|| body.rigid_positions());
            }
        }
        let contacts = |pair: &SegmentPair| {
            let points = self.pair_points(encounters, pair, &rigid);
            let side = |at: SegmentRef| {
                let handle = encounters[at.body].handle;
                let entry = self.entries.get(handle.0)?;
                let raw = handle.into_raw_parts();
                Some(ElasticSide::of(raw, &entry.body, &entry.ragdoll, self.settings.stiffness, bodies))
            };
            match (side(pair.a), side(pair.b)) {
                (Some(a), Some(b)) if !points.is_empty() => pair_contacts([a, b], &points),
                _ => Vec::new(),
            }
        };
        pairs.par_iter().map(contacts).collect::<Vec<_>>().into_iter().flatten().collect()
    }

    fn pair_points(
        &self,
        encounters: &[Encounter],
        pair: &SegmentPair,
        rigid: &BTreeMap<usize, Vec<Vec3>>,
    ) -> Vec<PairPoint> {
        let rigid_body = |at: SegmentRef| {
            let entry = self.entries.get(encounters[at.body].handle.0)?;
            entry.ragdoll.bodies.get(at.segment).copied()
        };
        let (Some(a), Some(b)) = (rigid_body(pair.a), rigid_body(pair.b)) else { return Vec::new() };
        let (Some(x), Some(y)) = (rigid.get(&pair.a.body), rigid.get(&pair.b.body)) else { return Vec::new() };
        let Some(overlap) = self.overlap(encounters, pair, x, y, 0.0) else { return Vec::new() };
        let point = |position: Vec3, depth: f32| PairPoint { bodies: [a, b], position, normal: pair.normal, depth };
        let first = overlap.a.iter().map(|p| point(p.position + pair.normal * (0.5 * p.depth), p.depth));
        let second = overlap.b.iter().map(|p| point(p.position - pair.normal * (0.5 * p.depth), p.depth));
        let all: Vec<PairPoint> = first.chain(second).collect();
        let stride = all.len().div_ceil(MOST_POINTS).max(1);
        all.into_iter().step_by(stride).collect()
    }

    /// Puts an interface between each two skins that overlap, or are about to: a part for each of them. Where there is one in this step,
    /// it stays where it is, and is widened to where the skins overlap now. True for the bodies whose skins overlap others.
    pub(super) fn part_skins(
        &self,
        encounters: &mut [Encounter],
        pairs: &[SegmentPair],
        parted: &mut Parted,
    ) -> Vec<bool> {
        let mut touched = vec![false; encounters.len()];
        for (pair, overlap) in self.skin_overlaps(encounters, pairs, NEARING) {
            let size = self.smaller_size(encounters, &pair);
            if overlap.depth() > TOLERANCE * size {
                (touched[pair.a.body], touched[pair.b.body]) = (true, true);
            }
            let presence = (1.0 + overlap.closeness() / (NEARING * size)).clamp(0.0, 1.0);
            let names = [interface_name(encounters, pair.a, pair.b), interface_name(encounters, pair.b, pair.a)];
            let share = self.share(encounters, &pair);
            let skins = self.skins_of(encounters, &pair);
            let Some(found) = Interface::of(&overlap, skins, pair.normal, pair.along, share) else { continue };
            let moved = [pair.b, pair.a].map(|other| encounters[other.body].motion_of(other.segment));
            let known = parted.get(&(pair.a, pair.b));
            let [first_found, interface] = match known {
                Some([first, known]) if overlap.depth() > TOLERANCE * size => [*first, known.reaching(&found)],
                Some(known) => *known,
                None => {
                    let wider = self.widenings.get(&[pair.a, pair.b].map(|at| name_of(encounters, at)));
                    [found, wider.map_or(found, |wider| found.grown(wider, LASTS))]
                }
            };
            for (side, at) in [pair.a, pair.b].into_iter().enumerate() {
                let first = side == 0;
                let yields = if first { share } else { 1.0 - share };
                let Some(body) = self.body_at(encounters, at.body).filter(|_| yields > 0.0) else { continue };
                let margin = MARGIN * body.skins()[at.segment].size;
                let Ok(mut part) = interface_part(&interface, first, margin, names[side]) else { continue };
                part.presence = presence;
                part.moved = moved[side];
                let encounter = &mut encounters[at.body];
                if let Some(old) = encounter.parts.iter_mut().find(|old| old.id == part.id) {
                    part.presence = presence.max(old.presence);
                    *old = part;
                    continue;
                }
                let normal = if first { pair.normal } else { -pair.normal };
                let (part_index, axis_point) = (encounter.parts.len(), pair.axis_points[side]);
                encounter.near.push(Proximity {
                    segment: at.segment as u16,
                    part: part_index,
                    normal,
                    axis_point,
                    leads: false,
                });
                encounter.parts.push(part);
            }
            parted.insert((pair.a, pair.b), [first_found, interface]);
        }
        touched
    }

    /// What interfaces were widened by serves in the next step from the beginning: else it would depend on a bulge that comes and goes how
    /// far skins are pushed.
    pub(super) fn remember_widenings(&mut self, encounters: &[Encounter], parted: &Parted) {
        let widening = |((a, b), [first, last]): (&(SegmentRef, SegmentRef), &[Interface; 2])| {
            let widening = last.beyond(first);
            let any = widening.as_flattened().as_flattened().iter().any(|end| *end > 0.0);
            any.then(|| ([*a, *b].map(|at| name_of(encounters, at)), widening))
        };
        self.widenings = parted.iter().filter_map(widening).collect();
    }

    /// The two skins of a pair; none where they belong to one body.
    fn skins_of(&self, encounters: &[Encounter], pair: &SegmentPair) -> Option<[SkinSide<'_>; 2]> {
        let (a, b) = (self.body_at(encounters, pair.a.body)?, self.body_at(encounters, pair.b.body)?);
        let whole =
            [SkinSide::whole(a, pair.a.segment, a.positions()), SkinSide::whole(b, pair.b.segment, b.positions())];
        (pair.a.body != pair.b.body).then_some(whole)
    }

    /// Notes how deep skins are still in each other.
    pub(super) fn measure_pairs(&self, encounters: &mut [Encounter], pairs: &[SegmentPair]) {
        for (pair, overlap) in self.skin_overlaps(encounters, pairs, -TOLERANCE) {
            for at in [pair.a, pair.b] {
                let depth = &mut encounters[at.body].pair_depth;
                *depth = depth.max(overlap.depth());
            }
        }
    }

    /// The overlaps of the skins as they are now, and skins that are nearer to each other than `within` (a part of the smaller
    /// body's size; below 0 for overlaps deeper than that), but for those of two bodies at rest.
    fn skin_overlaps(
        &self,
        encounters: &[Encounter],
        pairs: &[SegmentPair],
        within: f32,
    ) -> Vec<(SegmentPair, Overlap)> {
        let find = |pair: &SegmentPair| {
            let moves = |at: SegmentRef| encounters[at.body].is_active();
            if !moves(pair.a) && !moves(pair.b) {
                return None;
            }
            let (a, b) = (self.body_at(encounters, pair.a.body)?, self.body_at(encounters, pair.b.body)?);
            let within = if pair.a.body == pair.b.body { within.min(OWN_NEARING) } else { within };
            let margin = within * self.smaller_size(encounters, pair);
            let overlap = self.overlap(encounters, pair, a.positions(), b.positions(), margin.max(0.0))?;
            (overlap.closeness() > -margin).then_some((*pair, overlap))
        };
        pairs.par_iter().map(find).collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// The size of the smaller body of a pair, in metres.
    fn smaller_size(&self, encounters: &[Encounter], pair: &SegmentPair) -> f32 {
        let size = |at: SegmentRef| self.entries.get(encounters[at.body].handle.0).map_or(0.0, |entry| entry.size);
        size(pair.a).min(size(pair.b))
    }

    fn overlap(
        &self,
        encounters: &[Encounter],
        pair: &SegmentPair,
        x: &[Vec3],
        y: &[Vec3],
        margin: f32,
    ) -> Option<Overlap> {
        let (a, b) = (self.body_at(encounters, pair.a.body)?, self.body_at(encounters, pair.b.body)?);
        let side = match pair.a.body == pair.b.body {
            true => SkinSide::inner,
            false => SkinSide::whole,
        };
        let (first, second) = (side(a, pair.a.segment, x), side(b, pair.b.segment, y));
        Some(Overlap::within(first, second, pair.normal, pair.along.unwrap_or(Vec3::ZERO), margin))
    }

    /// The part of an overlap by which the first skin yields: its compliance over that of both.
    fn share(&self, encounters: &[Encounter], pair: &SegmentPair) -> f32 {
        let compliance = |at: SegmentRef| {
            let enabled = self.body_at(encounters, at.body).is_some_and(|body| body.settings.enabled);
            if enabled { 1.0 / encounters[at.body].stiffness.max(f32::MIN_POSITIVE) } else { 0.0 }
        };
        let (a, b) = (compliance(pair.a), compliance(pair.b));
        let share = a / (a + b);
        if share.is_finite() { share } else { 0.5 }
    }

    fn body_at(&self, encounters: &[Encounter], index: usize) -> Option<&ElasticBody> {
        self.entries.get(encounters[index].handle.0).map(|entry| &entry.body)
    }
}
