//! What one body gets, another one gives: the momentum of a closed system stays.

use pliant::elastic::ContactSettings;
use pliant::math::{Pose, Vec3};
use rapier3d::dynamics::{RigidBody, RigidBodyBuilder};
use rapier3d::geometry::{ColliderBuilder, SharedShape};
use rapier3d::utils::AngularInertiaOps;

use crate::scene::Scene;

/// A weightless room that floats freely, with soft balls and crates flying about in it. All inertias are those of
/// balls and cubes: rapier keeps the angular velocity of other bodies, not their angular momentum. Its own contacts change the
/// angular momentum of the whole a little, so what the impulses change is measured apart from that.
fn room(gravity: Vec3) -> Scene {
    let mut scene = Scene::new();
    scene.physics.gravity = gravity;
    let room = scene.physics.insert_body(RigidBodyBuilder::dynamic().can_sleep(false));
    for side in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]) {
        let half = Vec3::splat(2.5) - side.abs() * 2.25;
        let wall = ColliderBuilder::new(SharedShape::cuboid(half.x, half.y, half.z));
        scene.physics.insert_collider(wall.position(Pose::from_translation(side * 2.25)).mass(3.0), Some(room));
    }
    let bouncy = ContactSettings::bouncing(4.0, 0.8, 0.5);
    let soft = ContactSettings::bouncing(2.5, 0.4, 0.7);
    scene.ball(bouncy, Vec3::new(-1.2, -1.0, 0.2), Vec3::new(5.0, 3.0, -2.0));
    scene.ball(soft, Vec3::new(1.2, 1.0, -0.3), Vec3::new(-4.0, -1.0, 3.0));
    scene.ball(bouncy, Vec3::new(0.1, 0.3, 1.2), Vec3::new(0.0, 6.0, 1.0));
    for (x, mass) in [(-1.0, 0.5), (0.0, 2.0), (1.0, 8.0)] {
        let body = scene.crate_at(0.25, mass, Vec3::new(x, -1.5, -1.2));
        scene.physics.bodies[body].set_angvel(Vec3::new(1.0, 2.0, x), true);
    }
    // Rapier makes the masses in its first step; nothing touches yet.
    scene.physics.step();
    scene
}

/// Momentum and angular momentum about the origin.
pub fn momenta(scene: &Scene) -> (Vec3, Vec3) {
    let of = |(_, body): (_, &RigidBody)| {
        let momentum = body.linvel() * body.mass();
        let spin = body.mass_properties().effective_world_inv_inertia.inverse() * body.angvel();
        (momentum, body.center_of_mass().cross(momentum) + spin)
    };
    scene.physics.bodies.iter().map(of).fold((Vec3::ZERO, Vec3::ZERO), |(p, l), (q, m)| (p + q, l + m))
}

/// Sums of what single bodies have: the measure for the relative error.
fn amounts(scene: &Scene) -> f32 {
    scene.physics.bodies.iter().map(|(_, body)| body.linvel().length() * body.mass()).sum()
}

#[test]
fn a_closed_system_of_balls_and_crates_keeps_its_momentum_for_ten_seconds() {
    let mut scene = room(Vec3::ZERO);
    let (start, amount) = (momenta(&scene), amounts(&scene));
    let (mut worst, mut turned, mut by_rapier) = (0.0_f32, Vec3::ZERO, Vec3::ZERO);
    for frame in 0..600 {
        let before = momenta(&scene).1;
        scene.physics.step();
        let between = momenta(&scene);
        scene.deformation.step(&mut scene.physics);
        let now = momenta(&scene);
        by_rapier += between.1 - before;
        turned += now.1 - between.1;
        worst = worst.max(now.0.distance(start.0) / amount);
        assert!(turned.length() < 1e-4 * amount, "frame {frame}: turned by {turned}");
    }
    println!(
        "relative errors: momentum {worst:.2e}, angular momentum {:.2e} by the impulses, {:.2e} by rapier's contacts",
        turned.length() / amount,
        by_rapier.length() / amount
    );
    assert!(worst < 1e-4, "momentum {worst}");
}

#[test]
fn crates_and_balls_that_touch_softly_keep_their_angular_momentum_about_a_fixed_point() {
    let mut scene = Scene::weightless();
    let contact = ContactSettings::bouncing(5.0, 0.5, 0.5);
    scene.ball(contact, Vec3::new(-1.5, 0.1, 0.05), Vec3::new(3.0, 0.0, 0.0));
    let struck = scene.crate_at(0.5, 2.0, Vec3::ZERO);
    scene.physics.bodies[struck].set_angvel(Vec3::new(1.0, 2.0, 0.5), true);
    scene.ball(contact, Vec3::new(2.0, -0.2, 0.3), Vec3::new(-0.5, 0.2, 0.0));
    scene.physics.step();
    let (start, amount) = (momenta(&scene), amounts(&scene));
    for _ in 0..600 {
        scene.step();
    }
    let now = momenta(&scene);
    let errors = [now.0.distance(start.0) / amount, now.1.distance(start.1) / amount];
    println!("relative errors: momentum {:.2e}, angular momentum {:.2e}", errors[0], errors[1]);
    assert!(errors[0] < 1e-4 && errors[1] < 1e-4, "{errors:?}");
    assert!((scene.velocity(struck) - Vec3::ZERO).length() > 0.1, "nothing touched");
}

#[test]
fn in_free_fall_the_momentum_grows_as_gravity_says_and_nothing_else() {
    let gravity = Vec3::new(0.0, -9.81, 0.0);
    let mut scene = room(gravity);
    let (start, amount) = (momenta(&scene).0, amounts(&scene));
    let mass: f32 = scene.physics.bodies.iter().map(|(_, body)| body.mass()).sum();
    for frame in 1..=600 {
        scene.step();
        let expected = start + gravity * (mass * frame as f32 / 60.0);
        let error = momenta(&scene).0.distance(expected);
        assert!(error < 1e-4 * (amount + expected.length()), "frame {frame}: {error}");
    }
}

#[test]
fn soft_bodies_among_each_other_and_crates_never_gain_kinetic_energy() {
    let mut scene = room(Vec3::ZERO);
    let energy = |scene: &Scene| scene.physics.bodies.iter().map(|(_, body)| body.kinetic_energy()).sum::<f32>();
    let start = energy(&scene);
    for frame in 0..1200 {
        scene.step();
        assert!(energy(&scene) < start * 1.0001, "frame {frame}: {} after {start}", energy(&scene));
    }
    assert!(energy(&scene) < 0.8 * start, "hardly anything touched");
}
