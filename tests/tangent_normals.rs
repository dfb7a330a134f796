//! Normals from two tangent points against the exact rule: a normal is carried by the cofactors of the Jacobian.

#[path = "field/difference.rs"]
#[expect(dead_code, reason = "the Jacobian alone is needed")]
mod difference;
#[path = "common/icosphere.rs"]
mod icosphere;
#[path = "gpu/palettes.rs"]
#[expect(dead_code, reason = "one segment and one kind of palette are enough")]
mod palettes;
#[path = "common/random.rs"]
mod random;

use difference::jacobian;
use fastrand::Rng;
use palettes::{random_palette, skin};
use pliant::elastic::{Palette, SegmentEntry, SpringStage, tangent_epsilon};
use pliant::field::{Integrator, SpringField};
use pliant::math::{Pose, Quat, Vec3};

/// `cof(J) n`: the normal of the deformed tangent plane.
fn carried(palette: &Palette, skin: &palettes::Skin, i: usize) -> Vec3 {
    let j = jacobian(|x: Vec3| palette.deform(x, &skin.weights[i]), skin.positions[i], 0.01);
    let (a, b, c) = (j.x_axis, j.y_axis, j.z_axis);
    let n = skin.normals[i];
    (b.cross(c) * n.x + c.cross(a) * n.y + a.cross(b) * n.z).normalize()
}

/// Differences between the tangent normals of a skin and the carried ones, in rising order.
fn differences(palette: &Palette, skin: &palettes::Skin) -> Vec<f32> {
    let epsilon = tangent_epsilon(&skin.positions);
    let difference = |i: usize| {
        let (x, n) = palette.deform_with_normal(skin.positions[i], skin.normals[i], &skin.weights[i], epsilon);
        assert_eq!(
            x,
            palette.deform(skin.positions[i], &skin.weights[i]),
            "the position does not depend on the normal"
        );
        assert!((n.length() - 1.0).abs() < 1e-5);
        n.distance(carried(palette, skin, i))
    };
    let mut all: Vec<f32> = (0..skin.positions.len()).map(difference).collect();
    all.sort_by(f32::total_cmp);
    all
}

#[test]
fn tangent_normals_are_the_carried_normals_of_a_sphere_in_spring_fields() {
    let stage = |q: Vec3, radius| SpringStage {
        fields: vec![SpringField { p: Vec3::new(0.1, 0.0, 0.2), q, radius }],
        steps: 6,
    };
    let motion = Pose::from_parts(Vec3::new(0.5, -1.0, 2.0), Quat::from_rotation_z(1.0));
    let local = stage(Vec3::new(0.5, 0.1, 0.2), 1.0);
    let entry = SegmentEntry { motion, local, global: stage(Vec3::new(0.1, 0.8, 0.4), 2.0) };
    let palette = Palette { segments: vec![entry], ..Palette::default() };
    let all = differences(&palette, &skin(3, 1));
    // Measured: 1.2e-4 in the middle and 9e-4 at worst.
    assert!(
        all[all.len() / 2] < 3e-4 && all[all.len() - 1] < 2e-3,
        "{:e} {:e}",
        all[all.len() / 2],
        all[all.len() - 1]
    );
}

#[test]
fn tangent_normals_hold_through_blended_segments_and_collision_passes() {
    let mut rng = Rng::with_seed(5);
    let skin = skin(3, 4);
    for _ in 0..6 {
        let all = differences(&random_palette(&mut rng, 4, Integrator::Midpoint), &skin);
        // Where the slope of a collision field jumps there is no one normal, and the reference is as much in doubt.
        let (middle, most) = (all[all.len() / 2], all[all.len() * 95 / 100]);
        assert!(middle < 3e-3 && most < 1.5e-2, "{middle:e} {most:e}");
    }
}

#[test]
fn a_rigid_motion_turns_the_normals_and_keeps_them_outward() {
    let skin = skin(3, 1);
    let stage = SpringStage { fields: Vec::new(), steps: 6 };
    let motion = Pose::from_parts(Vec3::new(3.0, 2.0, -1.0), Quat::from_rotation_x(2.0));
    let entry = SegmentEntry { motion, local: stage.clone(), global: stage };
    let palette = Palette { segments: vec![entry], ..Palette::default() };
    let epsilon = tangent_epsilon(&skin.positions);
    for (i, &normal) in skin.normals.iter().enumerate() {
        let (_, turned) = palette.deform_with_normal(skin.positions[i], normal, &skin.weights[i], epsilon);
        assert!(turned.distance(motion.rotation * normal) < 1e-3);
        let (_, kept) = palette.deform_with_normal(skin.positions[i], normal, &skin.weights[i], 0.0);
        assert_eq!(kept, normal, "three points that are one have no normal of their own");
    }
}
