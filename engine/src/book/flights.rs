//! The leaves in flight, in their order around the spine.
//!
//! The leaves of a book lie in the order in which they are bound. Those in
//! flight are a run of them: left of the run lies the left pile, right of it
//! the right pile, and no leaf passes another. A leaf taken up from the right
//! joins the run at its right end, one from the left at its left end; a leaf
//! that has come to rest leaves the run only where nothing is in flight between
//! it and its pile.

use super::block::Pile;
use super::draw::{draw, on_left};
use super::flight::Flight;
use super::gutter::Gutter;
use super::leaf::{Leaf, Phase, TICK};
use super::meet::Neighbour;
use crate::grid::Side;

/// Leaves in flight at once, at most: what bounds a book's memory.
pub const MOST_FLIGHTS: usize = 16;

/// How firmly a leaf meets one that is stepped after it: half of what overlaps
/// is pushed out in a tick.
const YIELDING: f32 = 0.01;

/// Depth after a tick, metres, from which a leaf is brought out of what it met,
/// and how often at most.
const DEEP: f32 = 1.5e-3;
const MOST_ROUNDS: usize = 6;

/// Depth to which a tick may lead, metres.
const DEEPEST: f32 = 2.5e-3;

/// Depth in a tick, metres, from which a leaf may be drawn through another.
const ASTRAY: f32 = 5e-4;

/// Length of a whole turn of a leaf that makes way for one let go, seconds.
const WAY_SECONDS: f32 = 0.8;

/// The leaves in flight, and how many lie on either side of them.
pub struct Flights {
    /// Leaves of the book, and those of the left pile.
    leaves: u32,
    left: u32,
    /// From the left to the right.
    order: Vec<Flight>,
    /// Flights that are over, to be used again without an allocation.
    spare: Vec<Flight>,
    last_id: u32,
    /// Whether a leaf has come deep into another since all lay still.
    tangled: bool,
}

impl Flights {
    /// No leaf in flight over a book of `leaves`; the first to fly is `pattern`,
    /// others are its copies.
    pub fn new(leaves: u32, pattern: Leaf, u: &[f32], rows: usize) -> Flights {
        let mut spare = Vec::with_capacity(MOST_FLIGHTS);
        spare.push(Flight::new(pattern, u, rows));
        Flights {
            leaves,
            left: 0,
            order: Vec::with_capacity(MOST_FLIGHTS),
            spare,
            last_id: 0,
            tangled: false,
        }
    }

    /// Puts every leaf down, `left` of them (at most all) on the left.
    pub fn lay(&mut self, left: u32) {
        self.left = left.min(self.leaves);
        self.spare.append(&mut self.order);
    }

    /// Leaves of the left pile.
    pub fn left(&self) -> u32 {
        self.left
    }

    /// Leaves on the left if every leaf in flight counts by how far it has turned.
    pub fn turned(&self) -> f32 {
        let flying = self.order.iter().map(Flight::leaves_turned);
        self.left as f32 + flying.sum::<f32>()
    }

    /// Takes up the uppermost leaves of side `from`: `low` leaves are on the left
    /// of them, `high` with them. Answers the flight's number, never 0.
    ///
    /// None where they are not the uppermost of that side, where there are none,
    /// or where [`MOST_FLIGHTS`] are in flight.
    pub fn lift(&mut self, from: Side, low: u32, high: u32) -> Option<u32> {
        let right_end = self.order.last().map_or(self.left, Flight::high);
        let is_uppermost = match from {
            Side::Right => low == right_end && high <= self.leaves,
            Side::Left => high == self.left,
        };
        if !is_uppermost || low >= high || self.order.len() == MOST_FLIGHTS {
            return None;
        }
        let mut flight = self.take_spare();
        self.last_id = self.last_id.wrapping_add(1).max(1);
        flight.take_up(self.last_id, from, low, high);
        match from {
            Side::Right => self.order.push(flight),
            Side::Left => {
                self.left = low;
                self.order.insert(0, flight);
            }
        }
        Some(self.last_id)
    }

    /// A hand takes hold of a flight at (`u`, `v`). A reader holds one leaf at a
    /// time, with as many fingers as there are: what was held before is let go,
    /// and all others in flight make way to the sides where they belong.
    pub fn grab(&mut self, id: u32, hand: u32, u: f32, v: f32) {
        let Some(index) = self.index(id) else {
            return;
        };
        self.order[index].leaf_mut().grab(hand, u, v);
        if self.order[index].phase() == Phase::Held {
            self.send(0..index, Side::Left, WAY_SECONDS);
            self.send(index + 1..self.order.len(), Side::Right, WAY_SECONDS);
        }
    }

