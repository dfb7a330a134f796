//! Scattered values made a smooth field: radial basis functions with a linear polynomial.
//!
//! `f(x) = Σ wⱼ |x − pⱼ|³ + c + L·x` (Turk and O'Brien, *Shape Transformation Using Variational Implicit Functions*, 1999:
//! the kernel of three dimensions), with `Σ wⱼ = 0` and `Σ wⱼ pⱼ = 0`. It passes through its values, and values of a linear
//! function give that function back. Solved once, densely, in 64 bits.

use crate::math::Vec3;
use glam::DVec3;
use nalgebra::{DMatrix, Matrix3};

/// Points nearer to each other than this share of the points' extent are one point.
pub const MERGE_DISTANCE: f64 = 1.0e-5;
/// More points than this are thinned out: the solve takes the cube of their number.
pub const MAX_POINTS: usize = 1000;
/// Where the points extend less than this share of their largest extent, they are flat: no slope is fitted across.
const FLAT: f64 = 0.02;

/// Why no field goes through the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RadialBasisError {
    /// Nothing to interpolate.
    #[error("there are no points to interpolate")]
    NoPoints,
    /// A coordinate or value is NaN or infinite.
    #[error("point {0} or its value is not finite")]
    NotFinite(usize),
    /// The points and values differ in number.
    #[error("there are {points} points and {values} values")]
    Lengths {
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// The system has no unique solution in 64 bits.
    #[error("the points lie so that no field is determined by them")]
    Singular,
}

/// A smooth field of `N` components through scattered values.
#[derive(Clone, Debug)]
pub struct RadialBasis<const N: usize> {
    centre: DVec3,
    scale: f64,
    points: Vec<DVec3>,
    weights: Vec<[f64; N]>,
    constant: [f64; N],
    linear: [DVec3; N],
}

impl<const N: usize> RadialBasis<N> {
    /// The field through `values` at `points` (metres).
    ///
    /// Of points that coincide ([`MERGE_DISTANCE`]) the last counts, as paint covers paint. Of more than [`MAX_POINTS`]
    /// as many are kept as lie farthest from each other. Points on a plane, a line or in one place get a polynomial of
    /// so many dimensions: across the plane the field is as smooth as it can be.
    /// `smoothing` is added to the diagonal, in units of the kernel at the points' extent: 0 passes through the values,
    /// 1e-3 already evens out noise.
    ///
    /// # Errors
    /// No points, different lengths, values that are not finite (with their index), or a system without solution.
    pub fn fit(points: &[Vec3], values: &[[f32; N]], smoothing: f64) -> Result<Self, RadialBasisError> {
        if points.is_empty() {
            return Err(RadialBasisError::NoPoints);
        }
        if points.len() != values.len() {
            return Err(RadialBasisError::Lengths { points: points.len(), values: values.len() });
        }
        let bad = |i: &usize| !points[*i].is_finite() || values[*i].iter().any(|v| !v.is_finite());
        if let Some(i) = (0..points.len()).find(bad) {
            return Err(RadialBasisError::NotFinite(i));
        }
        let wide: Vec<DVec3> = points.iter().map(|p| p.as_dvec3()).collect();
        let (low, high) = wide.iter().fold((wide[0], wide[0]), |(l, h), p| (l.min(*p), h.max(*p)));
        let (centre, extent) = (0.5 * (low + high), (high - low).max_element());
        let scale = if extent > 0.0 { 2.0 / extent } else { 1.0 };
        let local: Vec<DVec3> = wide.iter().map(|p| (*p - centre) * scale).collect();
        let kept = thinned(&local, &distinct(&local));
        let points: Vec<DVec3> = kept.iter().map(|&i| local[i]).collect();
        let values: Vec<[f32; N]> = kept.iter().map(|&i| values[i]).collect();
        solve(centre, scale, points, &values, smoothing)
    }

    /// The field at `x`.
    pub fn value(&self, x: Vec3) -> [f32; N] {
        let x = (x.as_dvec3() - self.centre) * self.scale;
        let mut sum: [f64; N] = std::array::from_fn(|k| self.constant[k] + self.linear[k].dot(x));
        for (p, w) in self.points.iter().zip(&self.weights) {
            let kernel = kernel(x.distance_squared(*p));
            (0..N).for_each(|k| sum[k] += w[k] * kernel);
        }
        sum.map(|v| v as f32)
    }

