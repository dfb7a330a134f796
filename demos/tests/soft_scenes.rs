//! The scenes of bodies that move by themselves: each runs, and does what it is there to show.

#[path = "../../tests/common/ventricle.rs"]
mod ventricle;

use pliant::math::Vec3;
use pliant_demos::scene::{find_scene, load_scene, scene_names};
use pliant_demos::simulation::Simulation;

fn open(name: &str) -> Simulation {
    let scene = load_scene(find_scene(name).unwrap_or_else(|e| panic!("{e}"))).unwrap_or_else(|e| panic!("{e}"));
    Simulation::new(scene, 0).unwrap_or_else(|e| panic!("{e}"))
}

fn run(simulation: &mut Simulation, seconds: f32) {
    let until = simulation.time() + seconds - 0.5 * simulation.scene.dt;
    while simulation.time() < until {
        simulation.step();
    }
}

fn run_to_the_end(simulation: &mut Simulation) {
    let left = simulation.scene.duration - simulation.time();
    run(simulation, left);
}

fn positions(simulation: &Simulation, actor: usize) -> &[Vec3] {
    simulation.creatures.get(simulation.soft_actors[actor].handle).unwrap().positions()
}

fn rest(simulation: &Simulation, actor: usize) -> &[Vec3] {
    &simulation.soft_actors[actor].kind.model.rig.mesh().positions
}

fn centre(simulation: &Simulation, actor: usize) -> Vec3 {
    simulation.soft_figures(&simulation.soft_actors[actor]).centre
}

fn excitations(simulation: &Simulation, actor: usize) -> Vec<f32> {
    let mut excitations = Vec::new();
    simulation.creatures.excitations_into(simulation.soft_actors[actor].handle, &mut excitations);
    excitations
}

/// The mean place now of the vertices whose place at rest is chosen.
fn mean(simulation: &Simulation, actor: usize, choose: impl Fn(Vec3) -> bool) -> Vec3 {
    let chosen = rest(simulation, actor).iter().zip(positions(simulation, actor)).filter(|(r, _)| choose(**r));
    let (sum, count) = chosen.fold((Vec3::ZERO, 0.0), |(sum, count), (_, x)| (sum + *x, count + 1.0));
    assert!(count > 0.0, "there are such vertices");
    sum / count
}

#[test]
fn every_scene_of_soft_bodies_runs_finite_and_without_a_frozen_body() {
    let named = [
        ("jellyfish", 1),
        ("bending-bar", 1),
        ("propagation", 1),
        ("snail", 1),
        ("stiffness", 5),
        ("worm-crawl", 1),
        ("worm-bend", 1),
        ("jellyfish-swarm", 31),
        ("worm-heap", 101),
        ("heart", 1),
        ("bowel", 1),
    ];
    for name in scene_names() {
        let mut simulation = open(&name);
        if simulation.soft_actors.is_empty() {
            continue;
        }
        let expected = named.iter().find(|(known, _)| *known == name);
        assert!(expected.is_none_or(|(_, count)| *count == simulation.soft_actors.len()), "{name}");
        // More than the first contacts; crowds are dear.
        let steps = if simulation.soft_actors.len() > 50 { 30 } else { 80 };
        for step in 0..steps {
            simulation.step();
            for actor in &simulation.soft_actors {
                assert_eq!(simulation.soft_report(actor).frozen, None, "{name}, step {step}: {}", actor.name);
            }
        }
        for (index, actor) in simulation.soft_actors.iter().enumerate() {
            let lowest = positions(&simulation, index).iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
            assert!(positions(&simulation, index).iter().all(|x| x.is_finite()), "{name}: {}", actor.name);
            let floored = simulation.obstacles.iter().any(|o| o.obstacle.name.as_deref() == Some("floor"));
            // A centimetre or so of a fall is given back in the next steps.
            assert!(!floored || lowest > -0.05, "{name}: {} is {lowest} under the floor", actor.name);
            assert!(centre(&simulation, index).length() < 20.0, "{name}: {}", actor.name);
            let volume = simulation.soft_figures(actor).volume_ratio;
            assert!((0.4..1.4).contains(&volume), "{name}: {} has the volume {volume}", actor.name);
        }
        // Nothing stands still: charts, gravity or a hand moves each.
        let start = simulation.scene.soft_bodies[0].pose;
        let moved = rest(&simulation, 0).iter().zip(positions(&simulation, 0));
        let farthest = moved.map(|(r, x)| start.transform_point(*r).distance(*x)).fold(0.0, f32::max);
        assert!(farthest > 0.01 || name == "snail", "{name}: {farthest}");
    }
    for (name, _) in named {
        assert!(scene_names().iter().any(|n| n == name), "{name} is missing");
    }
}

