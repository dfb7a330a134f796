//! Painted scalar fields: layers, amplitudes and phase shifts.

use super::paint::{Brush, Canvas, PaintError};
use super::radial_basis::{RadialBasis, RadialBasisError};
use crate::math::Vec3;
use std::ops::RangeInclusive;

/// A value painted somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarConstraint {
    /// The value.
    pub value: f32,
    /// The tool, and where it was used.
    pub brush: Brush,
}

/// Why a painted field cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// A constraint cannot be placed.
    #[error("constraint {constraint} {source}")]
    Paint {
        /// Index of the constraint, from 0.
        constraint: usize,
        /// Why.
        source: PaintError,
    },
    /// A value out of the field's range.
    #[error("constraint {constraint} has the value {value}; it must be from {least} to {most}")]
    Value {
        /// Index of the constraint, from 0.
        constraint: usize,
        /// Its value.
        value: f32,
        /// The least value allowed.
        least: f32,
        /// The largest value allowed.
        most: f32,
    },
    /// The interpolation fails.
    #[error("cannot be interpolated: {0}")]
    Interpolation(#[from] RadialBasisError),
}

/// The range of layer values: 0 is the outermost layer, 1 the innermost.
pub const LAYERS: RangeInclusive<f32> = 0.0..=1.0;
/// The range of amplitudes: `c' = c^A`.
pub const AMPLITUDES: RangeInclusive<f32> = -1.0..=1.0;
/// The range of phase shifts: 0 is the source of the signals, 1 the sink.
pub const PHASES: RangeInclusive<f32> = 0.0..=1.0;

/// A smooth field through painted values.
#[derive(Clone, Debug)]
pub struct ScalarField {
    basis: RadialBasis<1>,
    range: RangeInclusive<f32>,
}

impl ScalarField {
    /// The field of constraints with values in `range`. Later constraints cover earlier ones where they meet.
    ///
    /// # Errors
    /// No constraints, a value out of range, a constraint that cannot be placed (each with its index).
    pub fn paint(
        canvas: &Canvas,
        constraints: &[ScalarConstraint],
        range: RangeInclusive<f32>,
    ) -> Result<Self, FieldError> {
        let (mut points, mut values) = (Vec::new(), Vec::new());
        for (constraint, painted) in constraints.iter().enumerate() {
            let value = painted.value;
            if !range.contains(&value) {
                return Err(FieldError::Value { constraint, value, least: *range.start(), most: *range.end() });
            }
            let placed = canvas.points(&painted.brush).map_err(|source| FieldError::Paint { constraint, source })?;
            values.extend(placed.iter().map(|_| [value]));
            points.extend(placed);
        }
        Ok(Self { basis: RadialBasis::fit(&points, &values, 0.0)?, range })
    }

    /// The value at a place, cut to the field's range.
    pub fn value(&self, x: Vec3) -> f32 {
        self.unlimited(x).clamp(*self.range.start(), *self.range.end())
    }

    /// The value as interpolated: beyond the constraints it may leave the range.
    pub fn unlimited(&self, x: Vec3) -> f32 {
        self.basis.value(x)[0]
    }

    /// The gradient of the interpolated value, per metre.
    pub fn gradient(&self, x: Vec3) -> Vec3 {
        self.basis.gradient(x)[0]
    }

    /// The values at many places.
    pub fn values(&self, places: &[Vec3]) -> Vec<f32> {
        places.iter().map(|x| self.value(*x)).collect()
    }
}
