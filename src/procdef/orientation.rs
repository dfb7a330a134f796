//! The orientation field: three orthogonal directions at each vertex (section 4.1).
//!
//! The gradient of the layer field is the secondary direction; strokes on layers give the primary one, interpolated by
//! component and made perpendicular to it; their cross product is the third.
//!
//! Where the gradient vanishes, strokes cancel each other or run along the gradient, the direction is extended from the
//! places around ([`super::line_field`]). What was not painted at all is chosen: without strokes the primary direction is the
//! body's longest axis, without layers the secondary one is the axis that is least along the primary.

use super::line_field::{Candidate, any_across, extend, perpendicular};
use super::paint::{Canvas, PaintError, finite};
use super::radial_basis::{RadialBasis, RadialBasisError};
use super::scalar_field::ScalarField;
use crate::math::{Mat3, Vec3};

/// A line drawn along the primary direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectionStroke {
    /// Its points, in metres in the frame of the mesh; in the body or on it.
    pub points: Vec<Vec3>,
    /// The layer that it is drawn on: the points are moved onto that level of the layer field. None leaves them.
    pub layer: Option<f32>,
}

/// Why strokes give no directions.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum OrientationError {
    /// A stroke cannot be placed.
    #[error("stroke {stroke} {source}")]
    Stroke {
        /// Index of the stroke, from 0.
        stroke: usize,
        /// Why.
        source: PaintError,
    },
    /// A stroke on a layer that is none.
    #[error("stroke {stroke} lies on layer {layer}; layers go from 0 to 1, and there must be painted ones")]
    Layer {
        /// Index of the stroke, from 0.
        stroke: usize,
        /// The layer.
        layer: f32,
    },
    /// The interpolation fails.
    #[error("cannot be interpolated: {0}")]
    Interpolation(#[from] RadialBasisError),
}

/// Three orthonormal, right-handed directions at each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientationField {
    /// For each vertex the primary, secondary and tertiary direction as columns.
    pub frames: Vec<Mat3>,
    /// For each vertex whether both directions were determined by what was painted there, in [0, 1]; below 1 they were
    /// partly or wholly extended from their surroundings.
    pub confidence: Vec<f32>,
}

impl OrientationField {
    /// The orientation field of layers and strokes, either of which may be missing.
    ///
    /// # Errors
    /// A stroke that is too short, not finite, too far from the body or on a layer that does not exist, with its index.
    pub fn paint(
        canvas: &Canvas,
        layers: Option<&ScalarField>,
        strokes: &[DirectionStroke],
    ) -> Result<Self, OrientationError> {
        let mesh = canvas.mesh();
        let neighbours = mesh.neighbours();
        let layers = layers.map(|field| Layers::new(field, &mesh.positions));
        let primary = primary_candidates(canvas, layers.as_ref(), strokes)?;
        let (first, second, confidence): (Vec<Vec3>, Vec<Vec3>, Vec<f32>);
        if let Some(layers) = &layers {
            let gradients: Vec<Candidate> = mesh.positions.iter().map(|x| layers.gradient(*x)).collect();
            second = extend(&gradients, &neighbours);
            let across: Vec<Candidate> = primary.iter().zip(&second).map(|(c, s)| made_across(*c, *s)).collect();
            first = extend(&across, &neighbours);
            confidence = across.iter().zip(&gradients).map(|(a, g)| a.confidence.min(g.confidence)).collect();
        } else {
            first = extend(&primary, &neighbours);
            let axis = least_along(&first);
            let across: Vec<Candidate> =
                first.iter().map(|p| made_across(Candidate { direction: axis, confidence: 1.0 }, *p)).collect();
            second = extend(&across, &neighbours);
            confidence = primary.iter().map(|c| c.confidence).collect();
        }
        // The direction that was determined first is kept; the other is turned the little that the extension left over.
        let frame = |(&first, &second): (&Vec3, &Vec3)| {
            let (kept, turned) = if layers.is_some() { (second, first) } else { (first, second) };
            let (rest, sine) = perpendicular(turned, kept);
            let turned = if sine > 1.0e-3 { rest.normalize() } else { any_across(kept) };
            let (first, second) = if layers.is_some() { (turned, kept) } else { (kept, turned) };
            Mat3::from_cols(first, second, first.cross(second))
        };
        Ok(Self { frames: first.iter().zip(&second).map(frame).collect(), confidence })
    }

    /// The same axes at every vertex: x primary, y secondary, z tertiary.
    pub fn axes(vertices: usize) -> Self {
        Self { frames: vec![Mat3::IDENTITY; vertices], confidence: vec![1.0; vertices] }
    }
}

/// Rises smoothly from 0 at `low` to 1 at `high`.
fn ramp(low: f32, high: f32, x: f32) -> f32 {
    let u = ((x - low) / (high - low)).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// Layers, and how steep they usually are.
struct Layers<'a> {
    field: &'a ScalarField,
    /// Median of the gradients' lengths over the vertices, per metre.
    usual: f32,
}

impl<'a> Layers<'a> {
    fn new(field: &'a ScalarField, positions: &[Vec3]) -> Self {
        let mut lengths: Vec<f32> = positions.iter().map(|x| field.gradient(*x).length()).collect();
        lengths.sort_by(f32::total_cmp);
        let usual = lengths.get(lengths.len() / 2).copied().unwrap_or(0.0);
        // A layer field of one value has gradients of rounding errors.
        let size = positions.iter().map(|x| x.distance(positions[0])).fold(0.0, f32::max);
        Self { field, usual: if usual * size > 1.0e-4 { usual } else { 0.0 } }
    }

