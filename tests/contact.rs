//! Elastic contacts and penetration cancellation on a soft ball.

mod common;

use common::ball_rig;
use pliant::coupling::{Bar, CancelSettings, Placement, RagdollStart, gauge_point};
use pliant::math::{Pose, Vec3};
use pliant::spring::SpringCoefficients;
use pliant::world::{BodyReport, DeformationWorld, ElasticBodyHandle};
use rapier3d::dynamics::RigidBodyBuilder;
use rapier3d::geometry::ColliderBuilder;
use rapier3d::pipeline::PhysicsWorld;

const RADIUS: f32 = 0.5;

struct Drop {
    physics: PhysicsWorld,
    deformation: DeformationWorld,
    ball: ElasticBodyHandle,
}

impl Drop {
    fn new(at: Vec3, velocity: Vec3, spring: SpringCoefficients) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.integration_parameters.dt = 1.0 / 60.0;
        let mut deformation = DeformationWorld::new();
        let start =
            RagdollStart { pose: Pose::from_translation(at), linear_velocity: velocity, ..RagdollStart::default() };
        let ball = deformation.insert(ball_rig(RADIUS, 1.2, spring), &start, &mut physics);
        Self { physics, deformation, ball }
    }

    fn wall(&mut self, at: Vec3, half: Vec3) {
        let body = self.physics.insert_body(RigidBodyBuilder::fixed().translation(at));
        self.physics.insert_collider(ColliderBuilder::cuboid(half.x, half.y, half.z), Some(body));
    }

    fn step(&mut self) -> BodyReport {
        self.physics.step();
        *self.deformation.step(&mut self.physics).body(self.ball).expect("the ball is in the report")
    }

    fn centre(&self) -> Vec3 {
        let handle = self.deformation.ragdoll(self.ball).expect("a ragdoll").bodies[0];
        self.physics.bodies[handle].translation()
    }

    fn extent(&self) -> Vec3 {
        let body = self.deformation.get(self.ball).expect("a body");
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &x in body.positions() {
            (low, high) = (low.min(x), high.max(x));
        }
        high - low
    }
}

#[test]
fn a_soft_ball_squashes_on_a_floor_of_100_m_wherever_it_lands_and_keeps_its_volume() {
    for at in [Vec3::new(0.0, 1.5, 0.0), Vec3::new(43.0, 1.5, -38.0), Vec3::new(-49.0, 1.5, 49.0)] {
        let mut drop = Drop::new(at, Vec3::ZERO, SpringCoefficients::new(3.0, 0.2));
        drop.wall(Vec3::new(0.0, -5.0, 0.0), Vec3::new(50.0, 5.0, 50.0));
        let (mut deepest, mut widest, mut lowest) = (0.0_f32, 0.0_f32, f32::INFINITY);
        for frame in 0..240 {
            let report = drop.step();
            let p = report.penetration;
            assert_eq!(p.vertices_inside, 0, "frame {frame}: {p:?}");
            assert!(p.max_gap < 0.01, "frame {frame}: {p:?}");
            assert!((report.volume_ratio - 1.0).abs() < 1e-3, "frame {frame}: volume {}", report.volume_ratio);
            deepest = deepest.max(p.max_depth_before);
            if p.max_depth_before > 0.2 {
                widest = widest.max(drop.extent().x);
                lowest = lowest.min(drop.extent().y);
            }
        }
        assert!(deepest > 0.1, "it hardly touched: {deepest}");
        assert!(widest > 2.0 * RADIUS * 1.02, "width {widest}");
        assert!(lowest < 2.0 * RADIUS * 0.95, "height {lowest}");
    }
}

fn in_corner(walls: usize, placement: Placement) -> BodyReport {
    let depth = 0.2 * RADIUS;
    let mut at = Vec3::new(RADIUS + 1.0, RADIUS - depth, RADIUS + 1.0);
    let mut drop_walls = vec![(Vec3::new(0.0, -5.0, 0.0), Vec3::new(50.0, 5.0, 50.0))];
    if walls >= 2 {
        at.x = RADIUS - depth;
        drop_walls.push((Vec3::new(-5.0, 0.0, 0.0), Vec3::new(5.0, 50.0, 50.0)));
    }
    if walls >= 3 {
        at.z = RADIUS - depth;
        drop_walls.push((Vec3::new(0.0, 0.0, -5.0), Vec3::new(50.0, 50.0, 5.0)));
    }
    let mut drop = Drop::new(at, Vec3::ZERO, SpringCoefficients::new(3.0, 0.2));
    drop.physics.gravity = Vec3::ZERO;
    for (centre, half) in drop_walls {
        drop.wall(centre, half);
    }
    drop.deformation.settings.cancel = CancelSettings { placement, ..CancelSettings::default() };
    drop.step()
}

