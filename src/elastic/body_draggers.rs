//! Draggers of a body: taking hold, leading, letting go, and their stage in the palette.

use super::body::ElasticBody;
use super::drag_stage::{DragField, DragStage};
use super::dragger::{Dragger, DraggerError, DraggerHandle, DraggerStart, Grip};
use super::rig::SkinWeights;
use crate::math::Vec3;

/// All draggers of one body, in the order in which they took hold.
#[derive(Clone, Debug, Default)]
pub(super) struct Draggers {
    pub list: Vec<(DraggerHandle, Dragger)>,
    next: u64,
}

impl Draggers {
    fn get_mut(&mut self, handle: DraggerHandle) -> Option<&mut Dragger> {
        self.list.iter_mut().find(|(h, _)| *h == handle).map(|(_, dragger)| dragger)
    }
}

impl ElasticBody {
    /// Where a grip is in the world now, with all that deforms the skin but the collisions.
    pub fn grip_position(&self, grip: &Grip) -> Vec3 {
        let palette = self.palette();
        palette.drags.flow(palette.spring(grip.point, &grip.skin), &grip.skin, palette.integrator)
    }

    /// Takes hold of a point of the skin: from the next step on it is at its goal, as far as the certificate allows (see
    /// [`super::DeformSettings::max_steps`]), and the skin around it follows.
    ///
    /// # Errors
    /// [`DraggerError`] for a radius, spring, point or weights that are of no use.
    pub fn add_dragger(&mut self, start: DraggerStart) -> Result<DraggerHandle, DraggerError> {
        start.check(self.motions().len())?;
        let dragger = Dragger::new(start, self.motions(), self.palette());
        let handle = DraggerHandle(self.draggers.next);
        self.draggers.next += 1;
        self.draggers.list.push((handle, dragger));
        Ok(handle)
    }

    /// Leads a dragger to another goal in the world; one that was let go takes hold again. False, and nothing happens,
    /// where there is no such dragger (any more) or the goal is not finite.
    pub fn move_dragger(&mut self, handle: DraggerHandle, goal: Vec3) -> bool {
        match self.draggers.get_mut(handle) {
            Some(dragger) if goal.is_finite() => {
                dragger.lead(goal);
                true
            }
            _ => false,
        }
    }

    /// Lets go: the skin swings back from where it is, as fast as it was led, and the dragger vanishes when it is at rest.
    /// False where there is no such dragger.
    pub fn release_dragger(&mut self, handle: DraggerHandle) -> bool {
        let dragger = self.draggers.get_mut(handle);
        let found = dragger.is_some();
        if let Some(dragger) = dragger {
            dragger.let_go();
        }
        found
    }

    /// Removes a dragger at once, and with it all that it does to the skin. None where there is no such dragger.
    pub fn remove_dragger(&mut self, handle: DraggerHandle) -> Option<Dragger> {
        let place = self.draggers.list.iter().position(|(h, _)| *h == handle)?;
        Some(self.draggers.list.remove(place).1)
    }

    /// One dragger.
    pub fn dragger(&self, handle: DraggerHandle) -> Option<&Dragger> {
        self.draggers().find(|(h, _)| *h == handle).map(|(_, dragger)| dragger)
    }

    /// All draggers, those that swing back included, in the order in which they took hold.
    pub fn draggers(&self) -> impl Iterator<Item = (DraggerHandle, &Dragger)> {
        self.draggers.list.iter().map(|(handle, dragger)| (*handle, dragger))
    }

    /// The farthest that draggers carry the skin at present, in metres.
    pub fn drag_reach(&self) -> f32 {
        let reach = |drag: &DragField| drag.field.p.distance(drag.field.q);
        self.palette().drags.fields.iter().map(reach).sum()
    }

    /// The drag stage over the springs of the palette.
    pub(super) fn build_drags(&mut self) {
        let Self { draggers, palette, settings, .. } = self;
        palette.drags = DragStage::default();
        if !settings.enabled || draggers.list.is_empty() {
            return;
        }
        let mut fields: Vec<DragField> = Vec::with_capacity(draggers.list.len());
        let mut held: Vec<SkinWeights> = Vec::with_capacity(draggers.list.len());
        for (_, dragger) in &mut draggers.list {
            fields.push(dragger.field(palette));
            held.push(dragger.grip().skin);
        }
        palette.drags = DragStage::meeting(&fields, &held, palette.integrator, settings.max_steps);
        for ((_, dragger), drag) in draggers.list.iter_mut().zip(&fields) {
            let p = drag.field.p;
            dragger.show(p, palette.drags.flow(p, &dragger.grip().skin, palette.integrator));
        }
    }
}
