//! Cells that stay right side out.
//!
//! Goals know nothing of cells: where a thin part bends quickly, or lies on the ground while what is above it goes on down, a
//! cell passes through flatness, and matching takes its time to turn it back. Here a cell that would have less than a part of
//! its volume at the end of the step is projected onto that part, as in [`super::volume`]. It is an inequality, a contact of a
//! corner with the face across from it: all other cells are left alone, and nothing is kept of what it did. Its pushes on the
//! four corners add up to nothing.
//!
//! Contacts come after the body has chosen its velocities, and may press a cell flat again. To take the vertices that were
//! held in the last step for immovable was tried: the others are then thrown off the ground, or pressed through the next cell.

use glam::Mat3;
use wide::f32x4;

use super::regions::Regions;
use super::volume::{Cells, cross, dot, volume_gradients};

/// Sweeps over the cells at most.
const MOST_SWEEPS: u32 = 8;
/// A cell may end a step below its least volume by this part of it.
const NEAR: f32 = 0.01;
/// The part of its way back that a cell that is below already goes in a step: more would throw the body apart.
const BACK: f32 = 0.2;

/// Where the vertices of a body go in a step, in the order of its regions.
pub(super) struct Ahead<'a> {
    /// Where they are.
    pub now: &'a [f32x4],
    /// Where they are about to be.
    pub ahead: &'a mut [f32x4],
    /// How far they are pushed.
    pub pushes: &'a mut [f32x4],
    /// The inverse masses.
    pub inverse_mass: &'a [f32],
}

impl Cells {
    /// Pushes the vertices so that no cell ends below the part `least` of its volume, times the determinant of its deformation
    /// `local` where that is below 1. False if there is nothing to push.
    pub fn hold_open(&self, regions: &Regions, local: &[Mat3], least: f32, way: &mut Ahead<'_>) -> bool {
        let mut pushed = false;
        for _ in 0..MOST_SWEEPS {
            let mut open = true;
            for (c, (corners, &rest)) in self.corners.iter().zip(&self.rest).enumerate() {
                if volume(corners, way.ahead) >= rest * least * (1.0 - NEAR) {
                    continue;
                }
                let floor = rest * least * self.shrinking(c, regions, local).min(1.0);
                let now = volume(corners, way.now);
                let wanted = if now < floor { now + (floor - now) * BACK } else { floor };
                open &= !way.push(corners, wanted, rest.cbrt(), floor * NEAR);
            }
            if open {
                break;
            }
            pushed = true;
        }
        pushed
    }
}

impl Ahead<'_> {
    /// Pushes the corners of one cell until it has the volume `wanted`, none farther than `farthest`. False if it is nearly there.
    fn push(&mut self, corners: &[u32; 4], wanted: f32, farthest: f32, near: f32) -> bool {
        let at = corners.map(|v| v as usize);
        let (volume, gradients) = volume_gradients(at.map(|v| self.ahead[v]));
        let missing = wanted - volume;
        if missing.is_nan() || missing <= near {
            return false;
        }
        let weights = at.map(|v| self.inverse_mass[v]);
        let total: f32 = gradients.iter().zip(weights).map(|(g, w)| w * dot(*g, *g)).sum();
        let step = missing / total;
        let longest = gradients.iter().zip(weights).map(|(g, w)| w * dot(*g, *g).sqrt()).fold(0.0, f32::max) * step;
        // All corners in one line.
        if !(longest > 0.0 && longest.is_finite()) {
            return false;
        }
        let step = step * (farthest / longest).min(1.0);
        for ((v, g), w) in at.into_iter().zip(gradients).zip(weights) {
            let push = g * f32x4::splat(step * w);
            self.pushes[v] += push;
            self.ahead[v] += push;
        }
        true
    }
}

/// Six times the volume of a cell.
#[inline]
fn volume(corners: &[u32; 4], x: &[f32x4]) -> f32 {
    let [p, q, r, s] = corners.map(|v| x[v as usize]);
    dot(q - p, cross(r - p, s - p))
}
