//! A creased sheet beside the book's leaves: its parts between creases meet each other, and what
//! is drawn of them is kept apart.

use super::book_space_leaf::WIDTH;
use crate::contact::drawn_parts::DrawnParts;
use crate::contact::flaps::Flaps;
use crate::contact::separate_parts::{ROUNDS, Rounds};
use crate::contact::work::Work;
use crate::models::sheet::Sheet;
use crate::surface::Surface;

/// What a creased sheet has beside any other.
#[derive(Clone, Debug)]
pub(super) struct FoldedSheet {
    flaps: Flaps,
    parts: DrawnParts,
}

impl FoldedSheet {
    /// What a creased sheet has; None of another.
    pub fn of(sheet: &Sheet) -> Option<FoldedSheet> {
        let parts = DrawnParts::of(&sheet.paper_mesh()?, sheet.drawn_columns());
        let flaps = Flaps::of(sheet)?;
        Some(FoldedSheet { flaps, parts })
    }

    /// Says that a crease rests at another angle, radians: what is folded over lies on that side.
    pub fn press(&mut self, crease: usize, rest: f32) {
        self.flaps.press(crease, rest);
    }

    /// Finds what parts of the sheet, the one that this is of, touch of each other.
    pub fn keep_apart(&self, sheet: &mut Sheet) {
        self.flaps.touch(sheet, 1);
    }

    /// Moves the drawn parts off each other, of a page `width` metres wide.
    pub fn separate(&mut self, surface: &mut Surface, width: f32) {
        let work = &mut Work::new(u32::MAX);
        let rounds = Rounds {
            scale: width / WIDTH,
            most: ROUNDS,
            edges: false,
        };
        self.parts.forget();
        self.parts
            .separate_flaps(surface, &self.flaps, rounds, work);
    }
}
