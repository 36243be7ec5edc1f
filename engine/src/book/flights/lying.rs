//! Creased leaves that lie uppermost upon a pile: they are drawn, met and woken as those in
//! flight, next to which they lie, but are in no one's hand and at rest with the pile.

use super::{Flights, MOST_FLIGHTS};
use crate::book::flight::{Flight, LYING};
use crate::book::gutter::Gutter;
use crate::book::phase::Phase;
use crate::book::pile::Pile;
use crate::grid::Side;
use crate::models::sheet::SheetCrease;

impl Flights {
    /// Creases a leaf along lines in place of those that it has: where it flies or lies, it
    /// goes on from there. Returns whether it can be; if not, nothing changes.
    pub fn crease(&mut self, leaf: u32, creases: &[SheetCrease]) -> bool {
        let size = self.pattern.size;
        let can_fold = creases
            .iter()
            .all(|crease| crease.is_valid() && crease.leaves_spine(size));
        let has_room = self.creased.has_room(leaf, creases.len());
        if leaf >= self.leaves || !can_fold || !has_room {
            return false;
        }
        let drawn = self.drawn(leaf);
        let is_creased = match drawn {
            Some(index) if !self.order[index].lies() => self.order[index].crease(creases),
            _ => self.creased.has_lines(creases) || self.pattern.can_crease(leaf, creases),
        };
        if !is_creased {
            return false;
        }
        for side in [Side::Left, Side::Right] {
            if let Some(index) = self.lying(side).filter(|index| drawn == Some(*index)) {
                // It is drawn anew, pressed flat.
                self.cover(index, side);
                self.creased.set(leaf, creases);
                return true;
            }
        }
        self.creased.set(leaf, creases);
        if let Some(index) = drawn {
            self.order[index].leaf_mut().wake();
        }
        true
    }

    /// Turns the rest of a crease of a leaf to an angle, radians as [`SheetCrease::rest`], and
    /// wakes the leaf. Nothing happens where no such leaf is drawn by itself.
    pub fn press(&mut self, leaf: u32, crease: usize, rest: f32) {
        if let Some(index) = self.drawn(leaf) {
            let leaf = self.order[index].leaf_mut();
            leaf.press(crease, rest);
            leaf.wake();
        }
    }

    /// The creases of a leaf, each with the angle at which it rests now.
    pub fn creases(&self, leaf: u32) -> Vec<SheetCrease> {
        match self.drawn(leaf) {
            Some(index) => self.order[index].leaf().creases(),
            None => self.creased.of(leaf).unwrap_or_default().to_vec(),
        }
    }

    /// Where a leaf that flies alone or lies creased is among those drawn.
    fn drawn(&self, leaf: u32) -> Option<usize> {
        let mut flights = self.order.iter();
        flights.position(|flight| flight.low() == leaf && flight.leaves() == 1)
    }

    /// Which of those drawn lies creased upon the pile of a side; None where none does.
    pub fn lying(&self, side: Side) -> Option<usize> {
        let index = match side {
            Side::Left => 0,
            Side::Right => self.order.len().checked_sub(1)?,
        };
        let flight = self.order.get(index)?;
        let lies_there = flight.lies() && flight.phase().side() == Some(side);
        lies_there.then_some(index)
    }

    /// How many are in flight.
    pub fn flying(&self) -> usize {
        let in_flight = |flight: &&Flight| !flight.lies();
        self.order.iter().filter(in_flight).count()
    }

    /// Whether nothing moves that is drawn.
    pub fn is_still(&self) -> bool {
        let lies = |flight: &Flight| flight.lies() && matches!(flight.phase(), Phase::Resting(_));
        self.order.iter().all(lies)
    }

    /// Whether the outermost in flight on a side rests, and is to join the pile there: but for
    /// a creased one that nothing covers.
    pub(super) fn joins(&self, side: Side) -> bool {
        let outermost = |k: usize| match side {
            Side::Left => self.order.get(k),
            Side::Right => self
                .order
                .len()
                .checked_sub(k + 1)
                .map(|at| &self.order[at]),
        };
        let rests = |flight: &Flight| flight.phase() == Phase::Resting(side);
        outermost(0).is_some_and(|flight| {
            let is_covered = || outermost(1).is_some_and(rests);
            rests(flight) && (!flight.leaf().is_creased() || is_covered())
        })
    }