#[test]
fn no_cell_is_inside_out_in_any_frame_of_scenes_of_single_bodies() {
    let names =
        ["jellyfish", "worm-crawl", "worm-bend", "heart", "bowel", "bending-bar", "propagation", "stiffness", "snail"];
    for name in names {
        let mut simulation = open(name);
        let end = simulation.scene.duration - 0.5 * simulation.scene.dt;
        while simulation.time() < end {
            simulation.step();
            for actor in &simulation.soft_actors {
                let inverted = simulation.soft_figures(actor).inverted;
                assert_eq!(inverted, 0, "{name}, {} at {} s", actor.name, simulation.time());
            }
        }
    }
}

#[test]
fn the_jellyfish_of_the_scene_swims_its_length_in_three_strokes() {
    let mut simulation = open("jellyfish");
    let cycle = simulation.soft_actors[0].kind.model.motion.cyclic().unwrap().charts.cycle;
    let heights = || rest(&simulation, 0).iter().map(|x| x.y);
    let length = heights().fold(f32::MIN, f32::max) - heights().fold(f32::MAX, f32::min);
    run(&mut simulation, cycle);
    let start = centre(&simulation, 0);
    run(&mut simulation, 3.0 * cycle);
    let way = centre(&simulation, 0) - start;
    println!("{way} of {length}");
    assert!(way.y > length, "{way} of {length}");
}

#[test]
fn the_jellyfish_of_the_scene_stops_when_its_charts_stop() {
    let mut simulation = open("jellyfish");
    let cycle = simulation.soft_actors[0].kind.model.motion.cyclic().unwrap().charts.cycle;
    run(&mut simulation, 2.0 * cycle);
    let before = centre(&simulation, 0);
    run(&mut simulation, cycle);
    let stroke = centre(&simulation, 0).distance(before);
    let handle = simulation.soft_actors[0].handle;
    simulation.creatures.motion_mut(handle).unwrap().strength = 0.0;
    // Water slows it by the square of its pace: what is left after some seconds is a small part of it.
    run(&mut simulation, 6.0);
    let before = centre(&simulation, 0);
    run(&mut simulation, cycle);
    let rest = centre(&simulation, 0).distance(before);
    assert!(rest < 0.15 * stroke, "{rest} in a cycle, {stroke} in a stroke");
}

#[test]
fn no_body_of_a_crowd_is_in_another_in_any_frame() {
    for name in ["jellyfish-swarm", "worm-heap"] {
        let mut simulation = open(name);
        let end = simulation.scene.duration - 0.5 * simulation.scene.dt;
        let mut held = 0;
        while simulation.time() < end {
            simulation.step();
            let crossings: usize = simulation.soft_crossings().into_iter().sum();
            assert_eq!(crossings, 0, "{name} at {} s", simulation.time());
            held += simulation.soft_actors.iter().map(|actor| simulation.soft_report(actor).held).sum::<usize>();
        }
        println!("{name}: {held} vertices held back in all frames");
    }
}

#[test]
fn the_swarm_swims_up() {
    let mut simulation = open("jellyfish-swarm");
    let start: Vec<Vec3> = (0..31).map(|i| centre(&simulation, i)).collect();
    run(&mut simulation, 3.0);
    let risen = (0..31).filter(|&i| centre(&simulation, i).y > start[i].y + 0.15).count();
    assert!(risen >= 28, "{risen} of 31");
}

#[test]
fn the_worm_crawls_ahead_until_its_cue_and_then_back() {
    let mut simulation = open("worm-crawl");
    let turn = simulation.scene.cues[0].time;
    let start = centre(&simulation, 0).x;
    run(&mut simulation, turn);
    let ahead = centre(&simulation, 0).x - start;
    // Half of its ten cycles are over: half of its length is asked for.
    assert!(ahead > 1.26, "{ahead}");
    run_to_the_end(&mut simulation);
    let back = centre(&simulation, 0).x - start - ahead;
    assert!(back < -1.26, "{back}");
}

