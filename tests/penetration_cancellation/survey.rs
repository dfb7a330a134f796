//! Many seeded poses of one kind: the worst figures, and each pose that fails as a scene file.

use std::fmt;

use pliant::coupling::CancelSettings;
use rayon::prelude::*;

use crate::figures::{Figures, Limits, cancelled};
use crate::kinds::Kind;
use crate::poses::{Subject, random_case};
use crate::scene_file::write_scene;

/// What came out of one body and kind.
pub struct Survey {
    name: String,
    figures: Vec<(u64, Figures)>,
    bad: usize,
    /// What does not hold, with seeds, figures and scene files.
    pub faults: Vec<String>,
}

/// Poses of each kind.
fn cases() -> u64 {
    match std::env::var("PLIANT_SUITE") {
        Ok(suite) if suite == "full" => 1000,
        Ok(suite) => suite.parse().expect("PLIANT_SUITE is a number of poses, or `full`"),
        Err(_) => 40,
    }
}

/// Poses that fail and are told one by one.
const TOLD: usize = 5;

/// One pose in so many is compared with the exact flow.
const EXACT: u64 = 10;

/// The share of poses that may take more than four passes.
const MANY_PASSES: f32 = 0.01;

/// Runs all poses of a kind.
pub fn survey(subject: &Subject, kind: Kind, limits: &Limits) -> Survey {
    survey_with(subject, kind, limits, &CancelSettings::default())
}

/// Runs all poses of a kind with these settings.
pub fn survey_with(subject: &Subject, kind: Kind, limits: &Limits, settings: &CancelSettings) -> Survey {
    let name = format!("{} {kind:?}", subject.name);
    if std::env::var("PLIANT_SUITE_KIND").is_ok_and(|only| !name.contains(&only)) {
        return Survey { name, figures: Vec::new(), bad: 0, faults: Vec::new() };
    }
    let seed = std::env::var("PLIANT_SUITE_SEED").ok().and_then(|seed| seed.parse().ok());
    let seeds = seed.map_or(0..cases(), |seed: u64| seed..seed + 1);
    let run = |seed| {
        let mut case = random_case(subject, kind, seed);
        cancelled(&mut case, settings, seed % EXACT == 0).0
    };
    let figures: Vec<(u64, Figures)> = seeds.into_par_iter().map(|seed| (seed, run(seed))).collect();
    let mut faults = Vec::new();
    let mut bad = 0;
    for (seed, figures) in &figures {
        let wrong = figures.faults(limits, subject.one_segment());
        if wrong.is_empty() {
            continue;
        }
        bad += 1;
        if bad <= TOLD {
            let case = random_case(subject, kind, *seed);
            let file = format!("{}_{kind:?}_{seed}", subject.name);
            let path = write_scene(&file, &subject.rig, case.pose, case.size, &case.obstacles);
            faults.push(format!(
                "{name} seed {seed}: {} ({} passes); pliant run {}",
                wrong.join(", "),
                figures.passes,
                path.display()
            ));
        }
    }
    if bad > TOLD {
        faults.push(format!("{name}: {} more", bad - TOLD));
    }
    let many = figures.iter().filter(|(_, f)| f.passes > 4).count();
    if many as f32 > MANY_PASSES * figures.len() as f32 && seed.is_none() {
        faults.push(format!("{name}: more than 4 passes in {many} of {}", figures.len()));
    }
    Survey { name, figures, bad, faults }
}

impl Survey {
    /// True where more poses than these shares fail a limit, or take more than four passes.
    pub fn exceeds(&self, (bad, many): (f32, f32)) -> bool {
        let count = self.figures.len() as f32;
        let passes = self.figures.iter().filter(|(_, figures)| figures.passes > 4).count();
        // At least one pose, where a share is open at all.
        let most = |share: f32| if share > 0.0 { (share * count).max(1.0) } else { 0.0 };
        self.bad as f32 > most(bad) || passes as f32 > most(many)
    }

    /// The cells of a table: share of poses in which all holds, worst depth, piercing, gap and change of volume in
    /// percent, most passes, poses with folded triangles.
    pub fn cells(&self) -> String {
        let count = self.figures.len().max(1) as f32;
        let worst = |value: fn(&Figures) -> f32| 100.0 * self.figures.iter().map(|(_, f)| value(f)).fold(0.0, f32::max);
        format!(
            "{:.1} | {:.2} | {:.2} | {:.2} | {:.2} | {} | {}",
            100.0 * (count - self.bad as f32) / count,
            worst(|f| f.penetration.max_depth_after),
            worst(|f| f.penetration.max_piercing),
            worst(|f| f.penetration.max_gap),
            worst(|f| f.volume.abs()),
            self.figures.iter().map(|(_, f)| f.passes).max().unwrap_or(0),
            self.figures.iter().filter(|(_, f)| f.folded > 0).count(),
        )
    }
}

impl fmt::Display for Survey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let worst = |value: fn(&Figures) -> f32| {
            let all = self.figures.iter().map(|(seed, figures)| (value(figures), *seed));
            let (value, seed) = all.fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
            format!("{value:.4} (#{seed})")
        };
        let count = |holds: fn(&Figures) -> bool| self.figures.iter().filter(|(_, x)| holds(x)).count();
        write!(
            f,
            "{:20} {} poses, bad {:3} | depth {} {} | pierce {} {} | gap {} {} | passes {} >4 {} | volume {} drift {} | folded {} {}",
            self.name,
            self.figures.len(),
            self.bad,
            worst(|x| x.penetration.max_depth_after),
            count(|x| x.penetration.max_depth_after > 1e-3),
            worst(|x| x.penetration.max_piercing),
            count(|x| x.penetration.max_piercing > 5e-3),
            worst(|x| x.penetration.max_gap),
            count(|x| x.penetration.max_gap > 5e-3),
            worst(|x| x.passes as f32),
            count(|x| x.passes > 4),
            worst(|x| x.volume.abs()),
            worst(|x| x.drift.abs()),
            worst(|x| x.folded as f32),
            count(|x| x.folded > 0),
        )
    }
}
