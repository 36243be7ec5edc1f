//! The leaves in flight, in their order around the spine.
//!
//! The leaves of a book lie in the order in which they are bound. Those in
//! flight are a run of them: left of the run lies the left pile, right of it
//! the right pile, and no leaf passes another. A leaf taken up from the right
//! joins the run at its right end, one from the left at its left end; a leaf
//! that has come to rest leaves the run only where nothing is in flight between
//! it and its pile.

mod lying;
mod stepping;

use super::creased_leaves::CreasedLeaves;
use super::draw::draw;
use super::flight::{Flight, LYING};
use super::leaf::Leaf;
use super::leaf_stocks::LeafStocks;
use super::limits::MOST_FLIGHTS;
use super::paper::Paper;
use super::phase::Phase;
use super::pile::Pile;
use crate::grid::Side;
use crate::models::sheet::{Sheet, SheetCrease};
use crate::stock::Stock;

/// Length of a whole turn of a leaf that makes way for one let go, seconds.
const WAY_SECONDS: f32 = 0.8;

/// Parts of the half turn between which a pile takes its shape from the leaf that comes down
/// on it, or from the one under that which leaves it.
const PRESSED: [f32; 2] = [0.1, 0.45];

/// The leaves in flight, and how many lie on either side of them.
pub struct Flights {
    /// Leaves of the book, and those of the left pile.
    leaves: u32,
    left: u32,
    /// From the left to the right.
    order: Vec<Flight>,
    /// Flights that are over, to be used again without an allocation.
    spare: Vec<Flight>,
    pattern: Pattern,
    creased: CreasedLeaves,
    last_id: u32,
    /// Whether a leaf has come deep into another since all lay still.
    had_deep_contact: bool,
    /// Flights that have joined a pile, and how many of them the limit on the time
    /// of a fall put down.
    landed: [u32; 2],
    /// Work of the last tick, and of keeping the leaves drawn last clear of each other,
    /// nanoseconds as counted.
    tick_work: u32,
    work: u32,
}

/// What leaves in flight are made of and how they are drawn.
#[derive(Clone)]
pub struct Pattern {
    /// Width and height of a leaf, metres.
    pub size: [f64; 2],
    pub paper: Paper,
    /// The leaves of other stocks than the paper's.
    pub stocks: LeafStocks,
    /// u of each drawn column, and how many rows are drawn.
    pub u: Vec<f32>,
    pub rows: usize,
}

impl Pattern {
    fn make(&self, kind: (Stock, f32)) -> Flight {
        Flight::new(self.make_leaf(kind), &self.u, self.rows)
    }

    fn make_leaf(&self, (stock, straightness): (Stock, f32)) -> Leaf {
        let paper = Paper {
            stock,
            ..self.paper
        };
        Leaf::new(self.size, &paper, straightness, (&self.u, self.rows))
    }

    /// The stock of a leaf, and how straight it lies on a pile.
    pub fn kind_of(&self, leaf: u32) -> (Stock, f32) {
        let stock = self.stocks.of(leaf).unwrap_or(&self.paper.stock);
        (*stock, self.stocks.straightness(leaf))
    }

    /// Whether a leaf can be creased along lines.
    fn can_crease(&self, leaf: u32, creases: &[SheetCrease]) -> bool {
        let [width, height] = self.size;
        let paper = Paper {
            stock: self.kind_of(leaf).0,
            ..self.paper
        };
        Sheet::new(paper.sheet([width, height]))
            .is_ok_and(|mut sheet| sheet.crease(creases).is_ok())
    }

    /// Thickness of leaves, in leaves of the book's own stock.
    fn thickness(&self, leaves: core::ops::Range<u32>) -> f32 {
        self.stocks.thickness(leaves, &self.paper.stock)
    }
}

impl Flights {
    /// No leaf in flight over a book of `leaves`.
    pub fn new(leaves: u32, pattern: Pattern) -> Flights {
        Flights {
            leaves,
            left: 0,
            order: Vec::with_capacity(MOST_FLIGHTS),
            // What the first pick-up would else wait for.
            spare: vec![pattern.make((pattern.paper.stock, 0.0))],
            pattern,
            creased: CreasedLeaves::default(),
            last_id: 0,
            had_deep_contact: false,
            landed: [0; 2],
            tick_work: 0,
            work: 0,
        }
    }

    /// The creased leaves, without their flights, for flights of another paper.
    pub fn take_creased(&mut self) -> CreasedLeaves {
        let mut creased = core::mem::take(&mut self.creased);
        creased.forget_flights();
        creased
    }

    /// Says which leaves are creased.
    pub fn set_creased(&mut self, creased: CreasedLeaves) {
        self.creased = creased;
    }

