//! One step, stage by stage, in order.

use std::collections::BTreeMap;
use std::time::Instant;

use rapier3d::dynamics::RigidBodySet;
use rapier3d::geometry::ColliderHandle;
use rapier3d::parry::bounding_volume::Aabb;
use rapier3d::pipeline::QueryFilter;
use rayon::prelude::*;

use super::deformation_world::{DeformationWorld, ElasticBodyHandle, Entry, Settled};
use super::encounter::Encounter;
use super::report::{BodyReport, Frozen, StepReport};
use super::view::RapierView;
use crate::coupling::{
    CancelReport, CancelSettings, ElasticSide, ObstacleError, SegmentPair, TimeCoherence, cancel_further,
    cancel_with_memory, measure, obstacles_near, proximities, push_back, remember_leaders, remember_pair_contacts,
    remember_skin_contacts, skin_contacts,
};
use crate::math::{Pose, Vec3};

impl DeformationWorld {
    /// [`DeformationWorld::step`] for separate sets.
    pub fn step_with(&mut self, rapier: &mut RapierView<'_>) -> &StepReport {
        let mut report = StepReport::default();
        let mut encounters = self.read_parents(rapier.bodies);

        let clock = Instant::now();
        self.move_springs(&mut encounters, rapier.dt);
        report.times.springs = lap(clock);

        let clock = Instant::now();
        self.find_obstacles(&mut encounters, rapier, &mut report);
        self.find_resting(&mut encounters);
        report.times.contact = lap(clock);

        let clock = Instant::now();
        self.deform_by_springs(&encounters);
        report.times.deform = lap(clock);

        let clock = Instant::now();
        let pairs = self.find_pairs(&encounters);
        self.push_bodies_back(&mut encounters, &pairs, rapier);
        self.cancel_penetrations(&mut encounters, &pairs);
        report.times.contact += lap(clock);

        let clock = Instant::now();
        self.renew_normals(&encounters);
        report.times.deform += lap(clock);

        let clock = Instant::now();
        self.write_report(&mut encounters, &mut report);
        report.times.measure = lap(clock);
        self.report = report;
        &self.report
    }

    /// Where every segment is now; bodies whose parents vanished, are disabled or not finite are frozen.
    fn read_parents(&self, bodies: &RigidBodySet) -> Vec<Encounter> {
        let read = |(index, entry): (_, &Entry)| Encounter::new(ElasticBodyHandle(index), read_motions(entry, bodies));
        self.entries.iter().map(read).collect()
    }

    /// The mass-spring sets follow their anchors.
    fn move_springs(&mut self, encounters: &mut [Encounter], dt: f32) {
        for encounter in encounters.iter_mut().filter(|e| e.frozen.is_none()) {
            let Some(entry) = self.entries.get_mut(encounter.handle.0) else { continue };
            if !std::mem::replace(&mut entry.placed, true) {
                entry.body.place(&encounter.motions);
                continue;
            }
            // After a body was frozen nobody knows how it has come here.
            if entry.cancelled.knows_a_step() {
                encounter.motions_before = entry.body.motions().to_vec();
            }
            if !entry.body.move_springs(&encounter.motions, dt) {
                encounter.frozen = Some(Frozen::NotFinite);
            }
        }
    }

    /// The convex parts around each body, and the segments that are close to them.
    fn find_obstacles(&mut self, encounters: &mut [Encounter], rapier: &RapierView<'_>, report: &mut StepReport) {
        let query = rapier.broad_phase.as_query_pipeline(
            rapier.narrow_phase.query_dispatcher(),
            rapier.bodies,
            rapier.colliders,
            QueryFilter::default(),
        );
        let mut refused: BTreeMap<(u32, u32), (ColliderHandle, ObstacleError)> = BTreeMap::new();
        self.parts.retain(|handle| rapier.colliders.get(handle).is_some());
        for encounter in encounters.iter_mut().filter(|e| e.frozen.is_none()) {
            let Some(entry) = self.entries.get_mut(encounter.handle.0) else { continue };
            let own = |handle: rapier3d::dynamics::RigidBodyHandle| self.own.contains(&handle.into_raw_parts());
            encounter.region = region_of(entry);
            let region = &encounter.region;
            let thickness = self.settings.surface_thickness * entry.size;
            encounter.parts =
                obstacles_near(&query, region, thickness, entry.groups, &own, &mut self.parts, &mut refused);
            encounter.obstacles = encounter.parts.len();
            let margin = swing(entry);
            encounter.near = proximities(&entry.body, &encounter.parts, margin, &mut entry.memories);
        }
        report.refused = refused.into_values().collect();
    }

