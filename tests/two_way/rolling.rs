//! A soft ball rolls as a ball of its inertia does.

use pliant::elastic::ContactSettings;
use pliant::math::Vec3;

use crate::scene::{RADIUS, Scene};

#[test]
fn a_soft_ball_rolls_down_a_plane_with_the_acceleration_of_its_inertia() {
    for (frequency, degrees) in [(3.0, 5.0_f32), (3.0, 15.0), (8.0, 15.0), (20.0, 10.0)] {
        let mut scene = Scene::new();
        let (sin, cos) = degrees.to_radians().sin_cos();
        scene.physics.gravity = 9.81 * Vec3::new(sin, -cos, 0.0);
        scene.floor();
        let contact = ContactSettings::bouncing(frequency, 0.5, 0.8);
        let ball = scene.ball(contact, Vec3::new(-100.0, RADIUS - 0.01, 0.0), Vec3::ZERO);
        let rigid = scene.rigid(ball);
        let mut before = Vec3::ZERO;
        for frame in 0..120 {
            scene.step();
            if frame == 29 {
                before = scene.velocity(rigid);
            }
        }
        let acceleration = (scene.velocity(rigid).x - before.x) / 1.5;
        let expected = 5.0 / 7.0 * 9.81 * sin;
        let spin = -scene.physics.bodies[rigid].angvel().z;
        // It rolls on a radius between its own and the height of its centre.
        let height = 0.5 * (RADIUS + scene.position(rigid).y);
        let slip = scene.velocity(rigid).x - spin * height;
        println!("{frequency} Hz, {degrees}°: {acceleration:.3} expected {expected:.3}, slip {slip:.3}, spin {spin}");
        assert!((acceleration / expected - 1.0).abs() < 0.1, "{frequency} Hz, {degrees}°: {acceleration}, {expected}");
        assert!(slip.abs() < 0.05 * scene.velocity(rigid).x, "{frequency} Hz, {degrees}°: slips at {slip}");
    }
}

#[test]
fn a_ball_that_is_thrown_flat_slides_then_rolls_and_stops_by_itself() {
    let mut scene = Scene::new();
    scene.floor();
    let contact = ContactSettings::bouncing(3.0, 0.5, 0.6);
    let ball = scene.ball(contact, Vec3::new(0.0, RADIUS - 0.02, 0.0), Vec3::new(2.0, 0.0, 0.0));
    let rigid = scene.rigid(ball);
    let mut stopped = None;
    for frame in 0..3600 {
        scene.step();
        let spin = scene.physics.bodies[rigid].angvel();
        assert!(spin.length() < 2.0 / (RADIUS - 0.1), "spins up to {spin}");
        assert!(spin.x.abs() < 0.12 && spin.y.abs() < 0.12, "turns aside: {spin}");
        if scene.physics.bodies[rigid].is_sleeping() {
            stopped = Some(frame);
            break;
        }
    }
    println!("stopped after {stopped:?} frames at {}", scene.position(rigid));
    assert!(stopped.is_some(), "still rolls at {} after a minute", scene.velocity(rigid));
}

#[test]
fn a_ball_on_a_rough_slope_does_not_creep_uphill_and_a_cushion_stays() {
    use crate::scene::cushion_rig;
    let mut scene = Scene::new();
    let (sin, cos) = 12_f32.to_radians().sin_cos();
    scene.physics.gravity = 9.81 * Vec3::new(sin, -cos, 0.0);
    scene.floor();
    let rig = cushion_rig(Vec3::new(0.6, 0.3, 0.6), 4.0, ContactSettings::bouncing(4.0, 0.2, 0.8));
    let cushion = scene.body(&rig, Vec3::new(0.0, 0.29, 0.0), Vec3::ZERO);
    let rigid = scene.rigid(cushion);
    let mut at = Vec3::ZERO;
    for frame in 0..600 {
        scene.step();
        if frame == 119 {
            at = scene.position(rigid);
        }
    }
    let moved = scene.position(rigid).distance(at);
    println!("cushion on a slope moved {moved}, asleep {}", scene.physics.bodies[rigid].is_sleeping());
    assert!(moved < 0.002, "creeps by {moved}");
}
