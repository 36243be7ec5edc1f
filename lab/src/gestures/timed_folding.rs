//! A leaf that is folded before the reader's eyes, as by the viewer.

use turnleaf_engine::SheetCrease;
use turnleaf_engine::book::Book;

/// Ticks in which a leaf is folded.
const TICKS: u32 = 60;

/// A leaf that is being folded.
pub struct TimedFolding {
    /// The leaf, from 0 at the front.
    pub leaf: u32,
    /// Where its folds rested when that began, and where they will rest, radians.
    from: Vec<f32>,
    to: Vec<f32>,
    /// Its creases from then on, if it has others until then.
    after: Option<Vec<SheetCrease>>,
    /// Since it was begun.
    ticks: u32,
}

impl TimedFolding {
    /// Folds a leaf of a book along lines, in place of its folds: these keep their creases until they
    /// are open, and are opened first where the leaf has too few nodes for both. None where it has too
    /// few for the new ones; the book is then as it was.
    pub fn begin(book: &mut Book, leaf: u32, lines: &[SheetCrease]) -> Option<TimedFolding> {
        let before = book.creases(leaf);
        let is_opened = |old: &&SheetCrease| !lines.iter().any(|line| line.through == old.through);
        let opened: Vec<SheetCrease> = before.iter().filter(is_opened).copied().collect();
        let rest_before = |line: &SheetCrease| {
            let known = before.iter().find(|old| old.through == line.through);
            known.map_or(0.0, |old| old.rest)
        };
        let all = lines.iter().chain(&opened);
        let creased: Vec<SheetCrease> = all
            .map(|line| SheetCrease {
                rest: rest_before(line),
                ..*line
            })
            .collect();
        let rests = |of: &[SheetCrease]| of.iter().map(|line| line.rest as f32).collect();
        if book.crease(leaf, &creased) {
            let to = lines.iter().map(|line| line.rest as f32);
            return Some(TimedFolding {
                leaf,
                from: rests(&creased),
                to: to.chain(opened.iter().map(|_| 0.0)).collect(),
                after: (!opened.is_empty()).then(|| lines.to_vec()),
                ticks: 0,
            });
        }
        (!opened.is_empty()).then(|| TimedFolding {
            leaf,
            from: rests(&before),
            to: vec![0.0; before.len()],
            after: Some(lines.to_vec()),
            ticks: 0,
        })
    }

    /// Presses its folds by a tick. Returns whether it is still being folded.
    pub fn press(&mut self, book: &mut Book) -> bool {
        self.ticks += 1;
        let part = self.ticks as f32 / TICKS as f32;
        let eased = part * part * (3.0 - 2.0 * part);
        for (crease, (from, to)) in self.from.iter().zip(&self.to).enumerate() {
            book.press(self.leaf, crease, from + eased * (to - from));
        }
        if self.ticks < TICKS {
            return true;
        }
        let Some(after) = self.after.take() else {
            return false;
        };
        // Folds that were opened together with new ones are done; those that were opened alone are not
        // folded yet.
        let is_folded = self.to.iter().any(|rest| *rest != 0.0);
        let rest = |line: &SheetCrease| if is_folded { line.rest } else { 0.0 };
        let flat: Vec<SheetCrease> = after
            .iter()
            .map(|line| SheetCrease {
                rest: rest(line),
                ..*line
            })
            .collect();
        if !book.crease(self.leaf, &flat) || is_folded {
            return false;
        }
        (self.from, self.ticks) = (vec![0.0; after.len()], 0);
        self.to = after.iter().map(|line| line.rest as f32).collect();
        true
    }
}
