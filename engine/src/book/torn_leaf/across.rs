//! What holds a loose sheet that is torn across, from an edge along a path to another.
//!
//! As at the spine, paper gives way by Griffith's rule, node by node of the path, and only at the
//! tear's tip: an edge of paper is a notch, and beyond the tip there is none.

use super::fracture::{stiffness_of, work_of};
use super::nodes::at_places;
use crate::book::limits::TICK;
use crate::models::sheet::{Sheet, Tie};

/// Paper that holds at a node of the path.
#[derive(Clone, Copy, Debug)]
struct BoundTie {
    tie: Tie,
    /// Work of tearing it, J.
    work: f32,
    /// How far along the path it begins, metres.
    from: f32,
}

/// What holds a sheet that is torn across: nothing of any other.
#[derive(Clone, Debug, Default)]
pub(super) struct Across {
    /// From the end of the path to the tip of the tear.
    bound: Vec<BoundTie>,
}

impl Across {
    /// Begins to tear a sheet along a path on its page, u and v of places. Returns the sheet that
    /// takes its place, where it is, and what holds that. None where it cannot be torn so.
    pub fn begin(whole: &Sheet, path: &[[f64; 2]]) -> Option<(Sheet, Across)> {
        let (mut sheet, grid) = whole.torn_along(path, f64::from(TICK))?;
        let nodes = at_places(whole, &sheet.torn_places());
        sheet.place(nodes.into_iter().flatten());
        let caliper = whole.settings().stock.caliper;
        let (columns, lengths) = (grid.columns, grid.lengths());
        let spacing = lengths[1];
        let mut order: Vec<usize> = (0..columns).collect();
        if grid.is_from_end {
            order.reverse();
        }
        let mut along = 0.0;
        let ties = order.into_iter().map(|column| {
            let work = work_of(caliper, lengths[column]);
            let foot = (grid.rows[0] - 1) * columns + column;
            let tie = Tie {
                nodes: [foot, foot + columns],
                stiffness: stiffness_of(work, spacing),
            };
            let from = along as f32;
            along += lengths[column];
            let work = work as f32;
            BoundTie { tie, work, from }
        });
        let mut across = Across {
            bound: ties.collect(),
        };
        across.bound.reverse();
        across.tie(&mut sheet);
        Some((sheet, across))
    }

    /// Number of nodes of the path that hold.
    pub fn count(&self) -> usize {
        self.bound.len()
    }

    /// How far along the path the tip of the tear is, metres; None where nothing holds.
    pub fn tip(&self) -> Option<f32> {
        self.bound.last().map(|tip| tip.from)
    }

    /// Tears the tip of the tear where that holds more energy than it takes. Returns the work, J.
    pub fn tear(&mut self, sheet: &mut Sheet) -> f32 {
        let positions = sheet.positions();
        let gives_way = |tip: &mut BoundTie| tip.tie.energy(positions) >= tip.work;
        self.bound.pop_if(gives_way).map_or(0.0, |tip| {
            self.tie(sheet);
            tip.work
        })
    }

    /// Tears all that holds, without work.
    pub fn cut(&mut self, sheet: &mut Sheet) {
        self.bound.clear();
        self.tie(sheet);
    }

    /// Ties the sheet by what holds.
    fn tie(&self, sheet: &mut Sheet) {
        let ties = sheet.ties_mut();
        ties.clear();
        ties.extend(self.bound.iter().map(|bound| bound.tie));
    }
}
