//! A banded symmetric positive definite matrix, factorised and solved with.
//!
//! A = Lᵀ D L with L unit lower triangular: the unknowns are eliminated from the
//! last to the first, because then both factors of every product lie along rows
//! of the lower part, in which the matrix is assembled. It costs what Cholesky's
//! own order costs, and no square root (Golub and Van Loan, Matrix Computations,
//! 4.1 and 4.3.5).
//!
//! Measured against other arrangements in docs/decisions/0005-band-cholesky.md.

mod factorise;
mod solve;
#[cfg(test)]
mod tests;

use crate::lanes::Lanes;
use crate::real::Real;

/// Rows that are finished together.
const PANEL: usize = 4;

/// Groups of four columns in a tile: four by eight sums leave half of sixteen
/// registers for what they take in.
const GROUPS: usize = 2;

/// Columns of a tile.
const WIDTH: usize = 4 * GROUPS;

/// A symmetric matrix whose entries further than the half-bandwidth from the
/// diagonal are zero; after [`Band::factorise`], its factors.
///
/// Kept row by row: each has `lead` columns before its diagonal, of which the
/// nearest `half_bandwidth` belong to the band and the others stay zero, so that
/// tiles may reach over the band's edge. Column c of row r thus lies at
/// `lead * r + lead + c`: whichever the row, a column is as well aligned. Rows
/// are filled up to whole panels by those of the unit matrix.
///
/// The factors are kept as the rows of D L, with D on the diagonal.
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

    /// Where the entry of a row and a column that is not after it is kept, for [`Self::add_blocks`].
    pub fn place(&self, row: usize, column: usize) -> usize {
        self.at(row, self.lead + column)
    }

    /// Adds blocks one after another to three rows below each other, to four entries of each.
    /// What a block has in no lower part must be zero.
    #[inline(always)]
    pub fn add_blocks(&mut self, place: usize, blocks: &[[T::Four; 3]]) {
        let mut rows = self.entries[place..].chunks_mut(self.lead);
        for i in 0..3 {
            let row = rows.next().and_then(|row| row.first_chunk_mut::<4>());
            let row = row.expect("a block of the matrix");
            let mut sum = T::Four::of(*row);
            for block in blocks {
                sum = sum + block[i];
            }
            *row = sum.to_array();
        }
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
}
