//! The nearest rotations of eight matrices at once, from those of the step before.
//!
//! `tr(Rᵀ A)` is maximised by Newton's method on the rotations: with `S = Rᵀ A` the gradient is the axial vector of `S` and
//! the Hessian `tr(S) 1 - sym(S)`. Near the maximum the error is squared by each step, so that one or two suffice when the
//! start is the rotation of the step before. Lanes where the Hessian is not safely positive (inverted neighbourhoods, lines,
//! points) or that do not converge are handed to [`nearest_rotation`].

use glam::{Mat3, Vec3};
use wide::f32x8;

use super::rotation::nearest_rotation;
use crate::math::Quat;

/// How many matrices make a batch.
pub(super) const LANES: usize = 8;

/// Eight 3x3 matrices, element `[row][column]`.
pub(super) type WideMat3 = [[f32x8; 3]; 3];

/// Newton steps at most; from there on the exact method is cheaper.
const MOST_STEPS: usize = 6;
/// A gradient below this times the trace is squared by the next step to below the rounding of 32 bits.
const ONE_STEP_LEFT: f32 = 3e-4;
/// The Hessian's determinant must exceed this times the cube of its trace. It is 1/27 for an undeformed isotropic
/// neighbourhood, 1/32 for a flat one, 0 for a line.
const SAFE: f32 = 2e-3;

/// Eight unit quaternions.
#[derive(Clone, Copy, Debug)]
pub(super) struct WideQuat {
    pub x: f32x8,
    pub y: f32x8,
    pub z: f32x8,
    pub w: f32x8,
}

impl WideQuat {
    pub const IDENTITY: Self = Self { x: f32x8::ZERO, y: f32x8::ZERO, z: f32x8::ZERO, w: f32x8::ONE };

    /// The rotation matrices.
    #[inline]
    pub fn matrix(self) -> WideMat3 {
        let Self { x, y, z, w } = self;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        let one = f32x8::ONE;
        [[one - (yy + zz), xy - wz, xz + wy], [xy + wz, one - (xx + zz), yz - wx], [xz - wy, yz + wx, one - (xx + yy)]]
    }

    /// Turned about `omega` in its own frame (Cayley's map: the angle is right to third order), of unit length again.
    #[inline]
    fn turned(self, omega: [f32x8; 3]) -> Self {
        let half = f32x8::HALF;
        let [a, b, c] = omega.map(|o| o * half);
        let Self { x, y, z, w } = self;
        let q = Self {
            w: w - x * a - y * b - z * c,
            x: x + w * a + y * c - z * b,
            y: y + w * b + z * a - x * c,
            z: z + w * c + x * b - y * a,
        };
        let length = (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w).sqrt();
        let inverse = f32x8::ONE / length;
        Self { x: q.x * inverse, y: q.y * inverse, z: q.z * inverse, w: q.w * inverse }
    }

    #[inline]
    fn select(mask: f32x8, yes: Self, no: Self) -> Self {
        Self {
            x: mask.bitselect(yes.x, no.x),
            y: mask.bitselect(yes.y, no.y),
            z: mask.bitselect(yes.z, no.z),
            w: mask.bitselect(yes.w, no.w),
        }
    }

    /// One of the eight.
    pub fn lane(&self, lane: usize) -> Quat {
        let at = |v: f32x8| v.to_array()[lane];
        Quat::from_xyzw(at(self.x), at(self.y), at(self.z), at(self.w))
    }

    /// Replaces one of the eight.
    pub fn set_lane(&mut self, lane: usize, q: Quat) {
        for (v, value) in [(&mut self.x, q.x), (&mut self.y, q.y), (&mut self.z, q.z), (&mut self.w, q.w)] {
            let mut all = v.to_array();
            all[lane] = value;
            *v = f32x8::new(all);
        }
    }
}

/// The rotations nearest to eight matrices of about unit size, from those of the step before.
#[inline]
pub(super) fn nearest_rotations(a: &WideMat3, previous: WideQuat) -> WideQuat {
    let mut q = previous;
    let mut unsafe_lanes = f32x8::ZERO;
    let mut open = f32x8::ZERO;
    for _ in 0..MOST_STEPS {
        let s = transposed_times(&q.matrix(), a);
        let trace = s[0][0] + s[1][1] + s[2][2];
        let gradient = [s[2][1] - s[1][2], s[0][2] - s[2][0], s[1][0] - s[0][1]];
        let half = f32x8::HALF;
        // H = tr(S) 1 - sym(S), solved by its cofactors.
        let (h00, h11, h22) = (trace - s[0][0], trace - s[1][1], trace - s[2][2]);
        let h01 = -half * (s[0][1] + s[1][0]);
        let h02 = -half * (s[0][2] + s[2][0]);
        let h12 = -half * (s[1][2] + s[2][1]);
        let (c00, c11, c22) = (h11 * h22 - h12 * h12, h00 * h22 - h02 * h02, h00 * h11 - h01 * h01);
        let (c01, c02, c12) = (h02 * h12 - h01 * h22, h01 * h12 - h02 * h11, h01 * h02 - h00 * h12);
        let determinant = h00 * c00 + h01 * c01 + h02 * c02;
        let positive = trace.simd_gt(f32x8::ZERO)
            & c00.simd_gt(f32x8::ZERO)
            & c22.simd_gt(f32x8::ZERO)
            & determinant.simd_gt(f32x8::splat(8.0 * SAFE) * trace * trace * trace);
        unsafe_lanes = !positive;
        let inverse = positive.bitselect(f32x8::ONE / determinant, f32x8::ZERO);
        let [g0, g1, g2] = gradient;
        let omega = [
            (c00 * g0 + c01 * g1 + c02 * g2) * inverse,
            (c01 * g0 + c11 * g1 + c12 * g2) * inverse,
            (c02 * g0 + c12 * g1 + c22 * g2) * inverse,
        ];
        let squared = g0 * g0 + g1 * g1 + g2 * g2;
        let bound = f32x8::splat(ONE_STEP_LEFT) * trace;
        let near = squared.simd_lt(bound * bound);
        q = WideQuat::select(positive, q.turned(omega), q);
        open = !(near | unsafe_lanes);
        if open.none() {
            break;
        }
    }
    let exact = (unsafe_lanes | open).to_bitmask();
    if exact != 0 {
        for lane in (0..LANES).filter(|lane| exact >> lane & 1 == 1) {
            q.set_lane(lane, nearest_rotation(lane_matrix(a, lane), previous.lane(lane)));
        }
    }
    q
}

/// `rᵀ a`.
#[inline]
fn transposed_times(r: &WideMat3, a: &WideMat3) -> WideMat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| r[0][i] * a[0][j] + r[1][i] * a[1][j] + r[2][i] * a[2][j]))
}

/// `a b`.
#[inline]
pub(super) fn times(a: &WideMat3, b: &WideMat3) -> WideMat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

/// `a bᵀ`.
#[inline]
pub(super) fn times_transposed(a: &WideMat3, b: &WideMat3) -> WideMat3 {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[j][0] + a[i][1] * b[j][1] + a[i][2] * b[j][2]))
}

fn lane_matrix(a: &WideMat3, lane: usize) -> Mat3 {
    let column = |j: usize| Vec3::new(a[0][j].to_array()[lane], a[1][j].to_array()[lane], a[2][j].to_array()[lane]);
    Mat3::from_cols(column(0), column(1), column(2))
}

#[cfg(test)]
#[path = "rotation_tests.rs"]
mod tests;