    /// What the leaves are made of and how they are drawn.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Puts every leaf down, `left` of them (at most all) on the left.
    pub fn lay(&mut self, left: u32) {
        self.left = left.min(self.leaves);
        for flight in core::mem::take(&mut self.order) {
            self.put_away(flight);
        }
        self.tick_work = 0;
    }

    /// Leaves on the left, in the pile and creased upon it.
    pub fn left(&self) -> u32 {
        let lying = self.lying(Side::Left);
        lying.map_or(self.left, |index| self.order[index].high())
    }

    /// Part of the book's thickness on the left, 0 to 1, if every leaf in flight counts by
    /// how far it has turned.
    pub fn turned(&self) -> f32 {
        let flying = self.order.iter().map(|flight| {
            flight.leaf().fraction_turned() * self.pattern.thickness(flight.low()..flight.high())
        });
        let turned = self.pattern.thickness(0..self.left) + flying.sum::<f32>();
        turned / self.pattern.thickness(0..self.leaves.max(1))
    }

    /// How straight the piles (right and left) lie under the leaves upon them, 0 to 1: see
    /// [`LeafStocks::straightness`].
    pub fn straightness(&self) -> [f32; 2] {
        let of = |leaf: u32| self.pattern.stocks.straightness(leaf);
        let under_left = |low: u32| low.checked_sub(1).map_or(0.0, of);
        let (Some(first), Some(last)) = (self.order.first(), self.order.last()) else {
            return [of(self.left), under_left(self.left)];
        };
        let gone = |away: f32| {
            let t = ((away - PRESSED[0]) / (PRESSED[1] - PRESSED[0])).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        };
        // The straightest of those in flight, by how near they are to the pile.
        let (mut right, mut left) = (0.0f32, 0.0f32);
        for flight in &self.order {
            let turned = flight.leaf().fraction_turned();
            right = right.max(of(flight.low()) * (1.0 - gone(turned)));
            left = left.max(of(flight.high() - 1) * (1.0 - gone(1.0 - turned)));
        }
        right += of(last.high()) * gone(last.leaf().fraction_turned());
        left += under_left(first.low()) * gone(1.0 - first.leaf().fraction_turned());
        [right.min(1.0), left.min(1.0)]
    }

    /// Takes up the uppermost leaves of side `from`: `low` leaves are on the left
    /// of them, `high` with them. Returns the flight's number, never 0.
    ///
    /// None where they are not the uppermost of that side, where there are none,
    /// or where [`MOST_FLIGHTS`] are in flight.
    pub fn pick_up(&mut self, from: Side, low: u32, high: u32) -> Option<u32> {
        let right_end = self.right_end();
        let is_uppermost = match from {
            Side::Right => low == right_end && high <= self.leaves,
            Side::Left => high == self.left(),
        };
        if !is_uppermost || low >= high || self.order.len() == MOST_FLIGHTS {
            return None;
        }
        // Not when it is drawn: steps must not know how often that is.
        self.had_deep_contact &= self.flying() > 0;
        self.last_id = self.last_id.wrapping_add(1).max(1);
        let uppermost = match from {
            Side::Right => low,
            Side::Left => high - 1,
        };
        if let Some(index) = self.lying(from) {
            if high - low == 1 {
                self.order[index].call(self.last_id);
                return Some(self.last_id);
            }
            // Several that fly as one have no creases.
            self.cover(index, from);
        }
        let mut flight = self.take_spare(self.pattern.kind_of(uppermost));
        flight.take_up(self.last_id, from, low, high);
        self.put_next_to(from, flight);
        Some(self.last_id)
    }

    /// Puts a flight next to the pile that it lay on.
    fn put_next_to(&mut self, side: Side, flight: Flight) {
        match side {
            Side::Right => self.order.push(flight),
            Side::Left => {
                self.left = flight.low();
                self.order.insert(0, flight);
            }
        }
    }

    /// Leaves on the left of the right pile and of what lies creased upon it.
    fn right_end(&self) -> u32 {
        match self.lying(Side::Right) {
            Some(index) => self.order[index].low(),
            None => self.order.last().map_or(self.left, Flight::high),
        }
    }

    /// A grab takes hold of a flight at (`u`, `v`). A reader holds one leaf at a
    /// time, with as many fingers as there are: what was held before is let go,
    /// and all others in flight make way to the sides where they belong.
    pub fn grab(&mut self, id: u32, grab: u32, u: f32, v: f32) {
        let Some(index) = self.index(id) else {
            return;
        };
        self.order[index].leaf_mut().grab(grab, u, v);
        if self.order[index].phase() == Phase::Held {
            self.send(0..index, Side::Left, WAY_SECONDS);
            self.send(index + 1..self.order.len(), Side::Right, WAY_SECONDS);
        }
    }

    /// The grab lets go; the leaf falls to the side that its swing takes it, and
    /// those in its way go there too.
    pub fn release(&mut self, id: u32, grab: u32) {
        let Some(index) = self.index(id) else {
            return;
        };
        self.order[index].leaf_mut().release(grab);
        if let Phase::Falling(side) = self.order[index].phase() {
            self.clear_way(index, side, WAY_SECONDS);
        }
    }

