//! What a frame of the tower costs, stage by stage, and what the alternatives cost beside each other.
//!
//! A table of one whole fall is printed first, then a table of ratios whose members were measured in turns in the same
//! run; criterion then repeats the figures that are worth following from run to run.
#![allow(clippy::print_stdout, reason = "the tables are what it is for")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use anyhow::Result;
use criterion::{Criterion, SamplingMode};
use pliant::elastic::{ElasticBody, tangent_epsilon};
use pliant::field::Integrator;
use pliant::math::Vec3;
use pliant::mesh::NormalTopology;
use pliant_demos::scene::{find_scene, load_scene};
use pliant_demos::simulation::Simulation;
use rayon::prelude::*;

/// Frames of one fall.
const FRAMES: u64 = 600;

/// A snapshot of the camel is kept every so many frames.
const EVERY: u64 = 20;

/// Falls of the first table. All are the same; each frame counts with its quickest, so that other work of the machine
/// does not look like a slow frame.
const FALLS: usize = 3;

/// Rounds over all snapshots in the table of ratios; the quickest counts.
const ROUNDS: u32 = 7;

fn tower(max_passes: Option<u32>) -> Result<Simulation> {
    let mut simulation = Simulation::new(load_scene(find_scene("tower")?)?, 0)?;
    simulation.deformation.settings.measure = false;
    if let Some(passes) = max_passes {
        simulation.deformation.settings.cancel.max_passes = passes;
    }
    Ok(simulation)
}

/// Milliseconds of each stage in each frame of a fall.
#[derive(Default)]
struct Fall {
    rigid: Vec<f32>,
    springs: Vec<f32>,
    contact: Vec<f32>,
    deform: Vec<f32>,
    step: Vec<f32>,
    passes: Vec<u32>,
    bodies: Vec<ElasticBody>,
}

fn fall(max_passes: Option<u32>) -> Result<Fall> {
    let mut quickest = one_fall(tower(max_passes)?);
    for _ in 1..FALLS {
        let again = one_fall(tower(max_passes)?);
        for (times, others) in [
            (&mut quickest.rigid, again.rigid),
            (&mut quickest.springs, again.springs),
            (&mut quickest.contact, again.contact),
            (&mut quickest.deform, again.deform),
            (&mut quickest.step, again.step),
        ] {
            times.iter_mut().zip(others).for_each(|(time, other)| *time = time.min(other));
        }
    }
    Ok(quickest)
}

fn one_fall(mut simulation: Simulation) -> Fall {
    let mut fall = Fall::default();
    for frame in 0..FRAMES {
        simulation.step();
        let times = simulation.times();
        fall.rigid.push(simulation.rigid_ms);
        fall.springs.push(times.springs);
        fall.contact.push(times.contact);
        fall.deform.push(times.deform);
        fall.step.push(times.springs + times.contact + times.deform);
        fall.passes.push(simulation.actors.iter().map(|actor| simulation.report(actor).passes).max().unwrap_or(0));
        if frame % EVERY == 0 {
            fall.bodies.extend(simulation.deformation.iter().map(|(_, body)| body.clone()));
        }
    }
    fall
}

fn mean(times: &[f32]) -> f32 {
    times.iter().sum::<f32>() / times.len().max(1) as f32
}

fn row(name: &str, times: &[f32]) {
    let mut sorted = times.to_vec();
    sorted.sort_by(f32::total_cmp);
    let at = |part: usize| sorted.get((sorted.len() * part / 100).min(sorted.len() - 1)).copied().unwrap_or(0.0);
    println!("{name:<34} {:8.3} {:8.3} {:8.3} {:8.3}", mean(times), at(50), at(95), at(100));
}

