//! The compute pass against the processor: random palettes with every kind of field, part and integrator.
//!
//! Without a device the tests say so and pass; with `PLIANT_REQUIRE_GPU=1` in the environment they fail instead.
#![cfg(feature = "gpu")]

#[path = "gpu/device.rs"]
mod device;
#[path = "common/icosphere.rs"]
mod icosphere;
#[path = "gpu/palettes.rs"]
mod palettes;
#[path = "common/random.rs"]
mod random;

use device::Gpu;
use fastrand::Rng;
use palettes::{Skin, random_palette, skin};
use pliant::elastic::{DragField, DragStage, Palette, SegmentEntry, SpringStage};
use pliant::field::{Integrator, SpringField};
use pliant::gpu::{GpuBody, GpuError, GpuSkin};
use pliant::math::{Pose, Quat, Vec3};

const INTEGRATORS: [Integrator; 3] = [Integrator::Euler, Integrator::Midpoint, Integrator::RungeKutta4];

/// Largest differences of positions and normals between the device and the processor.
fn differences(gpu: &Gpu, skin: &Skin, palette: &Palette) -> (f32, f32, u64) {
    let rest = GpuSkin::from_parts(&gpu.device, &skin.positions, &skin.normals, &skin.weights).expect("a skin");
    let mut body = GpuBody::new(&gpu.device, &rest);
    let mut encoder = gpu.encoder();
    gpu.pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &rest, &mut body, palette).expect("a palette that fits");
    gpu.queue.submit([encoder.finish()]);
    let positions = gpu.read(body.positions());
    let normals = gpu.read(body.normals());
    let (mut position_error, mut normal_error) = (0.0_f32, 0.0_f32);
    for i in 0..skin.positions.len() {
        let (x, n) = palette.deform_with_normal(skin.positions[i], skin.normals[i], &skin.weights[i], rest.epsilon());
        assert_eq!((positions[i][3], normals[i][3]), (1.0, 0.0));
        // `max` ignores NaN, a sum does not.
        let position_difference = (Vec3::from_slice(&positions[i][..3]) - x).length();
        let normal_difference = (Vec3::from_slice(&normals[i][..3]) - n).length();
        assert!((position_difference + normal_difference).is_finite(), "vertex {i}: {:?}", positions[i]);
        position_error = position_error.max(position_difference);
        normal_error = normal_error.max(normal_difference);
    }
    (position_error, normal_error, body.palette_bytes())
}

#[test]
fn the_device_deforms_random_palettes_as_the_processor_does() {
    let Some(gpu) = Gpu::open() else { return };
    let mut rng = Rng::with_seed(5);
    let skin = skin(3, 4);
    let (mut worst_position, mut worst_normal, mut bytes) = (0.0_f32, 0.0_f32, 0..0);
    for round in 0..12 {
        let palette = random_palette(&mut rng, 4, INTEGRATORS[round % 3]);
        let moved = skin.positions.iter().zip(&skin.weights).any(|(&x, weights)| {
            let without = Palette { passes: Vec::new(), ..palette.clone() };
            (palette.deform(x, weights) - without.deform(x, weights)).length() > 0.05
        });
        assert!(moved, "the collision passes of round {round} reach the body");
        let (position, normal, size) = differences(gpu, &skin, &palette);
        worst_position = worst_position.max(position);
        worst_normal = worst_normal.max(normal);
        bytes = if round == 0 { size..size } else { bytes.start.min(size)..bytes.end.max(size) };
    }
    eprintln!("positions {worst_position:e}, normals {worst_normal:e}, palettes {bytes:?} bytes");
    // The body's size is 2. Normals lose 2⁻²² · size / ε, about 5e-4, for every step or so that rounds.
    assert!(worst_position < 1e-4 * 2.0, "{worst_position:e}");
    assert!(worst_normal < 5e-3, "{worst_normal:e}");
}

#[test]
fn every_kind_of_part_agrees_by_itself() {
    let Some(gpu) = Gpu::open() else { return };
    let mut rng = Rng::with_seed(6);
    let skin = skin(2, 1);
    for kind in 0..random::SHAPES {
        let palette = palettes::single_part(&mut rng, kind);
        let (position, normal, _) = differences(gpu, &skin, &palette);
        assert!(position < 1e-4, "kind {kind}: positions {position:e}");
        assert!(normal < 5e-3, "kind {kind}: normals {normal:e}");
    }
}

