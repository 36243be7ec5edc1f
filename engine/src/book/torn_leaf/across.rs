//! What holds a loose sheet that is torn across, from an edge along a path to another.
//!
//! As at the spine, paper gives way by Griffith's rule, node by node of the path, and only at the
//! tear's tip: an edge of paper is a notch, and beyond the tip there is none.

use super::fracture::{stiffness_of, work_of};
use super::nodes::at_places;
use super::tear_heading::TearHeading;
use crate::book::limits::TICK;
use crate::grab::RADIUS;
use crate::models::sheet::{Sheet, SheetSettings, Tie, TornGrid};

/// Ticks between two turns of a path, each of which costs as much as the beginning of a tear.
const TURNING: u32 = 4;

/// Paper that holds at a node of the path.
#[derive(Clone, Copy, Debug)]
struct BoundTie {
    tie: Tie,
    /// Work of tearing it, J.
    work: f32,
    /// How far along the path it begins, metres.
    from: f64,
}

/// What holds a sheet that is torn across: nothing of any other.
#[derive(Clone, Debug, Default)]
pub(super) struct Across {
    /// From the end of the path to the tip of the tear.
    bound: Vec<BoundTie>,
    /// What turns its path; None where that is fixed.
    steered: Option<Box<SteeredPath>>,
}

/// A path that turns with the pull of the grabs.
#[derive(Clone, Debug)]
struct SteeredPath {
    grid: TornGrid,
    /// The settings of the whole sheet.
    paper: SheetSettings,
    heading: TearHeading,
    /// Ticks until it may turn again.
    wait: u32,
}

impl Across {
    /// Begins to tear a sheet along a path on its page, u and v of places, which turns if `turns`.
    /// Returns the sheet that takes its place, where it is, and what holds that. None where it
    /// cannot be torn so.
    pub fn begin(whole: &Sheet, path: &[[f64; 2]], turns: bool) -> Option<(Sheet, Across)> {
        let (mut sheet, grid) = whole.torn_along(path, f64::from(TICK))?;
        let nodes = at_places(whole, &sheet.torn_places());
        sheet.place(nodes.into_iter().flatten());
        let caliper = whole.settings().stock.caliper;
        let lengths = grid.lengths();
        let mut along = 0.0;
        let ties = (0..grid.columns).map(|number| {
            // They are as many, and as long, from either end.
            let work = work_of(caliper, lengths[number]);
            let from = along;
            along += lengths[number];
            bound_tie(&grid, number, work, from)
        });
        let mut across = Across {
            bound: ties.collect(),
            steered: None,
        };
        across.bound.reverse();
        if turns {
            across.steered = Some(Box::new(SteeredPath {
                heading: TearHeading::from(grid.first_heading()),
                paper: whole.settings().clone(),
                grid,
                wait: 0,
            }));
        }
        across.tie(&mut sheet);
        Some((sheet, across))
    }

    /// Turns the path ahead of its tip as two grabs pull, at most once in [`TURNING`] ticks. `shown`
    /// returns the points at which the sheet is drawn. Returns where those were drawn that are
    /// drawn from then on, if the path has turned.
    pub fn turn(
        &mut self,
        sheet: &mut Sheet,
        pulled: [[f32; 3]; 2],
        shown: impl FnOnce(&mut Sheet) -> Vec<f32>,
    ) -> Option<Vec<f32>> {
        let steered = self.steered.as_mut()?;
        steered.wait = steered.wait.saturating_sub(1);
        let columns = steered.grid.columns;
        let tip = columns - self.bound.len();
        if self.bound.is_empty() || steered.wait > 0 {
            return None;
        }
        let heading = steered.heading.follow(pulled, sheet)?;
        let grid = steered.grid.turned(tip, heading)?;
        // Paper under a finger does not tear.
        let [before, after] = [&steered.grid, &grid].map(|grid| sheet.nearest_grab(grid));
        if after < RADIUS.min(before) {
            return None;
        }
        let mut shown = shown(sheet);
        sheet.turn_tear(&grid, &steered.paper, f64::from(TICK), &mut shown);
        steered.wait = TURNING;
        let caliper = steered.paper.stock.caliper;
        let stations = grid.torn_stations();
        let mut from = self.bound.last().map_or(0.0, |tip| tip.from);
        self.bound.clear();
        for number in tip..columns {
            let to = match stations.get(number + 1) {
                Some(next) => stations[number].midpoint(*next),
                None => stations[number],
            };
            let work = work_of(caliper, to - from);
            self.bound.push(bound_tie(&grid, number, work, from));
            from = to;
        }
        self.bound.reverse();
        steered.grid = grid;
        self.tie(sheet);
        Some(shown)
    }

    /// Grabs have changed.
    pub fn hold_anew(&mut self) {
        if let Some(steered) = &mut self.steered {
            steered.heading.hold_anew();
        }
    }

    /// The grid of a sheet whose path turns.
    #[cfg(test)]
    pub fn grid(&self) -> Option<&TornGrid> {
        self.steered.as_ref().map(|steered| &steered.grid)
    }

    /// Number of nodes of the path that hold.
    pub fn count(&self) -> usize {
        self.bound.len()
    }

    /// How far along the path the tip of the tear is, metres; None where nothing holds.
    pub fn tip(&self) -> Option<f32> {
        self.bound.last().map(|tip| tip.from as f32)
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

/// The tie of a node of the path, the `number`th from where its tear begins.
fn bound_tie(grid: &TornGrid, number: usize, work: f64, from: f64) -> BoundTie {
    let columns = grid.columns;
    let column = if grid.is_from_end {
        columns - 1 - number
    } else {
        number
    };
    let foot = (grid.rows[0] - 1) * columns + column;
    let tie = Tie {
        nodes: [foot, foot + columns],
        stiffness: stiffness_of(work, grid.opening_spacing),
    };
    let work = work as f32;
    BoundTie { tie, work, from }
}