    /// The gradient, believed where it is not small against the usual one.
    fn gradient(&self, x: Vec3) -> Candidate {
        let direction = self.field.gradient(x);
        let confidence = if self.usual > 0.0 { ramp(0.05, 0.2, direction.length() / self.usual) } else { 0.0 };
        Candidate { direction, confidence }
    }
}

/// Interpolated strokes, believed where they do not cancel each other.
fn primary_candidates(
    canvas: &Canvas,
    layers: Option<&Layers>,
    strokes: &[DirectionStroke],
) -> Result<Vec<Candidate>, OrientationError> {
    let positions = &canvas.mesh().positions;
    if strokes.is_empty() {
        let direction = longest_axis(positions);
        return Ok(vec![Candidate { direction, confidence: 1.0 }; positions.len()]);
    }
    let (mut points, mut tangents) = (Vec::new(), Vec::new());
    for (stroke, drawn) in strokes.iter().enumerate() {
        for (point, tangent) in stroke_tangents(canvas, layers, stroke, drawn)? {
            points.push(point);
            tangents.push(tangent.to_array());
        }
    }
    let basis = RadialBasis::fit(&points, &tangents, 0.0)?;
    let candidate = |x: &Vec3| {
        let direction = Vec3::from(basis.value(*x));
        Candidate { direction, confidence: ramp(0.05, 0.3, direction.length()) }
    };
    Ok(positions.iter().map(candidate).collect())
}

/// Points along a stroke, on its layer, with unit tangents in the layer.
fn stroke_tangents(
    canvas: &Canvas,
    layers: Option<&Layers>,
    stroke: usize,
    drawn: &DirectionStroke,
) -> Result<Vec<(Vec3, Vec3)>, OrientationError> {
    let wrong = |source| OrientationError::Stroke { stroke, source };
    finite(&drawn.points).map_err(wrong)?;
    if let Some(layer) = drawn.layer
        && (layers.is_none() || !super::scalar_field::LAYERS.contains(&layer))
    {
        return Err(OrientationError::Layer { stroke, layer });
    }
    let mut line = Vec::new();
    for (k, p) in canvas.sampled(&drawn.points).map_err(wrong)? {
        let p = canvas.inside(k, p).map_err(wrong)?;
        let p = match (drawn.layer, layers) {
            (Some(layer), Some(layers)) => onto_layer(layers.field, layer, p, canvas.mesh().size()),
            _ => p,
        };
        // Points that fall together have no tangent.
        if line.last().is_none_or(|last: &Vec3| last.distance(p) > 1.0e-5 * canvas.mesh().size()) {
            line.push(p);
        }
    }
    let count = line.len();
    if count < 2 {
        return Err(wrong(PaintError::Short { least: 2, points: count }));
    }
    let closed = count > 3 && line[0].distance(line[count - 1]) < 1.0e-4 * canvas.mesh().size();
    let tangent = |k: usize| {
        let before = if k > 0 {
            k - 1
        } else if closed {
            count - 2
        } else {
            0
        };
        let after = if k + 1 < count {
            k + 1
        } else if closed {
            1
        } else {
            k
        };
        let along = line[after] - line[before];
        let Some(layers) = layers else { return along.try_normalize().map(|t| (line[k], t)) };
        let gradient = layers.gradient(line[k]);
        let normal = gradient.direction.normalize_or_zero();
        let inside = along - normal * (gradient.confidence * along.dot(normal));
        inside.try_normalize().map(|t| (line[k], t))
    };
    Ok((0..count).filter_map(tangent).collect())
}

/// Moves a point along the gradient onto a level of the layer field, by Newton's method; not farther than the layers go.
fn onto_layer(layers: &ScalarField, layer: f32, start: Vec3, size: f32) -> Vec3 {
    let mut p = start;
    for _ in 0..8 {
        let gradient = layers.gradient(p);
        let steepness = gradient.length_squared();
        let off = layer - layers.unlimited(p);
        if steepness * size * size < 1.0e-4 || off.abs() < 1.0e-4 {
            break;
        }
        p += (gradient * (off / steepness)).clamp_length_max(0.1 * size);
    }
    p
}

/// A candidate made perpendicular to a unit vector; believed less where it runs along it.
fn made_across(candidate: Candidate, across: Vec3) -> Candidate {
    let (direction, sine) = perpendicular(candidate.direction, across);
    Candidate { direction, confidence: candidate.confidence * ramp(0.08, 0.25, sine) }
}

/// The axis x, y or z that is least along the directions.
fn least_along(directions: &[Vec3]) -> Vec3 {
    let sum: Vec3 = directions.iter().map(|d| *d * *d).sum();
    let axes = [Vec3::Y, Vec3::Z, Vec3::X];
    axes.into_iter().min_by(|a, b| a.dot(sum).total_cmp(&b.dot(sum))).unwrap_or(Vec3::Y)
}

/// The direction in which the points extend most.
fn longest_axis(points: &[Vec3]) -> Vec3 {
    let mean = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
    let mut spread = nalgebra::Matrix3::<f64>::zeros();
    for p in points {
        let d = nalgebra::Vector3::from((*p - mean).as_dvec3().to_array());
        spread += d * d.transpose();
    }
    let eigen = spread.symmetric_eigen();
    let v = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    let axis = Vec3::new(v[0] as f32, v[1] as f32, v[2] as f32);
    let largest = axis.abs().max_position();
    axis * axis[largest].signum()
}
