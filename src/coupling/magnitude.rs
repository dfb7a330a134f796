//! How strong each contact's field has to be: a small complementarity problem, solved by projected Gauss-Seidel.

/// Finds `x ≥ l` with `A x ≥ b` and `x = l` where `A x > b`, as near as the sweeps get; `l` is `least`, 0 or below.
///
/// `a` is row-major, `n × n`; `a[i][j]` is how far field `j` of unit strength moves contact `i` out. `x` holds the
/// start and the result. Rows with a weak diagonal are solved as if it were `LEAST_DIAGONAL`.
pub fn complementarity(a: &[f32], b: &[f32], least: &[f32], x: &mut [f32]) {
    let n = b.len();
    for _ in 0..SWEEPS {
        for i in 0..n {
            let row = &a[i * n..(i + 1) * n];
            let sum: f32 = row.iter().zip(x.iter()).map(|(a, x)| a * x).sum();
            x[i] = (x[i] + RELAXATION * (b[i] - sum) / row[i].max(LEAST_DIAGONAL)).max(least[i]);
        }
    }
}

const SWEEPS: usize = 30;
const RELAXATION: f32 = 0.9;
const LEAST_DIAGONAL: f32 = 0.2;
