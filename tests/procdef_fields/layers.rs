//! Radial basis functions and painted scalar fields.

use fastrand::Rng;
use pliant::math::Vec3;
use pliant::procdef::{
    AMPLITUDES, Brush, Canvas, FieldError, LAYERS, MAX_POINTS, RadialBasis, RadialBasisError, ScalarConstraint,
    ScalarField,
};

use crate::meshes::bar;

fn cloud(rng: &mut Rng, n: usize) -> Vec<Vec3> {
    (0..n).map(|_| Vec3::new(rng.f32(), 2.0 * rng.f32(), 0.5 * rng.f32()) - Vec3::splat(0.3)).collect()
}

#[test]
fn the_field_passes_through_its_values() {
    let mut rng = Rng::with_seed(1);
    for n in [1, 2, 3, 4, 5, 30, 300] {
        let points = cloud(&mut rng, n);
        let values: Vec<[f32; 2]> = points.iter().map(|_| [rng.f32(), -3.0 * rng.f32()]).collect();
        let field = RadialBasis::fit(&points, &values, 0.0).unwrap();
        for (p, v) in points.iter().zip(&values) {
            let found = field.value(*p);
            // The solve is in 64 bits; what is left is the rounding of the values to 32.
            assert!((found[0] - v[0]).abs() < 1e-5 && (found[1] - v[1]).abs() < 1e-5, "{n}: {found:?} {v:?}");
        }
    }
}

#[test]
fn linear_functions_are_reproduced_with_their_gradient() {
    let mut rng = Rng::with_seed(2);
    for n in [4, 10, 200] {
        let points = cloud(&mut rng, n);
        let slope = Vec3::new(2.0, -1.0, 0.5);
        let linear = |p: Vec3| 0.7 + slope.dot(p);
        let values: Vec<[f32; 1]> = points.iter().map(|p| [linear(*p)]).collect();
        let field = RadialBasis::fit(&points, &values, 0.0).unwrap();
        for p in cloud(&mut rng, 50) {
            // Values are given in 32 bits: their rounding is all that may be seen, enlarged by extrapolation from few points.
            assert!((field.value(p)[0] - linear(p)).abs() < 2e-5, "{n}");
            assert!(field.gradient(p)[0].distance(slope) < 1e-3, "{n}: {}", field.gradient(p)[0]);
        }
    }
}

#[test]
fn the_gradient_is_that_of_the_value() {
    let mut rng = Rng::with_seed(3);
    let points = cloud(&mut rng, 40);
    let values: Vec<[f32; 1]> = points.iter().map(|_| [rng.f32()]).collect();
    let field = RadialBasis::fit(&points, &values, 0.0).unwrap();
    for x in cloud(&mut rng, 50) {
        let h = 1e-2;
        let difference = Vec3::from(
            [Vec3::X, Vec3::Y, Vec3::Z].map(|a| (field.value(x + a * h)[0] - field.value(x - a * h)[0]) / (2.0 * h)),
        );
        let exact = field.gradient(x)[0];
        // Central differences of step 0.01 in a field that varies over 0.2: a percent, plus rounding 1e-7 / 0.01.
        assert!(exact.distance(difference) < 0.03 * exact.length() + 0.05, "{exact} {difference}");
    }
}

#[test]
fn flat_sets_of_points_have_fields_without_slope_across() {
    let mut rng = Rng::with_seed(4);
    let plane: Vec<Vec3> = cloud(&mut rng, 30).into_iter().map(|p| Vec3::new(p.x, p.y, 0.2)).collect();
    let values: Vec<[f32; 1]> = plane.iter().map(|p| [p.x - p.y]).collect();
    let field = RadialBasis::fit(&plane, &values, 0.0).unwrap();
    assert!((field.value(Vec3::new(0.1, 0.3, 0.9))[0] + 0.2).abs() < 1e-4);
    let line: Vec<Vec3> = (0..5).map(|i| Vec3::X * i as f32).collect();
    let values: Vec<[f32; 1]> = line.iter().map(|p| [2.0 * p.x]).collect();
    let field = RadialBasis::fit(&line, &values, 0.0).unwrap();
    assert!((field.value(Vec3::new(2.5, 1.0, -1.0))[0] - 5.0).abs() < 1e-4);
    let one = RadialBasis::fit(&[Vec3::ONE], &[[3.0]], 0.0).unwrap();
    assert_eq!(one.value(Vec3::new(7.0, 0.0, 0.0)), [3.0]);
}

