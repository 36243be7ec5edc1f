//! A banded symmetric positive definite matrix, factorised and solved with.
//!
//! A = Lᵀ D L with L unit lower triangular: the unknowns are eliminated from the
//! last to the first, because then both factors of every product lie along rows
//! of the lower part, in which the matrix is assembled. It costs what Cholesky's
//! own order costs, and no square root (Golub and Van Loan, Matrix Computations,
//! 4.1 and 4.3.5).
//!
//! Four rows are finished at a time, in tiles that stay in registers: a tile is
//! loaded, takes in all later rows, is eliminated within itself and stored, once.

use crate::lanes::Lanes;
use crate::real::Real;

/// Rows that are finished together.
const PANEL: usize = 4;

/// Groups of four columns in a tile.
const GROUPS: usize = 2;

/// Columns of a tile.
const WIDTH: usize = 4 * GROUPS;

/// Four rows of a tile, from the first.
type Tile<T> = [[<T as Real>::Four; GROUPS]; PANEL];

/// A symmetric matrix whose entries further than the half-bandwidth from the
/// diagonal are zero; after [`Band::factorise`], its factors.
///
/// Kept row by row: each has `lead` columns before its diagonal, of which the
/// nearest `half_bandwidth` belong to the band and the others stay zero, so that
/// tiles may reach over the band's edge. Column c of row r thus lies at
/// `lead * r + lead + c`: whichever the row, a column is as well aligned. Rows
/// are filled up to whole panels by those of the unit matrix.
///
/// Factors: a row of D L, which on the diagonal is that of D.
#[derive(Clone, Debug)]
pub(crate) struct Band<T: Real> {
    order: usize,
    half_bandwidth: usize,
    lead: usize,
    entries: Vec<T>,
    /// 1 / d of every row, zero for an unknown that is held.
    inverses: Vec<T>,
    /// For every later row in reach of the panel, its L in the panel's columns.
    factors: Vec<[T::Four; PANEL]>,
}