#[test]
fn the_worm_of_the_scene_crawls_its_length_in_ten_cycles_and_backwards_with_the_phase_reversed() {
    let way = |pace: f32| {
        let mut simulation = open("worm-crawl");
        simulation.scene.cues.clear();
        let handle = simulation.soft_actors[0].handle;
        simulation.creatures.motion_mut(handle).unwrap().pace = pace;
        let xs = || rest(&simulation, 0).iter().map(|x| x.x);
        let length = xs().fold(f32::MIN, f32::max) - xs().fold(f32::MAX, f32::min);
        let cycle = simulation.soft_actors[0].kind.model.motion.cyclic().unwrap().charts.cycle;
        let start = centre(&simulation, 0).x;
        run(&mut simulation, 10.0 * cycle);
        (centre(&simulation, 0).x - start) / length
    };
    let (ahead, back) = (way(1.0), way(-1.0));
    println!("{ahead} lengths ahead, {back} back");
    assert!(ahead > 1.0 && back < -1.0, "{ahead} {back}");
}

#[test]
fn the_worm_winds_to_both_sides() {
    let mut simulation = open("worm-bend");
    let (mut left, mut right) = (0f32, 0f32);
    for _ in 0..180 {
        simulation.step();
        let [head, middle, tail] = [1.0, 0.0, -1.0].map(|u| mean(&simulation, 0, |r| (r.x - 1.1 * u).abs() < 0.15));
        // How far the middle is to the side of the line from tail to head.
        let side = Vec3::Y.cross((head - tail).normalize()).dot(middle - 0.5 * (head + tail));
        (left, right) = (left.min(side), right.max(side));
    }
    assert!(left < -0.1 && right > 0.1, "{left} {right}");
}

#[test]
fn the_bar_bends_up_and_down_by_its_amplitudes() {
    let mut simulation = open("bending-bar");
    let cycle = simulation.soft_actors[0].kind.model.motion.cyclic().unwrap().charts.cycle;
    // How far its ends are above its middle when the charts are at their ends.
    let ends = |simulation: &Simulation| {
        mean(simulation, 0, |r| r.x.abs() > 0.9).y - mean(simulation, 0, |r| r.x.abs() < 0.1).y
    };
    run(&mut simulation, 0.25 * cycle);
    let down = ends(&simulation);
    run(&mut simulation, 0.5 * cycle);
    let up = ends(&simulation);
    assert!(down < -0.3 && up > 0.3, "{down} {up}");
}

#[test]
fn bulges_run_along_the_bar() {
    let mut simulation = open("propagation");
    // How thick the bar is at each of its 21 layers, a tenth of a metre apart.
    let thickness = |simulation: &Simulation| -> Vec<f32> {
        let layer = |r: Vec3, k: i32| (r.x - 0.1 * k as f32).abs() < 0.05;
        let side = |k, up: f32| mean(simulation, 0, |r| layer(r, k) && r.y * up > 0.15).y;
        (-10..=10).map(|k| side(k, 1.0) - side(k, -1.0)).collect()
    };
    run(&mut simulation, 1.0);
    let before = thickness(&simulation);
    run(&mut simulation, 0.5);
    let after = thickness(&simulation);
    // By how many layers the later profile is ahead of the earlier one; the ends are left out, which swing freely.
    let difference = |lag: usize| {
        let pairs = (3..18 - lag).map(|k| (after[k + lag] - before[k]).powi(2));
        pairs.sum::<f32>() / (15 - lag) as f32
    };
    let lag = (0..9).min_by(|a, b| difference(*a).total_cmp(&difference(*b))).unwrap();
    // Phase shift 1, two metres, comes 1 / 0.4 s later: 0.4 m in half a second.
    assert!((3..=5).contains(&lag), "{lag}: {before:?} {after:?}");
    let range = |of: &[f32]| of.iter().fold([f32::MAX, f32::MIN], |[l, h], t| [l.min(*t), h.max(*t)]);
    let [thin, thick] = range(&before);
    assert!(thick > 1.15 * thin, "{thin} {thick}");
}

