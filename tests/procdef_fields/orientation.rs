//! Orientation fields: orthonormal everywhere, and smooth.

use fastrand::Rng;
use pliant::math::{Mat3, Vec3};
use pliant::mesh::TetrahedralMesh;
use pliant::procdef::{
    Brush, Canvas, DirectionStroke, LAYERS, OrientationError, OrientationField, PaintError, ScalarConstraint,
    ScalarField, stretch_along,
};

use crate::meshes::{bar, cubes, cylinder};

fn assert_orthonormal(field: &OrientationField) {
    for (vertex, frame) in field.frames.iter().enumerate() {
        let off = (frame.transpose() * *frame - Mat3::IDENTITY).to_cols_array().into_iter().map(f32::abs);
        assert!(off.fold(0.0, f32::max) < 1e-5, "vertex {vertex}: {frame:?}");
        assert!(frame.determinant() > 0.99, "vertex {vertex} is left-handed: {frame:?}");
    }
}

fn section(origin: Vec3, normal: Vec3, value: f32) -> ScalarConstraint {
    ScalarConstraint { value, brush: Brush::Section { origin, normal, stroke: vec![] } }
}

/// Layers of a cylinder: 0 outside, 1 along its axis.
fn radial_layers(canvas: &Canvas) -> ScalarField {
    let side = Brush::Region { seed: Vec3::new(2.0, 1.0, 0.0), angle: 0.5 };
    let mut painted = vec![ScalarConstraint { value: 0.0, brush: side }];
    for i in 0..=8 {
        let stroke = vec![Vec3::X * 0.5 * i as f32];
        let brush = Brush::Section { origin: stroke[0], normal: Vec3::X, stroke };
        painted.push(ScalarConstraint { value: 1.0, brush });
    }
    ScalarField::paint(canvas, &painted, LAYERS).unwrap()
}

#[test]
fn a_cylinder_with_lengthwise_strokes_has_radial_layers_and_rings() {
    let mesh = cylinder(4.0, 8, 4);
    let canvas = Canvas::new(&mesh);
    let stroke = DirectionStroke { points: vec![Vec3::new(0.2, 0.9, 0.0), Vec3::new(3.8, 0.9, 0.0)], layer: Some(0.0) };
    let field = OrientationField::paint(&canvas, Some(&radial_layers(&canvas)), &[stroke]).unwrap();
    assert_orthonormal(&field);
    for (x, frame) in mesh.positions.iter().zip(&field.frames) {
        let outward = Vec3::new(0.0, x.y, x.z);
        // Near the ends the gradient leans along the axis, and on the axis it has no direction.
        if outward.length() < 0.3 || !(0.9..3.1).contains(&x.x) {
            continue;
        }
        // Constraints half a metre apart along the axis leave ripples: 15 degrees.
        assert!(frame.x_axis.x.abs() > 0.966, "{x}: {frame:?}");
        assert!(frame.y_axis.dot(outward.normalize()).abs() > 0.966, "{x}: {frame:?}");
    }
}

#[test]
fn on_the_axis_the_directions_are_whole_and_what_the_rates_do_is_smooth() {
    let mesh = cylinder(4.0, 8, 4);
    let canvas = Canvas::new(&mesh);
    let stroke = DirectionStroke { points: vec![Vec3::new(0.2, 0.0, 0.0), Vec3::new(3.8, 0.0, 0.0)], layer: None };
    let field = OrientationField::paint(&canvas, Some(&radial_layers(&canvas)), &[stroke]).unwrap();
    assert_orthonormal(&field);
    for (x, frame) in mesh.positions.iter().zip(&field.frames) {
        if x.y.hypot(x.z) < 0.1 && (0.9..3.1).contains(&x.x) {
            assert!(frame.x_axis.x.abs() > 0.966, "{x}: {frame:?}");
        }
    }
}