impl<T: Real> Band<T> {
    /// A matrix of zeros with `order` rows.
    pub fn new(order: usize, half_bandwidth: usize) -> Self {
        let lead = (half_bandwidth + WIDTH + PANEL).next_multiple_of(4);
        let padded = order.next_multiple_of(PANEL);
        let mut band = Self {
            order,
            half_bandwidth,
            lead,
            entries: vec![T::ZERO; (padded + 1) * (lead + 1)],
            inverses: vec![T::ZERO; padded],
            factors: vec![[T::Four::repeat(T::ZERO); PANEL]; half_bandwidth],
        };
        band.clear();
        band
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Greatest distance of an entry from the diagonal, in columns.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Makes every entry zero again.
    pub fn clear(&mut self) {
        self.entries.fill(T::ZERO);
        for row in self.order..self.padded() {
            let diagonal = self.diagonal(row);
            self.entries[diagonal] = T::ONE;
        }
    }

    /// Becomes a copy of a matrix of the same shape.
    pub fn copy_from(&mut self, other: &Band<T>) {
        debug_assert_eq!(self.order, other.order);
        debug_assert_eq!(self.half_bandwidth, other.half_bandwidth);
        self.entries.copy_from_slice(&other.entries);
    }

    /// A row's columns `row - half_bandwidth ..= row`, the diagonal last. In the
    /// first rows this begins before column 0, with entries that must stay zero.
    pub fn row_mut(&mut self, row: usize) -> &mut [T] {
        let diagonal = self.diagonal(row);
        &mut self.entries[diagonal - self.half_bandwidth..=diagonal]
    }

    /// Adds to the entry of a row and a column, and to its mirror image.
    /// `column` is at most `row`, and within the band.
    pub fn add(&mut self, row: usize, column: usize, value: T) {
        let place = self.half_bandwidth - (row - column);
        self.row_mut(row)[place] += value;
    }

    /// Replaces the matrix by its factors and answers how many pivots were not
    /// positive, beyond what rounding leaves of the diagonal entry. Such a pivot
    /// is taken as infinite: its unknown is held, [`Band::solve`] answers zero
    /// for it, and solves for the others as if it were not there. So the factors
    /// stay finite, and an answer x to b has b·x > 0 unless it is zero.
    pub fn factorise(&mut self) -> usize {
        let firsts = (0..self.order).step_by(PANEL).rev();
        firsts.map(|first| self.factorise_panel(first)).sum()
    }

    /// Replaces `b` by the solution of A x = b. [`Band::factorise`] comes before.
    pub fn solve(&self, b: &mut [T]) {
        debug_assert_eq!(b.len(), self.order);
        for first in (0..self.order).step_by(PANEL).rev() {
            self.solve_panel_upwards(first, b);
        }
        for first in (0..self.order).step_by(PANEL) {
            self.solve_panel_downwards(first, b);
        }
    }

    /// A panel of Lᵀ y = b, and z = y / D in its place.
    fn solve_panel_upwards(&self, first: usize, b: &mut [T]) {
        let (before, rest) = b.split_at_mut(first);
        let mut z = [T::ZERO; PANEL];
        let count = PANEL.min(rest.len());
        z[..count].copy_from_slice(&rest[..count]);
        for k in (0..PANEL).rev() {
            let diagonal = self.diagonal(first + k);
            z[k] *= self.inverses[first + k];
            for i in 0..k {
                z[i] -= self.entries[diagonal - k + i] * z[k];
            }
        }
        rest[..count].copy_from_slice(&z[..count]);
        let z = z.map(T::Four::repeat);
        let left = self.left(first);
        let [row0, row1, row2, row3] = self.rows_before(first);
        let (b, _) = before[left..].as_chunks_mut::<4>();
        let rows = row0.iter().zip(row1).zip(row2).zip(row3);
        for (b, (((&row0, &row1), &row2), &row3)) in b.iter_mut().zip(rows) {
            let mut four = T::Four::of(*b);
            four = four - T::Four::of(row3) * z[3];
            four = four - T::Four::of(row2) * z[2];
            four = four - T::Four::of(row1) * z[1];
            four = four - T::Four::of(row0) * z[0];
            *b = four.to_array();
        }
    }

    /// A panel of L x = z.
    fn solve_panel_downwards(&self, first: usize, b: &mut [T]) {
        let (before, rest) = b.split_at_mut(first);
        let left = self.left(first);
        let (x, _) = before[left..].as_chunks::<4>();
        let [row0, row1, row2, row3] = self.rows_before(first);
        let mut sums = [T::Four::repeat(T::ZERO); PANEL];
        let rows = row0.iter().zip(row1).zip(row2).zip(row3);
        for (&x, (((&row0, &row1), &row2), &row3)) in x.iter().zip(rows) {
            let x = T::Four::of(x);
            sums[0] = sums[0] + T::Four::of(row0) * x;
            sums[1] = sums[1] + T::Four::of(row1) * x;
            sums[2] = sums[2] + T::Four::of(row2) * x;
            sums[3] = sums[3] + T::Four::of(row3) * x;
        }
        let mut sums = sums.map(|sum| {
            let [a, b, c, d] = sum.to_array();
            (a + b) + (c + d)
        });
        for (k, x) in rest.iter_mut().take(PANEL).enumerate() {
            *x -= self.inverses[first + k] * sums[k];
            for i in k + 1..PANEL {
                sums[i] += self.entries[self.diagonal(first + i) + k - i] * *x;
            }
        }
    }

    /// Where a group of four columns begins that the panel's band begins in.
    #[inline(always)]
    fn left(&self, first: usize) -> usize {
        first.saturating_sub(self.half_bandwidth.next_multiple_of(4))
    }

    /// The panel's rows from there to the panel's block, in groups of four.
    #[inline(always)]
    fn rows_before(&self, first: usize) -> [&[[T; 4]]; PANEL] {
        let columns = first - self.left(first);
        core::array::from_fn(|i| {
            let end = self.at(first + i, self.lead + first);
            self.entries[end - columns..end].as_chunks::<4>().0
        })
    }

    #[inline(always)]
    fn diagonal(&self, row: usize) -> usize {
        self.at(row, self.lead + row)
    }

    fn padded(&self) -> usize {
        self.order.next_multiple_of(PANEL)
    }

    /// Where the entry of a row and a column is. Columns count from `lead` before
    /// the first.
    #[inline(always)]
    fn at(&self, row: usize, column: usize) -> usize {
        self.lead * row + column
    }

    fn factorise_panel(&mut self, first: usize) -> usize {
        self.gather(first);
        let mut right = self.lead + first + PANEL;
        let mut tile = self.tile(first, right - WIDTH);
        let diagonal =
            core::array::from_fn(|i| self.entries[self.at(first + i, right - PANEL + i)]);
        let block = tile.map(|row| row[GROUPS - 1].to_array());
        let pivots = Pivots::of(block, diagonal);
        pivots.eliminate(&mut tile);
        self.store_diagonal(first, &tile, &pivots);
        right -= WIDTH;
        let least = self.lead + first.saturating_sub(self.half_bandwidth);
        while right > least {
            let mut tile = self.tile(first, right - WIDTH);
            pivots.eliminate(&mut tile);
            self.store(first, right - WIDTH, &tile);
            right -= WIDTH;
        }
        pivots.held
    }

    /// Rows after the panel that are not zero everywhere left of column `right`.
    #[inline(always)]
    fn later(&self, first: usize, right: usize) -> usize {
        let end = (right + self.half_bandwidth - self.lead).min(self.padded());
        end.saturating_sub(first + PANEL)
    }

    /// Gathers L of the later rows in the panel's columns.
    fn gather(&mut self, first: usize) {
        let right = self.lead + first + PANEL;
        let later = self.later(first, right);
        let from = self.at(first + PANEL, right - PANEL);
        let rows = self.entries[from..from + later * self.lead].chunks_exact(self.lead);
        let inverses = &self.inverses[first + PANEL..][..later];
        for ((row, &inverse), factors) in rows.zip(inverses).zip(&mut self.factors) {
            let four = T::Four::of(row[..PANEL].try_into().expect("four columns"));
            let four = four * T::Four::repeat(inverse);
            *factors = four.to_array().map(T::Four::repeat);
        }
    }

    /// The tile whose columns begin at `left`, with all later rows taken in, the
    /// last first.
    #[inline(always)]
    fn tile(&self, first: usize, left: usize) -> Tile<T> {
        let mut tile: Tile<T> = core::array::from_fn(|i| {
            let from = self.at(first + i, left);
            groups::<T>(&self.entries[from..from + WIDTH])
        });
        let later = self.later(first, left + WIDTH);
        let from = self.at(first + PANEL, left);
        let rows = self.entries[from..from + later * self.lead].chunks_exact(self.lead);
        for (row, factors) in rows.zip(&self.factors[..later]).rev() {
            let row = groups::<T>(row);
            for i in 0..PANEL {
                for group in 0..GROUPS {
                    tile[i][group] = tile[i][group] - factors[i] * row[group];
                }
            }
        }
        tile
    }

    #[inline(always)]
    fn store(&mut self, first: usize, left: usize, tile: &Tile<T>) {
        for i in 0..PANEL {
            let from = self.at(first + i, left);
            let (to, _) = self.entries[from..from + WIDTH].as_chunks_mut::<4>();
            for group in 0..GROUPS {
                to[group] = tile[i][group].to_array();
            }
        }
    }

    /// Stores the tile that ends with the diagonal's block, but for the upper
    /// part, in whose place the next row begins.
    fn store_diagonal(&mut self, first: usize, tile: &Tile<T>, pivots: &Pivots<T>) {
        for i in 0..PANEL {
            let diagonal = self.diagonal(first + i);
            for group in 0..GROUPS {
                let values = tile[i][group].to_array();
                let from = diagonal + 4 * group + PANEL - WIDTH - i;
                let last = group == GROUPS - 1;
                let count = if last { i + 1 } else { 4 };
                self.entries[from..from + count].copy_from_slice(&values[..count]);
            }
        }
        self.inverses[first..first + PANEL].copy_from_slice(&pivots.inverses);
    }
}

#[inline(always)]
fn groups<T: Real>(columns: &[T]) -> [T::Four; GROUPS] {
    let (fours, _) = columns.as_chunks::<4>();
    let fours: &[[T; 4]; GROUPS] = fours.first_chunk().expect("a tile's columns");
    core::array::from_fn(|group| T::Four::of(fours[group]))
}

/// How a panel is eliminated within itself.
struct Pivots<T: Real> {
    /// 1 / d, zero for an unknown that is held.
    inverses: [T; PANEL],
    /// L of row k in column i < k.
    factors: [[T::Four; PANEL]; PANEL],
    held: usize,
}

impl<T: Real> Pivots<T> {
    /// Of the diagonal's block, of which the lower part is read, and the matrix's
    /// diagonal there.
    #[inline(always)]
    fn of(mut block: [[T; PANEL]; PANEL], diagonal: [T; PANEL]) -> Self {
        let mut inverses = [T::ZERO; PANEL];
        let mut factors = [[T::Four::repeat(T::ZERO); PANEL]; PANEL];
        let mut held = 0;
        for k in (0..PANEL).rev() {
            if diagonal[k] + block[k][k] > diagonal[k] {
                inverses[k] = T::ONE / block[k][k];
            } else {
                held += 1;
            }
            for i in 0..k {
                let factor = block[k][i] * inverses[k];
                factors[k][i] = T::Four::repeat(factor);
                for j in 0..=i {
                    block[i][j] -= factor * block[k][j];
                }
            }
        }
        Self {
            inverses,
            factors,
            held,
        }
    }

