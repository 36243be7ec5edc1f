//! Which leaves of a book are of a stock of their own: its cover of card, its boards, the
//! plates between its pages.

use core::ops::Range;

use crate::stock::{Grain, Stock};

/// Weight over stiffness (see [`Stock::heaviness`]) from which a leaf takes the whole shape
/// of the pile that it lies on. Pressed down by its own weight against its stiffness it
/// takes part of it in proportion: half where it is card, a page 0.14 m wide.
const HEAVY: f64 = 3.1;

/// Runs at most: what bounds a book's memory, and the time of adding up its thickness.
const MOST_RUNS: usize = 4096;

/// A run of leaves of one stock.
#[derive(Clone, Debug)]
struct Run {
    leaves: Range<u32>,
    stock: Stock,
    straightness: f32,
}

/// Runs of leaves of other stocks than the book's, in order; none overlap.
#[derive(Clone, Debug, Default)]
pub struct LeafStocks {
    runs: Vec<Run>,
}

impl LeafStocks {
    /// Makes `leaves`, bound by `grain` on pages `width` metres wide, of `stock`.
    /// Returns false, and changes nothing, if the book has too many runs for that.
    pub fn set(&mut self, leaves: Range<u32>, stock: Stock, grain: Grain, width: f64) -> bool {
        let mut runs = Vec::with_capacity(self.runs.len() + 2);
        for run in &self.runs {
            let before = run.leaves.start..run.leaves.end.min(leaves.start);
            let after = run.leaves.start.max(leaves.end)..run.leaves.end;
            for leaves in [before, after] {
                if !leaves.is_empty() {
                    runs.push(Run {
                        leaves,
                        ..run.clone()
                    });
                }
            }
        }
        let straightness = straightness(&stock, grain, width);
        let at = runs.partition_point(|run: &Run| run.leaves.start < leaves.start);
        let made = Run {
            leaves,
            stock,
            straightness,
        };
        runs.insert(at, made);
        if runs.len() > MOST_RUNS {
            return false;
        }
        self.runs = runs;
        true
    }

    /// Makes every leaf of the book's stock again.
    pub fn clear(&mut self) {
        self.runs.clear();
    }

    /// Finds anew how straight leaves lie that are bound by `grain` on pages `width` metres wide.
    pub fn bind(&mut self, grain: Grain, width: f64) {
        for run in &mut self.runs {
            run.straightness = straightness(&run.stock, grain, width);
        }
    }

    /// The stock of a leaf; None if it is the book's.
    pub fn of(&self, leaf: u32) -> Option<&Stock> {
        self.run(leaf).map(|run| &run.stock)
    }

    /// How straight a leaf lies on a pile, from 0 (as the pile's pages) to 1.
    pub fn straightness(&self, leaf: u32) -> f32 {
        self.run(leaf).map_or(0.0, |run| run.straightness)
    }

    /// Thickness of `leaves`, in leaves of `own`, the book's stock.
    pub fn thickness(&self, leaves: Range<u32>, own: &Stock) -> f32 {
        let more = self.runs.iter().map(|run| {
            let (start, end) = (
                run.leaves.start.max(leaves.start),
                run.leaves.end.min(leaves.end),
            );
            let more = run.stock.caliper / own.caliper - 1.0;
            end.saturating_sub(start) as f32 * more as f32
        });
        (leaves.end - leaves.start) as f32 + more.sum::<f32>()
    }

    fn run(&self, leaf: u32) -> Option<&Run> {
        let next = self.runs.partition_point(|run| run.leaves.end <= leaf);
        self.runs.get(next).filter(|run| run.leaves.start <= leaf)
    }
}

fn straightness(stock: &Stock, grain: Grain, width: f64) -> f32 {
    (1.0 - stock.heaviness(width, grain) / HEAVY).max(0.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of each leaf whether it is card, C, or of the book, -.
    fn shown(stocks: &LeafStocks) -> String {
        let of = |leaf| match stocks.of(leaf) {
            Some(stock) if *stock == Stock::CARD => 'C',
            Some(_) => 'B',
            None => '-',
        };
        (0..10).map(of).collect()
    }

    #[test]
    fn later_runs_take_the_place_of_earlier_ones() {
        let mut stocks = LeafStocks::default();
        let mut set = |leaves, stock| {
            assert!(stocks.set(leaves, stock, Grain::AlongSpine, 0.14));
            shown(&stocks)
        };
        assert_eq!(set(2..8, Stock::CARD), "--CCCCCC--");
        assert_eq!(set(4..5, Stock::BOARD), "--CCBCCC--");
        assert_eq!(set(0..3, Stock::BOARD), "BBBCBCCC--");
        assert_eq!(set(0..10, Stock::CARD), "CCCCCCCCCC");
        stocks.clear();
        assert_eq!(shown(&stocks), "----------");
    }

    #[test]
    fn there_are_so_many_runs_and_no_more() {
        let mut stocks = LeafStocks::default();
        let mut set = |leaf| stocks.set(leaf..leaf + 1, Stock::CARD, Grain::AlongSpine, 0.14);
        assert!((0..MOST_RUNS as u32).all(|k| set(2 * k)));
        assert!(!set(2 * MOST_RUNS as u32));
        assert!(set(0));
    }

    #[test]
    fn thickness_counts_calipers() {
        let mut stocks = LeafStocks::default();
        assert_eq!(stocks.thickness(3..10, &Stock::BIBLE), 7.0);
        assert!(stocks.set(4..6, Stock::BOARD, Grain::AlongSpine, 0.14));
        let board = (1.6e-3 / 40e-6) as f32;
        assert!((stocks.thickness(0..5, &Stock::BIBLE) - 4.0 - board).abs() < 1e-3);
        assert!((stocks.thickness(5..10, &Stock::BIBLE) - 4.0 - board).abs() < 1e-3);
    }

    #[test]
    fn board_lies_straight_card_half_and_paper_as_the_pile() {
        let of = |stock| straightness(&stock, Grain::AlongSpine, 0.14);
        assert!(of(Stock::BOARD) > 0.98);
        assert!((of(Stock::CARD) - 0.5).abs() < 0.02);
        assert_eq!([of(Stock::COATED), of(Stock::BIBLE)], [0.0; 2]);
    }
}
