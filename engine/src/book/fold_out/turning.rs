//! The angles of a flap's folds while it is turned open or shut, or a pointer draws it.

use super::panels::{PANELS, Panels};
use crate::book::limits::TICK;
use core::f32::consts::PI;

/// Seconds in which a panel is turned over, and how near to its end it is let go, radians.
pub(super) const TURN: f32 = 0.6;
const LETS_GO: f32 = 0.1;

/// Greatest speed of a fold that a pointer draws, radians a second: twice as fast as in a turn.
const DRAWN: f32 = 2.0 * PI / TURN;

/// How far a fold stands open while what is beyond it is carried shut, radians: the drawn panels
/// are then a drawn column off the fold as far from each other as the depth buffer needs.
const CARRIED: f32 = 0.05;

/// A turn by grabs of the flap's own: at the outer end of each panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Angles of the folds at the start, radians: by how much each turns what is beyond it inward.
    pub from: [f32; PANELS],
    /// Whether it opens the flap; else it shuts it.
    pub is_to_open: bool,
    /// Stages of it that are over.
    pub part: f32,
}

impl Turn {
    /// The angle to which a fold is turned.
    fn end(&self, fold: usize, panels: Panels) -> f32 {
        // What is folded more than once is let go only where it lies.
        let short = if panels.count == 1 { LETS_GO } else { 0.0 };
        Panels::way(fold) * if self.is_to_open { short } else { PI - short }
    }

    /// The greatest angle of a fold now: panels that are carried upon each other stand apart, until
    /// all of them lie shut.
    fn most(&self, panels: Panels) -> f32 {
        if panels.count == 1 {
            return f32::INFINITY;
        }
        let left = (panels.stages() as f32 - self.part).clamp(0.0, 1.0);
        PI - if self.is_to_open {
            CARRIED
        } else {
            CARRIED * left
        }
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
    pub fn skip_stages(&mut self, panels: Panels) {
        let is_off = |fold: &usize| (self.from[*fold] - self.end(*fold, panels)).abs() > LETS_GO;
        let moving = (0..panels.count).filter(is_off);
        let first = moving.map(|fold| self.stage(fold, panels)).min();
        self.part = first.unwrap_or(panels.stages()) as f32;
    }

    /// The angles of the folds now, radians.
    pub fn angles(&self, panels: Panels) -> [f32; PANELS] {
        core::array::from_fn(|fold| {
            if fold >= panels.count {
                return 0.0;
            }
            let (stage, to) = (self.stage(fold, panels), self.end(fold, panels));
            let part = (self.part - stage as f32).clamp(0.0, 1.0);
            let eased = part * part * (3.0 - 2.0 * part);
            let angle = self.from[fold] + eased * (to - self.from[fold]);
            let way = Panels::way(fold);
            way * (way * angle).min(self.most(panels))
        })
    }
}

/// A flap with further folds whose edge follows a pointer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    /// How far beyond the fold the edge was when the pointer took hold, metres.
    pub edge: f32,
    /// Where the pointer holds the flap, 0 at its first fold to 1 at its edge.
    pub u: f32,
    /// Where across the book the pointer pulled first, metres.
    pub first: Option<f32>,
    /// Angles of the folds now, radians as of a turn.
    pub angles: [f32; PANELS],
}

impl Drawn {
    /// Moves the folds on where the pointer has moved outward by `moved` since it pulled first,
    /// metres; `width` is that of a panel. Each stage moves the edge by two panels.
    pub fn follow(&mut self, moved: f32, (panels, width): (Panels, f32)) {
        let edge = self.edge + moved / self.u;
        let shut = if panels.count.is_multiple_of(2) {
            0.0
        } else {
            -width
        };
        for (fold, angle) in self.angles.iter_mut().enumerate().take(panels.count) {
            let over = (edge - shut) / width - 2.0 * Panels::stage(fold) as f32;
            let cos = over.clamp(0.0, 2.0) - 1.0;
            let to = Panels::way(fold) * libm::atan2f((1.0 - cos * cos).max(0.0).sqrt(), cos);
            *angle += (to - *angle).clamp(-DRAWN * TICK, DRAWN * TICK);
        }
    }
}
