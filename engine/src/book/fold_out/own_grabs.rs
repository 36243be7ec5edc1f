//! The grabs of a flap's own that turn it: where they hold it, and how they move.

use super::panels::{PANELS, Panels};
use super::turning::{Drawn, TURN, Turn};
use super::{AJAR, FoldOut};
use crate::book::limits::TICK;
use core::f32::consts::PI;

/// Where grabs hold an edge, as fractions of it from the foot: in the middle, or in the middle of
/// each third where the flap is folded more than once, as air and weight bend thin panels between
/// fewer.
const MIDDLE: [f32; 1] = [0.5];
const THIRDS: [f32; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

/// Least part of the flap's width by which its edge is moved as if held there: nearer its fold a
/// pointer would move it too fast.
const LEAST_DRAWN: f32 = 0.3;

/// How much longer than a panel's turn grabs hold what is folded more than once, as a part of that.
const PRESSED: f32 = 0.5;

impl FoldOut {
    /// Turns it open or shut by grabs at its edge and its further folds, fold by fold, and lets go.
    pub fn turn(&mut self, is_to_open: bool) {
        self.let_go();
        self.hold_folds();
        let mut turn = Turn {
            from: self.fold_angles(),
            is_to_open,
            part: 0.0,
        };
        if self.creased.is_some() {
            turn.skip_stages(self.panels);
        }
        self.turn = Some(turn);
    }

    /// Takes hold at the outer end of every panel.
    fn hold_folds(&mut self) {
        for panel in 0..self.panels.count {
            let end = self.panels.last_column(panel) as f32 / (self.panels.columns() - 1) as f32;
            for (grab, v) in self.grabs_of(panel) {
                self.take_hold(grab, [end, v]);
            }
        }
    }

    /// The pointer takes hold at `u` of a flap with further folds. Grabs hold it at these, and
    /// fold it as the pointer draws it: pushed by its edge alone it would bend in an arch.
    pub(super) fn draw_from(&mut self, u: f32) {
        self.hold_folds();
        let out = self.panels.last_column(self.panels.count - 1);
        let edge = self.side.sign() * self.sheet.positions()[3 * out];
        self.drawn = Some(Drawn {
            edge,
            u: u.max(LEAST_DRAWN),
            first: None,
            angles: self.fold_angles(),
        });
    }

    /// The numbers of the flap's own grabs at the outer end of a panel, and where along it they are.
    fn grabs_of(&self, panel: usize) -> impl Iterator<Item = (u32, f32)> + use<> {
        let places: &[f32] = if self.creased.is_none() {
            &MIDDLE
        } else {
            &THIRDS
        };
        let first = (panel * places.len()) as u32;
        (first..).zip(places.iter().copied())
    }

    /// The grabs that may hold it: those numbered below this.
    pub(super) fn last_grab(&self) -> u32 {
        (self.panels.count * THIRDS.len()) as u32
    }

    /// Moves the flap's own grabs on.
    pub(super) fn move_grabs(&mut self) {
        let stages = self.panels.stages() as f32;
        let end = if self.creased.is_none() {
            stages
        } else {
            stages + PRESSED
        };
        let width = (self.panels.width() * self.page_width) as f32;
        let (angles, is_over) = if let Some(turn) = &mut self.turn {
            turn.part = (turn.part + TICK / TURN).min(end);
            (turn.angles(self.panels), turn.part >= end)
        } else if let Some(drawn) = &mut self.drawn {
            if let Some(first) = drawn.first {
                let moved = self.side.sign() * (self.pulled[0] - first);
                drawn.follow(moved, (self.panels, width));
            }
            (drawn.angles, false)
        } else {
            return;
        };
        let height = self.sheet.settings().height as f32;
        let [mut out, mut up, mut angle] = [0.0; 3];
        for panel in 0..self.panels.count {
            angle += angles[panel];
            let (sin, cos) = libm::sincosf(angle);
            out += width * cos;
            up += width * sin;
            for (grab, v) in self.grabs_of(panel) {
                let place = [self.side.sign() * out, v * height, up.max(0.0)];
                self.sheet.pull(grab, place);
            }
        }
        self.crease_along(&angles);
        if is_over {
            self.let_go();
            self.stillness.wake();
        }
    }

    /// Where the flap has further folds its own grabs run along each as they turn it, so that it
    /// rests as it is turned. Else thin paper would bend beside a fold, whose moment it bears, in
    /// place of opening or shutting it, and be let go in a bow.
    fn crease_along(&mut self, angles: &[f32; PANELS]) {
        let Some(creased) = &mut self.creased else {
            return;
        };
        let rest = |fold: usize| (Panels::way(fold) * angles[fold]).clamp(AJAR, PI);
        creased.press(&mut self.sheet, |crease, _, _| rest(crease + 1));
        let first = rest(0);
        self.set_rest(first);
    }

    /// The angles of its folds, radians: by how much each turns what is beyond it inward.
    pub(super) fn fold_angles(&self) -> [f32; PANELS] {
        let mut angles = [0.0; PANELS];
        angles[0] = self.angle();
        for fold in 1..self.panels.count {
            let [from, over, to] =
                [fold as isize - 2, fold as isize - 1, fold as isize].map(|panel| {
                    usize::try_from(panel).map_or(0, |panel| self.panels.last_column(panel))
                });
            let turned = self.direction([over, to]) - self.direction([from, over]);
            // The crease itself knows how often it has gone around.
            let crease = self.crease_angle(fold).unwrap_or(0.0);
            angles[fold] = turned + 2.0 * PI * libm::roundf((crease - turned) / (2.0 * PI));
        }
        angles
    }
}
