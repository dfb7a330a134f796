//! Scalar weights `φ`: how a field fades out.

/// Weight of the spring field: `φ(s) = ½ (1 − s/R)⁴` with `s = |b|²`, `R = r_o²` (equations 8 to 14).
///
/// C² everywhere, zero outside `r_o`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringKernel;

impl SpringKernel {
    /// `(φ, dφ/ds)` at the squared distance `s`, for the inverse `1/R` of the squared radius of influence.
    #[inline]
    pub fn weight(s: f32, inverse_radius_squared: f32) -> (f32, f32) {
        let u = 1.0 - s * inverse_radius_squared;
        if u <= 0.0 {
            return (0.0, 0.0);
        }
        let u3 = u * u * u;
        (0.5 * u3 * u, -2.0 * u3 * inverse_radius_squared)
    }
}

/// Weight of the collision fields: `φ = ½ k²`, `k = 1 − (4y³ − 3y⁴)`, `y = r / W` (equation 2 with weights 0 0 0 1 1).
///
/// `φ = ½` where `r ≤ 0` and 0 where `r ≥ W`; C¹ at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionKernel;

impl CollisionKernel {
    /// Largest `|dφ/dr| · W`, at `y ≈ 0.491` (the derivative is `−12 y² (1 − y) k`).
    pub const MAX_SLOPE: f32 = 1.0321;
    /// Largest of `|d²φ/dr²| · W²` and `|dφ/dr| / r · W²`: it bounds the Hessian of `φ` around any convex part.
    pub const MAX_CURVATURE: f32 = 3.4737;
    /// With `C` above, the Hessian of the product `2 φ(r₁/W) φ(r₂/V)` of two such weights is at most
    /// `C (1/W² + 1/V²) + MIXED_CURVATURE / (W V)`: scanned over both arguments and all ratios of the widths, the worst is 0.131.
    pub const MIXED_CURVATURE: f32 = 0.14;

    /// `(φ, dφ/dr)` at the distance `r` from the region of constant velocity, for a fade-out width `W > 0`.
    #[inline]
    pub fn weight(r: f32, width: f32) -> (f32, f32) {
        let y = r / width;
        if y <= 0.0 {
            return (0.5, 0.0);
        }
        if y >= 1.0 {
            return (0.0, 0.0);
        }
        let y2 = y * y;
        let k = 1.0 - y2 * y * (4.0 - 3.0 * y);
        let dk = -12.0 * y2 * (1.0 - y) / width;
        (0.5 * k * k, k * dk)
    }
}
