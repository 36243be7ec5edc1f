//! Where the nodes of a leaf are in the book.
//!
//! A leaf is simulated over a flat table with a straight root; in the book it
//! leaves a gutter between two curved piles (see [`bend_into_gutter`](super::bend_into_gutter())). The
//! gutter's bend is narrower than a cell of the leaf's grid, so for the nodes
//! it is summed up once a tick: for each column and a few angles of a row, by
//! how much a cell's edge is turned and shortened.

use super::book_space_leaf::BookSpaceLeaf;
use super::fraction_turned::fraction_turned;
#[cfg(doc)]
use super::pile::Pile;

/// Angles of a row, from lying right to lying left, for which a cell's turn is
/// tabled; between them it is linear.
const ANGLES: usize = 13;

/// The turn of each cell's edge, as cosine and sine times its shortening.
#[derive(Clone, Debug)]
pub struct Gutter {
    columns: usize,
    /// `[cell][angle]`, cells along u.
    turns: Vec<[[f32; 2]; ANGLES]>,
    /// Parts of drawn segments in each cell: cell, segment, part of the cell.
    parts: Vec<(usize, usize, f32)>,
}

impl Gutter {
    /// For leaves of `columns` nodes between piles with columns at `u`.
    pub fn new(columns: usize, u: &[f32]) -> Gutter {
        let cells = (columns - 1) as f32;
        let mut parts = Vec::new();
        for cell in 0..columns - 1 {
            for segment in 0..u.len() - 1 {
                let from = (u[segment] * cells).max(cell as f32);
                let to = (u[segment + 1] * cells).min((cell + 1) as f32);
                if to > from {
                    parts.push((cell, segment, to - from));
                }
            }
        }
        Gutter {
            columns,
            turns: vec![[[0.0; 2]; ANGLES]; columns - 1],
            parts,
        }
    }

    /// Brings the turns up to date with the [angles](Pile::angles) of the piles.
    pub fn update(&mut self, right: &[f32], left: &[f32]) {
        for turns in &mut self.turns {
            *turns = [[0.0; 2]; ANGLES];
        }
        for &(cell, segment, part) in &self.parts {
            let (on_right, on_left) = (right[segment], left[segment]);
            for (k, turn) in self.turns[cell].iter_mut().enumerate() {
                let w = k as f32 / (ANGLES - 1) as f32;
                let (sin, cos) = libm::sincosf((1.0 - w) * on_right - w * on_left);
                turn[0] += part * cos;
                turn[1] += part * sin;
            }
        }
    }

    /// Bends a leaf's nodes into the gutter: `flat` are x, y, z of each over a flat table, metres.
    pub fn bend(&self, flat: &[f32], in_book: &mut BookSpaceLeaf) {
        let rows = flat.as_chunks::<3>().0.chunks_exact(self.columns);
        let places = in_book.points.chunks_exact_mut(self.columns);
        let turned = in_book.turned.chunks_exact_mut(self.columns);
        for ((flat, places), turned) in rows.zip(places).zip(turned) {
            places[0] = [0.0, flat[0][1], 0.0];
            turned[0] = [1.0, 0.0];
            for k in 1..self.columns {
                let (dx, dz) = (flat[k][0] - flat[k - 1][0], flat[k][2] - flat[k - 1][2]);
                let [cos, sin] = self.turn(k - 1, fraction_turned(dx, dz));
                let before = places[k - 1];
                places[k] = [
                    before[0] + dx * cos - dz * sin,
                    flat[k][1],
                    before[2] + dx * sin + dz * cos,
                ];
                turned[k] = [cos, sin];
            }
        }
        in_book.update_normals();
    }

    fn turn(&self, cell: usize, fraction: f32) -> [f32; 2] {
        let at = fraction.clamp(0.0, 1.0) * (ANGLES - 1) as f32;
        let k = (at as usize).min(ANGLES - 2);
        let (t, [a, b]) = (
            at - k as f32,
            [self.turns[cell][k], self.turns[cell][k + 1]],
        );
        [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
    }
}

#[cfg(test)]
mod tests {
    use super::super::bend_into_gutter::bend_into_gutter;
    use super::super::pile::{Pile, crowded_columns};
    use super::*;
    use crate::creased_only::CreasedOnly;
    use crate::grid::Side;

    #[test]
    fn nodes_are_bent_to_where_the_drawn_leaf_is() {
        let (width, columns) = (0.14, 10);
        let u = crowded_columns(49);
        let right = Pile::new(Side::Right, width, 0.012, &u);
        let left = Pile::new(Side::Left, width, 0.006, &u);
        let mut gutter = Gutter::new(columns, &u);
        gutter.update(right.angles(), left.angles());
        for degrees in [0, 1, 30, 77, 90, 120, 178, 180] {
            let (sin, cos) = libm::sincosf(degrees as f32 * core::f32::consts::PI / 180.0);
            let line = |u: f32| [u * 0.14 * cos, 0.0, u * 0.14 * sin];
            let mut flat: Vec<f32> = (0..columns)
                .flat_map(|k| line(k as f32 / (columns - 1) as f32))
                .collect();
            flat.extend_from_within(..);
            let mut in_book = BookSpaceLeaf::new(columns, 2, [0.01, 0.01]);
            gutter.bend(&flat, &mut in_book);
            let mut drawn: Vec<f32> = u.iter().flat_map(|u| line(*u)).collect();
            bend_into_gutter(&mut drawn, &right, &left, (0.0, CreasedOnly::NONE));
            let end = &drawn[drawn.len() - 3..];
            let node = in_book.points[columns - 1];
            let apart = (end[0] - node[0]).hypot(end[2] - node[2]);
            assert!(apart < 6e-4, "{apart} m at {degrees} degrees");
        }
    }
}