    /// The gradient of each component at `x`, per metre; exact, not by differences.
    pub fn gradient(&self, x: Vec3) -> [Vec3; N] {
        let x = (x.as_dvec3() - self.centre) * self.scale;
        let mut sum = self.linear;
        for (p, w) in self.points.iter().zip(&self.weights) {
            // d|r|³ = 3 |r| r
            let d = x - *p;
            let slope = d * (3.0 * d.length());
            (0..N).for_each(|k| sum[k] += slope * w[k]);
        }
        sum.map(|g| (g * self.scale).as_vec3())
    }
}

/// `|r|³` from `r²`.
fn kernel(r2: f64) -> f64 {
    r2 * r2.sqrt()
}

/// The last of all points in one place, in ascending order.
fn distinct(points: &[DVec3]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].x.total_cmp(&points[b].x).then(a.cmp(&b)));
    let mut covered = vec![false; points.len()];
    for (k, &a) in order.iter().enumerate() {
        for &b in order[k + 1..].iter().take_while(|&&b| points[b].x - points[a].x <= 2.0 * MERGE_DISTANCE) {
            if points[a].distance(points[b]) <= 2.0 * MERGE_DISTANCE {
                covered[a.min(b)] = true;
            }
        }
    }
    (0..points.len()).filter(|&i| !covered[i]).collect()
}

/// At most [`MAX_POINTS`] of the points, each time the one that is farthest from those before; in ascending order.
fn thinned(points: &[DVec3], kept: &[usize]) -> Vec<usize> {
    if kept.len() <= MAX_POINTS {
        return kept.to_vec();
    }
    let mut far = vec![f64::INFINITY; kept.len()];
    let (mut chosen, mut next) = (Vec::with_capacity(MAX_POINTS), 0);
    while chosen.len() < MAX_POINTS {
        chosen.push(kept[next]);
        let from = points[kept[next]];
        let mut best = 0;
        for (k, &i) in kept.iter().enumerate() {
            far[k] = far[k].min(points[i].distance_squared(from));
            if far[k] > far[best] {
                best = k;
            }
        }
        next = best;
    }
    chosen.sort_unstable();
    chosen
}

/// Unit directions in which the points extend: three, or fewer for flat ones.
fn span(points: &[DVec3]) -> Vec<DVec3> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut spread = Matrix3::<f64>::zeros();
    for p in points {
        let d = nalgebra::Vector3::from((*p - mean).to_array());
        spread += d * d.transpose();
    }
    let eigen = spread.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let mut axes = Vec::new();
    for k in 0..3 {
        if largest > 0.0 && eigen.eigenvalues[k] > FLAT * FLAT * largest {
            let v = eigen.eigenvectors.column(k);
            axes.push(DVec3::new(v[0], v[1], v[2]));
        }
    }
    axes
}

fn solve<const N: usize>(
    centre: DVec3,
    scale: f64,
    points: Vec<DVec3>,
    values: &[[f32; N]],
    smoothing: f64,
) -> Result<RadialBasis<N>, RadialBasisError> {
    let axes = span(&points);
    let n = points.len();
    let size = n + 1 + axes.len();
    let mut matrix = DMatrix::<f64>::zeros(size, size);
    let mut right = DMatrix::<f64>::zeros(size, N);
    for i in 0..n {
        for j in 0..n {
            matrix[(i, j)] = kernel(points[i].distance_squared(points[j]));
        }
        matrix[(i, i)] += smoothing;
        matrix[(i, n)] = 1.0;
        matrix[(n, i)] = 1.0;
        for (k, axis) in axes.iter().enumerate() {
            matrix[(i, n + 1 + k)] = axis.dot(points[i]);
            matrix[(n + 1 + k, i)] = axis.dot(points[i]);
        }
        (0..N).for_each(|k| right[(i, k)] = f64::from(values[i][k]));
    }
    let solution = matrix.lu().solve(&right).ok_or(RadialBasisError::Singular)?;
    if solution.iter().any(|v| !v.is_finite()) {
        return Err(RadialBasisError::Singular);
    }
    Ok(RadialBasis {
        centre,
        scale,
        weights: (0..n).map(|i| std::array::from_fn(|k| solution[(i, k)])).collect(),
        constant: std::array::from_fn(|k| solution[(n, k)]),
        linear: std::array::from_fn(|k| {
            axes.iter().enumerate().map(|(a, axis)| *axis * solution[(n + 1 + a, k)]).sum()
        }),
        points,
    })
}
