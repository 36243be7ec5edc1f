//! A sheet that is torn across: two pieces in one, tied along the tear, then two sheets.
//!
//! The [grid](super::torn_grid) has the nodes of the path twice. Ties hold them together, one
//! for each, and stand for the paper there: when a tie is gone, the tear has opened by so much.
//! Paper bends freely along what still holds, as along a perforation. Once nothing holds, the
//! pieces have nothing to do with each other, and each goes on as a sheet of its own.

use super::creased::Creased;
use super::hinges::Hinges;
use super::material::Material;
use super::patches::Patches;
use super::torn::{Piece, Torn};
use super::torn_grid::TornGrid;
use super::turned_sheet::settings_over;
use super::{Sheet, SheetSettings, Tie};
use crate::creased_only::CreasedOnly;
use crate::interpolate::uniform_samples;

impl Sheet {
    /// Makes a sheet of the same paper that is torn along a path of its page, u and v of places,
    /// from the edge next to the first to the edge next to the last: its pieces hang together
    /// by what ties are added to it. It lies flat, and nothing holds it.
    ///
    /// None where [`TornGrid::new`] has none, and of a sheet that is creased, crumpled or torn.
    pub(crate) fn torn_along(&self, path: &[[f64; 2]], tick: f64) -> Option<(Sheet, TornGrid)> {
        if self.is_creased() {
            return None;
        }
        let page = [self.settings.width, self.settings.height];
        let [du, dv] = self.settings.cell();
        let grid = TornGrid::new(page, path, du.midpoint(dv))?;
        let material = Material::torn(&grid);
        let torn = Torn::of(&grid);
        let settings = settings_over(&self.settings, &grid, material.rows, tick);
        Some((Sheet::of_torn(settings, material, torn)?, grid))
    }

    /// Parts a torn sheet of which nothing is tied any more: returns the piece on the right of the
    /// path and the one on the left, each as it moves. None of any other.
    pub(crate) fn parted(&self) -> Option<[Sheet; 2]> {
        let torn = self.torn().filter(|_| self.is_both_pieces())?;
        if !self.ties.is_empty() {
            return None;
        }
        let [foot, head] = [Piece::Foot, Piece::Head].map(|piece| {
            let [before, beyond] = self.material.runs();
            let rows = if piece == Piece::Foot { before } else { beyond };
            let numbers =
                3 * rows.start * self.settings.columns..3 * rows.end * self.settings.columns;
            let material = self.material.piece(rows);
            let settings = &self.settings;
            let settings = settings
                .clone()
                .over(settings.columns, material.rows, settings.cell());
            let torn = torn.of_piece(piece);
            let mut sheet = Sheet::of_torn(settings, material, torn)?;
            sheet.write_nodes(&self.positions[numbers.clone()], &self.velocities[numbers]);
            Some(sheet)
        });
        Some([foot?, head?])
    }

    fn of_torn(settings: SheetSettings, material: Material, torn: Torn) -> Option<Sheet> {
        let mut sheet = Sheet::new(settings).ok()?;
        let drawn = torn.drawn(&material);
        sheet.draw_samples(
            &uniform_samples(drawn.columns),
            &uniform_samples(drawn.rows),
        );
        sheet.creased = CreasedOnly::some(Box::new(Creased {
            lines: Vec::new(),
            hinges: Hinges::new(&sheet.settings, &material, &[]),
            patches: Some(Patches::over(&material, drawn)),
            torn: Some(torn),
        }));
        sheet.take(material);
        sheet.lay_flat(crate::grid::Side::Right);
        Some(sheet)
    }

    /// How it is torn across, if it is.
    pub(super) fn torn(&self) -> Option<&Torn> {
        self.creased()?.torn.as_ref()
    }

    /// Whether it is torn across, and is both pieces: what holds one holds the other by ties alone.
    pub(super) fn is_both_pieces(&self) -> bool {
        self.torn().is_some_and(|torn| torn.piece.is_none())
    }

    /// Whether it is torn across, or a piece of a torn sheet.
    pub(crate) fn is_torn(&self) -> bool {
        self.torn().is_some()
    }

    /// Returns u and v along the grid of a place at u and v of the page.
    pub(super) fn in_frame(&self, at: [f32; 2]) -> [f32; 2] {
        self.torn().map_or(at, |torn| torn.frame.of_page(at))
    }

    /// The springs between nodes that tie it, to be added and removed.
    pub(crate) fn ties_mut(&mut self) -> &mut Vec<Tie> {
        &mut self.ties
    }

    /// Returns u and v on the page of each of a torn sheet's nodes.
    pub(crate) fn torn_places(&self) -> Vec<[f64; 2]> {
        let places = &self.material.places;
        self.torn().map_or_else(Vec::new, |torn| {
            places.iter().map(|at| torn.frame.on_page(*at)).collect()
        })
    }
}