#[test]
fn in_corners_of_two_and_three_walls_nothing_is_left_after_four_passes() {
    for walls in [1, 2, 3] {
        let report = in_corner(walls, Placement::Hugging);
        assert!(report.penetration.max_depth_before > 0.1);
        assert!(report.penetration.max_depth_after < 1e-3, "{walls} walls: {report:?}");
        assert!(report.passes <= 4);
        assert!(report.penetration.max_gap < 0.01, "{walls} walls: {report:?}");
        assert!((report.volume_ratio - 1.0).abs() < 2e-3, "{walls} walls: {report:?}");
    }
}

#[test]
fn the_papers_literal_placement_fails_in_the_same_corners() {
    for walls in [2, 3] {
        let report = in_corner(walls, Placement::Literal);
        assert!(
            report.penetration.max_depth_after > 1e-2 || report.penetration.max_gap > 1e-2,
            "{walls} walls: {report:?}"
        );
    }
}

#[test]
fn a_body_thrown_at_20_m_s_at_a_wall_a_tenth_of_its_size_thick_comes_back() {
    for frequency in [1.0, 3.0, 30.0, 1000.0] {
        let spring = SpringCoefficients::new(frequency, 0.2);
        let mut drop = Drop::new(Vec3::new(-2.0, 0.0, 0.0), Vec3::new(20.0, 0.0, 0.0), spring);
        drop.physics.gravity = Vec3::ZERO;
        drop.wall(Vec3::ZERO, Vec3::new(0.05 * RADIUS, 3.0, 3.0));
        for frame in 0..180 {
            let report = drop.step();
            assert!(drop.centre().x < 0.0, "{frequency} Hz, frame {frame}: went through to {}", drop.centre());
            assert_eq!(report.penetration.vertices_inside, 0, "{frequency} Hz, frame {frame}: {report:?}");
        }
        assert!(drop.centre().x < -RADIUS, "{frequency} Hz: stuck at {}", drop.centre());
    }
}

#[test]
fn contacts_of_any_stiffness_come_to_rest_and_never_gain_energy() {
    for frequency in [1.0, 3.0, 10.0, 100.0, 1000.0] {
        for damping_ratio in [0.05, 0.5] {
            let spring = SpringCoefficients::new(frequency, damping_ratio);
            let mut drop = Drop::new(Vec3::new(0.0, 1.5, 0.0), Vec3::ZERO, spring);
            drop.wall(Vec3::new(0.0, -5.0, 0.0), Vec3::new(50.0, 5.0, 50.0));
            let (mut low, mut high) = (f32::INFINITY, 0.0_f32);
            for frame in 0..600 {
                drop.step();
                assert!(
                    drop.centre().y < 1.5 + 1e-3,
                    "{frequency} Hz, ratio {damping_ratio}: rose to {}",
                    drop.centre()
                );
                if frame >= 540 {
                    (low, high) = (low.min(drop.centre().y), high.max(drop.centre().y));
                }
            }
            assert!(high - low < 0.01, "{frequency} Hz, ratio {damping_ratio}: still moves between {low} and {high}");
        }
    }
}

#[test]
fn a_body_that_moves_twice_its_core_in_a_step_does_not_tunnel_either() {
    for offset in [0.0, 0.3, 0.6, 0.9] {
        let spring = SpringCoefficients::new(3.0, 0.2);
        let mut drop = Drop::new(Vec3::new(-3.0 - offset, 0.0, 0.0), Vec3::new(60.0, 0.0, 0.0), spring);
        drop.physics.gravity = Vec3::ZERO;
        drop.wall(Vec3::ZERO, Vec3::new(0.05 * RADIUS, 3.0, 3.0));
        for frame in 0..120 {
            drop.step();
            assert!(drop.centre().x < 0.0, "start {offset}, frame {frame}: went through to {}", drop.centre());
        }
    }
}

#[test]
fn where_many_planes_tilt_together_about_one_axis_the_gauge_point_does_not_run_along_it() {
    // Twelve planes of a ring about y, which tilt a little: they meet at the tip of a steep cone, far off.
    let gauge = |tilt: f32| {
        let bars = (0..12).map(|i| {
            let (sin, cos) = (i as f32 * std::f32::consts::TAU / 12.0).sin_cos();
            let out = Vec3::new(cos, 0.0, sin);
            Bar { point: out * 0.3, normal: (Vec3::Y * tilt - out).normalize(), weight: 1.0 }
        });
        gauge_point(Vec3::X * 0.3, bars.skip(1), 10.0)
    };
    // Across the axis they fix the point: it lies on the axis, but for what ε takes off (a sixteenth) and the missing plane does.
    assert!(gauge(0.0).length() < 0.05, "{}", gauge(0.0));
    for step in 1..50 {
        let tilt = 0.01 * step as f32;
        let (a, b) = (gauge(tilt), gauge(tilt - 0.01));
        assert!(a.distance(b) < 0.03, "from {b} to {a} at a tilt of {tilt}");
    }
    // Two walls of a corner still fix it.
    let corner = [(Vec3::X, Vec3::X), (Vec3::Z, Vec3::Z)].map(|(point, normal)| Bar { point, normal, weight: 1.0 });
    assert!(gauge_point(Vec3::ZERO, corner, 10.0).distance(Vec3::new(1.0, 0.0, 1.0)) < 0.1);
}
