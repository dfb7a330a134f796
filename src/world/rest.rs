//! Bodies at rest: what has not changed is not deformed again.

use std::collections::BTreeSet;

use rapier3d::parry::partitioning::{Bvh, BvhBuildStrategy};

use super::deformation_world::{Circumstances, DeformationSettings, DeformationWorld, Entry};
use super::encounter::Encounter;

impl DeformationWorld {
    /// Finds the bodies whose skin stays as it is: their mass-spring sets are at rest, and they, the parts around them and
    /// the elastic bodies around them are as they were in the last step.
    pub(super) fn find_resting(&mut self, encounters: &mut [Encounter]) {
        let neighbours = neighbours(encounters);
        for (index, list) in neighbours.iter().enumerate() {
            let handles = list.iter().map(|&other| encounters[other].handle).collect();
            let encounter = &mut encounters[index];
            let Some(entry) = self.entries.get_mut(encounter.handle.0) else { continue };
            if encounter.frozen.is_none() && entry.body.settle_springs(SETTLED * entry.size) {
                let now = Circumstances { neighbours: handles, ..circumstances(entry, encounter, &self.settings) };
                let last = entry.last.as_ref().filter(|last| last.circumstances == now);
                encounter.settled = last.map(|last| last.report);
                encounter.circumstances = Some(now);
            }
        }
        wake_around(encounters, &neighbours);
    }
}

/// Whoever is near a body that moves may have to make room for it.
fn wake_around(encounters: &mut [Encounter], neighbours: &[BTreeSet<usize>]) {
    let mut moving: Vec<usize> = (0..encounters.len()).filter(|&i| encounters[i].settled.is_none()).collect();
    while let Some(index) = moving.pop() {
        for &other in &neighbours[index] {
            if encounters[other].settled.take().is_some() {
                moving.push(other);
            }
        }
    }
}

/// For each body those whose regions meet its own.
fn neighbours(encounters: &[Encounter]) -> Vec<BTreeSet<usize>> {
    let mut lists = vec![BTreeSet::new(); encounters.len()];
    let there: Vec<usize> = (0..encounters.len()).filter(|&i| encounters[i].frozen.is_none()).collect();
    let boxes: Vec<_> = there.iter().map(|&i| encounters[i].region).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    for (&index, region) in there.iter().zip(&boxes) {
        lists[index]
            .extend(tree.intersect_aabb(region).map(|leaf| there[leaf as usize]).filter(|&other| other != index));
    }
    lists
}

/// Everything that the deformation of a body with resting sets depends on, but for its neighbours.
fn circumstances(entry: &Entry, encounter: &Encounter, settings: &DeformationSettings) -> Circumstances {
    Circumstances {
        motions: encounter.motions.clone(),
        parts: encounter.parts.iter().map(|part| (part.id, part.placed.clone())).collect(),
        neighbours: Vec::new(),
        world: *settings,
        body: entry.body.settings,
    }
}

/// Sets that move less than this, as a fraction of the body's size, are at rest.
const SETTLED: f32 = 1.0e-4;
