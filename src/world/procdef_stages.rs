//! One step of the bodies that move by themselves, stage by stage, in order.

use std::time::Instant;

use rapier3d::data::arena::Index;
use rayon::prelude::*;

use super::procdef_report::{ProcDefBodyReport, ProcDefStepReport};
use super::procdef_view::ProcDefView;
use super::procdef_world::{ProcDefEntry, ProcDefHandle, ProcDefWorld};
use crate::coupling::procdef::{
    FeltContacts, GroundContact, WaterRegion, act_of_water, felt_impulses, ground_contacts, read_particles,
    write_velocities,
};
use crate::math::Vec3;
use crate::procdef::ContactKind;

/// What is found out about one body in a step.
pub(super) struct Visit {
    pub index: Index,
    pub report: ProcDefBodyReport,
    ground: Vec<GroundContact>,
}

impl ProcDefWorld {
    /// [`ProcDefWorld::step`] for separate sets.
    pub fn step_with(&mut self, rapier: &mut ProcDefView<'_>) -> &ProcDefStepReport {
        let mut report = ProcDefStepReport::default();
        let clock = Instant::now();
        let mut visits = self.read_bodies(rapier);
        report.times.exchange = milliseconds(clock);

        let clock = Instant::now();
        self.find_ground(&mut visits, rapier);
        self.feel_contacts(&mut visits, rapier.dt);
        report.times.contact = milliseconds(clock);

        let clock = Instant::now();
        self.drive_bodies(&visits, rapier.gravity, rapier.dt);
        report.times.drive = milliseconds(clock);

        let clock = Instant::now();
        report.refused = self.let_vertices_meet(&mut visits, rapier);
        report.times.contact += milliseconds(clock);

        let clock = Instant::now();
        self.write_bodies(&mut visits, rapier);
        report.times.exchange += milliseconds(clock);

        report.bodies = visits.into_iter().map(|visit| (ProcDefHandle(visit.index), visit.report)).collect();
        self.report = report;
        &self.report
    }

    /// The particles as rapier's step left them, and what it did to each beside gravity.
    fn read_bodies(&mut self, rapier: &ProcDefView<'_>) -> Vec<Visit> {
        let gravity_step = rapier.gravity * rapier.dt;
        let mut visits = Vec::with_capacity(self.entries.len());
        for (index, entry) in self.entries.iter_mut() {
            let soft = rapier.soft_bodies.get(entry.link.soft_body);
            let frozen = read_particles(soft, &mut entry.body).err();
            let known = frozen.is_none() && !entry.written.is_empty();
            entry.impulses.clear();
            if known {
                let (now, masses) = (entry.body.velocities(), entry.model.rig.masses());
                felt_impulses(masses, now, &entry.written, gravity_step, &mut entry.impulses);
            } else {
                entry.impulses.resize(entry.body.positions().len(), Vec3::ZERO);
            }
            let report = ProcDefBodyReport { frozen, ..ProcDefBodyReport::default() };
            visits.push(Visit { index, report, ground: Vec::new() });
        }
        visits
    }

    /// Which vertices stand on fixed bodies, where that matters.
    fn find_ground(&self, visits: &mut [Visit], rapier: &ProcDefView<'_>) {
        for visit in visits.iter_mut().filter(|visit| visit.report.frozen.is_none()) {
            let Some(entry) = self.entries.get(visit.index) else { continue };
            if entry.model.contacts == ContactKind::Vertices {
                visit.ground.clone_from(&entry.meeting.ground);
                visit.report.on_ground = visit.ground.len();
                continue;
            }
            let Some(soft) = rapier.soft_bodies.get(entry.link.soft_body) else { continue };
            if entry.trigger.is_some() || entry.directions.is_some() {
                let boundary = &entry.model.boundary;
                visit.ground = ground_contacts(soft, boundary, rapier.narrow_phase, rapier.colliders, rapier.bodies);
                visit.report.on_ground = visit.ground.len();
            }
        }
    }

    /// Contacts with what is not fixed are felt, and may be stimuli.
    fn feel_contacts(&mut self, visits: &mut [Visit], dt: f32) {
        for visit in visits.iter_mut().filter(|visit| visit.report.frozen.is_none()) {
            let Some(entry) = self.entries.get_mut(visit.index) else { continue };
            let Some(trigger) = &mut entry.trigger else { continue };
            let mut ignored = vec![false; entry.impulses.len()];
            entry.attached.iter().for_each(|&v| ignored[v as usize] = true);
            if entry.model.contacts == ContactKind::Surfaces {
                // Rapier does not tell how much of an impulse is the ground's.
                visit.ground.iter().for_each(|contact| ignored[contact.vertex as usize] = true);
            }
            entry.impulses.iter_mut().zip(&entry.meeting.felt).for_each(|(all, own)| *all += *own);
            let felt = FeltContacts::of(&entry.impulses, &ignored);
            visit.report.felt = felt.impulse;
            if trigger.step(felt.impulse, dt)
                && let Some(vertex) = felt.vertex
            {
                let place = entry.model.rig.mesh().positions[vertex as usize];
                visit.report.touched = entry.motion.touch(&entry.model.motion, place).then_some(place);
            }
        }
    }

    /// All bodies, each for itself and on all cores: time goes on, charts become local transformations, these become velocities,
    /// and water, ground and hands change them.
    fn drive_bodies(&mut self, visits: &[Visit], gravity: Vec3, dt: f32) {
        let water = &self.water;
        let entries: Vec<&mut ProcDefEntry> = self.entries.iter_mut().map(|(_, entry)| entry).collect();
        entries
            .into_par_iter()
            .zip(visits)
            .filter(|(_, visit)| visit.report.frozen.is_none())
            .for_each(|(entry, visit)| entry.drive(water, &visit.ground, gravity, dt));
    }

    /// The velocities that rapier's next step starts with. A body whose velocities are not finite is frozen.
    fn write_bodies(&mut self, visits: &mut [Visit], rapier: &mut ProcDefView<'_>) {
        for visit in visits {
            let Some(entry) = self.entries.get_mut(visit.index) else { continue };
            entry.written.clear();
            if visit.report.frozen.is_some() {
                continue;
            }
            if let Some(soft) = rapier.soft_bodies.get_mut(entry.link.soft_body) {
                write_velocities(&entry.body, soft);
                entry.written.extend_from_slice(entry.body.velocities());
            }
        }
    }
}

impl ProcDefEntry {
    /// Whether its cycle runs backwards.
    pub(super) fn is_turned(&self) -> bool {
        let speed = self.model.motion.cyclic().map_or(1.0, |cyclic| cyclic.speed);
        self.motion.pace * speed < 0.0
    }

    /// One body's share of the step.
    fn drive(&mut self, water: &[WaterRegion], ground: &[GroundContact], gravity: Vec3, dt: f32) {
        self.motion.advance(&self.model.motion, dt);
        self.motion.transforms_into(&self.model.motion, &mut self.local);
        self.body.drive(&self.local, dt);
        if !water.is_empty() {
            act_of_water(&self.model, water, gravity, dt, &mut self.body);
        }
        if let Some(directions) = self.directions.as_ref().filter(|_| self.model.contacts == ContactKind::Surfaces) {
            let turned = self.is_turned();
            directions.brake(&mut self.body, ground, &self.impulses, gravity * dt, turned);
        }
        if let Some(grip) = &self.grip {
            grip.pull(&mut self.body, dt);
        }
        self.body.hold_open(&self.local, dt);
    }
}

fn milliseconds(since: Instant) -> f32 {
    since.elapsed().as_secs_f32() * 1000.0
}
