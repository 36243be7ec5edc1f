//! A loose sheet that is torn across, from an edge along a path to another.
//!
//! As at the spine, paper gives way by Griffith's rule, node by node of the path, and only at the
//! tear's tip: an edge of paper is a notch, and beyond the tip there is none. Two grabs pull it
//! apart; once nothing holds the pieces, each is a loose sheet of its own.

use super::{FRACTURE, HANDS, OPENING, TornLeaf, point_at};
use crate::book::limits::TICK;
use crate::interpolate::uniform_samples;
use crate::models::sheet::{Sheet, Tie};
use crate::surface::Surface;
use crate::turn::TurnModel;

/// Paper that holds at a node of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundTie {
    tie: Tie,
    /// Work of tearing it, J.
    work: f32,
    /// How far along the path it begins, metres.
    from: f32,
}

impl TornLeaf {
    /// Begins to tear the sheet across, along a path on its page: u and v of places, from the edge
    /// next to the first, where the tear begins, to the edge next to the last. All grabs are
    /// released. The sheet is where it was, and its surface has another size.
    ///
    /// Returns whether it does: not one that is bound, crumpled, torn across already or a piece,
    /// and not along a path that leaves the page, has both its ends on one edge, or parts a piece
    /// narrower than a cell or more crooked than a grid can be.
    pub fn tear_across(&mut self, path: &[[f64; 2]]) -> bool {
        if !self.bound.is_empty() || self.is_crumpled() || self.sheet.is_torn() {
            return false;
        }
        let Some((mut sheet, grid)) = self.sheet.torn_along(path, f64::from(TICK)) else {
            return false;
        };
        let settings = self.sheet.settings();
        let coarse = Surface {
            positions: self.sheet.positions().to_vec(),
            ..Surface::new(settings.columns, settings.rows)
        };
        let even: Vec<f32> = uniform_samples(settings.columns);
        let places = sheet.torn_places().into_iter();
        let nodes = places.map(|at| point_at(&coarse, &even, at.map(|at| at as f32)));
        sheet.place(nodes.flatten());

        let (columns, before) = (grid.columns, grid.rows[0]);
        let opening = OPENING * 2.0 * grid.lengths()[0];
        let mut order: Vec<usize> = (0..columns).collect();
        if grid.is_from_end {
            order.reverse();
        }
        let mut along = 0.0;
        let ties = order.into_iter().map(|column| {
            let length = grid.lengths()[column];
            let work = FRACTURE * settings.stock.caliper * length;
            let foot = (before - 1) * columns + column;
            let tie = Tie {
                nodes: [foot, foot + columns],
                stiffness: (2.0 * work / (opening * opening)) as f32,
            };
            let from = along as f32;
            along += length;
            let work = work as f32;
            BoundTie { tie, work, from }
        });
        self.across = ties.collect();
        self.across.reverse();
        self.take_sheet(sheet);
        self.tie_across();
        true
    }

    /// Number of nodes of the path at which a sheet that is torn across still holds.
    pub fn ties(&self) -> usize {
        self.across.len()
    }

    /// How far along its path a sheet is torn across, metres: from the first place of the path
    /// on. Infinite once it is torn through; 0 of any other sheet.
    pub fn opened(&self) -> f32 {
        match self.across.last() {
            Some(tip) => tip.from,
            None if self.sheet.is_torn() => f32::INFINITY,
            None => 0.0,
        }
    }

    /// Parts a sheet that is torn through: this is what lies to the right of the path from then
    /// on, and what is returned is the piece to the left of it, where it was. Right and left are
    /// those of the path toward rising u, or toward rising v of a path that is steeper. All grabs
    /// are released. None of any other sheet.
    pub fn part(&mut self) -> Option<TornLeaf> {
        if !self.across.is_empty() {
            return None;
        }
        let [foot, head] = self.sheet.parted()?;
        let mut other = self.clone();
        self.take_sheet(foot);
        other.take_sheet(head);
        other.torn = 0.0;
        Some(other)
    }

    /// Tears the tip of the tear where that holds more energy than it takes.
    pub(super) fn tear_tip(&mut self) {
        let positions = self.sheet.positions();
        if let Some(tip) = self
            .across
            .pop_if(|tip| tip.tie.energy(positions) >= tip.work)
        {
            self.torn += tip.work;
            self.tie_across();
        }
    }

    /// Ties the sheet by the paper that holds across its path.
    pub(super) fn tie_across(&mut self) {
        let ties = self.sheet.ties_mut();
        ties.clear();
        ties.extend(self.across.iter().map(|bound| bound.tie));
    }

    /// Goes on as another sheet, which is drawn at once.
    fn take_sheet(&mut self, sheet: Sheet) {
        self.steps = libm::roundf(TICK / sheet.time_step()).max(1.0) as u32;
        self.mesh = sheet.torn_mesh();
        self.sheet = sheet;
        self.is_held = [false; HANDS];
        self.pulled = [[f32::NAN; 3]; HANDS];
        self.blend = 0;
        self.sheet.write_surface(&mut self.surface);
        self.surface.update_normals();
        self.wake();
    }
}