#[test]
fn a_layer_field_with_a_flat_ridge_is_bridged() {
    // Layer 0 on two sides, 1 in the middle plane: the gradient turns over there, and its tensor does not.
    let mesh = bar([6, 4, 2], 0.25);
    let canvas = Canvas::new(&mesh);
    let painted = [0.0, 0.5, 1.0].map(|y| section(Vec3::Y * y, Vec3::Y, if y == 0.5 { 1.0 } else { 0.0 }));
    let layers = ScalarField::paint(&canvas, &painted, LAYERS).unwrap();
    let stroke = DirectionStroke { points: vec![Vec3::new(0.1, 0.0, 0.2), Vec3::new(1.4, 0.0, 0.2)], layer: None };
    let field = OrientationField::paint(&canvas, Some(&layers), &[stroke]).unwrap();
    assert_orthonormal(&field);
    let doubtful = mesh.positions.iter().zip(&field.confidence).filter(|(x, c)| x.y == 0.5 && **c < 0.5).count();
    assert!(doubtful >= 7 * 3, "the ridge is not believed: {doubtful}");
    for frame in &field.frames {
        assert!(frame.y_axis.y.abs() > 0.99 && frame.x_axis.x.abs() > 0.99, "{frame:?}");
    }
}

#[test]
fn strokes_that_cancel_or_run_along_the_gradient_are_extended_from_around() {
    let mesh = bar([8, 3, 3], 0.25);
    let canvas = Canvas::new(&mesh);
    let layers = [section(Vec3::ZERO, Vec3::Z, 0.0), section(Vec3::Z * 0.75, Vec3::Z, 1.0)];
    let layers = ScalarField::paint(&canvas, &layers, LAYERS).unwrap();
    let line = |from: Vec3, to: Vec3| DirectionStroke { points: vec![from, to], layer: None };
    // Opposite strokes at the two ends: interpolated, they cancel in the middle.
    let strokes = [
        line(Vec3::new(0.1, 0.1, 0.3), Vec3::new(0.4, 0.1, 0.3)),
        line(Vec3::new(0.1, 0.6, 0.3), Vec3::new(0.4, 0.6, 0.3)),
        line(Vec3::new(1.9, 0.1, 0.3), Vec3::new(1.6, 0.1, 0.3)),
        line(Vec3::new(1.9, 0.6, 0.3), Vec3::new(1.6, 0.6, 0.3)),
    ];
    let field = OrientationField::paint(&canvas, Some(&layers), &strokes).unwrap();
    assert_orthonormal(&field);
    assert!(field.confidence.iter().any(|c| *c < 0.5));
    assert!(field.frames.iter().all(|f| f.x_axis.x.abs() > 0.95 && f.y_axis.z.abs() > 0.99));
    // All along the gradient: nothing is known of the primary direction but that it is across.
    let along = DirectionStroke { points: vec![Vec3::new(1.0, 0.3, 0.1), Vec3::new(1.0, 0.3, 0.6)], layer: None };
    let error = OrientationField::paint(&canvas, Some(&layers), &[along]);
    assert!(matches!(error, Ok(_) | Err(OrientationError::Interpolation(_))));
}

#[test]
fn without_layers_or_strokes_the_axes_of_the_body_are_taken() {
    let mesh = bar([8, 2, 2], 0.25);
    let canvas = Canvas::new(&mesh);
    let field = OrientationField::paint(&canvas, None, &[]).unwrap();
    assert_orthonormal(&field);
    assert!(field.frames.iter().all(|f| f.x_axis.distance(Vec3::X) < 1e-4));
    let constant = ScalarField::paint(&canvas, &[section(Vec3::X, Vec3::X, 0.5)], LAYERS).unwrap();
    assert_orthonormal(&OrientationField::paint(&canvas, Some(&constant), &[]).unwrap());
}

/// The largest angle that directions without sense turn by between neighbours, in radians.
fn largest_turn(mesh: &TetrahedralMesh, directions: impl Fn(usize) -> Vec3) -> f32 {
    let neighbours = mesh.neighbours();
    let pairs = (0..mesh.vertex_count()).flat_map(|i| neighbours.of(i).iter().map(move |&j| (i, j as usize)));
    pairs.map(|(i, j)| directions(i).dot(directions(j)).abs().min(1.0).acos()).fold(0.0, f32::max)
}