    /// Repelling impulses in proportion to the depth, all bodies together.
    fn push_bodies_back(&mut self, encounters: &mut [Encounter], pairs: &[SegmentPair], rapier: &mut RapierView<'_>) {
        let step = rapier.step_size();
        let mut contacts = Vec::new();
        for encounter in encounters.iter_mut().filter(|e| e.frozen.is_none()) {
            let Some(entry) = self.entries.get_mut(encounter.handle.0) else { continue };
            let (body, ragdoll, stiffness) = (&entry.body, &entry.ragdoll, self.settings.stiffness);
            let side = ElasticSide::of(encounter.handle.into_raw_parts(), body, ragdoll, stiffness, rapier.bodies);
            encounter.stiffness = side.material.stiffness;
            let found = skin_contacts(side, body, ragdoll, &encounter.parts, &encounter.near, rapier.colliders);
            contacts.extend(remember_skin_contacts(found, &mut entry.memories, &step, rapier.bodies));
        }
        let mut between = self.pair_foundation(encounters, pairs, rapier.bodies);
        remember_pair_contacts(&mut between, &mut self.approaches, &step, rapier.bodies);
        contacts.extend(between);
        push_back(&contacts, &step, self.settings.foundation, &mut self.foundation, rapier.bodies);
    }

    /// Local and global spring stages on every vertex.
    fn deform_by_springs(&mut self, encounters: &[Encounter]) {
        self.active(encounters).into_par_iter().for_each(|(entry, _)| {
            entry.body.build_palette();
            entry.body.deform_springs();
        });
    }

    /// The collision stage: what is left of the penetration vanishes from the visible surface.
    ///
    /// The first round pushes skins out of obstacles and out of each other; where that makes them bulge into each other
    /// anew, further rounds follow.
    fn cancel_penetrations(&mut self, encounters: &mut [Encounter], pairs: &[SegmentPair]) {
        if self.settings.measure {
            self.begin_coherence(encounters);
        }
        let mut pairs = pairs.to_vec();
        let mut parted = BTreeMap::new();
        for round in 0..=PAIR_ROUNDS {
            let touched = self.part_skins(encounters, &pairs, &mut parted);
            if round > 0 && !touched.contains(&true) {
                break;
            }
            let again: Vec<bool> = touched.iter().map(|touched| *touched || round == 0).collect();
            let settings = self.settings.cancel;
            let mut jobs = self.active_mut(encounters, &again);
            jobs.par_iter_mut().for_each(|(entry, encounter)| cancel_one(entry, encounter, &settings));
            pairs = self.find_pairs(encounters);
        }
        self.remember_widenings(encounters, &parted);
        self.remember_cancellations(encounters);
        if self.settings.measure {
            self.measure_pairs(encounters, &pairs);
            self.measure_coherence(encounters, &parted);
        }
    }

    /// What was done serves in the next step for bodies that lie still.
    fn remember_cancellations(&mut self, encounters: &mut [Encounter]) {
        let settings = self.settings.cancel;
        let entries = self.entries.iter_mut().map(|(_, entry)| entry);
        for (entry, encounter) in entries.zip(encounters).filter(|(_, encounter)| encounter.is_active()) {
            let before = std::mem::take(&mut encounter.before);
            entry.cancelled.remember(before, &entry.body, &encounter.parts, &encounter.cancelled, &settings);
        }
    }

    /// Normals of the skin as it is drawn.
    fn renew_normals(&mut self, encounters: &[Encounter]) {
        self.active(encounters).into_par_iter().for_each(|(entry, _)| entry.body.renew_normals());
    }

    /// The bodies that are deformed in this step.
    pub(super) fn active<'a>(&'a mut self, encounters: &'a [Encounter]) -> Vec<(&'a mut Entry, &'a Encounter)> {
        let entries = self.entries.iter_mut().map(|(_, entry)| entry);
        entries.zip(encounters).filter(|(_, encounter)| encounter.is_active()).collect()
    }

    /// Those of them for which `chosen` is true.
    fn active_mut<'a>(
        &'a mut self,
        encounters: &'a mut [Encounter],
        chosen: &[bool],
    ) -> Vec<(&'a mut Entry, &'a mut Encounter)> {
        let entries = self.entries.iter_mut().map(|(_, entry)| entry);
        let all = entries.zip(encounters).zip(chosen);
        all.filter(|((_, e), chosen)| **chosen && e.is_active()).map(|(job, _)| job).collect()
    }

    fn write_report(&mut self, encounters: &mut Vec<Encounter>, report: &mut StepReport) {
        for mut encounter in encounters.drain(..) {
            let Some(entry) = self.entries.get_mut(encounter.handle.0) else { continue };
            if let Some(figures) = encounter.settled {
                report.bodies.push((encounter.handle, figures));
                continue;
            }
            let mut figures = BodyReport {
                frozen: encounter.frozen,
                volume_ratio: 1.0,
                passes: encounter.cancelled.passes,
                steps: entry.body.palette().most_steps(),
                ..BodyReport::default()
            };
            if self.settings.measure && encounter.frozen.is_none() {
                let Encounter { parts, obstacles, cancelled, .. } = &mut encounter;
                // Contacts that lead out of another skin too are judged by the overlap of the skins.
                cancelled.contacts.retain(|contact| contact.points.iter().all(|point| point.part < *obstacles));
                figures.penetration = measure(&entry.body, &parts[..*obstacles], entry.size, cancelled);
                figures.penetration.coherence = encounter.coherence;
                figures.max_pair_depth = encounter.pair_depth / entry.size;
                let volume =
                    crate::mesh::measure::signed_volume(entry.body.positions(), &entry.body.rig().mesh.triangles);
                figures.volume_ratio = (volume / entry.rest_volume) as f32;
            } else {
                entry.coherence.forget();
            }
            if encounter.frozen.is_some() {
                entry.cancelled.forget();
            }
            report.bodies.push((encounter.handle, figures));
            // A skin that stays as it is does not change.
            figures.penetration.coherence = TimeCoherence::default();
            let settled = |circumstances| Settled { circumstances, report: figures };
            entry.last = encounter.circumstances.map(settled);
        }
    }
}

