//! A leaf whose folds are pressed shut under others: laid so, and opened again.

use super::Leaf;
use super::opening::Opening;
use crate::book::phase::Phase;
use crate::contact::flaps::Flaps;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use crate::models::sheet::SheetCrease;

impl Leaf {
    /// Lays the leaf still on a side as it lies under others, its folds shut. Woken, it opens them
    /// to where they rest.
    pub fn lay_pressed(&mut self, side: Side) {
        self.end_opening();
        self.was_opened_anew = false;
        self.release_shut();
        let creases = self.sheet.creases();
        let to: Vec<f32> = creases.iter().map(|crease| crease.rest as f32).collect();
        let from = self.press_flat(side);
        self.lie(side);
        for (crease, rest) in from.iter().enumerate() {
            self.press_to(crease, *rest);
        }
        self.opening = CreasedOnly::some(Opening::new(from, to));
    }

    /// Has its creases creep toward where they are pressed to, for so many seconds, where they have not
    /// begun to open.
    pub fn stay_pressed(&mut self, seconds: f64) {
        let lines = self.sheet.creases();
        if let Some(opening) = self.opening.as_mut() {
            opening.creep(&lines, seconds);
        }
    }

    /// Puts the nodes where they are in the leaf pressed flat on a side. Returns the angle at which
    /// each crease then is, radians.
    fn press_flat(&mut self, side: Side) -> Vec<f32> {
        let heights = self.flaps().map_or_else(Vec::new, Flaps::stacked);
        self.sheet.let_yield(false);
        self.sheet.lay_pressed(side, &heights)
    }

    /// Whether it has landed in this tick.
    pub fn has_landed(&self) -> bool {
        self.settling == Some(0.0)
    }

    /// Has it eased, as it has just landed, to where it lies pressed flat, and its folds open from
    /// there to where they rest, as when it comes out from under others. Once until it is held or
    /// played again: see `settle_pressed`.
    pub fn open_anew(&mut self) {
        let Phase::Falling(side) = self.phase else {
            return;
        };
        self.end_opening();
        self.press_flat(side);
        self.rest.copy_from_slice(self.sheet.positions());
        self.sheet.put_back(&self.landed);
        self.lowering = 0.0;
        self.opens_anew = true;
    }

    /// Where it is being eased to where it lies pressed flat, has it lie there: on the way its edges
    /// do not keep their lengths. Returns whether it was.
    pub(super) fn end_open_anew(&mut self) -> bool {
        let (true, Phase::Falling(side)) = (self.opens_anew && self.is_creased(), self.phase)
        else {
            return false;
        };
        let put_down = self.put_down;
        self.lay_pressed(side);
        self.put_down = put_down;
        self.was_opened_anew = true;
        self.wake();
        true
    }

    /// Ends the easing of a leaf to where it lies pressed flat: its folds open from there, or, where
    /// they have done so before, it stays pressed. Leaves that landed through themselves twice did so
    /// each time after that. Returns whether it was eased there.
    pub(super) fn settle_pressed(&mut self, side: Side) -> bool {
        let (put_down, stays_pressed) = (self.put_down, self.was_opened_anew);
        if !self.end_open_anew() {
            return false;
        }
        if stays_pressed {
            self.lie(side);
            self.put_down = put_down;
        }
        true
    }

    /// The creases of the leaf, each with the angle at which it rests, or will once it is open.
    pub fn creases(&self) -> Vec<SheetCrease> {
        let mut creases = self.sheet.creases();
        if let Some(opening) = self.opening.as_ref() {
            for (crease, to) in creases.iter_mut().zip(&opening.to) {
                crease.rest = f64::from(*to);
            }
        }
        creases
    }

    /// Turns the rest of a crease to an angle, radians as [`SheetCrease::rest`]; one that is opening
    /// goes on to there.
    pub fn press(&mut self, crease: usize, rest: f32) {
        // Where it was to be eased to rest it would lie as it landed, folded as it was then.
        self.settling = None;
        match self.opening.as_mut() {
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
        let Some(opening) = self.opening.as_mut() else {
            return;
        };
        let Some(rests) = opening.step() else {
            self.end_opening();
            // What was slow until now does not lie still for that.
            self.stay_awake();
            return;
        };
        for (crease, rest) in rests.into_iter().enumerate() {
            self.press_to(crease, rest);
        }
    }

    /// Slows the leaf at the end of a tick while its creases open and nothing but its weight moves it.
    pub(super) fn slow_opening(&mut self) {
        let is_left_alone = matches!(self.phase, Phase::Falling(_)) && !self.shut.is_held;
        if let Some(opening) = self.opening.as_ref().filter(|_| is_left_alone) {
            self.sheet.slow(opening.kept_speed());
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

    pub(super) fn press_to(&mut self, crease: usize, rest: f32) {
        self.sheet.press(crease, rest);
        if let Some(flaps) = self.flaps.as_mut() {
            flaps.press(crease, rest);
        }
    }
}
