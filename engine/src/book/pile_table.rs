//! Every pile that a book may have, blended from a few that are computed once.
//!
//! Finding a pile's shape costs bisections; while leaves are in flight both
//! piles grow and shrink with every tick. So a book computes its piles at a
//! few thicknesses, the table's entries, and blends between them.

use super::pile::Pile;
use crate::grid::Side;

/// PileTable from an empty pile to the whole book. They crowd toward the empty one,
/// where a pile's shape changes most: with 49 a blended pile is within 0.05 mm
/// of the one that would be computed, as a test holds.
const ENTRIES: usize = 49;

/// The piles of a book at the thicknesses of the table, as they lie on the right.
pub struct PileTable {
    piles: Vec<Pile>,
}

impl PileTable {
    /// Computes the piles of a book of pages `width` metres wide and together
    /// `thickness` metres thick, at the columns `u`.
    pub fn new(width: f64, thickness: f64, u: &[f32]) -> PileTable {
        let pile = |entry| Pile::new(Side::Right, width, thickness * fraction_at(entry) as f64, u);
        PileTable {
            piles: (0..ENTRIES).map(pile).collect(),
        }
    }

    /// Writes the pile on `side` of a fraction (0 to 1) of the book's thickness.
    /// `out` has the same columns.
    pub fn write(&self, side: Side, fraction: f32, out: &mut Pile) {
        let fraction = fraction.clamp(0.0, 1.0);
        let entry =
            ((libm::cbrtf(fraction * fraction) * (ENTRIES - 1) as f32) as usize).min(ENTRIES - 2);
        let (low, high) = (fraction_at(entry), fraction_at(entry + 1));
        let t = (fraction - low) / (high - low);
        out.blend(&self.piles[entry], &self.piles[entry + 1], t);
        if side == Side::Left {
            out.mirror();
        }
    }
}

/// Share of the book's thickness at a entry.
fn fraction_at(entry: usize) -> f32 {
    let t = entry as f32 / (ENTRIES - 1) as f32;
    t * t.sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::pile::crowded_columns;
    use super::*;

    #[test]
    fn a_blended_pile_is_the_one_that_would_be_computed() {
        let u = crowded_columns(49);
        for thickness in [0.002, 0.012, 0.024] {
            let pile_table = PileTable::new(0.14, thickness, &u);
            let mut worst = 0.0f32;
            for i in 0..=100 {
                let fraction = i as f32 / 100.0;
                for side in [Side::Right, Side::Left] {
                    let exact = Pile::new(side, 0.14, thickness * fraction as f64, &u);
                    let mut blended = exact.clone();
                    pile_table.write(side, fraction, &mut blended);
                    for (a, b) in exact.curves().iter().zip(blended.curves()) {
                        worst = worst.max((a - b).abs());
                    }
                }
            }
            assert!(worst < 5e-5, "{worst} m at {thickness} m");
        }
    }

    #[test]
    fn piles_grow_without_a_jump() {
        let u = crowded_columns(49);
        let pile_table = PileTable::new(0.14, 0.02, &u);
        let mut pile = Pile::new(Side::Right, 0.14, 0.0, &u);
        let mut before = pile.curves().to_vec();
        for i in 0..=4000 {
            pile_table.write(Side::Right, i as f32 / 4000.0, &mut pile);
            for (a, b) in before.iter().zip(pile.curves()) {
                assert!((a - b).abs() < 1e-4, "{} m at step {i}", (a - b).abs());
            }
            before.copy_from_slice(pile.curves());
        }
    }
}
