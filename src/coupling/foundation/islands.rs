//! Islands: bodies that no contact joins are solved apart from each other, and side by side.
//!
//! Immovable bodies join nothing. Islands, and the contacts in them, keep the order in which the contacts were given, so
//! the result does not depend on the number of threads.

use std::collections::HashMap;

use rapier3d::dynamics::{RigidBodyHandle, RigidBodySet};
use rayon::prelude::*;

use super::reactions::Reactions;
use super::rebound::Rebound;
use super::share::materials;
use super::sleepers::Rest;
use super::solve::Island;
use super::velocities::{BodyVelocity, StepSize, Velocities, mean_of_substeps};
use super::{FoundationContact, FoundationMemory, FoundationSettings};
use crate::coupling::joined::Joined;

/// Gives the bodies the impulses that push them out over rapier's next step: changes their velocities in `bodies`.
///
/// `contacts` of bodies that do not exist are left out; the order decides over nothing but the last bits.
pub fn push_back(
    contacts: &[FoundationContact],
    step: &StepSize,
    settings: FoundationSettings,
    memory: &mut FoundationMemory,
    bodies: &mut RigidBodySet,
) {
    if step.dt <= 0.0 {
        return;
    }
    let materials = materials(contacts);
    let springs: Vec<_> = materials.iter().map(|material| material.sampled(step.dt)).collect();
    memory.sleepers.wake(contacts, &springs, step, bodies);
    let drift = mean_of_substeps(step.substeps.max(1));
    let mut velocities = Velocities::default();
    let mut joined = Joined::default();
    let mut places = Vec::with_capacity(contacts.len());
    for contact in contacts {
        places.push(place(contact, &memory.reactions, step, bodies, &mut velocities));
        joined.grow(velocities.entries.len());
        if let Some(places) = places.last().and_then(Option::as_ref) {
            let movable = |&index: &usize| velocities.entries[index].is_movable();
            let mut all = places.iter().flat_map(|&(a, b)| [Some(a), b]).flatten().filter(movable);
            if let Some(first) = all.next() {
                all.for_each(|other| joined.join(first, other));
            }
        }
    }
    let mut islands: Vec<(Island, HashMap<usize, usize>)> = Vec::new();
    let mut of_root: HashMap<usize, usize> = HashMap::new();
    for (index, contact) in contacts.iter().enumerate() {
        let Some(places) = &places[index] else { continue };
        let movable = |&index: &usize| velocities.entries[index].is_movable();
        let Some(body) = places.iter().flat_map(|&(a, b)| [Some(a), b]).flatten().find(movable) else { continue };
        let root = joined.root(body);
        let island = *of_root.entry(root).or_insert_with(|| {
            islands.push(Default::default());
            islands.len() - 1
        });
        let (island, local) = &mut islands[island];
        let mut local_place = |index: usize| {
            *local.entry(index).or_insert_with(|| {
                island.bodies.push(velocities.entries[index]);
                island.bodies.len() - 1
            })
        };
        let places: Vec<_> = places.iter().map(|&(a, b)| (local_place(a), b.map(&mut local_place))).collect();
        island.add(contact, &places, Rebound::new(contact, &materials[index], step, drift, bodies));
    }
    islands.par_iter_mut().for_each(|(island, _)| island.solve(settings.sweeps, step.dt));
    let solved = || islands.iter().flat_map(|(island, _)| &island.bodies);
    solved().for_each(|body| body.write(bodies));
    memory.reactions.note(solved());
}

/// The indices of the two bodies of each point; `None` where rapier leaves all of them asleep, or one is not there.
fn place(
    contact: &FoundationContact,
    reactions: &Reactions,
    step: &StepSize,
    bodies: &RigidBodySet,
    velocities: &mut Velocities,
) -> Option<Vec<(usize, Option<usize>)>> {
    let rest = |handle| Rest::of(handle, bodies);
    let pair = |point: &super::FoundationPoint| [Some(point.body), point.other].into_iter().flatten();
    if !contact.points.iter().flat_map(pair).any(|handle| rest(handle) == Rest::Moves) {
        return None;
    }
    let mut index = |handle: RigidBodyHandle| {
        velocities.index(handle, || {
            let support = reactions.support(handle, step, bodies);
            BodyVelocity::read(handle, rest(handle) == Rest::Asleep, support, step, bodies)
        })
    };
    contact
        .points
        .iter()
        .map(|point| {
            let a = index(point.body)?;
            Some((a, point.other.and_then(&mut index)))
        })
        .collect()
}