#[test]
fn the_last_of_points_in_one_place_counts() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::X, Vec3::X + Vec3::splat(1e-7)];
    let values = [[0.0], [1.0], [0.5], [0.2], [2.0], [3.0]];
    let field = RadialBasis::fit(&points, &values, 0.0).unwrap();
    assert!((field.value(Vec3::X)[0] - 3.0).abs() < 1e-4);
}

#[test]
fn many_points_are_thinned_out_and_still_give_the_field() {
    let mut rng = Rng::with_seed(5);
    let points = cloud(&mut rng, MAX_POINTS + 400);
    let smooth = |p: Vec3| (3.0 * p.x).sin() + p.y * p.z;
    let values: Vec<[f32; 1]> = points.iter().map(|p| [smooth(*p)]).collect();
    let field = RadialBasis::fit(&points, &values, 0.0).unwrap();
    // The points are 0.1 apart on the field's wavelength of 2: the cubic kernel leaves far less than a percent.
    assert!(points.iter().all(|p| (field.value(*p)[0] - smooth(*p)).abs() < 0.01));
}

#[test]
fn smoothing_evens_out_noise() {
    let mut rng = Rng::with_seed(6);
    let points = cloud(&mut rng, 200);
    let noisy: Vec<[f32; 1]> = points.iter().map(|p| [p.x + 0.1 * (rng.f32() - 0.5)]).collect();
    let worst = |smoothing| {
        let field = RadialBasis::fit(&points, &noisy, smoothing).unwrap();
        points.iter().map(|p| (field.value(*p)[0] - p.x).abs()).fold(0.0, f32::max)
    };
    assert!(worst(0.0) > 0.045 && worst(1.0) < 0.03, "{} {}", worst(0.0), worst(1.0));
}

#[test]
fn values_that_are_none_are_refused_with_their_index() {
    assert_eq!(RadialBasis::<1>::fit(&[], &[], 0.0).unwrap_err(), RadialBasisError::NoPoints);
    let nan = RadialBasis::fit(&[Vec3::X, Vec3::Y], &[[1.0], [f32::NAN]], 0.0);
    assert_eq!(nan.unwrap_err(), RadialBasisError::NotFinite(1));
    let short = RadialBasis::fit(&[Vec3::X, Vec3::Y], &[[1.0]], 0.0);
    assert_eq!(short.unwrap_err(), RadialBasisError::Lengths { points: 2, values: 1 });
}

#[test]
fn painted_values_stay_in_their_range_and_hold_where_they_were_painted() {
    let mesh = bar([8, 2, 2], 0.25);
    let canvas = Canvas::new(&mesh);
    let end =
        |x: f32, value| ScalarConstraint { value, brush: Brush::Region { seed: Vec3::new(x, 0.25, 0.25), angle: 0.2 } };
    let middle = Brush::Section { origin: Vec3::X, normal: Vec3::X, stroke: vec![] };
    let painted = [end(0.0, -1.0), ScalarConstraint { value: 1.0, brush: middle }, end(2.0, 0.0)];
    let field = ScalarField::paint(&canvas, &painted, AMPLITUDES).unwrap();
    for x in &mesh.positions {
        let value = field.value(*x);
        assert!((-1.0..=1.0).contains(&value));
        let painted = [(0.0, -1.0), (1.0, 1.0), (2.0, 0.0)].into_iter().find(|p| p.0 == x.x);
        assert!(painted.is_none_or(|p| (value - p.1).abs() < 1e-4), "{value} at {x}");
    }
}

#[test]
fn a_wrong_value_is_told_with_its_constraint() {
    let mesh = bar([2, 1, 1], 1.0);
    let canvas = Canvas::new(&mesh);
    let painted = [0.5, 1.5].map(|value| ScalarConstraint { value, brush: Brush::Face(0) });
    let error = ScalarField::paint(&canvas, &painted, LAYERS).unwrap_err();
    assert_eq!(error, FieldError::Value { constraint: 1, value: 1.5, least: 0.0, most: 1.0 });
}