#[test]
fn frames_of_random_constraints_are_orthonormal_and_turn_slowly_where_they_are_determined() {
    let mut rng = Rng::with_seed(11);
    let mesh = cubes([8, 5, 5], |_| true, |p| p * 0.2 + Vec3::Y * 0.1 * (0.8 * p.x).sin());
    let canvas = Canvas::new(&mesh);
    let mut sure = 0;
    for round in 0..30 {
        let mut unit = || Vec3::new(rng.f32() - 0.5, rng.f32() - 0.5, rng.f32() - 0.5).normalize_or(Vec3::Y);
        let (normal, along) = (unit(), unit());
        let middle = Vec3::new(0.8, 0.5, 0.5);
        let painted: Vec<ScalarConstraint> =
            [-0.25, 0.0, 0.25].into_iter().map(|h| section(middle + normal * h, normal, 0.5 + 2.0 * h)).collect();
        let layers = ScalarField::paint(&canvas, &painted, LAYERS).unwrap();
        let points = vec![middle - along * 0.2, middle, middle + along * 0.2];
        let field =
            OrientationField::paint(&canvas, Some(&layers), &[DirectionStroke { points, layer: None }]).unwrap();
        assert_orthonormal(&field);
        // Planar layers and one straight stroke: nearly constant fields, unless the stroke runs along the gradient.
        if normal.dot(along).abs() < 0.9 {
            sure += 1;
            let turn = largest_turn(&mesh, |i| field.frames[i].x_axis);
            assert!(turn < 0.2, "round {round}: {turn}");
            assert!(largest_turn(&mesh, |i| field.frames[i].y_axis) < 0.2);
        }
    }
    assert!(sure > 15);
}

#[test]
fn wild_constraints_still_give_orthonormal_frames() {
    let mut rng = Rng::with_seed(12);
    let mesh = bar([5, 3, 3], 0.3);
    let faces = mesh.boundary().len() as u32;
    let canvas = Canvas::new(&mesh);
    for _ in 0..40 {
        let painted: Vec<ScalarConstraint> = (0..rng.usize(1..8))
            .map(|_| ScalarConstraint { value: (rng.u8(0..3) as f32) / 2.0, brush: Brush::Face(rng.u32(0..faces)) })
            .collect();
        let layers = ScalarField::paint(&canvas, &painted, LAYERS).unwrap();
        let mut point = || Vec3::new(1.5 * rng.f32(), 0.9 * rng.f32(), 0.9 * rng.f32());
        let strokes: Vec<DirectionStroke> =
            (0..3).map(|_| DirectionStroke { points: (0..3).map(|_| point()).collect(), layer: None }).collect();
        assert_orthonormal(&OrientationField::paint(&canvas, Some(&layers), &strokes).unwrap());
    }
}

#[test]
fn a_wrong_stroke_is_told_with_its_index() {
    let mesh = bar([4, 1, 1], 0.5);
    let canvas = Canvas::new(&mesh);
    let good = DirectionStroke { points: vec![Vec3::ZERO, Vec3::X], layer: None };
    let error = |bad| OrientationField::paint(&canvas, None, &[good.clone(), bad]).unwrap_err();
    let short = error(DirectionStroke { points: vec![Vec3::ZERO, Vec3::ZERO], layer: None });
    assert_eq!(short, OrientationError::Stroke { stroke: 1, source: PaintError::Short { least: 2, points: 1 } });
    let layer = error(DirectionStroke { layer: Some(0.5), ..good.clone() });
    assert_eq!(layer, OrientationError::Layer { stroke: 1, layer: 0.5 });
}

#[test]
fn a_stretch_has_its_rates_along_its_axes() {
    let frame = Mat3::from_cols(Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.8, 0.6, 0.0), Vec3::Z);
    let matrix = stretch_along(&frame, [2.0, 0.5, 3.0]);
    assert!((matrix * frame.x_axis).distance(2.0 * frame.x_axis) < 1e-6);
    assert!((matrix * frame.y_axis).distance(0.5 * frame.y_axis) < 1e-6);
    assert!((matrix * frame.z_axis).distance(3.0 * frame.z_axis) < 1e-6);
}
