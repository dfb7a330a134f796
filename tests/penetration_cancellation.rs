//! Penetration cancellation: no vertex and no triangle of the visible skin is seen inside an obstacle.
//!
//! `PLIANT_SUITE=full` runs 1,000 poses of each kind; `PLIANT_SUITE_KIND` and `PLIANT_SUITE_SEED` pick one.

#[path = "penetration_cancellation/figures.rs"]
mod figures;
#[path = "penetration_cancellation/kinds.rs"]
mod kinds;
#[path = "penetration_cancellation/poses.rs"]
mod poses;
#[allow(dead_code)] // other tests use the rest of it
#[path = "common/random.rs"]
mod random;
#[path = "penetration_cancellation/scene_file.rs"]
mod scene_file;
#[path = "penetration_cancellation/survey.rs"]
mod survey;

use figures::Limits;
use kinds::Kind;
use poses::Subject;
use survey::survey;

/// Every kind of obstacle, pushed into a body in random poses.
fn holds_for(name: &'static str) {
    let subject = Subject::load(name);
    let mut faults = Vec::new();
    for kind in Kind::ALL {
        let found = survey(&subject, kind, &Limits::ONE);
        println!("{found}");
        faults.extend(found.faults);
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn no_obstacle_of_any_kind_is_seen_in_a_ball() {
    holds_for("ball");
}

#[test]
fn no_obstacle_of_any_kind_is_seen_in_a_head() {
    holds_for("head");
}

#[test]
fn no_obstacle_of_any_kind_is_seen_in_a_camel() {
    holds_for("camel");
}
