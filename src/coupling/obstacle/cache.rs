//! What has been taken apart, kept as long as it is of use.

use std::collections::HashMap;
use std::sync::Arc;

use rapier3d::geometry::{Collider, ColliderHandle};
use rapier3d::parry::bounding_volume::{Aabb, BoundingVolume};
use rapier3d::parry::shape::SharedShape;

use super::error::ObstacleError;
use super::local_part::LocalPart;
use super::source::PartSource;

/// Convex parts by collider, kept as long as a collider keeps its shape: a cache, and the stand-ins that colliders were
/// given.
#[derive(Default)]
pub struct PartCache {
    known: HashMap<ColliderHandle, Known>,
    stand_ins: HashMap<ColliderHandle, SharedShape>,
    /// Calls of [`PartCache::retain`].
    clock: u64,
}

struct Known {
    shape: SharedShape,
    source: Result<PartSource, ObstacleError>,
    /// Expanded cells, by thickness (a power of two) and cell.
    cells: HashMap<(i32, u64), Expanded>,
}

struct Expanded {
    parts: Arc<[(u32, LocalPart)]>,
    used: u64,
}

/// Cells that nobody asked for in so many steps are forgotten.
const FORGET_AFTER: u64 = 120;

/// The thicknesses that there are: powers of two with an exponent within this.
const MOST_EXPONENT: i32 = 60;

impl PartCache {
    /// The convex parts of a collider near `region` (in the world), each with its number, ascending by cell.
    ///
    /// Surfaces are at least `thickness` metres and less than twice as thick: thicknesses are rounded up to powers of
    /// two, so that bodies of about one size share the parts.
    ///
    /// # Errors
    /// The same [`ObstacleError`] each time for a collider that has none.
    pub fn parts_near(
        &mut self,
        handle: ColliderHandle,
        collider: &Collider,
        region: &Aabb,
        thickness: f32,
        found: &mut Vec<(u32, LocalPart)>,
    ) -> Result<(), ObstacleError> {
        let clock = self.clock;
        let known = self.known(handle, collider);
        let source = known.source.as_ref().map_err(Clone::clone)?;
        let exponent = (thickness.max(f32::MIN_POSITIVE).log2().ceil() as i32).clamp(-MOST_EXPONENT, MOST_EXPONENT);
        let thickness = 2.0_f32.powi(exponent);
        let local = region.transform_by(&collider.position().inverse());
        let mut cells = Vec::new();
        source.cells_near(&local, thickness, &mut cells);
        for cell in cells {
            let expand = || Expanded { parts: source.expand(cell, thickness).into(), used: clock };
            let expanded = known.cells.entry((exponent, cell)).or_insert_with(expand);
            expanded.used = clock;
            let near = |part: &LocalPart| {
                let pose = *collider.position() * part.pose;
                pose.is_finite() && part.shape.compute_aabb(&pose).intersects(region)
            };
            found.extend(expanded.parts.iter().filter(|(_, part)| near(part)).cloned());
        }
        Ok(())
    }

    /// Makes a collider ready, before a body meets it: a large triangle mesh takes a moment.
    ///
    /// # Errors
    /// [`ObstacleError`] for a collider that has no convex parts.
    pub fn prepare(&mut self, handle: ColliderHandle, collider: &Collider) -> Result<(), ObstacleError> {
        self.known(handle, collider).source.as_ref().map(drop).map_err(Clone::clone)
    }

    /// From now on the collider is taken for `shape`, in the same place, until it is removed; `None` undoes it.
    pub fn stand_in(&mut self, handle: ColliderHandle, shape: Option<SharedShape>) {
        match shape {
            Some(shape) => drop(self.stand_ins.insert(handle, shape)),
            None => drop(self.stand_ins.remove(&handle)),
        }
    }

    fn known(&mut self, handle: ColliderHandle, collider: &Collider) -> &mut Known {
        let shape = self.stand_ins.get(&handle).unwrap_or(collider.shared_shape());
        let fresh = || Known { shape: shape.clone(), source: PartSource::new(shape), cells: HashMap::new() };
        let known = self.known.entry(handle).or_insert_with(fresh);
        if !Arc::ptr_eq(&known.shape.0, &shape.0) {
            *known = fresh();
        }
        known
    }

    /// Forgets colliders that are gone, and parts that were not asked for lately. Called once a step.
    pub fn retain(&mut self, exists: impl Fn(ColliderHandle) -> bool) {
        self.known.retain(|&handle, _| exists(handle));
        self.stand_ins.retain(|&handle, _| exists(handle));
        self.clock += 1;
        if self.clock.is_multiple_of(FORGET_AFTER) {
            let oldest = self.clock.saturating_sub(FORGET_AFTER);
            for known in self.known.values_mut() {
                known.cells.retain(|_, expanded| expanded.used >= oldest);
            }
        }
    }

    /// How many expanded cells are kept now.
    pub fn kept_cells(&self) -> usize {
        self.known.values().map(|known| known.cells.len()).sum()
    }
}
