use crate::scene::*;
use pliant::elastic::ContactSettings;
use pliant::math::Vec3;
#[test]
fn debug_bounce() {
    let mut scene = Scene::new();
    scene.floor();
    let ball = scene.ball(
        ContactSettings::bouncing(12.0, 0.0, 0.5),
        Vec3::new(0.0, RADIUS + 0.05, 0.0),
        Vec3::new(0.0, -10.0, 0.0),
    );
    let rigid = scene.rigid(ball);
    for _ in 0..12 {
        scene.physics.step();
        print!("h {:.4} v {:.3} -> ", scene.position(rigid).y - RADIUS, scene.velocity(rigid).y);
        scene.deformation.step(&mut scene.physics);
        println!("{:.3}", scene.velocity(rigid).y);
    }
}
#[test]
fn debug_momentum() {
    for crates in [0, 1] {
        for speed in [1.0, 5.0] {
            let mut scene = Scene::weightless();
            let c = ContactSettings::bouncing(5.0, 0.5, 0.5);
            let ball = scene.ball(c, Vec3::new(-1.5, 0.1, 0.05), Vec3::new(speed, 0.0, 0.0));
            let b = scene.crate_at(0.5, 2.0, Vec3::ZERO);
            if crates == 1 {
                scene.crate_at(0.5, 2.0, Vec3::new(1.1, 0.2, 0.2));
            }
            scene.physics.bodies[b].set_angvel(Vec3::new(1.0, 2.0, 0.5), true);
            let _ = ball;
            scene.physics.step();
            let start = crate::momentum::momenta(&scene);
            for f in 0..200 {
                scene.step();
                let now = crate::momentum::momenta(&scene);
                if f % 20 == 19 {
                    println!("{crates} {speed} {f} {:.2e} {:.2e}", now.0.distance(start.0), now.1.distance(start.1));
                }
            }
        }
    }
}
#[test]
fn debug_stack() {
    let mut scene = Scene::new();
    scene.floor();
    let soft = ContactSettings { spring: pliant::spring::SpringCoefficients::new(4.0, 0.4), friction: 0.7 };
    let n: usize = std::env::var("N").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let cushion = scene.body(&cushion_rig(Vec3::new(1.0, 0.4, 1.0), 10.0, soft), Vec3::new(0.0, 0.4, 0.0), Vec3::ZERO);
    let c = scene.rigid(cushion);
    let bodies: Vec<_> =
        (0..n).map(|i| scene.crate_at(0.25, 1.0, Vec3::new(0.0, 1.06 + 0.501 * i as f32, 0.0))).collect();
    let b = bodies[0];
    for f in 0..120 {
        scene.physics.step();
        let v = scene.velocity(b);
        scene.deformation.step(&mut scene.physics);
        println!(
            "{f} cushion {:.4} crate {:.4} v {:.4} -> {:.4} w {:.3} top {:.3}",
            scene.position(c).y,
            scene.position(b),
            v,
            scene.velocity(b),
            scene.physics.bodies[b].angvel(),
            scene.position(bodies[n - 1])
        );
    }
}
