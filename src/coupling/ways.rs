//! The ways to cancel that are tried one after the other, and how their outcomes are compared.
//!
//! Where the usual way leaves something over, folds the skin, or changes it more than the body moves, first the passes of the
//! step before are tried once more ([`continued`](super::continued)), then softer fields, and triangles that are looked at from the first pass on.

use std::collections::VecDeque;

use super::attempt::{Begun, attempt};
use super::cancel::{CancelReport, CancelSettings, WORTH_CLOSING, softness_of};
use super::cancel_memory::CancelMemory;
use super::contact::Proximity;
use super::folds::count_folds;
use super::obstacle::ObstaclePart;
use super::strength::Way;
use crate::elastic::{CollisionState, ElasticBody};
use crate::math::Vec3;

/// Tries ways until one is good, and takes the best. `earlier` is the skin before any cancellation of this step, and what was done
/// since, where there was any.
pub(super) fn best_of_ways(
    memory: &CancelMemory,
    earlier: Option<(&[Vec3], &CancelReport)>,
    body: &mut ElasticBody,
    (parts, near): (&[ObstaclePart], &[Proximity]),
    size: f32,
    settings: &CancelSettings,
) -> CancelReport {
    let start = body.collision_state();
    let before = earlier.map_or(start.positions(), |(before, _)| before);
    let mut best: Option<(Grade, CancelReport, CollisionState)> = None;
    let first = settings.first_way.min(WAYS.len() - 1);
    let mut courses = VecDeque::from([Course::Anew(first)]);
    while let Some(course) = courses.pop_front() {
        let number = course.way(first);
        let kind = &WAYS[number];
        let way = Way { softness: softness_of(body, settings) * kind.softer, stride: STRIDE, tips: kind.tips };
        let outcome = match course {
            Course::Anew(_) => {
                let earlier = earlier.map_or(Vec::new(), |(_, report)| report.contacts.clone());
                Some(attempt(body, parts, near, way, size, settings, Begun::Anew { earlier }))
            }
            Course::Continued(keep) => memory.continued(keep, body, (parts, near), way, size, settings),
        };
        if let Some(mut report) = outcome {
            // Without passes all ways are the same.
            if report.passes == 0 && (report.left <= 0.0 || settings.max_passes == 0) {
                return report;
            }
            report.way = number;
            let pop = memory.pop(body, before, parts, &report.contacts, size, settings);
            let grade = Grade::of(&report, pop, body, &start, size, settings);
            let good = grade.open <= 0.0 && grade.folds == 0;
            if best.is_none() {
                courses.extend(other_courses(first, pop, earlier.is_none()));
            }
            if best.as_ref().is_none_or(|(least, ..)| grade < *least) {
                best = Some((grade, report, body.collision_state()));
            }
            let fine = best.as_ref().is_some_and(|(least, ..)| least.open <= 0.0);
            if good || fine && kind.softer > 1.0 {
                break;
            }
        }
        body.resume(&start);
    }
    let Some((_, report, state)) = best else { return CancelReport::default() };
    body.resume(&state);
    report
}

/// Where the passes come from.
#[derive(Clone, Copy, Debug)]
enum Course {
    /// All of them are chosen anew, in one of the [`WAYS`].
    Anew(usize),
    /// So much of the passes of the step before, and what they leave over.
    Continued(f32),
}

impl Course {
    /// The way in which passes are chosen, `first` where the course does not say.
    fn way(self, first: usize) -> usize {
        match self {
            Self::Anew(way) => way,
            Self::Continued(_) => first,
        }
    }
}

/// The courses that are tried, in this order, where passes in the `first` way are not good; they changed the skin by `pop`
/// times what it has moved.
fn other_courses(first: usize, pop: f32, may_continue: bool) -> impl Iterator<Item = Course> {
    // Where the skin would pop it goes as far towards its new shape as is calm, or else not at all.
    let keeps = if pop > CALM { [1.0 - GOES * CALM / pop, 1.0] } else { [1.0, MOST] };
    let continued = keeps.into_iter().filter(move |_| may_continue).map(Course::Continued);
    continued.chain((0..WAYS.len()).filter(move |&way| way != first).map(Course::Anew))
}

/// The part of the way to the new shape that is gone in a step where all of it would be a pop, as a part of what is calm.
const GOES: f32 = 0.6;

/// How much of the passes of the step before is kept where they are tried for their shape only.
const MOST: f32 = 0.8;

/// A way to choose passes.
struct Kind {
    /// How many times softer than the rig says.
    softer: f32,
    /// Triangles that are pierced are looked at from the first pass on.
    tips: bool,
}

/// In the order in which they are tried.
const WAYS: [Kind; 6] = [
    Kind { softer: 1.0, tips: false },
    Kind { softer: 1.6, tips: false },
    Kind { softer: 2.5, tips: false },
    Kind { softer: 1.0, tips: true },
    Kind { softer: 1.6, tips: true },
    Kind { softer: 2.5, tips: true },
];

/// The way that is gone in one pass where contacts push against each other, in sizes of the body.
const STRIDE: f32 = 0.12;

/// What is wrong with the outcome of a way; of two, the lower is the better one. What comes first counts first.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Grade {
    /// How many times the tolerance a depth or a gap is, or in the same proportion to its limit the change of the skin since the step before; 0 where
    /// nothing is worth another way.
    open: f32,
    /// Triangles turned over.
    folds: u32,
    /// Passes.
    passes: u32,
}

impl Grade {
    fn of(
        report: &CancelReport,
        pop: f32,
        body: &ElasticBody,
        start: &CollisionState,
        size: f32,
        settings: &CancelSettings,
    ) -> Self {
        let depth = report.left / (settings.depth_tolerance * size);
        let gap = report.gap / (settings.gap_tolerance * size);
        let open = depth.max(gap).max(pop * WORTH_CLOSING / CALM);
        Self {
            open: if open <= WORTH_CLOSING { 0.0 } else { open },
            folds: count_folds(body, start.positions(), size, TURNED),
            passes: report.passes,
        }
    }
}

/// Cosine of the angle by which a triangle has turned that is looked at for a fold.
const TURNED: f32 = 0.0;

/// A time coherence up to this one is calm: a little below [`SMOOTH`](super::SMOOTH), since what is measured later knows more of what the skin touches.
const CALM: f32 = 7.5;
