//! Where the flap of a fold-out is, and the panels into which it is folded.

use crate::book::limits::NODES;
use crate::contact::flaps::PARTS_GAP;
use crate::grid::Side;

/// Least distance of a fold from the spine, and least width of a panel, as fractions of the page.
const NEAREST: f64 = 0.5;
const NARROWEST: f64 = 0.05;

/// Panels of a flap, at most. Each takes `CELLS` columns of nodes, and a step of the sheet costs as
/// the third power of its columns: with three panels some eight times as much as with one.
pub(super) const PANELS: usize = 3;

/// Cells across each panel of several: fewer than of one, as the work grows so fast.
const CELLS: usize = 6;

/// Where a flap is, on the uppermost page of a side, and how it is folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlapPlace {
    /// The side on which the page lies.
    pub side: Side,
    /// Distance of the fold from the spine, as a fraction of the page's width, 0.5 to 1.
    pub fold: f64,
    /// Width of the flap, likewise: of each of its panels 0.05 to `fold`, as it lies upon its page
    /// when it is shut.
    pub width: f64,
    /// Panels of the flap, all of one width, 1 to 3. Further folds are between them, to both sides
    /// by turns, as of a leporello.
    pub panels: usize,
}

impl FlapPlace {
    /// Whether every figure is one that a flap can have.
    pub(super) fn is_sound(&self) -> bool {
        (1..=PANELS).contains(&self.panels)
            && (NEAREST..=1.0).contains(&self.fold)
            && (NARROWEST..=self.fold).contains(&self.layout().width())
    }

    /// The panels of a flap at this place.
    pub(super) fn layout(&self) -> Panels {
        Panels {
            count: self.panels,
            width: self.width,
        }
    }
}

/// The panels of a flap, from its first fold to its edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panels {
    /// How many there are.
    pub count: usize,
    /// Width of them all, as a fraction of the page's.
    width: f64,
}

impl Panels {
    /// Width of a panel, as a fraction of the page's.
    pub fn width(self) -> f64 {
        self.width / self.count as f64
    }

    /// Columns of nodes of the flap's sheet.
    pub fn columns(self) -> usize {
        self.count * self.cells() + 1
    }

    /// The column at the outer end of a panel.
    pub fn last_column(self, panel: usize) -> usize {
        (panel + 1) * self.cells()
    }

    fn cells(self) -> usize {
        if self.count == 1 { NODES[0] - 1 } else { CELLS }
    }

    /// The direction in which a fold turns what is beyond it when it is shut: 1 inward, as the first
    /// does, or -1.
    pub fn way(fold: usize) -> f32 {
        if fold.is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    /// The stages in which the folds are opened. Two of them are opened at once, so that the panel
    /// beyond both stays level.
    pub fn stages(self) -> usize {
        Panels::stage(self.count - 1) + 1
    }

    /// The stage in which a fold is opened.
    pub fn stage(fold: usize) -> usize {
        fold / 2
    }

    /// Where a column is when the flap is shut: how far inward of the first fold, as a fraction of
    /// the page's width, and how high over the page, metres.
    pub fn shut(self, column: usize) -> (f64, f32) {
        let cells = self.cells();
        let panel = (column / cells).min(self.count - 1);
        let part = (column - panel * cells) as f64 / cells as f64 * self.width();
        let is_inward = panel.is_multiple_of(2);
        let inward = if is_inward { part } else { self.width() - part };
        // Each lies upon the one before it; a fold is half-way between both.
        let is_on_fold = panel > 0 && column.is_multiple_of(cells);
        let layer = if is_on_fold {
            panel as f32 - 0.5
        } else {
            panel as f32
        };
        (inward, layer * PARTS_GAP)
    }
}
