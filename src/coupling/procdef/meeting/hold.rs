//! Bodies that are apart stay apart, whatever the contacts left undone.
//!
//! Two things that are near each other are parted by a plane across the way between their nearest points. If no vertex of
//! either side crosses a plane between them that goes along, they cannot meet: ways that would are shortened, for each side in
//! proportion to how far it comes (*divide and truncate*; Chen et al., *Offset Geometric Contact*, 2025, bound the ways by
//! spheres in place of planes). Vertices move along straight lines in a step, so that nothing happens between its ends.
//!
//! Ways are those beside the common motion of all bodies that may meet. What shortening takes of their momentum is given back
//! to all of them, unless something rigid holds them.

use glam::DVec3;
use rayon::prelude::*;

use super::near::Near;
use crate::math::Vec3;

/// The part of a distance that is never used up in one step.
const KEPT: f32 = 0.1;

/// How often ways are shortened that take account of the other side's going away; then nothing counts on that any more.
const ROUNDS: usize = 8;

/// Near things that are looked at by one thread at a time.
const CHUNK: usize = 2048;

/// The vertices of all bodies that may meet.
pub struct Ways<'a> {
    /// Their velocities in m/s, which are changed.
    pub velocities: &'a mut [Vec3],
    /// One over their masses.
    pub inverse_masses: &'a [f32],
    /// The frame of each.
    pub frames: &'a [u32],
    /// The velocity of each frame, and whether something rigid holds its bodies.
    pub common: &'a [(Vec3, bool)],
    /// The length of the step in seconds.
    pub h: f32,
}

/// Shortens the ways of vertices so that nothing that is near crosses. The vertices that were held back,
/// ascending.
pub fn hold_apart(near: &[Near], ways: &mut Ways<'_>) -> Vec<u32> {
    let h = ways.h;
    let along = ways.velocities.iter().zip(ways.frames);
    let mut to: Vec<Vec3> = along.map(|(v, &frame)| (*v - ways.common[frame as usize].0) * h).collect();
    let mut left: Vec<f32> = Vec::new();
    for round in 0..=ROUNDS {
        let signed = round < ROUNDS;
        let crossing: Vec<&Near> = near
            .par_chunks(CHUNK)
            .flat_map_iter(|chunk| chunk.iter().filter(|near| near.is_crossed(&to, signed)))
            .collect();
        if crossing.is_empty() {
            break;
        }
        left.resize(to.len(), 1.0);
        crossing.into_iter().for_each(|near| near.shorten(&mut to, &mut left, signed));
    }
    if left.is_empty() {
        return Vec::new();
    }
    let mut lost = vec![(DVec3::ZERO, 0.0f64); ways.common.len()];
    let mut held = Vec::new();
    for (k, &left) in left.iter().enumerate() {
        let frame = ways.frames[k] as usize;
        let mass = 1.0 / f64::from(ways.inverse_masses[k]);
        lost[frame].1 += mass;
        if left < 1.0 {
            held.push(k as u32);
            let shortened = ways.common[frame].0 + to[k] / h;
            lost[frame].0 += (ways.velocities[k] - shortened).as_dvec3() * mass;
            ways.velocities[k] = shortened;
        }
    }
    let back: Vec<Vec3> = lost
        .iter()
        .zip(ways.common)
        .map(|((momentum, mass), (_, rigid))| if *rigid { Vec3::ZERO } else { (*momentum / *mass).as_vec3() })
        .collect();
    ways.velocities.iter_mut().zip(ways.frames).for_each(|(v, &frame)| *v += back[frame as usize]);
    held
}

impl Near {
    /// How far each side comes; where that is not counted on, none goes away.
    fn comes(&self, ways: &[Vec3], signed: bool) -> [f32; 2] {
        let comes = self.approaches(ways);
        if signed { comes } else { comes.map(|c| c.max(0.0)) }
    }

    /// Whether its sides come too near.
    fn is_crossed(&self, ways: &[Vec3], signed: bool) -> bool {
        let [a, b] = self.comes(ways, signed);
        a + b > (1.0 - KEPT) * self.distance
    }

    /// Shortens the ways of its vertices until its sides do not come too near.
    fn shorten(&self, ways: &mut [Vec3], left: &mut [f32], signed: bool) {
        let [a, b] = self.comes(ways, signed);
        let all = (1.0 - KEPT) * self.distance;
        if a + b <= all {
            return;
        }
        // A side that goes away gives the other its way.
        let limits = match (a > 0.0, b > 0.0) {
            (true, true) => [all * a / (a + b), all * b / (a + b)],
            (true, false) => [all - b, 0.0],
            (false, true) => [0.0, all - a],
            (false, false) => return,
        };
        for (k, (&v, behind)) in self.vertices.iter().zip(self.behind).enumerate() {
            let second = k >= self.first;
            let along = ways[v as usize].dot(self.normal);
            let comes = if second { along } else { -along };
            let most = limits[usize::from(second)] * (1.0 - ROUNDING) + behind;
            if comes > most && comes > 0.0 {
                let part = (most / comes).max(0.0);
                ways[v as usize] *= part;
                left[v as usize] *= part;
            }
        }
    }
}

/// A way is shortened a little more than it must be.
const ROUNDING: f32 = 1e-4;
