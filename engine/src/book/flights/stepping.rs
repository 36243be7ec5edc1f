//! A tick of the leaves in flight: each steps between its neighbours, and what the tick
//! drove into each other is brought out of it, or taken back.

use super::Flights;
use crate::book::contacts::Neighbour;
use crate::book::draw::on_left;
use crate::book::flight::Flight;
use crate::book::gutter::Gutter;
use crate::book::limits::{MOST_FLIGHTS, TICK};
use crate::book::phase::Phase;
use crate::book::pile::Pile;
use crate::contact::tolerance::{DEEP, DEEPEST, NEEDS_TEST, TUNNELLED};
use crate::grid::Side;

/// How firmly a leaf meets one that is stepped after it: half of what overlaps
/// is pushed out in a tick.
const YIELDING: f32 = 0.01;

/// How often a leaf is brought out of what it met in a tick, at most.
const MOST_ROUNDS: usize = 6;

/// Part of the half turn by which a leaf is well ahead of another.
const AHEAD: f32 = 0.2;

impl Flights {
    /// Steps every flight by one tick between the piles (right and left), and
    /// lets those at rest join their piles.
    pub fn step(&mut self, gutter: &Gutter, piles: [&Pile; 2]) {
        self.creased.pass(f64::from(TICK));
        self.wake();
        self.part_overdue();
        for flight in &mut self.order {
            flight.leaf_mut().bend_over(piles);
            flight.leaf_mut().bend_into_gutter(gutter);
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
        for flight in &mut self.order {
            flight.keep_from_itself(gutter, DEEPEST);
            flight.open_where_through_itself();
        }
        if self.order.iter().any(Flight::may_have_tunnelled) {
            self.take_back(gutter);
        }
        let work = self.order.iter_mut().map(Flight::take_work);
        self.tick_work = work.fold(0, u32::saturating_add);
        self.join_piles();
        self.let_folds_open();
    }

    /// Keeps grabs from pulling what they hold through the leaves beside it: they
    /// follow these as they make way.
    fn make_room(&mut self) {
        for index in 0..self.order.len() {
            let (own, [left, right]) = self.among(index);
            if own.phase() != Phase::Held {
                continue;
            }
            let least = right.map_or(0.0, |flight| flight.leaf().in_book_space().reach(1.0));
            let most = left.map_or(1.0, |flight| {
                1.0 - flight.leaf().in_book_space().reach(-1.0)
            });
            let middle = 0.5 * (least + most);
            let room = if least < most {
                [least, most]
            } else {
                [middle; 2]
            };
            own.leaf_mut().set_room(room);
        }
    }

    /// Steps one flight; its neighbours, left and right, are as firm as said.
    pub(super) fn step_one(
        &mut self,
        index: usize,
        gutter: &Gutter,
        piles: [&Pile; 2],
        firm: [f32; 2],
    ) {
        let supported = self.is_supported(index);
        let is_held_up = self.lies_upon_folds(index);
        let has_way = self.has_way(index);
        let is_pressed = self.is_pressed(index);
        let (own, [left, right]) = self.among(index);
        let leaf = own.leaf_mut();
        if matches!(leaf.phase(), Phase::Resting(_)) {
            return;
        }
        // Folds give way to what is next to them: what lies upon them bends less sharply than
        // they rise, and would be pierced between its nodes.
        let firm = if leaf.is_creased() { [1.0; 2] } else { firm };
        let left = left.map(|flight| neighbour_of(flight, firm[0]));
        let right = right.map(|flight| neighbour_of(flight, firm[1]));
        leaf.detect_contacts(piles, [left, right], true);
        leaf.set_held_up(is_held_up);
        leaf.step(supported, has_way, is_pressed);
        leaf.bend_into_gutter(gutter);
    }

    /// Brings out of each other, of the piles and of neighbours, what a tick drove
    /// in: contact is given to the sheet as planes, and what moved fast is
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
            let flight = &mut self.order[index];
            let depth = flight.leaf().in_book_space().depth;
            self.had_deep_contact |= depth > TUNNELLED;
            let is_held = self.had_deep_contact && flight.leaf().was_held();
            flight.set_may_have_tunnelled(depth > TUNNELLED || is_held, depth > NEEDS_TEST);
            self.look_again(index, piles);
            self.order[index].leaf_mut().give_way(DEEP);
        }
    }

    /// Brings one flight out of what it overlaps. Returns whether there was none.
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
        let in_book = neighbours.map(|flight| flight.map(|flight| flight.leaf().in_book_space()));
        if is_first && leaf.in_book_space().is_clear(in_book, DEEP, TICK) {
            return true;
        }
        let [left, right] = neighbours.map(|flight| Some(neighbour_of(flight?, 1.0)));
        leaf.detect_contacts(piles, [left, right], false);
        if leaf.in_book_space().depth < DEEP {
            return true;
        }
        leaf.push_out();
        leaf.bend_into_gutter(gutter);
        false
    }

    /// Leaves that sank deep into something in the tick, or went through each other,
    /// take it back. Others go on: what they lie upon may just be moving off.
    fn take_back(&mut self, gutter: &Gutter) {
        let count = self.order.len();
        let mut back = [false; MOST_FLIGHTS];
        for index in 0..count {
            back[index] = self.order[index].leaf().has_sunk(DEEPEST);
        }
        for (flight, back) in self.order.iter_mut().zip(back) {
            if back {
                flight.leaf_mut().step_back(gutter, DEEPEST);
            }
            flight.cut();
        }
        let through = |order: &mut [Flight], back: &[bool]| {
            (1..order.len()).find_map(|right| {
                let (pair, back) = (&mut order[right - 1..=right], &back[right - 1..=right]);
                let is_tested = pair.iter().any(Flight::may_have_tunnelled) || back.contains(&true);
                let [left, other] = pair else { return None };
                (is_tested && back != [true; 2] && left.is_through(other)).then_some(right - 1)
            })
        };
        while let Some(index) = through(&mut self.order, &back) {
            for index in [index, index + 1] {
                if !back[index] {
                    back[index] = true;
                    self.order[index].leaf_mut().step_back(gutter, DEEPEST);
                    self.order[index].cut();
                }
            }
        }
    }

    /// Finds how deep a flight still is after it was brought out.
    fn look_again(&mut self, index: usize, piles: [&Pile; 2]) {
        let (own, neighbours) = self.among(index);
        let leaf = own.leaf_mut();
        if leaf.in_book_space().depth > DEEP {
            let [left, right] = neighbours.map(|flight| Some(neighbour_of(flight?, 1.0)));
            leaf.detect_contacts(piles, [left, right], false);
        }
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

    /// Whether the flight next to flight `index`, where that is headed for, is well ahead
    /// of it.
    fn has_way(&self, index: usize) -> bool {
        let Some(side) = self.order[index].phase().side() else {
            return false;
        };
        let ahead = match side {
            Side::Right => self.order.get(index + 1),
            Side::Left => index.checked_sub(1).and_then(|ahead| self.order.get(ahead)),
        };
        let fraction = |flight: &Flight| flight.leaf().fraction_turned();
        let own = fraction(&self.order[index]);
        ahead.is_none_or(|ahead| (fraction(ahead) - own).abs() > AHEAD)
    }

    /// Wakes leaves that rest upon others that move.
    fn wake(&mut self) {
        for index in 0..self.order.len() {
            let own = &self.order[index];
            let rests = matches!(own.phase(), Phase::Resting(_));
            let is_pressed = !own.leaf().is_held_shut() && self.is_pressed(index);
            if rests && (!self.is_supported(index) || is_pressed) {
                self.order[index].leaf_mut().wake();
            }
        }
    }

    /// Lets folds open that were held shut, of leaves that lie and upon which nothing is any more.
    fn let_folds_open(&mut self) {
        for index in 0..self.order.len() {
            let own = &self.order[index];
            let rests = own.lies() && matches!(own.phase(), Phase::Resting(_));
            if rests && own.leaf().is_held_shut() && self.upon(index).is_none() {
                self.order[index].leaf_mut().open_shut();
            }
        }
    }

    /// Sends two leaves that have both fallen for as long as leaves may, and are headed for each
    /// other's side, to the side that they are over. Without help each falls where its own swing
    /// takes it, and each of these would wait for the other to be down.
    fn part_overdue(&mut self) {
        let on_left = on_left(&self.order);
        for right in 1..self.order.len() {
            let pair = &mut self.order[right - 1..=right];
            let sides = [&pair[0], &pair[1]].map(|flight| flight.phase().side());
            let are_overdue = pair.iter().all(|flight| flight.leaf().is_overdue());
            if are_overdue && sides == [Some(Side::Right), Some(Side::Left)] {
                for (index, flight) in (right - 1..).zip(pair) {
                    let is_left = index < on_left;
                    let side = if is_left { Side::Left } else { Side::Right };
                    flight.leaf_mut().head_for(side);
                }
            }
        }
    }

    /// Flight `index` and its neighbours, left and right.
    fn among(&mut self, index: usize) -> (&mut Flight, [Option<&Flight>; 2]) {
        let (left, rest) = self.order.split_at_mut(index);
        let (own, right) = rest
            .split_first_mut()
            .expect("the index is below the length");
        (own, [left.last(), right.first()])
    }
}

fn neighbour_of(flight: &Flight, firmness: f32) -> Neighbour<'_> {
    Neighbour {
        leaf: flight.leaf().in_book_space(),
        firmness,
    }
}