    /// The hand lets go; the leaf falls to the side that its swing takes it, and
    /// those in its way go there too.
    pub fn release(&mut self, id: u32, hand: u32) {
        let Some(index) = self.index(id) else {
            return;
        };
        self.order[index].leaf_mut().release(hand);
        if let Phase::Falling(side) = self.order[index].phase() {
            self.clear_way(index, side, WAY_SECONDS);
        }
    }

    /// Takes a flight to a side, out of every hand, and those in its way with it.
    /// While a hand holds another, it goes to its own side of that one.
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

    /// Steps every flight by one tick between the piles (right and left), and
    /// lets those at rest join their piles.
    pub fn step(&mut self, gutter: &Gutter, piles: [&Pile; 2]) {
        self.wake();
        for flight in &mut self.order {
            flight.leaf_mut().seat(gutter);
        }
        self.make_room();
        for flight in &mut self.order {
            flight.leaf_mut().keep();
        }
        // From the piles inward, so that what lies upon another meets it where it
        // will be; two leaves that push each other at once would shake.
        let on_left = on_left(&self.order);
        for index in 0..on_left {
            self.step_one(index, gutter, piles, [1.0, YIELDING]);
        }
        for index in (on_left..self.order.len()).rev() {
            let left = if index == on_left { 1.0 } else { YIELDING };
            self.step_one(index, gutter, piles, [left, 1.0]);
        }
        self.relax(gutter, piles);
        if self.tangled {
            self.take_back(gutter);
        }
        self.join_piles();
    }

    /// Keeps hands from pulling what they hold through the leaves beside it: they
    /// follow these as they make way.
    fn make_room(&mut self) {
        for index in 0..self.order.len() {
            let (own, [left, right]) = self.among(index);
            if own.phase() != Phase::Held {
                continue;
            }
            let least = right.map_or(0.0, |flight| flight.leaf().seated().reach(1.0));
            let most = left.map_or(1.0, |flight| 1.0 - flight.leaf().seated().reach(-1.0));
            let middle = 0.5 * (least + most);
            let room = if least < most {
                [least, most]
            } else {
                [middle; 2]
            };
            own.leaf_mut().set_room(room);
        }
    }

    /// Draws every flight between the piles (right and left).
    pub fn draw(&mut self, piles: [&Pile; 2]) {
        self.tangled &= !self.order.is_empty();
        let held = |flight: &Flight| flight.leaf().was_held();
        let wary = self.tangled || self.order.iter().any(held);
        draw(&mut self.order, piles, wary);
    }

    /// Flight `index` and its neighbours, left and right.
    fn among(&mut self, index: usize) -> (&mut Flight, [Option<&Flight>; 2]) {
        let (left, rest) = self.order.split_at_mut(index);
        let (own, right) = rest
            .split_first_mut()
            .expect("the index is below the length");
        (own, [left.last(), right.first()])
    }

    /// Steps one flight; its neighbours, left and right, are as firm as said.
    fn step_one(&mut self, index: usize, gutter: &Gutter, piles: [&Pile; 2], firm: [f32; 2]) {
        let supported = self.is_supported(index);
        let (own, [left, right]) = self.among(index);
        let leaf = own.leaf_mut();
        if matches!(leaf.phase(), Phase::Resting(_)) {
            return;
        }
        let left = left.map(|flight| neighbour_of(flight, firm[0]));
        let right = right.map(|flight| neighbour_of(flight, firm[1]));
        leaf.meet(piles, [left, right], true);
        leaf.step(supported);
        leaf.seat(gutter);
    }

    /// Brings out of each other, of the piles and of neighbours, what a tick drove
    /// in: contact is told to the sheet as planes, and what moved fast is
    /// elsewhere than they said; and a leaf between two others yields to both.
    fn relax(&mut self, gutter: &Gutter, piles: [&Pile; 2]) {
        let count = self.order.len();
        for round in 0..MOST_ROUNDS {
            let mut is_clear = true;
            for k in 0..count {
                let index = if round % 2 == 0 { count - 1 - k } else { k };
                is_clear &= self.relax_one(index, gutter, piles, round == 0);
            }
            if is_clear {
                break;
            }
        }
        for index in 0..count {
            self.tangled |= self.order[index].leaf().seated().depth > ASTRAY;
            self.look_again(index, piles);
            self.order[index].leaf_mut().give_way(DEEP);
        }
    }

