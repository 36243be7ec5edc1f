//! How hands turn a flap open and shut.

use super::panels::{PANELS, Panels};
use super::{AJAR, FoldOut};
use crate::book::limits::TICK;
use core::f32::consts::PI;

/// Seconds in which hands turn a panel over, and how near to its end they let go, radians.
const TURN: f32 = 0.6;
const LETS_GO: f32 = 0.1;

/// Where hands hold an edge, as fractions of it from the foot: in the middle, or in the middle of
/// each third where the flap is folded more than once, as air and weight bend thin panels between
/// fewer.
const MIDDLE: [f32; 1] = [0.5];
const THIRDS: [f32; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

/// Least part of the flap's width by which its edge is moved as if held there: nearer its fold a
/// pointer would move it too fast.
const LEAST_DRAWN: f32 = 0.3;

/// Greatest speed of a fold that a pointer draws, radians a second: twice as fast as in a turn.
const DRAWN: f32 = 2.0 * PI / TURN;

/// How much longer than a panel's turn hands hold what is folded more than once, as a part of that.
const PRESSED: f32 = 0.5;

/// A turn by hands of the flap's own: at the outer end of each panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Angles of the folds at the start, radians: by how much each turns what is beyond it inward.
    from: [f32; PANELS],
    is_to_open: bool,
    /// Stages of it that are over.
    part: f32,
}

impl FoldOut {
    /// Hands take its edge and its further folds, turn it open or shut, fold by fold, and let go.
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

    /// Hands take hold at the outer end of every panel.
    fn hold_folds(&mut self) {
        for panel in 0..self.panels.count {
            let end = self.panels.last_column(panel) as f32 / (self.panels.columns() - 1) as f32;
            for (hand, v) in self.hands_of(panel) {
                self.take_hold(hand, [end, v]);
            }
        }
    }

    /// The pointer's hand takes hold at `u` of a flap with further folds. Others hold it at these, and
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

    /// The numbers of the flap's own hands at the outer end of a panel, and where along it they are.
    fn hands_of(&self, panel: usize) -> impl Iterator<Item = (u32, f32)> + use<> {
        let places: &[f32] = if self.creased.is_none() {
            &MIDDLE
        } else {
            &THIRDS
        };
        let first = (panel * places.len()) as u32;
        (first..).zip(places.iter().copied())
    }

    /// The hands that may hold it: those numbered below this.
    pub(super) fn last_hand(&self) -> u32 {
        (self.panels.count * THIRDS.len()) as u32
    }

    /// Moves the flap's own hands on.
    pub(super) fn move_hands(&mut self) {
        let stages = self.panels.stages() as f32;
        let end = if self.creased.is_none() {
            stages
        } else {
            stages + PRESSED
        };
        let (angles, is_over) = if let Some(turn) = &mut self.turn {
            turn.part = (turn.part + TICK / TURN).min(end);
            (turn.angles(self.panels), turn.part >= end)
        } else if let Some(drawn) = &mut self.drawn {
            let out = self.side.sign() * (self.pulled[0] - self.foot[0]);
            let width = (self.panels.width() * self.page_width) as f32;
            drawn.follow(out, (self.panels, width));
            (drawn.angles, false)
        } else {
            return;
        };
        let height = self.sheet.settings().height as f32;
        let [mut out, mut up, mut angle] = [0.0; 3];
        let width = (self.panels.width() * self.page_width) as f32;
        for panel in 0..self.panels.count {
            angle += angles[panel];
            let (sin, cos) = libm::sincosf(angle);
            out += width * cos;
            up += width * sin;
            for (hand, v) in self.hands_of(panel) {
                let place = [self.side.sign() * out, v * height, up.max(0.0)];
                self.sheet.pull(hand, place);
            }
        }
        self.crease_along(&angles);
        if is_over {
            self.let_go();
            self.stillness.wake();
        }
    }

    /// Where the flap has further folds its own hands run along each as they turn it, so that it
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

impl Turn {
    /// The angle to which a fold is turned.
    fn end(&self, fold: usize, panels: Panels) -> f32 {
        // What is folded more than once is let go only where it lies.
        let short = if panels.count == 1 { LETS_GO } else { 0.0 };
        Panels::way(fold) * if self.is_to_open { short } else { PI - short }
    }

    /// The stage in which it is turned: shut, the outermost folds are first.
    fn stage(&self, fold: usize, panels: Panels) -> usize {
        if self.is_to_open {
            Panels::stage(fold)
        } else {
            panels.stages() - 1 - Panels::stage(fold)
        }
    }

    /// Begins with the first stage that moves anything.
    fn skip_stages(&mut self, panels: Panels) {
        let is_off = |fold: &usize| (self.from[*fold] - self.end(*fold, panels)).abs() > LETS_GO;
        let moving = (0..panels.count).filter(is_off);
        let first = moving.map(|fold| self.stage(fold, panels)).min();
        self.part = first.unwrap_or(panels.stages()) as f32;
    }

    /// The angles of the folds now.
    fn angles(&self, panels: Panels) -> [f32; PANELS] {
        core::array::from_fn(|fold| {
            if fold >= panels.count {
                return 0.0;
            }
            let (stage, to) = (self.stage(fold, panels), self.end(fold, panels));
            let part = (self.part - stage as f32).clamp(0.0, 1.0);
            let eased = part * part * (3.0 - 2.0 * part);
            self.from[fold] + eased * (to - self.from[fold])
        })
    }
}

/// A flap with further folds whose edge follows a pointer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    /// How far beyond the fold the edge was when the pointer took hold, metres.
    edge: f32,
    /// Where the pointer holds the flap.
    u: f32,
    /// How far beyond the fold the pointer pulled first, metres.
    first: Option<f32>,
    /// Angles of the folds now, as of a turn.
    angles: [f32; PANELS],
}

impl Drawn {
    /// Moves the folds on where the pointer is so far beyond the first fold, metres; `width` is that
    /// of a panel. Each stage moves the edge by two panels.
    fn follow(&mut self, out: f32, (panels, width): (Panels, f32)) {
        if !out.is_finite() {
            return;
        }
        let first = *self.first.get_or_insert(out);
        let edge = self.edge + (out - first) / self.u;
        let shut = if panels.count.is_multiple_of(2) {
            0.0
        } else {
            -width
        };
        for (fold, angle) in self.angles.iter_mut().enumerate().take(panels.count) {
            let moved = (edge - shut) / width - 2.0 * Panels::stage(fold) as f32;
            let cos = moved.clamp(0.0, 2.0) - 1.0;
            let to = Panels::way(fold) * libm::atan2f((1.0 - cos * cos).max(0.0).sqrt(), cos);
            *angle += (to - *angle).clamp(-DRAWN * TICK, DRAWN * TICK);
        }
    }
}
