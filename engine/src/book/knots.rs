//! Every pile that a book may have, blended from a few that are computed once.
//!
//! Finding a pile's shape costs bisections; while leaves are in flight both
//! piles grow and shrink with every tick. So a book computes its piles at a
//! few thicknesses, its knots, and blends between them.

use super::block::Pile;
use crate::grid::Side;

/// Knots from an empty pile to the whole book. They crowd toward the empty one,
/// where a pile's shape changes most: with 49 a blended pile is within 0.05 mm
/// of the one that would be computed, as a test holds.
const KNOTS: usize = 49;

/// The piles of a book at its knots, as they lie on the right.
pub struct Knots {
    piles: Vec<Pile>,
}

impl Knots {
    /// Computes the piles of a book of pages `width` metres wide and together
    /// `thickness` metres thick, at the columns `u`.
    pub fn new(width: f64, thickness: f64, u: &[f32]) -> Knots {
        let pile = |knot| Pile::new(Side::Right, width, thickness * share_at(knot) as f64, u);
        Knots {
            piles: (0..KNOTS).map(pile).collect(),
        }
    }

    /// Writes the pile on `side` of a share (0 to 1) of the book's thickness.
    /// `out` has the same columns.
    pub fn write(&self, side: Side, share: f32, out: &mut Pile) {
        let share = share.clamp(0.0, 1.0);
        let knot = ((libm::cbrtf(share * share) * (KNOTS - 1) as f32) as usize).min(KNOTS - 2);
        let (low, high) = (share_at(knot), share_at(knot + 1));
        let t = (share - low) / (high - low);
        out.blend(&self.piles[knot], &self.piles[knot + 1], t);
        if side == Side::Left {
            out.mirror();
        }
    }
}

/// Share of the book's thickness at a knot.
fn share_at(knot: usize) -> f32 {
    let t = knot as f32 / (KNOTS - 1) as f32;
    t * t.sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::block::crowded_columns;
    use super::*;

    #[test]
    fn a_blended_pile_is_the_one_that_would_be_computed() {
        let u = crowded_columns(49);
        for thickness in [0.002, 0.012, 0.024] {
            let knots = Knots::new(0.14, thickness, &u);
            let mut worst = 0.0f32;
            for i in 0..=100 {
                let share = i as f32 / 100.0;
                for side in [Side::Right, Side::Left] {
                    let exact = Pile::new(side, 0.14, thickness * share as f64, &u);
                    let mut blended = exact.clone();
                    knots.write(side, share, &mut blended);
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
        let knots = Knots::new(0.14, 0.02, &u);
        let mut pile = Pile::new(Side::Right, 0.14, 0.0, &u);
        let mut before = pile.curves().to_vec();
        for i in 0..=4000 {
            knots.write(Side::Right, i as f32 / 4000.0, &mut pile);
            for (a, b) in before.iter().zip(pile.curves()) {
                assert!((a - b).abs() < 1e-4, "{} m at step {i}", (a - b).abs());
            }
            before.copy_from_slice(pile.curves());
        }
    }
}