#[test]
fn the_snail_answers_its_touches_from_there_on_and_comes_to_rest_again() {
    let mut simulation = open("snail");
    run(&mut simulation, 0.9);
    assert!(excitations(&simulation, 0).iter().all(|e| *e == 0.0), "the ground is no touch");
    let height = |simulation: &Simulation| mean(simulation, 0, |r| r.y > 0.85).y;
    let (length, start) =
        (|s: &Simulation| mean(s, 0, |r| r.x > 0.9).x - mean(s, 0, |r| r.x < -0.85).x, height(&simulation));
    let at_rest = length(&simulation);
    run(&mut simulation, 0.5);
    let now = excitations(&simulation, 0);
    let ends = |e: &[f32], head: bool| {
        let of = rest(&simulation, 0).iter().zip(e).filter(|(r, _)| if head { r.x > 0.7 } else { r.x < -0.7 });
        of.map(|(_, e)| *e).fold(0.0, f32::min)
    };
    assert!(
        ends(&now, true) < -0.5 && ends(&now, false) == 0.0,
        "the head first: {} {}",
        ends(&now, true),
        ends(&now, false)
    );
    run(&mut simulation, 1.2);
    let shortest = length(&simulation);
    assert!(shortest < 0.85 * at_rest, "it draws in: {shortest} of {at_rest}");
    run_to_the_end(&mut simulation);
    assert!(height(&simulation) > 0.6 * start, "it stands: {} of {start}", height(&simulation));
    let inverted = simulation.soft_figures(&simulation.soft_actors[0]).inverted;
    assert_eq!(inverted, 0, "cells are inside out");
}

#[test]
fn worms_sag_less_with_more_passes_and_little_with_the_solve() {
    let mut simulation = open("stiffness");
    for _ in 0..180 {
        simulation.step();
        let signals = simulation.soft_actors.iter().map(|actor| simulation.soft_figures(actor).stimuli);
        assert_eq!(signals.sum::<usize>(), 0, "hanging is no touch");
    }
    let sags: Vec<f32> = (0..5)
        .map(|worm| mean(&simulation, worm, |r| r.x.abs() < 0.1).y - mean(&simulation, worm, |r| r.x.abs() > 1.1).y)
        .collect();
    let [one, four, sixteen, many, solve] = sags[..] else { panic!("five worms") };
    assert!(one > 0.5 && one > four && four > sixteen && sixteen > many && many < 0.1, "{sags:?}");
    // What is held by few vertices gives way there, however stiff the rest is.
    assert!(solve < sixteen, "{sags:?}");
}

#[test]
fn the_heart_twists_and_shortens_at_each_beat() {
    let mut simulation = open("heart");
    let start = simulation.scene.soft_bodies[0].pose.translation;
    // By how many degrees a band of heights has turned about the vertical.
    let turn = |simulation: &Simulation, from: f32, to: f32| {
        let band = |r: Vec3| (from..to).contains(&r.y);
        let rest_middle = {
            let chosen: Vec<Vec3> = rest(simulation, 0).iter().copied().filter(|r| band(*r)).collect();
            chosen.iter().sum::<Vec3>() / chosen.len() as f32
        };
        let now_middle = mean(simulation, 0, band);
        let pairs = rest(simulation, 0).iter().zip(positions(simulation, 0)).filter(|(r, _)| band(**r));
        let (sine, cosine) = pairs.fold((0.0, 0.0), |(sine, cosine), (r, x)| {
            let (a, b) = (*r - rest_middle, *x - now_middle);
            (sine + a.z * b.x - a.x * b.z, cosine + a.x * b.x + a.z * b.z)
        });
        sine.atan2(cosine).to_degrees()
    };
    let (mut twist, mut shortest) = (0f32, f32::MAX);
    for _ in 0..120 {
        simulation.step();
        twist = twist.max((turn(&simulation, -1.5, -1.15) - turn(&simulation, -0.25, 0.1)).abs());
        let height = mean(&simulation, 0, |r| r.y > -0.1).y - mean(&simulation, 0, |r| r.y < -1.3).y;
        shortest = shortest.min(height);
    }
    assert!(twist > 5.0, "{twist} degrees");
    assert!(shortest < 1.2, "{shortest}");
    assert!(centre(&simulation, 0).distance(start - Vec3::Y * 0.6) < 0.3, "it beats in its place");
}