#[test]
fn draggers_deform_the_same_on_the_device() {
    let Some(gpu) = Gpu::open() else { return };
    let skin = skin(3, 4);
    let motion = Pose::from_parts(Vec3::new(2.0, 1.0, -1.0), Quat::from_rotation_z(0.4));
    let entry = SegmentEntry { motion, local: SpringStage::default(), global: SpringStage::default() };
    let held = [10, 200, 400].map(|v| (skin.positions[v], skin.weights[v]));
    let field = |(x, weights): &(Vec3, _)| {
        let p = motion.transform_point(*x);
        DragField::new(SpringField { p, q: p + motion.rotation * *x * 0.8, radius: 0.7 }, weights)
    };
    let drags = DragStage::certified(held.iter().map(field).collect(), Integrator::Midpoint, 24);
    for integrator in INTEGRATORS {
        let palette =
            Palette { segments: vec![entry.clone(); 4], drags: drags.clone(), integrator, ..Palette::default() };
        let pulled = palette.deform(held[0].0, &held[0].1).distance(motion.transform_point(held[0].0));
        assert!(pulled > 0.5, "{pulled}");
        let (position, normal, _) = differences(gpu, &skin, &palette);
        // As above, for a body of size 2.
        assert!(position < 2e-4, "{integrator:?}: positions {position:e}");
        assert!(normal < 5e-3, "{integrator:?}: normals {normal:e}");
    }
}

#[test]
fn a_palette_that_outgrows_its_buffer_still_agrees_and_says_how_large_it_is() {
    let Some(gpu) = Gpu::open() else { return };
    let skin = skin(2, 1);
    let rest = GpuSkin::from_parts(&gpu.device, &skin.positions, &skin.normals, &skin.weights).expect("a skin");
    let mut body = GpuBody::new(&gpu.device, &rest);
    let mut rng = Rng::with_seed(7);
    let small = random_palette(&mut rng, 1, Integrator::Midpoint);
    let large = random_palette(&mut rng, 40, Integrator::Midpoint);
    for palette in [&small, &large, &small] {
        let mut encoder = gpu.encoder();
        gpu.pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &rest, &mut body, palette).expect("it fits");
        gpu.queue.submit([encoder.finish()]);
        let positions = gpu.read(body.positions());
        for (i, &x) in skin.positions.iter().enumerate() {
            let expected = palette.deform(x, &skin.weights[i]);
            assert!((Vec3::from_slice(&positions[i][..3]) - expected).length() < 2e-4);
        }
        let fields = palette.segments.iter().map(|s| s.local.fields.len() + s.global.fields.len()).sum::<usize>();
        let least = 16 * (2 + 4 * palette.segments.len() + 2 * fields) as u64;
        assert!(body.palette_bytes() >= least && body.palette_bytes().is_multiple_of(16));
    }
}

#[test]
fn a_hull_that_many_fields_share_is_packed_once() {
    let Some(gpu) = Gpu::open() else { return };
    let skin = skin(1, 1);
    let mut palette = palettes::single_part(&mut Rng::with_seed(8), 6);
    let (_, _, once) = differences(gpu, &skin, &palette);
    let field = palette.passes[0].fields[0].clone();
    palette.passes[0].fields.push(field);
    let (_, _, twice) = differences(gpu, &skin, &palette);
    assert_eq!(twice - once, (9 + 1) * 16, "one more collision field and its shares, no more triangles");
}

#[test]
fn normals_stay_smooth_far_away_from_the_origin_of_the_world() {
    let Some(gpu) = Gpu::open() else { return };
    let skin = skin(3, 1);
    let motion = Pose::from_parts(Vec3::new(3000.0, -200.0, 1000.0), Quat::from_rotation_x(0.7));
    let stage = SpringStage { fields: Vec::new(), steps: 6 };
    let entry = SegmentEntry { motion, local: stage.clone(), global: stage };
    let palette = Palette { segments: vec![entry], ..Palette::default() };
    let rest = GpuSkin::from_parts(&gpu.device, &skin.positions, &skin.normals, &skin.weights).expect("a skin");
    let mut body = GpuBody::new(&gpu.device, &rest);
    let mut encoder = gpu.encoder();
    gpu.pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &rest, &mut body, &palette).expect("it fits");
    gpu.queue.submit([encoder.finish()]);
    for (normal, rest) in gpu.read(body.normals()).iter().zip(&skin.normals) {
        assert!((Vec3::from_slice(&normal[..3]) - motion.rotation * rest).length() < 1e-3);
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let Some(gpu) = Gpu::open() else { return };
    let [small, large] = [skin(1, 1), skin(2, 3)];
    let [first, second] = [&small, &large]
        .map(|s| GpuSkin::from_parts(&gpu.device, &s.positions, &s.normals, &s.weights).expect("a skin"));
    let palette = random_palette(&mut Rng::with_seed(9), 2, Integrator::Euler);
    let mut encoder = gpu.encoder();
    let mut body = GpuBody::new(&gpu.device, &first);
    let refused = gpu.pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &second, &mut body, &palette);
    assert_eq!(refused, Err(GpuError::OtherSkin { body: first.vertices(), skin: second.vertices() }));
    let mut body = GpuBody::new(&gpu.device, &second);
    let refused = gpu.pipeline.encode(&gpu.device, &gpu.queue, &mut encoder, &second, &mut body, &palette);
    assert_eq!(refused, Err(GpuError::MissingSegments { needed: 3, given: 2 }));
}
