//! The further folds of a flap: creases of its sheet, and the panels between them.

use super::panels::Panels;
use crate::book::folded_sheet::FoldedSheet;
use crate::grid::Side;
use crate::models::sheet::{Sheet, SheetCrease};

/// What a flap with further folds has beside any other.
#[derive(Clone, Debug)]
pub(super) struct CreasedFlap {
    /// Its panels.
    pub folded: FoldedSheet,
    /// For each fold the direction in which it is shut: 1 toward the recto, or -1.
    ways: Vec<f32>,
}

impl CreasedFlap {
    /// Creases a flap's sheet at its further folds, as shut as a crease of its paper is. None where
    /// the sheet cannot be creased so.
    pub fn new(
        sheet: &mut Sheet,
        (panels, side): (Panels, Side),
        crease: &SheetCrease,
    ) -> Option<CreasedFlap> {
        let ways = (1..panels.count).map(|fold| side.sign() * Panels::way(fold));
        let ways: Vec<f32> = ways.collect();
        let folds = (1..panels.count).zip(&ways).map(|(fold, way)| {
            let at = fold as f64 / panels.count as f64;
            SheetCrease {
                through: [[at, 0.0], [at, 1.0]],
                rest: f64::from(*way) * crease.rest,
                ..*crease
            }
        });
        sheet.crease(&folds.collect::<Vec<_>>()).ok()?;
        sheet.let_yield(false);
        Some(CreasedFlap {
            folded: FoldedSheet::of(sheet)?,
            ways,
        })
    }

    /// Angle of a crease and its rest, radians: pi where it is shut.
    pub fn angle(&self, sheet: &Sheet, crease: usize) -> Option<[f32; 2]> {
        let angle = sheet.crease_angle(crease)?;
        Some(angle.map(|angle| self.ways[crease] * angle))
    }

    /// Turns the rest of each crease to what `rest` makes of its number, its angle and its rest,
    /// radians.
    pub fn press(&mut self, sheet: &mut Sheet, rest: impl Fn(usize, f32, f32) -> f32) {
        for crease in 0..self.ways.len() {
            if let Some([angle, before]) = self.angle(sheet, crease) {
                let rest = self.ways[crease] * rest(crease, angle, before);
                sheet.press(crease, rest);
                self.folded.press(crease, rest);
            }
        }
    }
}
