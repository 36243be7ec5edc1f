//! How far the folds of a leaf are held shut.

use crate::book::book_space_leaf::BookSpaceLeaf;
use crate::book::shut_folds::ShutFolds;
use crate::creased_only::CreasedOnly;

/// Ticks in which folds are shut: 0.15 s, as a leaf is eased to rest.
pub(super) const SHUTTING: u32 = 18;

/// How far the folds of a leaf are held shut.
#[derive(Default)]
pub(super) struct HeldShut {
    /// Where its points lie then, if those creases are shut that rest so; found anew for others.
    pub(super) folds: CreasedOnly<ShutFolds>,
    /// Those creases, as a set of bits.
    pub(super) sought: u16,
    /// Whether they are held.
    pub(super) is_held: bool,
    /// Ticks until they are shut.
    pub(super) ticks_left: u32,
    /// Whether they are shut by now, as one packet: the part next to the spine carries what lies over it.
    pub(super) is_stacked: bool,
    /// Ticks by which they are drawn shut, up to [`SHUTTING`].
    pub(super) ticks_drawn: u32,
}

impl HeldShut {
    /// Where its points lie, and how far they are drawn there, 0 to 1.
    pub fn folds(&self) -> Option<(&ShutFolds, f32)> {
        let part = self.ticks_drawn as f32 / SHUTTING as f32;
        let folds = self.folds.as_ref().filter(|_| part > 0.0);
        folds.map(|folds| (folds, part * part * (3.0 - 2.0 * part)))
    }

    /// Brings nodes in the book to where they lie.
    pub fn lay_in_book(&self, in_book: &mut BookSpaceLeaf) {
        if let Some((folds, part)) = self.folds() {
            folds.nodes.lay(&mut in_book.points, part, 1.0);
            folds.nodes.follow(&mut in_book.turned, part);
        }
    }
}
