//! Eight points at once: the formulas of the scalar fields, lane by lane. This is what makes the deformation of a whole
//! skin fast on a processor.

use std::ops::{Add, Div, Mul, Sub};

use wide::f32x8;

use super::convex_hull::ConvexHull;
use super::hugging::{HuggingField, Spread};
use super::part::PartShape;
use super::spring::SpringField;
use crate::math::Vec3;

/// How many points make a batch.
pub const LANES: usize = 8;

/// Eight vectors.
#[derive(Clone, Copy, Debug)]
pub struct WideVec {
    x: f32x8,
    y: f32x8,
    z: f32x8,
}

impl WideVec {
    /// Eight times the zero vector.
    pub const ZERO: Self = Self { x: f32x8::ZERO, y: f32x8::ZERO, z: f32x8::ZERO };

    /// Eight times the same vector.
    #[inline]
    pub fn splat(v: Vec3) -> Self {
        Self { x: f32x8::splat(v.x), y: f32x8::splat(v.y), z: f32x8::splat(v.z) }
    }

    /// One vector a lane.
    #[inline]
    pub fn from_lanes(v: [Vec3; LANES]) -> Self {
        Self { x: f32x8::new(v.map(|v| v.x)), y: f32x8::new(v.map(|v| v.y)), z: f32x8::new(v.map(|v| v.z)) }
    }

    /// The lanes.
    #[inline]
    pub fn to_lanes(self) -> [Vec3; LANES] {
        let (x, y, z) = (self.x.to_array(), self.y.to_array(), self.z.to_array());
        std::array::from_fn(|i| Vec3::new(x[i], y[i], z[i]))
    }

    /// Each lane times its own number.
    #[inline]
    pub fn scaled(self, s: f32x8) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }

    #[inline]
    fn dot(self, o: Self) -> f32x8 {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    #[inline]
    fn dot_all(self, v: Vec3) -> f32x8 {
        self.x * f32x8::splat(v.x) + self.y * f32x8::splat(v.y) + self.z * f32x8::splat(v.z)
    }
}

impl Add for WideVec {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
}

impl Sub for WideVec {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
}

impl Mul<f32> for WideVec {
    type Output = Self;
    #[inline]
    fn mul(self, s: f32) -> Self {
        self.scaled(f32x8::splat(s))
    }
}

impl Div<f32> for WideVec {
    type Output = Self;
    #[inline]
    fn div(self, s: f32) -> Self {
        let s = f32x8::splat(s);
        Self { x: self.x / s, y: self.y / s, z: self.z / s }
    }
}

impl SpringField {
    /// [`SpringField::velocity`] of eight points.
    #[inline]
    pub fn velocity_wide(&self, x: WideVec, t: f32) -> WideVec {
        let a = self.q - self.p;
        let b = x - WideVec::splat(self.p + a * t);
        let inverse = f32x8::splat(1.0 / (self.radius * self.radius));
        let u = (f32x8::ONE - b.dot(b) * inverse).max(f32x8::ZERO);
        let u3 = u * u * u;
        // φ = ½ u⁴ and ∇φ = −4 u³ b / R: see the kernel; ∇φ · b and ∇φ · a follow.
        let slope = u3 * inverse * f32x8::splat(-4.0);
        let along = u3 * u + slope * b.dot(b);
        WideVec::splat(a).scaled(along) - b.scaled(slope * b.dot_all(a))
    }
}

impl HuggingField {
    /// [`HuggingField::velocity`] of eight points.
    #[inline]
    pub fn velocity_wide(&self, x: WideVec, t: f32) -> WideVec {
        let frame = self.part.rotation().transpose();
        let offset = self.d * (1.0 - t) - self.part.pose().translation;
        let shifted = x + WideVec::splat(offset);
        let patch = self.patch_wide(x, t);
        if patch.0.simd_le(f32x8::ZERO).all() {
            return WideVec::ZERO;
        }
        let axis = |row: usize| shifted.dot_all(frame.row(row));
        let local = WideVec { x: axis(0), y: axis(1), z: axis(2) };
        let away = self.outside_wide(local, patch.0);
        let length = away.dot(away).sqrt();
        let width = f32x8::splat(1.0 / self.width);
        let rounding = f32x8::splat(self.part.part().rounding);
        let y = ((length - rounding) * width).max(f32x8::ZERO).min(f32x8::ONE);
        if y.simd_ge(f32x8::ONE).all() {
            return WideVec::ZERO;
        }
        let k = f32x8::ONE - y * y * y * (f32x8::splat(4.0) - f32x8::splat(3.0) * y);
        let slope = k * (f32x8::splat(-12.0) * y * y * (f32x8::ONE - y)) * width;
        let grad = away.scaled(slope * patch.0 / length.max(f32x8::splat(f32::MIN_POSITIVE)));
        // The products with the slope towards the part are taken in the part's frame, where it was found.
        let d = frame * self.d;
        let from_gauge = self.spread_wide(x - WideVec::splat(self.gauge));
        let b = WideVec {
            x: from_gauge.dot_all(frame.row(0)),
            y: from_gauge.dot_all(frame.row(1)),
            z: from_gauge.dot_all(frame.row(2)),
        };
        let patch_grad = patch.1.scaled(k * k);
        let along = k * k * patch.0 + grad.dot(b) + patch_grad.dot(from_gauge);
        WideVec::splat(self.d).scaled(along) - from_gauge.scaled(grad.dot_all(d) + patch_grad.dot_all(self.d))
    }

