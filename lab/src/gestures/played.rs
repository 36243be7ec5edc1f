//! One gesture that was played.

use super::scene::Outcome;
use super::world::Kind;

/// The outcome of a seed on a stock, by its place among [`STOCKS`](super::world::STOCKS).
pub struct Played {
    pub seed: u64,
    pub stock: usize,
    pub kind: Kind,
    pub outcome: Outcome,
}
