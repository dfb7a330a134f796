//! Penetration cancellation: no vertex and no triangle of the visible skin is seen inside an obstacle.
//!
//! `PLIANT_SUITE=full` runs 1,000 poses of each kind; `PLIANT_SUITE_KIND` and `PLIANT_SUITE_SEED` pick one.
#![allow(clippy::print_stdout, reason = "the figures are what one runs the suite for")]

#[path = "penetration_cancellation/figures.rs"]
mod figures;
#[path = "common/icosphere.rs"]
mod icosphere;
#[path = "penetration_cancellation/kinds.rs"]
mod kinds;
#[path = "penetration_cancellation/poses.rs"]
mod poses;
#[allow(dead_code)] // other tests use the rest of it
#[path = "common/random.rs"]
mod random;
#[path = "penetration_cancellation/scene_file.rs"]
mod scene_file;
#[path = "penetration_cancellation/structured.rs"]
mod structured;
#[path = "penetration_cancellation/survey.rs"]
mod survey;

use pliant::coupling::{CancelSettings, Placement};

use figures::{Limits, cancelled};
use kinds::Kind;
use poses::Subject;
use scene_file::write_scene;
use structured::{Arrangement, arrangements, pinned};
use survey::{survey, survey_with};

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

/// Corners, wedges, funnels, presses, rings and crossing bars.
fn arrangements_hold_for(name: &'static str) {
    let subject = Subject::load(name);
    let mut faults = Vec::new();
    for Arrangement { name, mut case } in arrangements(&subject) {
        if std::env::var("PLIANT_SUITE_KIND").is_ok_and(|only| !name.contains(&only)) {
            continue;
        }
        let (figures, _) = cancelled(&mut case, &CancelSettings::default(), true);
        let p = &figures.penetration;
        println!(
            "{:6} {name:45} | depth {:.4} piercing {:.4} gap {:.4} | passes {} | volume {:+.4} drift {:+.4} | folded {}",
            subject.name,
            p.max_depth_after,
            p.max_piercing,
            p.max_gap,
            figures.passes,
            figures.volume,
            figures.drift,
            figures.folded
        );
        let mut wrong = figures.faults(&Limits::ONE, true);
        if figures.passes > 4 {
            wrong.push(format!("{} passes", figures.passes));
        }
        if !wrong.is_empty() {
            let file = format!("{}_{}", subject.name, name.replace([' ', ','], "_"));
            let path = write_scene(&file, &subject.rig, case.pose, case.size, &case.obstacles);
            faults.push(format!("{} {name}: {}; pliant run {}", subject.name, wrong.join(", "), path.display()));
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn a_ball_fits_into_corners_wedges_funnels_presses_rings_and_between_bars() {
    arrangements_hold_for("ball");
}

#[test]
fn a_head_fits_into_corners_wedges_funnels_presses_rings_and_between_bars() {
    arrangements_hold_for("head");
}

#[test]
fn a_body_without_any_room_stays_finite_and_unfolded_and_the_report_says_so() {
    for name in ["ball", "head"] {
        let subject = Subject::load(name);
        for room in [0.9, 0.7] {
            let (mut case, depth) = pinned(&subject, room);
            let (figures, report) = cancelled(&mut case, &CancelSettings::default(), false);
            let said = format!("{name} in {room} of its volume, walls {depth} deep: {figures:?}, left {}", report.left);
            println!("{said}");
            assert!(figures.finite && figures.folded == 0, "{said}");
            assert!(figures.penetration.uncancelled && report.left > 0.0, "{said}");
            // It is no worse than it was.
            assert!(figures.penetration.max_depth_after <= depth + 1e-3, "{said}");
        }
    }
}

#[test]
#[ignore = "prints the tables of docs/penetration.md, and asserts nothing"]
fn tables() {
    for placement in [Placement::Hugging, Placement::Literal] {
        let settings = CancelSettings { placement, ..CancelSettings::default() };
        println!("\n{placement:?}\n");
        println!("| body | obstacle | all holds % | depth % | piercing % | gap % | volume % | passes | folded poses |");
        println!("|---|---|---|---|---|---|---|---|---|");
        for name in ["ball", "head", "camel"] {
            let subject = Subject::load(name);
            for kind in Kind::ALL {
                let cells = survey_with(&subject, kind, &Limits::ONE, &settings).cells();
                println!("| {name} | {kind:?} | {cells} |");
            }
        }
    }
}
