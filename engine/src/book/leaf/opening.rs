//! A leaf whose folds were pressed shut under others: laid so, and how its creases open again.

use super::Leaf;
use crate::book::flaps::Flaps;
use crate::book::phase::Phase;
use crate::grid::Side;
use crate::models::sheet::{CAN_CREASE, FoldLine};

/// Ticks in which creases open that were pressed shut: half a second, as they are folded in by hand.
/// Paper that was pressed recovers in time; let go at once, a letter would leap.
const OPENING: u32 = 60;

/// Part of its speed that what begins to open keeps in a tick, all once it is open: air between its
/// parts has to come in. Parts that lie nearer to each other than they keep apart would else throw
/// each other off.
const KEPT_SPEED: f32 = 0.1;

/// How creases open that were pressed shut.
pub(super) struct Opening {
    /// Where each was pressed to, and where it rests once it is open, radians.
    from: Vec<f32>,
    to: Vec<f32>,
    /// Ticks since it was pressed.
    ticks: u32,
}

impl Leaf {
    /// Lays the leaf still on a side as it lies under others, its folds shut. Woken, it opens them
    /// to where they rest.
    pub fn lay_pressed(&mut self, side: Side) {
        self.end_opening();
        let heights = self.flaps().map_or_else(Vec::new, Flaps::stacked);
        let creases = self.sheet.creases();
        let to: Vec<f32> = creases.iter().map(|crease| crease.rest as f32).collect();
        self.sheet.let_yield(false);
        let from = self.sheet.lay_pressed(side, &heights);
        self.lie(side);
        for (crease, rest) in from.iter().enumerate() {
            self.press_to(crease, *rest);
        }
        self.opening = Some(Opening { from, to, ticks: 0 });
    }

    /// The creases of the leaf, each with the angle at which it rests, or will once it is open.
    pub fn creases(&self) -> Vec<FoldLine> {
        let mut creases = self.sheet.creases();
        if let (true, Some(opening)) = (CAN_CREASE, &self.opening) {
            for (crease, to) in creases.iter_mut().zip(&opening.to) {
                crease.rest = f64::from(*to);
            }
        }
        creases
    }

    /// Turns the rest of a crease to an angle, radians as [`FoldLine::rest`]; one that is opening
    /// goes on to there.
    pub fn press(&mut self, crease: usize, rest: f32) {
        match self.opening.as_mut().filter(|_| CAN_CREASE) {
            Some(opening) => {
                if let Some(to) = opening.to.get_mut(crease) {
                    *to = rest;
                }
            }
            None => self.press_to(crease, rest),
        }
    }

    /// Opens creases that were pressed shut by a tick.
    pub(super) fn step_opening(&mut self) {
        let Some(opening) = self.opening.as_mut().filter(|_| CAN_CREASE) else {
            return;
        };
        opening.ticks += 1;
        let part = opening.ticks as f32 / OPENING as f32;
        if part >= 1.0 {
            self.end_opening();
            // What was slow until now does not lie still for that.
            self.stay_awake();
            return;
        }
        let eased = part * part * (3.0 - 2.0 * part);
        let rests = opening.from.iter().zip(&opening.to);
        let rests: Vec<f32> = rests.map(|(from, to)| from + (to - from) * eased).collect();
        for (crease, rest) in rests.into_iter().enumerate() {
            self.press_to(crease, rest);
        }
    }

    /// Slows the leaf at the end of a tick while its creases open and nothing but its weight moves it.
    pub(super) fn slow_opening(&mut self) {
        let is_left_alone = matches!(self.phase, Phase::Falling(_));
        if let Some(opening) = self
            .opening
            .as_ref()
            .filter(|_| CAN_CREASE && is_left_alone)
        {
            let part = opening.ticks as f32 / OPENING as f32;
            self.sheet.slow(KEPT_SPEED + part * (1.0 - KEPT_SPEED));
        }
    }

    /// Has creases that are opening rest at once where they would in the end.
    pub(super) fn end_opening(&mut self) {
        if let Some(opening) = self.opening.take() {
            for (crease, rest) in opening.to.into_iter().enumerate() {
                self.press_to(crease, rest);
            }
        }
    }

    fn press_to(&mut self, crease: usize, rest: f32) {
        self.sheet.press(crease, rest);
        if let (true, Some(flaps)) = (CAN_CREASE, &mut self.flaps) {
            flaps.press(crease, rest);
        }
    }
}
