//! Which leaves of a book are creased, and along which lines.

use super::flight::Flight;
use crate::creased_only::CreasedOnly;
use crate::models::sheet::SheetCrease;

/// Creased leaves of a book and creases of a leaf, at most: what bounds a book's memory.
const MOST_LEAVES: usize = 4096;
const MOST_CREASES: usize = 16;

/// Flights of creased leaves that are kept to be used again, at most: creasing a sheet takes as
/// long as a frame.
const MOST_KEPT: usize = 4;

/// A creased leaf.
#[derive(Clone, Debug)]
struct CreasedLeaf {
    leaf: u32,
    creases: CreasedOnly<Vec<SheetCrease>>,
    /// When it was creased or covered last, seconds as the book's time.
    since: f64,
}

/// The creased leaves of a book.
#[derive(Default)]
pub struct CreasedLeaves {
    /// By their numbers.
    leaves: Vec<CreasedLeaf>,
    /// Leaves that were creased and drawn, from the one that was covered first.
    kept: Vec<(u32, Flight)>,
    /// Seconds that have passed.
    time: f64,
}

impl CreasedLeaves {
    /// Whether a leaf may have so many creases, and be one more creased leaf if it is not.
    pub fn has_room(&self, leaf: u32, creases: usize) -> bool {
        let is_full = self.leaves.len() == MOST_LEAVES && self.index(leaf).is_err();
        creases == 0 || (creases <= MOST_CREASES && !is_full)
    }

    /// Notes the creases of a leaf, for which there is [room](Self::has_room), in place of those
    /// that it had; none where it has none any more.
    pub fn set(&mut self, leaf: u32, creases: &[SheetCrease]) {
        self.kept.retain(|(kept, _)| *kept != leaf);
        if let Ok(at) = self.index(leaf) {
            self.leaves.remove(at);
        }
        if !creases.is_empty() {
            let made = CreasedLeaf {
                leaf,
                creases: CreasedOnly::some(creases.to_vec()),
                since: self.time,
            };
            let at = self.index(leaf).unwrap_or_else(|at| at);
            self.leaves.insert(at, made);
        }
    }

    /// The creases of a leaf; None where it has none.
    pub fn of(&self, leaf: u32) -> Option<&[SheetCrease]> {
        let at = self.index(leaf).ok()?;
        self.leaves[at].creases.as_ref().map(Vec::as_slice)
    }

    /// Lets seconds pass.
    pub fn pass(&mut self, seconds: f64) {
        self.time += seconds;
    }

    /// Seconds for which a creased leaf has lain under others; 0 of one that is not creased.
    pub fn covered_for(&self, leaf: u32) -> f64 {
        self.index(leaf)
            .map_or(0.0, |at| self.time - self.leaves[at].since)
    }

    /// Whether a leaf is creased along the same lines, so that another can be.
    pub fn has_lines(&self, creases: &[SheetCrease]) -> bool {
        let lines = |creases: &[SheetCrease]| creases.iter().map(|crease| crease.through).collect();
        let asked: Vec<_> = lines(creases);
        let mut known = self.leaves.iter().filter_map(|leaf| leaf.creases.as_ref());
        known.any(|creases| creases.len() == asked.len() && lines(creases) == asked)
    }

    /// Keeps the flight of a creased leaf that is covered and so no longer drawn. Returns it where
    /// the leaf has no creases any more.
    pub fn cover(&mut self, flight: Flight) -> Option<Flight> {
        let leaf = flight.low();
        let Ok(at) = self.index(leaf) else {
            return Some(flight);
        };
        self.leaves[at].creases = CreasedOnly::some(flight.leaf().creases());
        self.leaves[at].since = self.time;
        self.kept.push((leaf, flight));
        if self.kept.len() > MOST_KEPT {
            self.kept.remove(0);
        }
        None
    }

    /// A kept flight of a leaf.
    pub fn take(&mut self, leaf: u32) -> Option<Flight> {
        let at = self.kept.iter().position(|(kept, _)| *kept == leaf)?;
        Some(self.kept.remove(at).1)
    }

    /// Forgets every flight that it keeps, as leaves are made of another paper.
    pub fn forget_flights(&mut self) {
        self.kept.clear();
    }

    fn index(&self, leaf: u32) -> Result<usize, usize> {
        self.leaves.binary_search_by_key(&leaf, |known| known.leaf)
    }
}
