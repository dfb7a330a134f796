//! Bodies that are apart stay apart, whatever the contacts left undone.
//!
//! Two things that are near each other are parted by a plane across the way between their nearest points. If no vertex of
//! either side crosses a plane between them that goes along, they cannot meet. Each side gets of the distance in proportion to
//! how far it comes. Vertices move along straight lines in a step, so that nothing happens between its ends. A way that goes
//! too far is first turned along the plane, which lets it part from others but may lead it across another plane; what is left
//! after some rounds of that is shortened, which is safe for all planes at once. (Chen et al., *Offset Geometric Contact*, 2025,
//! shorten ways by spheres in place of planes.)
//!
//! Ways are those beside the common motion of all bodies that may meet. What this takes of their momentum is given back to all of
//! them, unless fixed bodies hold them: then the common motion is theirs.

use glam::DVec3;
use rayon::prelude::*;

use super::near::Near;
use crate::math::Vec3;

/// How often ways are turned along planes.
const TURNS: usize = 12;
/// How often ways are shortened with regard to the other side's going away; then nothing counts on that any more.
const SHORTENINGS: usize = 6;

/// Rounds at most; what is left then is a matter of the last digits.
const MOST_ROUNDS: usize = 64;

/// Pairs of bodies that are looked at by one thread at a time, at least.
const CHUNK: usize = 16;

/// The vertices of all bodies that may meet.
pub struct Ways<'a> {
    /// Their velocities in m/s, which are changed.
    pub velocities: &'a mut [Vec3],
    /// One over their masses.
    pub inverse_masses: &'a [f32],
    /// The frame of each.
    pub frames: &'a [u32],
    /// The velocity of each frame, and whether fixed bodies hold it.
    pub common: &'a [(Vec3, bool)],
    /// The length of the step in seconds.
    pub h: f32,
}

/// Changes the ways of vertices so that nothing that is near crosses; there is a list for each pair of bodies. The vertices that were
/// held back, ascending.
pub fn hold_apart(near: &[Vec<Near>], ways: &mut Ways<'_>) -> Vec<u32> {
    let h = ways.h;
    let along = ways.velocities.iter().zip(ways.frames);
    let mut to: Vec<Vec3> = along.map(|(v, &frame)| (*v - ways.common[frame as usize].0) * h).collect();
    let crosses = |near: &&Near| near.is_crossed(&to, true);
    let mut crossing: Vec<&Near> =
        near.par_iter().with_min_len(CHUNK).flat_map_iter(|pair| pair.iter().filter(crosses)).collect();
    if crossing.is_empty() {
        return Vec::new();
    }
    let mut changed = vec![false; to.len()];
    for round in 0.. {
        // The last rounds end: with nothing that counts on another's going away, to shorten a way brings nothing else nearer.
        let signed = round < TURNS + SHORTENINGS;
        for near in crossing {
            near.vertices.iter().for_each(|&v| changed[v as usize] = true);
            if round < TURNS {
                near.turn(&mut to);
            } else {
                near.shorten(&mut to, signed);
            }
        }
        let next = round + 1 < TURNS + SHORTENINGS;
        let concerned = |near: &&Near| near.vertices.iter().any(|&v| changed[v as usize]);
        crossing = near.iter().flatten().filter(|near| concerned(near) && near.is_crossed(&to, next)).collect();
        if crossing.is_empty() || round > MOST_ROUNDS {
            break;
        }
    }
    let mut lost = vec![(DVec3::ZERO, 0.0f64); ways.common.len()];
    let mut held = Vec::new();
    for (k, &changed) in changed.iter().enumerate() {
        let frame = ways.frames[k] as usize;
        let mass = 1.0 / f64::from(ways.inverse_masses[k]);
        lost[frame].1 += mass;
        let velocity = ways.common[frame].0 + to[k] / h;
        if changed && velocity != ways.velocities[k] {
            held.push(k as u32);
            lost[frame].0 += (ways.velocities[k] - velocity).as_dvec3() * mass;
            ways.velocities[k] = velocity;
        }
    }
    let back: Vec<Vec3> = lost
        .iter()
        .zip(ways.common)
        .map(|((momentum, mass), (_, fixed))| if *fixed { Vec3::ZERO } else { (*momentum / *mass).as_vec3() })
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
        a + b > self.room
    }

    /// How far each side may come, for ways that lead too near; nothing for those that do not.
    fn limits(&self, ways: &[Vec3], signed: bool) -> Option<[f32; 2]> {
        let [a, b] = self.comes(ways, signed);
        let all = self.room;
        // A side that goes away gives the other its way.
        let limits = match (a > 0.0, b > 0.0) {
            (true, true) => [all * a / (a + b), all * b / (a + b)],
            (true, false) => [all - b, 0.0],
            (false, true) => [0.0, all - a],
            (false, false) => return None,
        };
        (a + b > all).then_some(limits.map(|limit| limit * (1.0 - ROUNDING)))
    }

    /// How far each vertex comes, and how far it may.
    fn excesses(&self, ways: &[Vec3], limits: [f32; 2]) -> [(usize, f32, f32); 4] {
        std::array::from_fn(|k| {
            let v = self.vertices[k] as usize;
            let second = k >= self.first;
            let along = ways[v].dot(self.normal);
            (v, if second { along } else { -along }, limits[usize::from(second)] + self.behind[k])
        })
    }

    /// Turns the ways of its vertices along the plane between its sides where they lead too near.
    fn turn(&self, ways: &mut [Vec3]) {
        let Some(limits) = self.limits(ways, true) else { return };
        for (k, (v, comes, most)) in self.excesses(ways, limits).into_iter().enumerate() {
            if comes > most {
                let back = self.normal * (comes - most);
                ways[v] += if k >= self.first { -back } else { back };
            }
        }
    }

    /// Shortens the ways of its vertices where they lead too near.
    fn shorten(&self, ways: &mut [Vec3], signed: bool) {
        let Some(limits) = self.limits(ways, signed) else { return };
        for (v, comes, most) in self.excesses(ways, limits) {
            if comes > most && comes > 0.0 {
                ways[v] *= (most / comes).max(0.0);
            }
        }
    }
}

/// A way is shortened a little more than it must be.
const ROUNDING: f32 = 1e-4;