    #[inline(always)]
    fn eliminate(&self, tile: &mut Tile<T>) {
        for k in (1..PANEL).rev() {
            for i in 0..k {
                for group in 0..GROUPS {
                    tile[i][group] = tile[i][group] - self.factors[k][i] * tile[k][group];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, for_seeds};

    /// Orders and half-bandwidths about the sizes of panels and tiles.
    const SHAPES: [(usize, usize); 12] = [
        (0, 3),
        (1, 0),
        (1, 5),
        (3, 1),
        (5, 0),
        (7, 9),
        (8, 3),
        (13, 4),
        (30, 11),
        (33, 12),
        (61, 17),
        (90, 68),
    ];

    /// Entries between -1 and 1, and a diagonal that is greater than its row's sum.
    fn definite<T: Real>(random: &mut Random, order: usize, half_bandwidth: usize) -> Band<T> {
        let mut band = Band::new(order, half_bandwidth);
        for row in 0..order {
            for column in row.saturating_sub(half_bandwidth)..row {
                let value = T::of(f64::from(random.between(-1.0, 1.0)));
                band.add(row, column, value);
                band.add(row, row, value.abs());
                band.add(column, column, value.abs());
            }
            band.add(row, row, T::of(f64::from(random.between(0.01, 1.0))));
        }
        band
    }

    fn dense<T: Real>(band: &Band<T>) -> Vec<Vec<T>> {
        let mut dense = vec![vec![T::ZERO; band.order]; band.order];
        let mut band = band.clone();
        for row in 0..band.order {
            for column in row.saturating_sub(band.half_bandwidth)..=row {
                let place = band.half_bandwidth - (row - column);
                let value = band.row_mut(row)[place];
                dense[row][column] = value;
                dense[column][row] = value;
            }
        }
        dense
    }

    /// The same factors in scalars, one entry after the other, in the same order.
    fn dense_factors<T: Real>(mut a: Vec<Vec<T>>) -> Vec<Vec<T>> {
        let mut inverses = vec![T::ZERO; a.len()];
        for i in (0..a.len()).rev() {
            for j in (0..=i).rev() {
                for k in (i + 1..a.len()).rev() {
                    let product = a[k][i] * inverses[k] * a[k][j];
                    a[i][j] -= product;
                }
            }
            inverses[i] = T::ONE / a[i][i];
        }
        a
    }

    fn times<T: Real>(a: &[Vec<T>], x: &[T]) -> Vec<T> {
        let product = |row: &Vec<T>| {
            let terms = row.iter().zip(x).map(|(&a, &x)| a * x);
            terms.fold(T::ZERO, |sum, term| sum + term)
        };
        a.iter().map(product).collect()
    }

    fn greatest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
        values
            .into_iter()
            .fold(T::ZERO, |most, value| most.max(value.abs()))
    }

    fn factors_agree<T: Real>(random: &mut Random) {
        for (order, half_bandwidth) in SHAPES {
            let mut band = definite::<T>(random, order, half_bandwidth);
            let expected = dense_factors(dense(&band));
            assert_eq!(band.factorise(), 0);
            let got = dense(&band);
            for row in 0..order {
                assert_eq!(
                    got[row][..=row],
                    expected[row][..=row],
                    "row {row} of {order}, {half_bandwidth}"
                );
            }
        }
    }

    #[test]
    fn factors_are_those_of_scalars_in_the_same_order() {
        for_seeds(factors_agree::<f32>);
        for_seeds(factors_agree::<f64>);
    }

    fn solution_multiplies_back<T: Real>(random: &mut Random, precision: f64) {
        for (order, half_bandwidth) in SHAPES {
            let mut band = definite::<T>(random, order, half_bandwidth);
            let a = dense(&band);
            let b: Vec<T> = (0..order)
                .map(|_| T::of(f64::from(random.between(-1.0, 1.0))))
                .collect();
            let mut x = b.clone();
            assert_eq!(band.factorise(), 0);
            band.solve(&mut x);
            let residual = greatest(times(&a, &x).iter().zip(&b).map(|(&ax, &b)| ax - b));
            let scale = greatest(a.concat()) * greatest(x) * T::of(order as f64);
            assert!(
                residual <= scale * T::of(precision),
                "{residual:?} of {scale:?}"
            );
        }
    }

    #[test]
    fn solution_multiplies_back_to_b() {
        for_seeds(|random| solution_multiplies_back::<f32>(random, f64::from(f32::EPSILON)));
        for_seeds(|random| solution_multiplies_back::<f64>(random, f64::EPSILON));
    }
}
