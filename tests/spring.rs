//! Mass-spring sets: the closed form against a fine integration, stability and the limit.

use pliant::math::Vec3;
use pliant::spring::{MassSpringSet, SpringCoefficients};

/// Integrates the same set with tiny symplectic steps in f64: an independent reference.
fn reference(spring: SpringCoefficients, y0: f64, v0: f64, gravity: f64, time: f64) -> (f64, f64) {
    let omega = std::f64::consts::TAU * f64::from(spring.natural_frequency);
    let zeta = f64::from(spring.damping_ratio);
    let n = 200_000;
    let h = time / f64::from(n);
    let acceleration = |y: f64, v: f64| gravity - omega * omega * y - 2.0 * zeta * omega * v;
    let (mut y, mut v) = (y0, v0);
    for _ in 0..n {
        let (ym, vm) = (y + 0.5 * h * v, v + 0.5 * h * acceleration(y, v));
        y += h * vm;
        v += h * acceleration(ym, vm);
    }
    (y, v)
}

#[test]
fn the_closed_form_agrees_with_a_fine_integration_for_every_kind_of_damping() {
    for damping_ratio in [0.0, 0.1, 0.999_99, 1.0, 1.000_01, 3.0] {
        let spring = SpringCoefficients::new(2.5, damping_ratio);
        let gravity = Vec3::new(0.0, -9.81, 0.0);
        let mut set = MassSpringSet { p: Vec3::ZERO, q: Vec3::new(0.0, 0.3, 0.0), velocity: Vec3::new(0.0, -1.0, 0.0) };
        for _ in 0..20 {
            set = set.stepped(Vec3::ZERO, 1.0 / 60.0, spring, gravity, 10.0);
        }
        let (y, v) = reference(spring, 0.3, -1.0, -9.81, 20.0 / 60.0);
        assert!((f64::from(set.q.y) - y).abs() < 2e-5, "zeta {damping_ratio}: {} against {y}", set.q.y);
        assert!((f64::from(set.velocity.y) - v).abs() < 3e-4, "zeta {damping_ratio}: {} against {v}", set.velocity.y);
    }
}

#[test]
fn one_large_step_lands_where_many_small_ones_do() {
    let spring = SpringCoefficients::new(1.3, 0.2);
    let start = MassSpringSet { p: Vec3::ZERO, q: Vec3::X, velocity: Vec3::Y };
    let once = start.stepped(Vec3::Z, 0.5, spring, Vec3::ZERO, 100.0);
    let mut often = start;
    for i in 1..=50 {
        often = often.stepped(Vec3::Z * (i as f32 / 50.0), 0.01, spring, Vec3::ZERO, 100.0);
    }
    assert!((once.q - often.q).length() < 1e-4, "{} {}", once.q, often.q);
}

#[test]
fn no_frequency_damping_or_step_makes_a_set_explode() {
    for frequency in [1e-3, 1.0, 60.0, 1e3, 1e6] {
        for damping_ratio in [0.0, 1e-3, 1.0, 50.0, 1e6] {
            for h in [1e-6, 1.0 / 60.0, 1.0, 100.0] {
                let spring = SpringCoefficients::new(frequency, damping_ratio);
                let mut set = MassSpringSet { p: Vec3::ZERO, q: Vec3::X, velocity: Vec3::ZERO };
                for _ in 0..200 {
                    set = set.stepped(Vec3::ZERO, h, spring, Vec3::ZERO, f32::MAX);
                    assert!(set.q.length() < 1.01, "{frequency} Hz, ratio {damping_ratio}, step {h}: {}", set.q);
                }
            }
        }
    }
}

#[test]
fn the_limit_holds_the_mass_back_even_when_the_anchor_teleports() {
    let spring = SpringCoefficients::new(2.0, 0.1);
    let mut set = MassSpringSet::at_rest(Vec3::ZERO);
    for i in 0..100 {
        let p = if i == 50 { Vec3::splat(1000.0) } else { Vec3::splat((i / 50) as f32 * 1000.0) };
        set = set.stepped(p, 1.0 / 60.0, spring, Vec3::ZERO, 0.2);
        assert!(set.displacement().length() <= 0.2001);
    }
    assert!(set.is_finite());
}

#[test]
fn the_papers_mass_stiffness_and_damping_convert_both_ways() {
    let spring = SpringCoefficients::from_mass_stiffness_damping(2.0, 300.0, 7.0);
    let (stiffness, damping) = spring.stiffness_damping(2.0);
    assert!((stiffness - 300.0).abs() < 1e-3 && (damping - 7.0).abs() < 1e-5);
}

#[test]
fn a_spring_made_from_a_restitution_has_it() {
    for restitution in [0.0, 0.05, 0.3, 0.6, 0.9, 1.0] {
        let spring = SpringCoefficients::from_restitution(3.0, restitution);
        assert!(spring.is_valid());
        assert!((spring.restitution() - restitution).abs() < 1e-5, "{restitution}: {}", spring.restitution());
    }
}
