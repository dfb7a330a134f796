//! The Cholesky factor of a sparse matrix, laid out for solving: columns that have the same rows below them go together.
//!
//! In an order of nested dissection most columns come in runs whose rows are the same but for the run itself. Up to four of them are one
//! block: the rows are read, and the right-hand side is touched, once for all of them.

use wide::f32x4;

/// Columns of a block at most.
const WIDEST: usize = 4;

/// `L` of `A = L Lᵀ`.
#[derive(Clone, Debug, Default)]
pub(super) struct BlockFactor {
    blocks: Vec<Block>,
    /// The rows below the blocks, block after block.
    rows: Vec<u32>,
    /// Beside each row the entries of the block's columns.
    values: Vec<f32>,
    /// The entries between the columns of each block, by rows.
    inner: Vec<f32>,
    /// One over each element of the diagonal.
    inverse: Vec<f32>,
}

/// Neighbouring columns with the same rows below them, and where the next block's data begins.
#[derive(Clone, Copy, Debug)]
struct Block {
    first: u32,
    width: u32,
    rows_end: u32,
    values_end: u32,
    inner_end: u32,
}

impl BlockFactor {
    /// Of the columns of `L`, each its diagonal and the entries below it by ascending rows. None where an entry is not finite in 32
    /// bits.
    pub fn new(columns: &[(f64, Vec<(u32, f64)>)]) -> Option<Self> {
        let mut out = Self { inverse: columns.iter().map(|c| (1.0 / c.0) as f32).collect(), ..Self::default() };
        let mut first = 0;
        while first < columns.len() {
            let width = width(&columns[first..]);
            let block = &columns[first..first + width];
            for (k, column) in block.iter().enumerate() {
                // Row `k` of the triangle: what the columns before it have in that row.
                let own = |j: usize| block[j].1[k - j - 1].1 as f32;
                out.inner.extend((0..k).map(own));
                debug_assert!(column.1.len() >= width - 1 - k);
            }
            let below = |k: usize| &block[k].1[width - 1 - k..];
            for (at, &(row, _)) in below(0).iter().enumerate() {
                out.rows.push(row);
                out.values.extend((0..width).map(|k| below(k)[at].1 as f32));
            }
            out.blocks.push(Block {
                first: first as u32,
                width: width as u32,
                rows_end: out.rows.len() as u32,
                values_end: out.values.len() as u32,
                inner_end: out.inner.len() as u32,
            });
            first += width;
        }
        let finite = out.inverse.iter().chain(&out.values).chain(&out.inner).all(|v| v.is_finite());
        finite.then_some(out)
    }

    /// `L Lᵀ y = b`, in place, three right-hand sides at once.
    pub fn solve(&self, b: &mut [f32x4]) {
        let mut starts = [0; 3];
        for block in &self.blocks {
            self.with(block, starts, |part| part.forward(b));
            starts = block.ends();
        }
        for (place, block) in self.blocks.iter().enumerate().rev() {
            let starts = place.checked_sub(1).map_or([0; 3], |before| self.blocks[before].ends());
            self.with(block, starts, |part| part.backward(b));
        }
    }

    /// The data of a block.
    #[inline]
    fn with<'a>(&'a self, block: &Block, [rows, values, inner]: [usize; 3], act: impl FnOnce(Part<'a>)) {
        let (first, width) = (block.first as usize, block.width as usize);
        let [rows_end, values_end, inner_end] = block.ends();
        act(Part {
            first,
            inverse: &self.inverse[first..first + width],
            rows: &self.rows[rows..rows_end],
            values: &self.values[values..values_end],
            inner: &self.inner[inner..inner_end],
        });
    }
}

impl Block {
    fn ends(&self) -> [usize; 3] {
        [self.rows_end as usize, self.values_end as usize, self.inner_end as usize]
    }
}

/// How many of the first columns have the same rows below them.
fn width(columns: &[(f64, Vec<(u32, f64)>)]) -> usize {
    let rows = |k: usize| columns[k].1.iter().map(|e| e.0);
    let mut width = 1;
    while width < WIDEST.min(columns.len()) {
        let last = &columns[width - 1].1;
        // The next column is the first row of the last one, and has the others.
        let follows = !last.is_empty()
            && last.len() == columns[width].1.len() + 1
            && last[1..].iter().map(|e| e.0).eq(rows(width))
            && !columns[width].1.iter().any(|e| e.0 <= last[0].0);
        if !follows {
            break;
        }
        width += 1;
    }
    width
}

