//! One gesture that was played.

use super::folding::Fold;
use super::scene::Outcome;
use super::world::Kind;

/// The outcome of a seed on a stock, by its place among [`STOCKS`](super::world::STOCKS).
pub struct Played {
    /// The seed of the gesture.
    pub seed: u64,
    /// The stock, as a place in that list.
    pub stock: usize,
    /// What its pointers did.
    pub kind: Kind,
    /// How its leaves were folded; None where they were whole.
    pub fold: Option<Fold>,
    /// What was seen of it.
    pub outcome: Outcome,
}
