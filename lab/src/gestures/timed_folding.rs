//! A leaf that is folded before the reader's eyes, as by the viewer.

use turnleaf_engine::FoldLine;
use turnleaf_engine::book::Book;

/// Ticks in which a leaf is folded.
const TICKS: u32 = 60;

/// A leaf that is being folded.
pub struct TimedFolding {
    pub leaf: u32,
    /// Where its folds will rest, radians.
    rests: Vec<f32>,
    /// Since it was begun.
    ticks: u32,
}

impl TimedFolding {
    /// Creases a leaf of a book along lines, flat at first, in place of its creases. None where it has
    /// too few nodes for them; the book is then as it was.
    pub fn begin(book: &mut Book, leaf: u32, lines: &[FoldLine]) -> Option<TimedFolding> {
        let flat = |line: &FoldLine| FoldLine { rest: 0.0, ..*line };
        let is_creased = book.crease(leaf, &lines.iter().map(flat).collect::<Vec<_>>());
        is_creased.then(|| TimedFolding {
            leaf,
            rests: lines.iter().map(|line| line.rest as f32).collect(),
            ticks: 0,
        })
    }

    /// Presses its folds by a tick. Returns whether it is still being folded.
    pub fn press(&mut self, book: &mut Book) -> bool {
        self.ticks += 1;
        let part = self.ticks as f32 / TICKS as f32;
        let eased = part * part * (3.0 - 2.0 * part);
        for (crease, rest) in self.rests.iter().enumerate() {
            book.press(self.leaf, crease, eased * rest);
        }
        self.ticks < TICKS
    }
}
