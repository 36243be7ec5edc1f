//! The rows of the spine that bind a leaf, and the work of tearing each.

use super::fracture::{stiffness_of, work_of};
use crate::models::sheet::{Sheet, Tether};

/// How a leaf is bound, which says what there is to tear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TearLine {
    /// Along the whole spine: sewn or glued.
    Sewn,
    /// At two staples, each of whose crowns holds 12 mm of paper.
    Stapled,
    /// Along a line of cuts that leave three tenths of the paper.
    Perforated,
}

/// Part of a perforated line that is paper: cuts of 2.5 mm with 1 mm between them.
pub(super) const TIES: f64 = 0.3;

/// Width of a staple, metres, and where the two are along the spine.
pub(super) const STAPLE: f64 = 0.012;
const STAPLES: [f64; 2] = [0.25, 0.75];

/// A row of the spine that holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundRow {
    /// The spring that holds its node at the spine.
    pub tether: Tether,
    /// Work of tearing it, J.
    pub work: f32,
}

/// The rows of the spine between `range` (from the foot) that bind a leaf, at rest where it is.
pub(super) fn bound_rows(
    sheet: &Sheet,
    line: TearLine,
    range: core::ops::Range<usize>,
) -> Vec<BoundRow> {
    let settings = sheet.settings();
    let places = sheet.positions().as_chunks::<3>().0;
    let (rows, cell) = (settings.rows, settings.cell()[1]);
    let length_at = |row: usize| match line {
        TearLine::Stapled => {
            let is_staple = |at: &f64| libm::round(at * (rows - 1) as f64) as usize == row;
            if STAPLES.iter().any(is_staple) {
                STAPLE
            } else {
                0.0
            }
        }
        TearLine::Sewn | TearLine::Perforated => {
            let part = if line == TearLine::Sewn { 1.0 } else { TIES };
            part * cell
                * if row == 0 || row + 1 == rows {
                    0.5
                } else {
                    1.0
                }
        }
    };
    range
        .filter_map(|row| {
            let work = work_of(settings.stock.caliper, length_at(row));
            let node = row * settings.columns;
            let tether = Tether {
                node,
                place: places[node],
                stiffness: stiffness_of(work, cell),
            };
            let work = work as f32;
            (work > 0.0).then_some(BoundRow { tether, work })
        })
        .collect()
}