    #[inline]
    fn spread_wide(&self, b: WideVec) -> WideVec {
        let Spread { along, share } = self.spread;
        if share == 0.0 {
            return b;
        }
        let even = f32x8::splat(1.0 - share);
        b.scaled(even) + WideVec::splat(along).scaled(b.dot_all(along) * f32x8::splat(2.0 * share))
    }

    /// `k²` of the patch, and its slope over two.
    #[inline]
    fn patch_wide(&self, x: WideVec, t: f32) -> (f32x8, WideVec) {
        if !self.patch.radius.is_finite() {
            return (f32x8::ONE, WideVec::ZERO);
        }
        let away = x + WideVec::splat(self.d * (1.0 - t) - self.patch.centre);
        let distance = away.dot(away).sqrt();
        let inverse = f32x8::splat(1.0 / self.patch.width);
        let y = ((distance - f32x8::splat(self.patch.radius)) * inverse).max(f32x8::ZERO).min(f32x8::ONE);
        let k = f32x8::ONE - y * y * y * (f32x8::splat(4.0) - f32x8::splat(3.0) * y);
        let slope = k * (f32x8::splat(-12.0) * y * y * (f32x8::ONE - y)) * inverse;
        (k * k, away.scaled(slope / distance.max(f32x8::splat(f32::MIN_POSITIVE))))
    }

    /// Eight points of the part's frame minus their nearest points of the part before rounding; any vector longer than the
    /// field is wide for points beyond that, and for those outside the patch.
    #[inline]
    fn outside_wide(&self, x: WideVec, patch: f32x8) -> WideVec {
        let zero = f32x8::ZERO;
        match &self.part.part().shape {
            PartShape::Point => x,
            PartShape::Segment { a, b } => {
                let ab = *b - *a;
                let inverse = if ab.length_squared() > 0.0 { 1.0 / ab.length_squared() } else { 0.0 };
                let from = x - WideVec::splat(*a);
                let along = (from.dot_all(ab) * f32x8::splat(inverse)).max(zero).min(f32x8::ONE);
                from - WideVec::splat(ab).scaled(along)
            }
            PartShape::Cuboid { half_extents: h } => {
                let beyond = |x: f32x8, h: f32| x - x.max(f32x8::splat(-h)).min(f32x8::splat(h));
                WideVec { x: beyond(x.x, h.x), y: beyond(x.y, h.y), z: beyond(x.z, h.z) }
            }
            PartShape::Cylinder { half_height, radius } => {
                let rho = (x.x * x.x + x.z * x.z).sqrt();
                let radius = f32x8::splat(*radius);
                let out = (rho - radius).max(zero) / rho.max(f32x8::splat(f32::MIN_POSITIVE));
                let h = f32x8::splat(*half_height);
                WideVec { x: x.x * out, y: x.y - x.y.max(-h).min(h), z: x.z * out }
            }
            PartShape::HalfSpace { normal } => {
                let height = x.dot_all(*normal);
                let above = height.simd_gt(zero).select(height, zero);
                WideVec::splat(*normal).scaled(above)
            }
            PartShape::Hull(hull) => outside_hull_wide(x, hull, patch, self.width + self.part.part().rounding),
            PartShape::Cone { .. } => {
                let outside = |x| {
                    let (distance, direction) = self.part.part().distance_before_rounding(x);
                    direction * distance
                };
                WideVec::from_lanes(x.to_lanes().map(outside))
            }
        }
    }
}

/// The scalar `outside_hull` of eight points: the highest plane of each is found eight points at a time, and the nearest point
/// of those that are within `reach` and have a `patch` weight.
fn outside_hull_wide(x: WideVec, hull: &ConvexHull, patch: f32x8, reach: f32) -> WideVec {
    let mut highest = f32x8::splat(f32::NEG_INFINITY);
    let mut first = f32x8::ZERO;
    for (i, &(normal, offset)) in hull.planes().iter().enumerate() {
        let height = x.dot_all(normal) - f32x8::splat(offset);
        let higher = height.simd_gt(highest);
        highest = higher.select(height, highest);
        first = higher.select(f32x8::splat(i as f32), first);
    }
    let highest = highest.to_array();
    if highest.iter().all(|&height| height <= hull.rounding_error()) {
        return WideVec::ZERO;
    }
    let points = x.to_lanes();
    let (first, patch) = (first.to_array(), patch.to_array());
    let outside = |lane: usize| {
        if highest[lane] <= hull.rounding_error() {
            Vec3::ZERO
        } else if highest[lane] >= reach || patch[lane] <= 0.0 {
            // No point of the hull is nearer than its plane.
            Vec3::Y * (2.0 * reach)
        } else {
            points[lane] - hull.nearest_from(points[lane], first[lane] as usize)
        }
    };
    WideVec::from_lanes(std::array::from_fn(outside))
}