    /// Takes what lies creased upon a pile into it.
    pub(super) fn cover(&mut self, index: usize, side: Side) {
        let covered = self.order.remove(index);
        if side == Side::Left {
            self.left = covered.high();
        }
        self.put_away(covered);
    }

    /// Says that creased leaves which have come to rest uppermost on a side lie there.
    pub(super) fn let_lie(&mut self) {
        let ends = [
            (self.order.first(), Side::Left),
            (self.order.last(), Side::Right),
        ];
        let at = ends.map(|(flight, side)| {
            let has_landed =
                |flight: &&Flight| flight.is_creased() && flight.phase() == Phase::Resting(side);
            flight.filter(has_landed).map(Flight::id)
        });
        for id in at.into_iter().flatten() {
            if let Some(index) = self.index(id) {
                let mut flight = self.order.remove(index);
                self.count(&flight);
                flight.call(LYING);
                self.order.insert(index, flight);
            }
        }
    }

    /// Lets seconds pass in which nothing moves. Creases that are pressed shut creep meanwhile.
    pub fn wait(&mut self, seconds: f64) {
        self.creased.pass(seconds);
        for flight in &mut self.order {
            flight.leaf_mut().stay_pressed(seconds);
        }
    }

    /// Draws the creased leaf that lies uppermost in the pile of a side by itself, if there is one:
    /// pressed flat between the piles (right and left), as it lay in there. The next steps open its
    /// folds to where they rest. Returns whether there is.
    pub fn uncover(&mut self, side: Side, gutter: &Gutter, piles: [&Pile; 2]) -> bool {
        if self.lying(side).is_some() || self.order.len() == MOST_FLIGHTS {
            return false;
        }
        let leaf = match side {
            Side::Left => self.left.checked_sub(1),
            Side::Right => Some(self.right_end()),
        };
        let Some((leaf, creases)) = leaf.and_then(|leaf| Some((leaf, self.creased.of(leaf)?)))
        else {
            return false;
        };
        let creases = creases.to_vec();
        let covered_for = self.creased.covered_for(leaf);
        let mut flight = self.creased.take(leaf).unwrap_or_else(|| {
            let mut made = self.take_spare(self.pattern.kind_of(leaf));
            made.crease(&creases);
            made
        });
        flight.take_up(LYING, side, leaf, leaf + 1);
        let laid = flight.leaf_mut();
        laid.lay_pressed(side);
        laid.stay_pressed(covered_for);
        laid.wake();
        // It is drawn before it is stepped.
        laid.bend_over(piles);
        laid.bend_into_gutter(gutter);
        self.put_next_to(side, flight);
        true
    }

    /// Whether flight `index` falls upon folds of the one under it.
    pub(super) fn lies_upon_folds(&self, index: usize) -> bool {
        let under = match self.order[index].phase().side() {
            Some(Side::Right) => self.order.get(index + 1),
            Some(Side::Left) => index.checked_sub(1).and_then(|under| self.order.get(under)),
            None => None,
        };
        under.is_some_and(|under| under.leaf().is_creased())
    }

    /// Whether flight `index` is creased and another comes down upon it or leaves it.
    pub(super) fn is_pressed(&self, index: usize) -> bool {
        let is_creased = self.order[index].leaf().is_creased();
        is_creased && self.upon(index).is_some_and(|over| !over.leaf().is_down())
    }

    /// The flight that lies upon flight `index`, or nearly, or is turned onto it: the folds of that
    /// are shut before it comes, as one that ends at the spine is where it passes.
    pub(super) fn upon(&self, index: usize) -> Option<&Flight> {
        let own = &self.order[index];
        let over = match own.phase().side()? {
            Side::Right => self.order.get(index.checked_sub(1)?)?,
            Side::Left => self.order.get(index + 1)?,
        };
        let apart = over.leaf().fraction_turned() - own.leaf().fraction_turned();
        let is_led_here = over.phase() == Phase::Playing(own.phase().side()?);
        (is_led_here || apart.abs() < NEAR).then_some(over)
    }
}

/// Part of the half turn within which a leaf comes near to the folds of another: it is past upright
/// over them, as far as what is folded may stand open.
const NEAR: f32 = 0.5;