    /// Leaves that sank deep into something in the tick, or went through each other,
    /// take it back, and those that they touch with them.
    fn take_back(&mut self, gutter: &Gutter) {
        let count = self.order.len();
        let mut back = [false; MOST_FLIGHTS];
        for index in 0..count {
            if self.order[index].leaf().has_sunk(DEEPEST) {
                back[index.saturating_sub(1)..(index + 2).min(count)].fill(true);
            }
        }
        for (flight, back) in self.order.iter_mut().zip(back) {
            if back {
                flight.leaf_mut().step_back(gutter);
            }
            flight.cut();
        }
        let through = |order: &[Flight], back: &[bool]| {
            let mut pairs = order.windows(2).zip(back.windows(2));
            pairs.position(|(pair, back)| back != [true; 2] && pair[0].is_through(&pair[1]))
        };
        while let Some(index) = through(&self.order, &back) {
            for index in [index, index + 1] {
                if !back[index] {
                    back[index] = true;
                    self.order[index].leaf_mut().step_back(gutter);
                    self.order[index].cut();
                }
            }
        }
    }

    /// Finds how deep a flight still is after it was brought out.
    fn look_again(&mut self, index: usize, piles: [&Pile; 2]) {
        let (own, neighbours) = self.among(index);
        let leaf = own.leaf_mut();
        if leaf.seated().depth > DEEP {
            let [left, right] = neighbours.map(|flight| Some(neighbour_of(flight?, 1.0)));
            leaf.meet(piles, [left, right], false);
        }
    }

    /// Brings one flight out of what it overlaps; answers whether there was none.
    /// At first nothing is looked for where nothing can be.
    fn relax_one(
        &mut self,
        index: usize,
        gutter: &Gutter,
        piles: [&Pile; 2],
        is_first: bool,
    ) -> bool {
        let (own, neighbours) = self.among(index);
        let leaf = own.leaf_mut();
        if matches!(leaf.phase(), Phase::Resting(_)) {
            return true;
        }
        let seated = neighbours.map(|flight| flight.map(|flight| flight.leaf().seated()));
        if is_first && leaf.seated().is_clear(seated, DEEP, TICK) {
            return true;
        }
        let [left, right] = neighbours.map(|flight| Some(neighbour_of(flight?, 1.0)));
        leaf.meet(piles, [left, right], false);
        if leaf.seated().firm_depth < DEEP {
            return true;
        }
        leaf.push_out();
        leaf.seat(gutter);
        false
    }

    /// Whether what flight `index` lies upon, or will, is down.
    fn is_supported(&self, index: usize) -> bool {
        let Some(side) = self.order[index].phase().side() else {
            return false;
        };
        let under = match side {
            Side::Right => self.order.get(index + 1),
            Side::Left => index.checked_sub(1).and_then(|under| self.order.get(under)),
        };
        under.is_none_or(|under| under.leaf().is_down() && under.phase().side() == Some(side))
    }

    /// Wakes leaves that rest upon others that move.
    fn wake(&mut self) {
        for index in 0..self.order.len() {
            if matches!(self.order[index].phase(), Phase::Resting(_)) && !self.is_supported(index) {
                self.order[index].leaf_mut().wake();
            }
        }
    }

    /// The flights from the left to the right.
    pub fn order(&self) -> &[Flight] {
        &self.order
    }

    /// The flight of a number; None once it is over.
    pub fn get(&self, id: u32) -> Option<&Flight> {
        self.order.iter().find(|flight| flight.id() == id)
    }

    /// The flight of a number, to be held.
    pub fn get_mut(&mut self, id: u32) -> Option<&mut Flight> {
        self.order.iter_mut().find(|flight| flight.id() == id)
    }

    fn index(&self, id: u32) -> Option<usize> {
        self.order.iter().position(|flight| flight.id() == id)
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
        while let Some(first) = self.order.first()
            && first.phase() == Phase::Resting(Side::Left)
        {
            self.left = first.high();
            let over = self.order.remove(0);
            self.spare.push(over);
        }
        while let Some(last) = self.order.last()
            && last.phase() == Phase::Resting(Side::Right)
            && let Some(over) = self.order.pop()
        {
            self.spare.push(over);
        }
    }

    fn take_spare(&mut self) -> Flight {
        self.spare.pop().unwrap_or_else(|| {
            // One flight was made at the beginning: it is in the air now.
            self.order[0].clone()
        })
    }
}

fn neighbour_of(flight: &Flight, firmness: f32) -> Neighbour<'_> {
    Neighbour {
        leaf: flight.leaf().seated(),
        firmness,
    }
}
