//! A leaf whose folds are held shut: by the hand that turns it or leads it down, or by another leaf
//! that comes down upon it.

use super::Leaf;
use super::held_shut::SHUTTING;
use super::lead::LYING;
use super::opening::Opening;
use crate::book::phase::Phase;
use crate::book::shut_folds::{Layers, ShutFolds};
use crate::contact::flaps::Flaps;
use crate::creased_only::CreasedOnly;
use crate::grid::Side;
use core::f32::consts::PI;

impl Leaf {
    /// Lets go of its folds at once, as it is laid elsewhere.
    pub(super) fn release_shut(&mut self) {
        self.let_folds_go();
        self.shut.ticks_drawn = 0;
    }

    /// Nothing holds its folds any more: each part weighs and bends by itself.
    fn let_folds_go(&mut self) {
        self.shut.is_held = false;
        if core::mem::take(&mut self.shut.is_stacked) {
            self.sheet.unstack();
        }
    }

    /// Whether something holds its folds shut.
    pub fn is_held_shut(&self) -> bool {
        self.shut.is_held
    }

    /// Lets folds open that are held shut where the leaf lies.
    pub fn open_shut(&mut self) {
        self.let_folds_go();
        self.wake();
    }

    /// Where what is drawn of it lies while its folds are shut, and how far they are, 0 to 1.
    pub fn drawn_shut(&self) -> Option<(&Layers, f32)> {
        self.shut.folds().map(|(folds, part)| (&folds.drawn, part))
    }

    /// Holds its folds shut in a tick where something does; `is_pressed` says that a leaf comes down
    /// upon it, or leaves it. Returns whether something does.
    pub(super) fn hold_shut(&mut self, is_pressed: bool) -> bool {
        let is_held = self.is_creased() && self.is_to_be_shut(is_pressed) && self.find_shut();
        if !is_held {
            self.let_folds_go();
            self.shut.ticks_drawn = self.shut.ticks_drawn.saturating_sub(1);
            return false;
        }
        if !self.shut.is_held {
            self.shut.is_held = true;
            let open = self.opening.as_ref().map_or(1.0, Opening::part);
            self.shut.ticks_left = (open * SHUTTING as f32) as u32;
            let to = self.creases().into_iter().map(|crease| crease.rest as f32);
            let to: Vec<f32> = to.collect();
            let shut = self.shut.sought;
            let from = to.iter().enumerate().map(|(crease, rest)| {
                let is_shut = shut >> crease & 1 == 1;
                if is_shut { PI.copysign(*rest) } else { *rest }
            });
            self.opening = CreasedOnly::some(Opening::new(from.collect(), to));
        }
        self.shut.ticks_drawn = (self.shut.ticks_drawn + 1).min(SHUTTING);
        let part = 1.0 - self.shut.ticks_left as f32 / SHUTTING as f32;
        let rests = self.opening.as_mut().map(|opening| opening.shut(part));
        for (crease, rest) in rests.into_iter().flatten().enumerate() {
            self.press_to(crease, rest);
        }
        true
    }

    /// Brings what is folded over nearer to where it lies while its folds are held shut, by a tick.
    pub(super) fn lay_shut(&mut self) {
        if !self.shut.is_held {
            return;
        }
        let part = 1.0 / (self.shut.ticks_left + 1) as f32;
        self.shut.ticks_left = self.shut.ticks_left.saturating_sub(1);
        if let Some(folds) = self.shut.folds.as_ref() {
            if part == 1.0 && !self.shut.is_stacked {
                self.shut.is_stacked = true;
                self.sheet.stack(self.shut.sought, folds.nodes.carried());
            }
            let [points, velocities] = self.sheet.states_mut();
            folds.nodes.lay(points, part, 1.0);
            folds.nodes.follow(velocities, part);
            self.sheet.restore_lengths();
        }
    }

    /// Where its nodes are once it lies flat on the right, its folds held shut, x, y, z of each, metres;
    /// None where they are not.
    pub(super) fn shut_places(&self) -> Option<&Vec<f32>> {
        let folds = self.shut.folds.as_ref().filter(|_| self.shut.is_held);
        folds.map(|folds| &folds.places)
    }

    /// Finds where it is eased to rest on a side with its folds shut.
    pub(super) fn find_shut_rest(&mut self, side: Side) {
        let Some(folds) = self.shut.folds.as_ref() else {
            return;
        };
        self.rest.copy_from_slice(&self.flat);
        let points = self.rest.as_chunks_mut::<3>().0;
        for point in &mut *points {
            point[0] *= side.sign();
        }
        folds.nodes.lay(points, 1.0, 1.0);
        // None of its layers lies under the table.
        let lowest = points
            .iter()
            .fold(0.0f32, |least, point| least.min(point[2]));
        for (node, point) in points.iter_mut().enumerate() {
            if node % super::NODES[0] > 0 {
                point[2] -= lowest;
            }
        }
        // What is pressed together before the spine keeps its lengths.
        self.sheet.place(self.rest.iter().copied());
        self.rest.copy_from_slice(self.sheet.positions());
        self.sheet.put_back(&self.landed);
    }

    fn is_to_be_shut(&self, is_pressed: bool) -> bool {
        match self.phase {
            Phase::Resting(_) | Phase::Held => false,
            Phase::Playing(_) => true,
            // The hand that leads it lets go of its folds once it lies.
            Phase::Falling(side) => {
                let is_led = |due: f32| due > 0.0 || self.to_go(side) > LYING;
                let is_taken = is_pressed || self.due.is_some_and(is_led);
                self.shut.is_held || is_taken && !self.is_overdue()
            }
        }
    }

    /// Finds where its points lie with those folds shut that rest so. Returns whether there is such a
    /// place.
    fn find_shut(&mut self) -> bool {
        let rests = self.flaps().map_or(0, Flaps::resting_shut);
        if rests != self.shut.sought {
            self.shut.sought = rests;
            let folds = self
                .flaps()
                .and_then(|flaps| ShutFolds::of(&self.sheet, flaps));
            self.shut.folds = folds.into();
        }
        !self.shut.folds.is_none()
    }
}
