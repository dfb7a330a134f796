//! Penetration cancellation: no vertex and no triangle of the visible skin is seen inside an obstacle.

mod common;
#[path = "penetration_cancellation/figures.rs"]
mod figures;
#[path = "penetration_cancellation/poses.rs"]
mod poses;
#[path = "common/random.rs"]
mod random;

use std::sync::Arc;

use pliant::coupling::CancelSettings;
use pliant::elastic::{ElasticBody, ElasticRig, load_rig};
use pliant::spring::SpringCoefficients;
use rayon::prelude::*;

use figures::{Figures, cancelled};
use poses::{Kind, random_case};

fn rigs() -> Vec<(&'static str, Arc<ElasticRig>)> {
    let ball = common::ball_rig(0.5, 1.2, SpringCoefficients::new(3.0, 0.2));
    let camel = Arc::new(load_rig(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/rigs/camel.toml")).expect("a rig"));
    vec![("ball", ball), ("camel", camel)]
}

#[test]
fn survey() {
    let count: u64 = std::env::var("CASES").ok().and_then(|s| s.parse().ok()).unwrap_or(40);
    let only = std::env::var("ONLY").unwrap_or_default();
    for (name, rig) in rigs() {
        let template = ElasticBody::new(rig.clone());
        for kind in Kind::ALL {
            if !only.is_empty() && !format!("{name} {kind:?}").contains(&only) {
                continue;
            }
            if let Ok(seed) = std::env::var("SEED") {
                let mut case = random_case(&rig, &template, kind, seed.parse().unwrap());
                println!("{:?}", case.parts[0].placed.part().shape);
                let f = cancelled(&mut case, &CancelSettings::default()).0;
                println!("{:?} {f:?}", case.depth);
                continue;
            }
            let mut all: Vec<(u64, f32, Figures)> = (0..count)
                .into_par_iter()
                .map(|seed| {
                    let mut case = random_case(&rig, &template, kind, seed);
                    let (figures, _) = cancelled(&mut case, &CancelSettings::default());
                    (seed, case.depth, figures)
                })
                .collect();
            let max = |f: &dyn Fn(&Figures) -> f32| {
                all.iter()
                    .map(|(s, _, x)| (f(x), *s))
                    .fold((f32::NEG_INFINITY, 0), |a, b| if b.0 > a.0 { b } else { a })
            };
            let share = |f: &dyn Fn(&Figures) -> bool| all.iter().filter(|(_, _, x)| f(x)).count();
            println!(
                "{name:6} {:10} depth {:.4} (#{}) bad {:3} | pierce {:.4} (#{}) bad {:3} | gap {:.4} (#{}) bad {:3} | passes {} >4 {:3} | vol {:.4} | folded {} (#{})",
                format!("{kind:?}"),
                max(&|x| x.depth).0,
                max(&|x| x.depth).1,
                share(&|x| x.depth > 1e-3),
                max(&|x| x.piercing).0,
                max(&|x| x.piercing).1,
                share(&|x| x.piercing > 5e-3),
                max(&|x| x.gap).0,
                max(&|x| x.gap).1,
                share(&|x| x.gap > 5e-3),
                max(&|x| x.passes as f32).0,
                share(&|x| x.passes > 4),
                max(&|x| x.volume.abs()).0,
                max(&|x| x.folded as f32).0,
                max(&|x| x.folded as f32).1,
            );
            all.clear();
        }
    }
}