fn print_fall(whole: &Fall, uncancelled: &Fall) {
    println!("\ntower, {FRAMES} frames, ms a frame         mean   median     95 %    worst");
    row("mass-spring sets", &whole.springs);
    row("contacts and repelling impulses", &uncancelled.contact);
    row("contacts, impulses, cancellation", &whole.contact);
    row("deformation by the springs", &whole.deform);
    row("rapier", &whole.rigid);
    row("all of pliant", &whole.step);
    for passes in 0..=whole.passes.iter().copied().max().unwrap_or(0) {
        let frames = whole.step.iter().zip(&whole.passes).filter(|&(_, &p)| p == passes);
        let times: Vec<f32> = frames.map(|(&time, _)| time).collect();
        if !times.is_empty() {
            row(&format!("  {} frames of {passes} passes", times.len()), &times);
        }
    }
    println!("cancellation alone, mean {:.3} ms (the difference)", mean(&whole.contact) - mean(&uncancelled.contact));
}

/// The camel at some moments of the fall in all variants that are compared.
struct Moments {
    rigid: Vec<ElasticBody>,
    springs: Vec<ElasticBody>,
    euler: Vec<ElasticBody>,
    midpoint: Vec<ElasticBody>,
    runge_kutta: Vec<ElasticBody>,
    whole: Vec<ElasticBody>,
    topology: NormalTopology,
    epsilon: f32,
}

impl Moments {
    fn new(whole: Vec<ElasticBody>) -> Result<Self> {
        // Each rule with its full number of steps: on its own a body takes fewer where the fields are weak.
        let with = |integrator: Integrator| {
            let changed = |body: &ElasticBody| {
                let mut body = body.clone();
                body.settings.integrator = integrator;
                body.build_palette();
                for entry in &mut body.palette_mut().segments {
                    entry.local.steps = integrator.default_steps();
                    entry.global.steps = integrator.default_steps();
                }
                body
            };
            whole.iter().map(changed).collect()
        };
        let without_passes = |enabled: bool| {
            let changed = |body: &ElasticBody| {
                let mut body = body.clone();
                body.settings.enabled = enabled;
                body.build_palette();
                body
            };
            whole.iter().map(changed).collect()
        };
        let mesh = &whole[0].rig().mesh;
        Ok(Self {
            rigid: without_passes(false),
            springs: without_passes(true),
            euler: with(Integrator::Euler),
            midpoint: with(Integrator::Midpoint),
            runge_kutta: with(Integrator::RungeKutta4),
            topology: NormalTopology::new(&mesh.triangles, &mesh.welded)?,
            epsilon: tangent_epsilon(&mesh.positions),
            whole,
        })
    }

    /// Springs and all collision passes of the frame, without normals.
    fn deform(&mut self) {
        for body in &mut self.whole {
            deform(body);
            black_box(body.positions());
        }
    }

    /// The same, then the normals of the triangles.
    fn deform_then_triangle_normals(&mut self) {
        let (mut areas, mut normals) = (Vec::new(), Vec::new());
        for body in &mut self.whole {
            deform(body);
            let _ = black_box(self.topology.normals_into(body.positions(), &mut areas, &mut normals));
        }
    }

    /// The same a vertex at a time, as the compute pass does it.
    fn deform_each(&self) {
        for body in &self.whole {
            let rig = body.rig();
            let deformed: Vec<Vec3> = (0..rig.mesh.positions.len())
                .into_par_iter()
                .with_min_len(256)
                .map(|v| body.palette().deform(rig.mesh.positions[v], &rig.weights[v]))
                .collect();
            black_box(deformed);
        }
    }

    /// A vertex at a time with the normals of two tangent points, which need no neighbours.
    fn deform_each_with_tangent_normals(&self) {
        for body in &self.whole {
            let rig = body.rig();
            let deformed: Vec<(Vec3, Vec3)> = (0..rig.mesh.positions.len())
                .into_par_iter()
                .with_min_len(256)
                .map(|v| {
                    let (x, n) = (rig.mesh.positions[v], rig.mesh.normals[v]);
                    body.palette().deform_with_normal(x, n, &rig.weights[v], self.epsilon)
                })
                .collect();
            black_box(deformed);
        }
    }

    fn count(&self) -> u32 {
        self.whole.len() as u32
    }
}