fn read_motions(entry: &Entry, bodies: &RigidBodySet) -> Result<Vec<Pose>, Frozen> {
    let rest = &entry.body.rig().rest_poses;
    let motion = |(handle, rest): (_, &Pose)| {
        let body = bodies.get(handle).ok_or(Frozen::ParentRemoved)?;
        if !body.is_enabled() {
            return Err(Frozen::ParentDisabled);
        }
        let motion = *body.position() * rest.inverse();
        if motion.is_finite() { Ok(motion) } else { Err(Frozen::NotFinite) }
    };
    entry.ragdoll.bodies.iter().copied().zip(rest).map(motion).collect()
}

/// Cancels what one body penetrates, in addition to what was cancelled before.
fn cancel_one(entry: &mut Entry, encounter: &mut Encounter, settings: &CancelSettings) {
    if entry.body.settings.enabled {
        let (parts, near, size) = (&encounter.parts, &encounter.near, entry.size);
        let first = encounter.before.is_empty();
        let report = if first {
            encounter.before = entry.body.positions().to_vec();
            cancel_with_memory(&entry.cancelled, &mut entry.body, parts, near, size, settings)
        } else {
            let earlier = (encounter.before.as_slice(), &encounter.cancelled);
            cancel_further(&entry.cancelled, earlier, &mut entry.body, parts, near, size, settings)
        };
        if first {
            encounter.cancelled.way = report.way;
        }
        if encounter.cancelled.contacts.is_empty() {
            remember_leaders(&report.contacts, &encounter.parts, &mut entry.memories);
        }
        encounter.cancelled.passes += report.passes;
        encounter.cancelled.left = report.left;
        encounter.cancelled.contacts = report.contacts;
        encounter.cancelled.gap = report.gap;
    }
    if !entry.body.is_finite() {
        // Whatever it was, it is not to be seen: the skin follows the rigid bodies, and the report says why.
        entry.body.place(&encounter.motions);
        entry.body.build_palette();
        entry.body.deform_springs();
        entry.body.renew_normals();
        encounter.cancelled = CancelReport::default();
        entry.cancelled.forget();
        encounter.frozen = Some(Frozen::NotFinite);
    }
}

/// Rounds in which skins that were pushed into each other by the first are pushed apart again.
const PAIR_ROUNDS: u32 = 3;

/// How far the skin may be carried beyond the rigid segments: by the springs, and by the cancellation out of one
/// obstacle towards the next.
fn swing(entry: &Entry) -> f32 {
    let springs = entry.body.sets().iter().map(|set| set.displacement().length()).fold(0.0, f32::max);
    springs + entry.body.drag_reach() + CANCELLED * entry.size
}

/// The farthest that the cancellation is expected to move the skin, as a fraction of the body's size.
const CANCELLED: f32 = 0.2;

/// Everything that the skin of a body may touch.
fn region_of(entry: &Entry) -> Aabb {
    let mut mins = Vec3::INFINITY;
    let mut maxs = Vec3::NEG_INFINITY;
    for (skin, motion) in entry.body.skins().iter().zip(entry.body.motions()) {
        let centre = motion.transform_point(skin.centroid);
        mins = mins.min(centre - skin.size);
        maxs = maxs.max(centre + skin.size);
    }
    let margin = swing(entry);
    Aabb::new(mins - margin, maxs + margin)
}

fn lap(clock: Instant) -> f32 {
    clock.elapsed().as_secs_f32() * 1.0e3
}
