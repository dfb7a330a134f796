//! The weights and the constants that the bounds are made of.

use pliant::field::{CollisionKernel, SpringKernel};

/// `½ k²` and its first two derivatives, in f64.
fn collision(y: f64) -> [f64; 3] {
    let k = 1.0 - (4.0 * y.powi(3) - 3.0 * y.powi(4));
    let dk = -12.0 * y * y * (1.0 - y);
    let ddk = -24.0 * y + 36.0 * y * y;
    [0.5 * k * k, k * dk, dk * dk + k * ddk]
}

#[test]
fn the_collision_weight_and_its_slope_are_the_formulas() {
    for i in 0..=1000 {
        let y = f64::from(i) / 1000.0;
        let (phi, slope) = CollisionKernel::weight(y as f32 * 2.5, 2.5);
        let [expected, expected_slope, _] = collision(y);
        assert!((f64::from(phi) - expected).abs() < 1e-6, "{y}");
        assert!((f64::from(slope) * 2.5 - expected_slope).abs() < 1e-5, "{y}");
    }
}

#[test]
fn the_collision_constants_are_the_largest_values_rounded_up() {
    let (mut slope, mut curvature) = (0.0_f64, 0.0_f64);
    for i in 1..1_000_000 {
        let y = f64::from(i) / 1e6;
        let [_, first, second] = collision(y);
        slope = slope.max(first.abs());
        curvature = curvature.max(second.abs()).max(first.abs() / y);
    }
    let [max_slope, max_curvature] = [CollisionKernel::MAX_SLOPE, CollisionKernel::MAX_CURVATURE].map(f64::from);
    assert!(slope <= max_slope && max_slope < slope + 2e-4, "{slope} {max_slope}");
    assert!(curvature <= max_curvature && max_curvature < curvature + 2e-4, "{curvature} {max_curvature}");
}

#[test]
fn the_product_of_two_weights_is_bounded_as_the_certificate_takes_it() {
    let [slope, curvature, mixed] =
        [CollisionKernel::MAX_SLOPE, CollisionKernel::MAX_CURVATURE, CollisionKernel::MIXED_CURVATURE].map(f64::from);
    for ratio in [0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0] {
        let (w, v) = (1.0, f64::from(ratio as f32));
        for i in 1..400 {
            for j in 1..400 {
                let (y, z) = (f64::from(i) / 400.0, f64::from(j) / 400.0);
                let ([a, da, dda], [b, db, ddb]) = (collision(y), collision(z));
                let (da, db) = (da.abs(), db.abs());
                let (bent, other) = (dda.abs().max(da / y), ddb.abs().max(db / z));
                let first = 2.0 * (b * da * w + a * db * v);
                let second = 2.0 * (b * bent * w * w + a * other * v * v + 2.0 * da * db * w * v);
                assert!(first <= slope * w.hypot(v), "{first} at {y} {z} for {ratio}");
                assert!(second <= curvature * (w * w + v * v) + mixed * w * v, "{second} at {y} {z} for {ratio}");
            }
        }
    }
}

#[test]
fn the_spring_weight_and_its_slope_are_the_formulas() {
    for i in 0..=1000 {
        let s = f64::from(i) / 1000.0 * 9.0;
        let (phi, slope) = SpringKernel::weight(s as f32, 1.0 / 9.0);
        let u = 1.0 - s / 9.0;
        assert!((f64::from(phi) - 0.5 * u.powi(4)).abs() < 1e-6, "{s}");
        assert!((f64::from(slope) + 2.0 / 9.0 * u.powi(3)).abs() < 1e-6, "{s}");
    }
    assert_eq!(SpringKernel::weight(9.1, 1.0 / 9.0), (0.0, 0.0));
}
