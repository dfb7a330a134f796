//! Fields and matching alone: charts, local transformations and where every vertex should go.

use std::sync::Arc;
use std::time::Instant;

use anyhow::Result;
use pliant::math::{Mat3, Pose, Vec3};
use pliant::procdef::{Motion, ProcDefBody, ProcDefModel, Stiffness};
use rayon::prelude::*;
use serde::Serialize;

use super::crowd::clock;
use super::rows::Row;

/// Steps that are measured.
const STEPS: usize = 400;

/// Milliseconds a step of all bodies together, each the median of many steps.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MatchingTimes {
    /// Charts and local transformations, on one core.
    pub fields: f64,
    /// Matching, on one core.
    pub matching: f64,
    /// Both together, on one core.
    pub one_core: f64,
    /// Both together, on all threads of the pool.
    pub all_cores: f64,
    /// One pass of matching, on one core, of bodies in the same places.
    pub one_pass: f64,
    /// One pass and the global solve at [`STIFF`], on one core, of bodies in the same places.
    pub solve: f64,
}

/// A stiffness at which a bar swings no slower than with 64 passes of matching at 60 steps a second (the tests compare them). What
/// the solve costs does not depend on it.
pub const STIFF: f32 = 0.8;

struct Moving {
    motion: Motion,
    body: ProcDefBody,
    local: Vec<Mat3>,
    /// In the same places, with one pass, and with the global solve.
    others: [ProcDefBody; 2],
}

/// Measures bodies that are stepped alone, without rapier; they move, so that their rotations do.
pub fn measure(row: &Row, model: &Arc<ProcDefModel>, dt: f32, pool: &rayon::ThreadPool) -> Result<MatchingTimes> {
    let new = |i: usize| {
        let mut body = ProcDefBody::new(model.rig.clone(), &Pose::IDENTITY);
        body.settings = model.settings;
        let others = [Stiffness::Iterations(1), Stiffness::Solve(STIFF)].map(|stiffness| {
            let mut other = body.clone();
            other.settings.stiffness = stiffness;
            other
        });
        Moving { others, motion: Motion::at(clock(i)), body, local: Vec::new() }
    };
    let mut bodies: Vec<Moving> = (0..row.bodies as usize).map(new).collect();
    let rig = &model.motion;
    let mut times: [Vec<f64>; 6] = Default::default();
    for _ in 0..STEPS {
        let start = Instant::now();
        bodies.iter_mut().for_each(|m| m.motion.transforms_into(rig, &mut m.local));
        let fields = start.elapsed();
        for m in &mut bodies {
            m.body.pulls(&m.local, dt);
        }
        let both = start.elapsed();
        let all = pool.install(|| {
            let start = Instant::now();
            bodies.par_iter_mut().for_each(|m| {
                m.motion.transforms_into(rig, &mut m.local);
                m.body.pulls(&m.local, dt);
            });
            start.elapsed()
        });
        let [one_pass, solve] = [0, 1].map(|other| {
            for m in &mut bodies {
                m.others[other].positions_mut().copy_from_slice(m.body.positions());
            }
            let start = Instant::now();
            for m in &mut bodies {
                m.others[other].pulls(&m.local, dt);
            }
            start.elapsed()
        });
        for (list, time) in times.iter_mut().zip([fields, both - fields, both, all, one_pass, solve]) {
            list.push(time.as_secs_f64() * 1e3);
        }
        for m in &mut bodies {
            m.motion.advance(rig, dt);
            m.body.step(&m.local, dt, Vec3::ZERO, None);
        }
    }
    let [fields, matching, one_core, all_cores, one_pass, solve] = times.map(median);
    Ok(MatchingTimes { fields, matching, one_core, all_cores, one_pass, solve })
}

/// The middle one of some times; 0 where there are none.
pub fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or_default()
}
