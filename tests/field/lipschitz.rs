//! The bound that each field states against what its gradient really is.

use fastrand::Rng;
use pliant::math::Vec3;

use crate::difference::{jacobian, spectral_norm};
use crate::samples;

#[test]
fn the_stated_bound_is_never_exceeded() {
    let mut rng = Rng::with_seed(6);
    for sample in samples::all(&mut rng) {
        let mut largest = 0.0_f32;
        for _ in 0..4000 {
            let (x, t) = (sample.point(&mut rng), rng.f32());
            let m = jacobian(|x: Vec3| (sample.velocity)(x, t), x, sample.width / 100.0);
            largest = largest.max(spectral_norm(&m));
        }
        // A difference quotient can come out larger than the slope by its rounding, about 1e-4 of it.
        assert!(largest <= sample.bound * 1.001, "{largest} exceeds {} in {}", sample.bound, sample.name);
        assert!(largest >= sample.bound * 0.02, "{largest} is nothing like {} in {}", sample.bound, sample.name);
    }
}

#[test]
fn the_bound_of_the_spring_field_is_tight() {
    let mut rng = Rng::with_seed(7);
    let sample = samples::spring(&mut rng);
    let mut largest = 0.0_f32;
    for _ in 0..60_000 {
        let x = sample.point(&mut rng);
        let m = jacobian(|x: Vec3| (sample.velocity)(x, 0.5), x, sample.width / 100.0);
        largest = largest.max(spectral_norm(&m));
    }
    assert!(largest > 0.99 * sample.bound && largest < 1.0005 * sample.bound, "{largest} {}", sample.bound);
}