#[test]
fn the_heart_of_the_scene_empties_its_left_ventricle_by_a_third_and_turns_its_apex() {
    let mut simulation = open("heart");
    let heart = ventricle::Heart::of(&simulation.soft_actors[0].kind.model.boundary, rest(&simulation, 0));
    let (mut least, mut most, mut twist) = (f32::MAX, f32::MIN, 0f32);
    run(&mut simulation, 1.0);
    for _ in 0..120 {
        simulation.step();
        let now = positions(&simulation, 0);
        let volume = heart.volume(now);
        (least, most) = (least.min(volume), most.max(volume));
        twist = twist.max(heart.twist(now).abs());
    }
    println!("volumes {least} to {most} of that at rest, twist {twist} degrees");
    assert!(least < 0.7 * most, "{least} {most}");
    assert!(twist > 5.0, "{twist}");
}

#[test]
fn beads_are_carried_through_the_bowel() {
    let mut simulation = open("bowel");
    let phase = |simulation: &Simulation, name: &str| {
        let bead = simulation.obstacles.iter().find(|o| o.obstacle.name.as_deref() == Some(name)).unwrap();
        let place = bead.pose(&simulation.physics).translation;
        let wall = positions(simulation, 0);
        let nearest = (0..wall.len()).min_by(|&a, &b| wall[a].distance(place).total_cmp(&wall[b].distance(place)));
        simulation.soft_actors[0].kind.model.motion.fields().phase[nearest.unwrap()]
    };
    let start = ["bead", "second bead"].map(|name| phase(&simulation, name));
    assert!((start[0] - 0.2).abs() < 0.1 && (start[1] - 0.5).abs() < 0.1, "{start:?}");
    run_to_the_end(&mut simulation);
    let end = ["bead", "second bead"].map(|name| phase(&simulation, name));
    assert!(end.iter().all(|phase| *phase > 0.85), "{end:?}");
}

#[test]
fn a_seed_moves_the_start_of_a_soft_body() {
    let [written, moved, again] = [0, 3, 3].map(|seed| {
        let mut simulation = Simulation::new(load_scene(find_scene("worm-crawl").unwrap()).unwrap(), seed).unwrap();
        (0..10).for_each(|_| simulation.step());
        positions(&simulation, 0)[0]
    });
    assert!(written.distance(moved) > 1e-2 && moved == again);
}

#[test]
fn an_elastic_ball_bounces_on_a_worm_and_both_go_on() {
    let rigs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/rigs").canonicalize().unwrap();
    let rig = |name: &str| rigs.join(name).display().to_string();
    let text = format!(
        r#"name = "meeting"
duration = 2
substeps = 2
camera = {{ eye = [1.5, 1.6, 5], target = [0, 0.5, 0] }}
[[body]]
name = "ball"
rig = '{}'
position = [0, 1.5, 0]
[[soft_body]]
name = "worm"
rig = '{}'
position = [-0.3, 0.18, 0]
[[obstacle]]
name = "floor"
shape = {{ kind = "cuboid", half_extents = [50, 5, 50] }}
position = [0, -5, 0]
"#,
        rig("ball.toml"),
        rig("worm.toml")
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("meeting.toml");
    std::fs::write(&path, text).unwrap();
    let mut simulation = Simulation::new(load_scene(path).unwrap(), 0).unwrap();
    let handle = simulation.actors[0].handle;
    let mut flattest = f32::MAX;
    for _ in 0..45 {
        simulation.step();
        let ball = simulation.deformation.get(handle).unwrap();
        let heights = ball.positions().iter().map(|x| x.y);
        let (low, high) = heights.fold((f32::MAX, f32::MIN), |(low, high), y| (low.min(y), high.max(y)));
        flattest = flattest.min(high - low);
        assert!(low > -0.02 && ball.is_finite(), "the ball is not in the floor: {low}");
        assert_eq!(simulation.soft_report(&simulation.soft_actors[0]).frozen, None);
    }
    assert!(flattest < 0.93, "the ball is squashed: {flattest}");
    assert!(positions(&simulation, 0).iter().all(|x| x.is_finite()));
}
