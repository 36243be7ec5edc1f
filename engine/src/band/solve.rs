//! Solving with the factors, four rows at a time.

use super::{Band, PANEL};
use crate::lanes::Lanes;
use crate::real::Real;

impl<T: Real> Band<T> {
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
}
