//! Fast bodies, thin obstacles, spinning bars, teleports.

use pliant::elastic::ContactSettings;
use pliant::math::Vec3;
use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier3d::geometry::ColliderBuilder;

use crate::scene::{RADIUS, Scene};

fn energy(scene: &Scene) -> f32 {
    scene.physics.bodies.iter().filter(|(_, body)| body.is_dynamic()).map(|(_, body)| body.kinetic_energy()).sum()
}

fn obstacle(scene: &mut Scene, collider: ColliderBuilder, body: RigidBodyBuilder) -> RigidBodyHandle {
    let body = scene.physics.insert_body(body);
    scene.physics.insert_collider(collider, Some(body));
    body
}

#[test]
fn plates_bars_and_wires_stop_fast_balls_and_give_back_no_more_than_they_got() {
    for speed in [20.0, 60.0] {
        for (kind, collider) in [
            ("plate", ColliderBuilder::cuboid(0.01, 3.0, 3.0)),
            ("bar", ColliderBuilder::capsule_y(3.0, 0.05)),
            ("wire", ColliderBuilder::capsule_y(3.0, 0.004)),
        ] {
            for phase in [0.0, 0.35, 0.7] {
                let mut scene = Scene::weightless();
                obstacle(&mut scene, collider.clone(), RigidBodyBuilder::fixed());
                let contact = ContactSettings::bouncing(4.0, 0.5, 0.4);
                let ball = scene.ball(contact, Vec3::new(-3.0 - phase, 0.0, 0.0), Vec3::new(speed, 0.0, 0.0));
                let rigid = scene.rigid(ball);
                scene.physics.step();
                let start = energy(&scene);
                for frame in 0..120 {
                    scene.step();
                    assert!(energy(&scene) <= start * 1.001, "{kind} at {speed} m/s, frame {frame}: gains energy");
                    assert!(scene.position(rigid).x < 0.0, "{kind} at {speed} m/s, frame {frame}: went through");
                }
                let rebound = -scene.velocity(rigid).x / speed;
                println!("{kind} {speed} m/s phase {phase}: rebound {rebound:.3}");
                assert!(rebound > 0.2 && rebound < 0.55, "{kind} at {speed} m/s: rebound {rebound}");
            }
        }
    }
}

#[test]
fn a_spinning_bar_bats_a_ball_away_no_faster_than_its_tip_allows() {
    let mut scene = Scene::weightless();
    let contact = ContactSettings::bouncing(6.0, 0.5, 0.4);
    let ball = scene.ball(contact, Vec3::new(1.5, 0.0, 0.9), Vec3::ZERO);
    let rigid = scene.rigid(ball);
    let spin = 6.0;
    obstacle(
        &mut scene,
        ColliderBuilder::cuboid(2.0, 0.2, 0.05),
        RigidBodyBuilder::kinematic_velocity_based().angvel(Vec3::new(0.0, -spin, 0.0)),
    );
    let mut fastest = 0.0_f32;
    for _ in 0..300 {
        scene.step();
        fastest = fastest.max(scene.velocity(rigid).length());
    }
    println!("batted at {fastest}");
    // The tip's speed, and as much again times the restitution.
    assert!(fastest > 0.8 * spin * 1.5 && fastest < 1.6 * spin * 2.0, "{fastest}");
}

#[test]
fn a_free_bar_that_spins_into_a_ball_shares_its_energy() {
    let mut scene = Scene::weightless();
    let contact = ContactSettings::bouncing(6.0, 0.7, 0.4);
    scene.ball(contact, Vec3::new(1.5, 0.0, 0.9), Vec3::ZERO);
    obstacle(
        &mut scene,
        ColliderBuilder::cuboid(2.0, 0.2, 0.05).mass(2.0),
        RigidBodyBuilder::dynamic().angvel(Vec3::new(0.0, -8.0, 0.0)),
    );
    scene.physics.step();
    let start = energy(&scene);
    for frame in 0..300 {
        scene.step();
        assert!(energy(&scene) <= start * 1.001, "frame {frame}: {} after {start}", energy(&scene));
    }
    assert!(energy(&scene) < 0.98 * start, "they did not meet");
}

#[test]
fn a_ball_that_appears_inside_an_obstacle_is_let_out_gently() {
    for depth in [0.1, 0.3, 0.6, 1.2] {
        let mut scene = Scene::weightless();
        obstacle(&mut scene, ColliderBuilder::cuboid(0.6, 0.6, 0.6), RigidBodyBuilder::fixed());
        let contact = ContactSettings::bouncing(4.0, 0.9, 0.4);
        let ball = scene.ball(contact, Vec3::new(0.0, 5.0, 0.0), Vec3::ZERO);
        let rigid = scene.rigid(ball);
        scene.step();
        scene.physics.bodies[rigid].set_translation(Vec3::new(0.02, 0.6 + RADIUS - depth, 0.01), true);
        let mut fastest = 0.0_f32;
        for frame in 0..600 {
            scene.step();
            assert!(scene.position(rigid).is_finite(), "{depth}, frame {frame}");
            fastest = fastest.max(scene.velocity(rigid).length());
        }
        println!("depth {depth}: fastest {fastest}, end {} {}", scene.position(rigid), scene.velocity(rigid));
        assert!(fastest < 6.5 * depth.max(0.5), "{depth}: shot out at {fastest}");
    }
}
