//! Measuring how smoothly the cancellation changes from step to step.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;

use super::deformation_world::DeformationWorld;
use super::encounter::Encounter;
use super::meetings::Parted;
use crate::coupling::SkinsMet;

impl DeformationWorld {
    /// Remembers the skins before the cancellation.
    pub(super) fn begin_coherence(&mut self, encounters: &[Encounter]) {
        self.active(encounters).into_par_iter().for_each(|(entry, _)| entry.coherence.begin(&entry.body));
    }

    /// Compares the cancellation with that of the step before; `parted` are the skins that were pushed apart.
    pub(super) fn measure_coherence(&mut self, encounters: &mut [Encounter], parted: &Parted) {
        let raw = |encounter: &Encounter| encounter.handle.into_raw_parts();
        let motions: BTreeMap<_, _> =
            encounters.iter().map(|encounter| (raw(encounter), encounter.motions.clone())).collect();
        let motions = Arc::new(motions);
        let mut met: Vec<SkinsMet> =
            encounters.iter().map(|_| SkinsMet { motions: motions.clone(), ..SkinsMet::default() }).collect();
        for (a, b) in parted.keys() {
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
