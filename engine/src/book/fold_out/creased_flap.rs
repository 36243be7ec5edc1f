//! The further folds of a flap: creases of its sheet, and the panels between them.

use super::panels::Panels;
use crate::book::creased_mesh::CreasedMesh;
use crate::book::flaps::Flaps;
use crate::book::separate_parts::{DrawnParts, ROUNDS};
use crate::book::work::Work;
use crate::grid::Side;
use crate::models::sheet::{FoldLine, Sheet};
use crate::surface::Surface;

/// What a flap with further folds has beside any other.
#[derive(Clone, Debug)]
pub(super) struct CreasedFlap {
    /// Which panel lies upon which.
    flaps: Flaps,
    parts: DrawnParts,
    pub mesh: CreasedMesh,
    /// For each fold the direction in which it is shut: 1 toward the recto, or -1.
    ways: Vec<f32>,
}

impl CreasedFlap {
    /// Creases a flap's sheet at its further folds, as shut as a crease of its paper is. None where
    /// the sheet cannot be creased so.
    pub fn new(
        sheet: &mut Sheet,
        (panels, side): (Panels, Side),
        crease: &FoldLine,
    ) -> Option<CreasedFlap> {
        let ways = (1..panels.count).map(|fold| side.sign() * Panels::way(fold));
        let ways: Vec<f32> = ways.collect();
        let folds = (1..panels.count).zip(&ways).map(|(fold, way)| {
            let at = fold as f64 / panels.count as f64;
            FoldLine {
                through: [[at, 0.0], [at, 1.0]],
                rest: f64::from(*way) * crease.rest,
                ..*crease
            }
        });
        sheet.crease(&folds.collect::<Vec<_>>()).ok()?;
        sheet.let_yield(false);
        let (mesh, parts) = CreasedMesh::of(sheet)?;
        Some(CreasedFlap {
            flaps: Flaps::of(sheet)?,
            parts,
            mesh,
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
                self.flaps.press(crease, rest);
            }
        }
    }

    /// Finds the contacts of the panels with each other.
    pub fn find_contacts(&self, sheet: &mut Sheet) {
        self.flaps.write_contacts(sheet);
    }

    /// Moves the drawn panels off each other.
    pub fn separate(&mut self, surface: &mut Surface, scale: f32) {
        let flaps = &self.flaps;
        let side = |under, part, is_alike| flaps.drawn_side(under, part, is_alike);
        let points = surface.positions.as_chunks_mut::<3>().0;
        let work = &mut Work::new(u32::MAX);
        self.parts.separate(points, (scale, ROUNDS), side, work);
    }
}
