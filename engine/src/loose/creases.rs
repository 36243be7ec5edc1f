//! Creases of a loose leaf.

use super::LooseLeaf;
use super::settings::InvalidLoose;
use super::table_sheet::CreaseState;
use crate::models::sheet::SheetCrease;
use crate::paper_mesh::PaperMesh;
use crate::real::bounded;

impl LooseLeaf {
    /// Creases a sheet along lines, pressed by hand, each two places (u and v) on it and the
    /// angle at which it rests, radians as [`SheetCrease::rest`]; in place of those it has. It stays
    /// where it is, and a record under way ends. Its creases yield while a hand holds it.
    ///
    /// # Errors
    /// Where the leaf is of another model, a line is none or meets the spine, or there are too
    /// many for its nodes; in a sentence. It is then as it was.
    pub fn crease(&mut self, lines: &[([[f64; 2]; 2], f64)]) -> Result<(), InvalidLoose> {
        let (stock, width) = (self.settings.stock, self.settings.size[0]);
        let Some(sheet) = self.body.sheet_mut() else {
            let sentence = "Of all models only the sheet can be creased.";
            return Err(InvalidLoose(sentence.into()));
        };
        let lines: Vec<SheetCrease> = lines
            .iter()
            .map(|(through, rest)| SheetCrease::pressed(*through, *rest, &stock, width))
            .collect();
        sheet.crease(&lines)?;
        self.record = None;
        Ok(())
    }

    /// Turns the rest of a crease to an angle, radians, -pi to pi or the nearer of these. Nothing
    /// happens where it is no number or there is no such crease.
    pub fn press(&mut self, crease: usize, rest: f32) {
        if let (true, Some(sheet)) = (!rest.is_nan(), self.body.sheet_mut()) {
            let half = core::f32::consts::PI;
            sheet.press(crease, bounded(rest, -half, half));
        }
    }

    /// A crease as it is now; None where there is none of that number.
    pub fn crease_state(&self, crease: usize) -> Option<CreaseState> {
        self.body.sheet()?.crease_state(crease)
    }

    /// How what is drawn lies on the flat paper; None of a leaf without creases, whose points
    /// lie at the values that it is drawn at.
    pub fn paper_mesh(&self) -> Option<PaperMesh> {
        self.body.sheet()?.sheet.paper_mesh()
    }

    /// Says whether creases yield, as in a hand.
    pub(super) fn let_yield(&mut self, may_yield: bool) {
        if let Some(sheet) = self.body.sheet_mut() {
            sheet.let_yield(may_yield);
        }
    }
}
