//! Two elastic bodies against each other, islands, and the same bits for any number of threads.

use pliant::coupling::{
    ElasticSide, FoundationContact, FoundationMemory, FoundationSettings, PairApproaches, PairPoint, StepSize,
    pair_contacts, push_back, remember_pair_contacts,
};
use pliant::elastic::ContactSettings;
use pliant::math::Vec3;
use pliant::world::ElasticBodyHandle;
use rapier3d::dynamics::RigidBodyHandle;

use crate::scene::{RADIUS, Scene};

/// Where two balls overlap: rings of points of the lens between them.
fn lens(scene: &Scene, a: RigidBodyHandle, b: RigidBodyHandle) -> Vec<PairPoint> {
    let (p, q) = (scene.position(a), scene.position(b));
    let normal = (p - q).normalize();
    let depth = 2.0 * RADIUS - p.distance(q);
    if depth <= 0.0 {
        return Vec::new();
    }
    let (s, t) = normal.any_orthonormal_pair();
    let edge = (RADIUS * RADIUS - (0.5 * p.distance(q)).powi(2)).sqrt();
    let point = |ring: u32, i: u32| {
        let (sin, cos) = (i as f32 * std::f32::consts::TAU / 8.0).sin_cos();
        let r = ring as f32 / 3.0;
        let position = 0.5 * (p + q) + (s * cos + t * sin) * (edge * r);
        PairPoint { bodies: [a, b], position, normal, depth: depth * (1.0 - r * r) }
    };
    let rings = (1..3).flat_map(|ring| (0..8).map(move |i| point(ring, i)));
    std::iter::once(point(0, 0)).chain(rings).collect()
}

struct Pairs {
    scene: Scene,
    approaches: PairApproaches,
    memory: FoundationMemory,
}

impl Pairs {
    fn new(scene: Scene) -> Self {
        Self { scene, approaches: PairApproaches::new(), memory: FoundationMemory::default() }
    }

    fn side(&self, ball: ElasticBodyHandle) -> ElasticSide {
        let Scene { physics, deformation } = &self.scene;
        let (body, ragdoll) = (deformation.get(ball).expect("a body"), deformation.ragdoll(ball).expect("a ragdoll"));
        ElasticSide::of(ball.into_raw_parts(), body, ragdoll, 1.0, &physics.bodies)
    }

    fn step(&mut self, pairs: &[[ElasticBodyHandle; 2]]) {
        self.scene.physics.step();
        let mut contacts: Vec<FoundationContact> = Vec::new();
        for &[a, b] in pairs {
            let points = lens(&self.scene, self.scene.rigid(a), self.scene.rigid(b));
            contacts.extend(pair_contacts([self.side(a), self.side(b)], &points));
        }
        let parameters = &self.scene.physics.integration_parameters;
        let step = StepSize {
            dt: parameters.dt,
            gravity: self.scene.physics.gravity,
            substeps: parameters.num_solver_iterations,
        };
        let bodies = &mut self.scene.physics.bodies;
        remember_pair_contacts(&mut contacts, &mut self.approaches, &step, bodies);
        push_back(&contacts, &step, FoundationSettings::default(), &mut self.memory, bodies);
    }
}

#[test]
fn two_elastic_bodies_push_each_other_apart_with_their_common_restitution_and_keep_their_momentum() {
    for (first, second, expected) in [(0.8, 0.8, 0.8), (0.2, 0.2, 0.2), (0.9, 0.0, 0.6364)] {
        let mut scene = Scene::weightless();
        let a =
            scene.ball(ContactSettings::bouncing(4.0, first, 0.3), Vec3::new(-0.8, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
        let b = scene.ball(ContactSettings::bouncing(4.0, second, 0.3), Vec3::new(0.8, 0.2, 0.0), Vec3::ZERO);
        let (ra, rb) = (scene.rigid(a), scene.rigid(b));
        let mut pairs = Pairs::new(scene);
        let mut normal = Vec3::X;
        for _ in 0..180 {
            pairs.step(&[[a, b]]);
            let between = pairs.scene.position(rb) - pairs.scene.position(ra);
            if between.length() > 2.0 * RADIUS - 0.01 && between.x > 0.0 && pairs.scene.velocity(rb).length() == 0.0 {
                normal = between.normalize();
            }
        }
        let (va, vb) = (pairs.scene.velocity(ra), pairs.scene.velocity(rb));
        assert!((va + vb - Vec3::new(2.0, 0.0, 0.0)).length() < 1e-5, "momentum {}", va + vb);
        let restitution = (vb - va).dot(normal) / (2.0 * normal.x);
        println!("{first} and {second}: {restitution}");
        // Friction turns the normal a little while they touch.
        assert!((restitution - expected).abs() < 0.08, "{first} and {second}: {restitution}, expected {expected}");
    }
}

#[test]
fn an_island_does_not_feel_the_others_and_threads_change_no_bit() {
    let speeds = |count: usize, threads: usize| {
        let mut scene = Scene::weightless();
        let pairs: Vec<[ElasticBodyHandle; 2]> = (0..count)
            .map(|i| {
                let z = 5.0 * i as f32;
                let contact = ContactSettings::bouncing(3.0 + i as f32, 0.5, 0.4);
                let a = scene.ball(contact, Vec3::new(-0.6, 0.0, z), Vec3::new(3.0, 0.3 * i as f32, 0.0));
                [a, scene.ball(contact, Vec3::new(0.6, 0.1, z), Vec3::ZERO)]
            })
            .collect();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut world = Pairs::new(scene);
            for _ in 0..40 {
                world.step(&pairs);
            }
            let of = |ball: &ElasticBodyHandle| {
                let rigid = world.scene.rigid(*ball);
                (world.scene.velocity(rigid), world.scene.physics.bodies[rigid].angvel())
            };
            pairs.iter().flatten().map(of).collect::<Vec<_>>()
        })
    };
    let many = speeds(12, 1);
    assert_eq!(many, speeds(12, 2));
    assert_eq!(many, speeds(12, 4));
    assert_eq!(many[..2], speeds(1, 1)[..], "the first pair alone");
}