/// Deforms a body anew by the palette that it has.
fn deform(body: &mut ElasticBody) {
    let passes = std::mem::take(&mut body.palette_mut().passes);
    body.deform_springs();
    for pass in passes {
        body.deform_collision(pass);
    }
}

fn springs(bodies: &mut [ElasticBody]) {
    for body in bodies {
        body.deform_springs();
        black_box(body.positions());
    }
}

fn timed(work: impl FnOnce()) -> Duration {
    let clock = Instant::now();
    work();
    clock.elapsed()
}

fn print_ratios(moments: &mut Moments) {
    let mut quickest = [Duration::MAX; 9];
    for _ in 0..ROUNDS {
        let times = [
            timed(|| springs(&mut moments.rigid)),
            timed(|| springs(&mut moments.springs)),
            timed(|| springs(&mut moments.euler)),
            timed(|| springs(&mut moments.midpoint)),
            timed(|| springs(&mut moments.runge_kutta)),
            timed(|| moments.deform()),
            timed(|| moments.deform_then_triangle_normals()),
            timed(|| moments.deform_each()),
            timed(|| moments.deform_each_with_tangent_normals()),
        ];
        quickest.iter_mut().zip(times).for_each(|(best, time)| *best = time.min(*best));
    }
    let names = [
        "rigid skinning alone",
        "springs, as a body does it",
        "springs, Euler, 12 steps",
        "springs, midpoint, 6 steps",
        "springs, Runge-Kutta, 4 steps",
        "springs and collision passes",
        "  and normals of the triangles",
        "  a vertex at a time, no normals",
        "  a vertex at a time, tangent normals",
    ];
    println!("\nthe skin alone, {} moments of the fall      ms   ratio", moments.count());
    for (name, time) in names.iter().zip(quickest) {
        let ms = time.as_secs_f64() * 1.0e3 / f64::from(moments.count());
        println!("{name:<38} {ms:8.3} {:7.2}", time.as_secs_f64() / quickest[0].as_secs_f64());
    }
    println!();
}

/// One iteration is one frame; the fall goes on from sample to sample and starts again at its end.
fn frames(criterion: &mut Criterion) -> Result<()> {
    let mut simulation = tower(None)?;
    let mut group = criterion.benchmark_group("tower");
    group.sample_size(10).sampling_mode(SamplingMode::Flat).measurement_time(Duration::from_secs(5));
    group.bench_function("frame", |bencher| {
        bencher.iter_custom(|iterations| {
            let mut sum = Duration::ZERO;
            for _ in 0..iterations {
                if simulation.frame >= FRAMES
                    && let Ok(again) = tower(None)
                {
                    simulation = again;
                }
                simulation.physics.step();
                sum += timed(|| {
                    simulation.deformation.step(&mut simulation.physics);
                });
                simulation.frame += 1;
            }
            sum
        });
    });
    group.finish();
    Ok(())
}

fn skins(criterion: &mut Criterion, moments: &mut Moments) {
    let each = moments.count();
    let mut group = criterion.benchmark_group("skin");
    group
        .sample_size(10)
        .sampling_mode(SamplingMode::Flat)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    for (name, bodies) in [
        ("rigid", &mut moments.rigid),
        ("springs", &mut moments.springs),
        ("springs-euler", &mut moments.euler),
        ("springs-midpoint", &mut moments.midpoint),
        ("springs-runge-kutta", &mut moments.runge_kutta),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|n| (0..n).map(|_| timed(|| springs(bodies)) / each).sum());
        });
    }
    group.finish();
}

fn main() -> Result<()> {
    let mut criterion = Criterion::default().configure_from_args();
    let whole = fall(None)?;
    let uncancelled = fall(Some(0))?;
    print_fall(&whole, &uncancelled);
    let mut moments = Moments::new(whole.bodies)?;
    print_ratios(&mut moments);
    frames(&mut criterion)?;
    skins(&mut criterion, &mut moments);
    criterion.final_summary();
    Ok(())
}