    /// Takes a flight to a side, out of every grab, and those in its way with it.
    /// While a grab holds another, it goes to its own side of that one.
    pub fn play(&mut self, id: u32, to: Side, seconds: f32) {
        let held = |flight: &Flight| flight.phase() == Phase::Held;
        if let Some(index) = self.index(id) {
            let to = match self.order.iter().position(held) {
                Some(held) if index < held => Side::Left,
                Some(held) if index > held => Side::Right,
                _ => to,
            };
            self.order[index].leaf_mut().play(to, seconds);
            self.clear_way(index, to, seconds);
        }
    }

    /// Draws every flight between the piles (right and left), or between those that were
    /// drawn `last`. Returns whether these piles are to be drawn.
    pub fn draw(&mut self, piles: [&Pile; 2], last: [&Pile; 2]) -> bool {
        let is_followed;
        (is_followed, self.work) = draw(&mut self.order, piles, last);
        is_followed
    }

    /// Notes a tick in which nothing moves.
    pub fn rest(&mut self) {
        self.tick_work = 0;
    }

    /// Work of the last tick, nanoseconds as counted.
    pub fn tick_work(&self) -> u32 {
        self.tick_work
    }

    /// Work of keeping the leaves drawn last clear of each other, nanoseconds as counted.
    pub fn work(&self) -> u32 {
        self.work
    }

    /// The flights from the left to the right.
    pub fn order(&self) -> &[Flight] {
        &self.order
    }

    /// The flight of a number; None once it is over.
    pub fn get(&self, id: u32) -> Option<&Flight> {
        self.order
            .iter()
            .find(|flight| flight.id() == id && id != LYING)
    }

    /// The flight of a number, to be held.
    pub fn get_mut(&mut self, id: u32) -> Option<&mut Flight> {
        let mut flights = self.order.iter_mut();
        flights.find(|flight| flight.id() == id && id != LYING)
    }

    /// The points of the flight at `index`, from the left: see [`Flight::override_surface`].
    pub fn override_surface(&mut self, index: usize) -> Option<&mut [f32]> {
        self.order.get_mut(index).map(Flight::override_surface)
    }

    fn index(&self, id: u32) -> Option<usize> {
        let is_meant = |flight: &Flight| flight.id() == id && id != LYING;
        self.order.iter().position(is_meant)
    }

    /// Leaves cannot pass each other: those between flight `index` and `side` go
    /// there as well.
    fn clear_way(&mut self, index: usize, side: Side, seconds: f32) {
        let in_the_way = match side {
            Side::Left => 0..index,
            Side::Right => index + 1..self.order.len(),
        };
        self.send(in_the_way, side, seconds);
    }

    fn send(&mut self, flights: core::ops::Range<usize>, side: Side, seconds: f32) {
        for flight in &mut self.order[flights] {
            if flight.phase().side() != Some(side) {
                flight.leaf_mut().play(side, seconds);
            }
        }
    }

    fn join_piles(&mut self) {
        while self.joins(Side::Left) {
            let over = self.order.remove(0);
            self.left = over.high();
            self.count(&over);
            self.put_away(over);
        }
        while self.joins(Side::Right)
            && let Some(over) = self.order.pop()
        {
            self.count(&over);
            self.put_away(over);
        }
        self.let_lie();
    }

    /// Counts what has come to rest; what lay creased already was.
    fn count(&mut self, over: &Flight) {
        if !over.lies() {
            let put_down = over.leaf().was_put_down();
            self.landed[0] = self.landed[0].wrapping_add(1);
            self.landed[1] = self.landed[1].wrapping_add(put_down.into());
        }
    }

    /// Keeps a flight that is over to be used again.
    fn put_away(&mut self, over: Flight) {
        if !over.leaf().is_creased() {
            self.spare.push(over);
        } else if let Some(mut over) = self.creased.cover(over) {
            over.crease(&[]);
            self.spare.push(over);
        }
    }

    /// Flights that have joined a pile, and those of them that the limit on the time
    /// of a fall put down.
    pub fn landed(&self) -> [u32; 2] {
        self.landed
    }

    /// A flight of such a leaf: one that was, or else any with its leaf made anew.
    fn take_spare(&mut self, kind: (Stock, f32)) -> Flight {
        let is_such = |flight: &Flight| flight.leaf().kind() == kind;
        if let Some(index) = self.spare.iter().rposition(is_such) {
            return self.spare.remove(index);
        }
        if self.order.len() + self.spare.len() < MOST_FLIGHTS {
            return self.pattern.make(kind);
        }
        let mut flight = self.spare.remove(0);
        *flight.leaf_mut() = self.pattern.make_leaf(kind);
        flight
    }
}
