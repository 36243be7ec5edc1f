//! A = Lᵀ D L, a panel of four rows at a time from the last.
//!
//! A panel is finished tile by tile: a tile is loaded, takes in all later rows
//! while it stays in registers, is eliminated within the panel and stored, once.

use super::{Band, GROUPS, PANEL, WIDTH};
use crate::lanes::Lanes;
use crate::real::Real;

/// Four rows of a tile, from the first.
type Tile<T> = [[<T as Real>::Four; GROUPS]; PANEL];

impl<T: Real> Band<T> {
    /// Replaces the matrix by its factors. Returns how many pivots were not
    /// positive, beyond what rounding leaves of the diagonal entry. Such a pivot
    /// is taken as infinite: its unknown is held, [`Band::solve`] returns zero
    /// for it, and solves for the others as if it were not there. So the factors
    /// stay finite, and a solution x for b has b·x > 0 unless it is zero.
    pub fn factorise(&mut self) -> usize {
        let firsts = (0..self.order).step_by(PANEL).rev();
        firsts.map(|first| self.factorise_panel(first)).sum()
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

    /// The tile whose columns begin at `left`, with all later rows taken in.
    #[inline(always)]
    fn tile(&self, first: usize, left: usize) -> Tile<T> {
        let mut tile: Tile<T> = core::array::from_fn(|i| {
            let from = self.at(first + i, left);
            groups::<T>(&self.entries[from..from + WIDTH])
        });
        let later = self.later(first, left + WIDTH);
        let from = self.at(first + PANEL, left);
        let rows = self.entries[from..from + later * self.lead].chunks_exact(self.lead);
        for (row, factors) in rows.zip(&self.factors[..later]) {
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
