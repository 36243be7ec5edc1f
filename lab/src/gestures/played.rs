//! One gesture that was played.

use super::folding::Fold;
use super::scene::Outcome;
use super::world::Kind;

/// The outcome of a seed on a stock, by its place among [`STOCKS`](super::world::STOCKS).
pub struct Played {
    pub seed: u64,
    pub stock: usize,
    pub kind: Kind,
    /// How its leaves were folded; None where they were whole.
    pub fold: Option<Fold>,
    pub outcome: Outcome,
}
