//! The ways to cancel that are tried one after the other.
//!
//! Where the first way leaves something over, folds the skin, or changes it more than the body moves, first the passes of the
//! step before are tried once more ([`continued`](super::continued)), then softer fields, and triangles that are looked at from the first pass on.
//! Where the first way is good but takes many passes, they are tried [all at once](super::at_once).

use std::collections::VecDeque;

use super::at_once::at_once;
use super::attempt::{Begun, attempt};
use super::cancel::{CancelReport, CancelSettings, softness_of};
use super::cancel_memory::CancelMemory;
use super::contact::Proximity;
use super::grade::{CALM, Grade, MANY};
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
    let judge = |body: &ElasticBody, report: &CancelReport| {
        let pop = memory.pop(body, before, parts, &report.contacts, size, settings);
        (Grade::of(report, pop, body, &start, size, settings), pop)
    };
    let mut best: Option<Outcome> = None;
    let mut tried = 0;
    let first = known_way(settings.first_way);
    let mut courses = VecDeque::from([Course::Anew(first)]);
    while let Some(course) = courses.pop_front() {
        let number = course.way(first);
        let way = way_of(number, body, settings);
        let report = match course {
            Course::Anew(_) => {
                let earlier = earlier.map_or(Vec::new(), |(_, report)| report.contacts.clone());
                Some(attempt(body, parts, near, way, size, settings, Begun::Anew { earlier }))
            }
            Course::Continued(keep) => memory.continued(keep, body, (parts, near), way, size, settings),
        };
        if let Some(mut report) = report {
            // Without passes all ways are the same.
            if report.passes == 0 && (report.left <= 0.0 || settings.max_passes == 0) {
                return report;
            }
            report.way = number;
            let (grade, pop) = judge(body, &report);
            if best.is_none() {
                courses.extend(other_courses(first, pop, earlier.is_none()));
            }
            if best.as_ref().is_none_or(|best| grade < best.grade) {
                best = Some(Outcome { grade, report, state: body.collision_state() });
            }
            tried += 1;
            let fine = best.as_ref().is_some_and(|best| best.grade.open <= 0.0);
            if grade.is_good() || fine && WAYS[number].softer > 1.0 {
                break;
            }
        }
        body.resume(&start);
    }
    let Some(best) = best else { return CancelReport::default() };
    // Where it is the first way that is good.
    if tried == 1 && best.grade.is_good() && best.grade.passes > MANY {
        body.resume(&start);
        let report = at_once(body, [&start, &best.state], &best.report, (parts, near), size, settings);
        if let Some(report) = report.filter(|report| judge(body, report).0 < best.grade) {
            return report;
        }
    }
    body.resume(&best.state);
    best.report
}

/// What a course came to.
struct Outcome {
    grade: Grade,
    report: CancelReport,
    state: CollisionState,
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

/// The number of a way that there is.
pub(super) fn known_way(number: usize) -> usize {
    number.min(WAYS.len() - 1)
}

/// A way by its number in [`WAYS`].
pub(super) fn way_of(number: usize, body: &ElasticBody, settings: &CancelSettings) -> Way {
    let kind = &WAYS[known_way(number)];
    Way { softness: softness_of(body, settings) * kind.softer, stride: STRIDE, tips: kind.tips }
}

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

/// The way that is gone at least in one pass where contacts push against each other, in sizes of the body.
const STRIDE: f32 = 0.12;
