//! Measuring how smoothly the cancellation changes from step to step.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;

use super::deformation_world::DeformationWorld;
use super::encounter::Encounter;
use super::meetings::{Parted, interface_name};
use crate::coupling::{SegmentRef, SkinsMet};

impl DeformationWorld {
    /// Remembers the skins before the cancellation.
    pub(super) fn begin_coherence(&mut self, encounters: &[Encounter]) {
        self.active(encounters).into_par_iter().for_each(|(entry, _)| entry.coherence.begin(&entry.body));
    }

    /// Compares the cancellation with that of the step before; `parted` are the skins that are near each other: of them
    /// those touch that were in the interface between them.
    pub(super) fn measure_coherence(&mut self, encounters: &mut [Encounter], parted: &Parted) {
        let raw = |encounter: &Encounter| encounter.handle.into_raw_parts();
        let motions: BTreeMap<_, _> =
            encounters.iter().map(|encounter| (raw(encounter), encounter.motions.clone())).collect();
        let motions = Arc::new(motions);
        let mut met: Vec<SkinsMet> =
            encounters.iter().map(|_| SkinsMet { motions: motions.clone(), ..SkinsMet::default() }).collect();
        for (a, b) in parted.keys() {
            if !in_interface(encounters, *a, *b) && !in_interface(encounters, *b, *a) {
                continue;
            }
            met[a.body].touched.insert((raw(&encounters[b.body]), b.segment));
            met[b.body].touched.insert((raw(&encounters[a.body]), a.segment));
        }
        let settings = self.settings.cancel;
        let entries = self.entries.iter_mut().map(|(_, entry)| entry);
        for ((entry, encounter), met) in entries.zip(encounters).zip(met).filter(|((_, e), _)| e.is_active()) {
            let parts = &encounter.parts[..encounter.obstacles];
            let (report, size) = (&encounter.cancelled, entry.size);
            encounter.coherence = entry.coherence.end(&entry.body, parts, met, report, size, &settings);
        }
    }
}

/// True where the first skin was in the interface between it and the second.
fn in_interface(encounters: &[Encounter], first: SegmentRef, second: SegmentRef) -> bool {
    let name = interface_name(encounters, first, second);
    let Encounter { parts, cancelled, .. } = &encounters[first.body];
    let points = || cancelled.contacts.iter().flat_map(|contact| &contact.points);
    let part = parts.iter().position(|part| part.id == name);
    part.is_some_and(|part| points().any(|point| point.part == part))
}
