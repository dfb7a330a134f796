//! Every field is free of divergence.

use fastrand::Rng;
use pliant::field::curl_of_weighted_rotation;
use pliant::math::Vec3;

use crate::difference::{jacobian, trace};
use crate::samples;

#[test]
fn the_divergence_of_every_field_is_zero() {
    let mut rng = Rng::with_seed(1);
    for sample in samples::all(&mut rng) {
        let mut across = 0;
        for _ in 0..1000 {
            let (x, t) = (sample.point(&mut rng), rng.f32());
            // At this step rounding leaves some 1e-4 of the bound, and the third derivative, which jumps where a field
            // begins and ends, less. A wrong sign or factor leaves tenths.
            let m = jacobian(|x: Vec3| (sample.velocity)(x, t), x, sample.width / 500.0);
            if trace(&m).abs() > 2e-3 * sample.bound {
                across += 1;
            }
        }
        // Around a part with faces and edges the slope of the field jumps from region to region; a difference across such
        // a border is neither of the two slopes. The borders are surfaces: few differences cross one.
        let allowed = if sample.kinks { 30 } else { 0 };
        assert!(across <= allowed, "not zero at {across} of 1000 points of {}", sample.name);
    }
}

#[test]
fn the_curl_formula_is_free_of_divergence_for_any_weight() {
    let mut rng = Rng::with_seed(2);
    // Nothing radial, nothing of compact support.
    let phi = |x: Vec3| (x.x * 1.3 + x.y * x.z).sin() + 0.3 * x.z * x.x;
    let grad = |x: Vec3| {
        let c = (x.x * 1.3 + x.y * x.z).cos();
        Vec3::new(1.3 * c + 0.3 * x.z, x.z * c, x.y * c + 0.3 * x.x)
    };
    for _ in 0..500 {
        let [d, gauge, x] = [(); 3].map(|()| crate::random::in_cube(&mut rng, 1.0));
        let field = |x: Vec3| curl_of_weighted_rotation(phi(x), grad(x), d, x - gauge);
        let m = jacobian(field, x, 0.02);
        assert!(trace(&m).abs() < 1e-3, "{}", trace(&m));
    }
}