/// A block with its data.
struct Part<'a> {
    first: usize,
    inverse: &'a [f32],
    rows: &'a [u32],
    values: &'a [f32],
    inner: &'a [f32],
}

impl Part<'_> {
    fn forward(self, b: &mut [f32x4]) {
        match self.inverse.len() {
            1 => self.forward_of::<1>(b),
            2 => self.forward_of::<2>(b),
            3 => self.forward_of::<3>(b),
            _ => self.forward_of::<4>(b),
        }
    }

    fn backward(self, b: &mut [f32x4]) {
        match self.inverse.len() {
            1 => self.backward_of::<1>(b),
            2 => self.backward_of::<2>(b),
            3 => self.backward_of::<3>(b),
            _ => self.backward_of::<4>(b),
        }
    }

    #[inline]
    fn forward_of<const W: usize>(self, b: &mut [f32x4]) {
        let mut y = [f32x4::ZERO; W];
        let mut inner = self.inner.iter();
        for k in 0..W {
            let mut value = b[self.first + k];
            for (before, &l) in y[..k].iter().zip(&mut inner) {
                value -= *before * f32x4::splat(l);
            }
            y[k] = value * f32x4::splat(self.inverse[k]);
            b[self.first + k] = y[k];
        }
        for (&row, values) in self.rows.iter().zip(self.values.as_chunks::<W>().0) {
            let mut sum = y[0] * f32x4::splat(values[0]);
            for k in 1..W {
                sum += y[k] * f32x4::splat(values[k]);
            }
            b[row as usize] -= sum;
        }
    }

    #[inline]
    fn backward_of<const W: usize>(self, b: &mut [f32x4]) {
        let mut sums = [f32x4::ZERO; W];
        for (&row, values) in self.rows.iter().zip(self.values.as_chunks::<W>().0) {
            let below = b[row as usize];
            for k in 0..W {
                sums[k] += below * f32x4::splat(values[k]);
            }
        }
        for k in (0..W).rev() {
            let mut value = b[self.first + k] - sums[k];
            for later in k + 1..W {
                // Rows of the triangle have 0, 1, 2 and 3 entries.
                let l = self.inner[later * (later - 1) / 2 + k];
                value -= b[self.first + later] * f32x4::splat(l);
            }
            b[self.first + k] = value * f32x4::splat(self.inverse[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A random lower triangle with dense runs of columns, as sparse columns.
    fn random(n: usize, rng: &mut fastrand::Rng) -> Vec<(f64, Vec<(u32, f64)>)> {
        let dense = |column: usize| column / 3;
        let mut columns = Vec::new();
        let kept: Vec<bool> = (0..n * n).map(|_| rng.f32() < 0.3).collect();
        for column in 0..n {
            let below = (column + 1..n).filter(|&row| dense(row) == dense(column) || kept[dense(column) * n + row]);
            let entries = below.map(|row| (row as u32, rng.f64() - 0.5)).collect();
            columns.push((1.0 + rng.f64(), entries));
        }
        columns
    }

    #[test]
    fn what_is_solved_is_the_right_hand_side_again_when_multiplied() {
        let mut rng = fastrand::Rng::with_seed(4);
        for n in [1, 2, 5, 24, 40] {
            let columns = random(n, &mut rng);
            let factor = BlockFactor::new(&columns).unwrap();
            assert!(n < 5 || factor.blocks.len() < n, "runs go together");
            let wanted: Vec<f64> = (0..n).map(|_| rng.f64() - 0.5).collect();
            // b = L Lᵀ y
            let upper: Vec<f64> = (0..n)
                .map(|c| {
                    columns[c].0 * wanted[c] + columns[c].1.iter().map(|e| e.1 * wanted[e.0 as usize]).sum::<f64>()
                })
                .collect();
            let mut b = vec![0.0f64; n];
            for (c, column) in columns.iter().enumerate() {
                b[c] += column.0 * upper[c];
                column.1.iter().for_each(|e| b[e.0 as usize] += e.1 * upper[c]);
            }
            let mut x: Vec<f32x4> = b.iter().map(|v| f32x4::splat(*v as f32)).collect();
            factor.solve(&mut x);
            for (x, wanted) in x.iter().zip(&wanted) {
                assert!((f64::from(x.to_array()[1]) - wanted).abs() < 1e-2, "{n}: {x:?} {wanted}");
            }
        }
    }

    #[test]
    fn entries_that_are_not_finite_make_no_factor() {
        assert!(BlockFactor::new(&[(0.0, Vec::new())]).is_none());
        assert!(BlockFactor::new(&[(1.0, vec![(1, f64::NAN)]), (1.0, Vec::new())]).is_none());
    }
}
