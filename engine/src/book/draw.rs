//! The leaves in flight as they are drawn: clear of each other and of the piles.
//!
//! Where leaves have come deep into each other, moving what is drawn out of the way
//! is not enough: a crumpled leaf has folds in which no one knows any more on which
//! side the other belongs. There the picture does not follow the paper through
//! another leaf but goes only as far as it can, and catches up when the paper has come
//! clear.

use super::block::Pile;
use super::flight::{Flight, Touch};
use super::flights::MOST_FLIGHTS;
use crate::grid::Side;

/// How far over a pile what flies is drawn, metres, and over what flies under it: a leaf
/// that is taken up from under others lies on the pile, where those that lie crumpled
/// upon it were drawn.
const OVER: f32 = 1e-4;

/// Leaves that go through each other by less than this, metres, touch: crumpled ones, by
/// what comes of rounding; and smooth ones, which no hand has crumpled. In a riffle these lie
/// so closely that else one would always be held back.
const TOUCH: Touch = [1e-6, 5e-5];

/// The same where no more than a few fly, which have room: so much less is enough for them
/// to be cleared thoroughly. Leaves at a small angle to each other are deeper in than their
/// edges are past facets.
const GRAZING: Touch = [1e-6, 2e-5];
const FEW: usize = 3;

/// The same where no picture is clear, for the one that is nearly.
const ALMOST: Touch = [5e-5; 2];

/// Draws flights, from the left to the right, between the piles (right and left).
pub fn draw(order: &mut [Flight], piles: [&Pile; 2]) {
    let are_few = order.len() <= FEW;
    for flight in order.iter_mut() {
        flight.draw(piles, are_few);
    }
    let all = [true; MOST_FLIGHTS];
    settle(order, &all, piles);
    let mut met = [false; MOST_FLIGHTS];
    // Most are clear by now, and only those that are not are worth more work.
    let touch = if are_few { GRAZING } else { TOUCH };
    if find_crossings(order, &mut met, touch) {
        for (flight, met) in order.iter_mut().zip(met) {
            flight.draw_again(met);
        }
        settle(order, &all, piles);
        spread(order);
        lift_off(order, &all, piles);
        hold_back(order, piles);
    }
    for flight in order {
        flight.show();
    }
}

/// How many of the flights, from the left, are over the left pile.
pub fn on_left(order: &[Flight]) -> usize {
    let over = |flight: &&Flight| flight.leaf().share_turned() > 0.5;
    order.iter().take_while(over).count()
}

/// Moves flights, of those `asked` about, off each other and out of the piles.
fn settle(order: &mut [Flight], asked: &[bool], piles: [&Pile; 2]) {
    clear(order, asked);
    lift_off(order, asked, piles);
}

/// Moves each flight, of those `asked` about, off the one that it lies upon.
fn clear(order: &mut [Flight], asked: &[bool]) {
    let (on_left, count) = (on_left(order), order.len());
    let on_right = (on_left..count).rev().map(|index| (index, Side::Right));
    // Last, the two that meet in the middle.
    let middle = (on_left, Side::Left);
    let on_left = (0..on_left).map(|index| (index, Side::Left));
    for (index, side) in on_left.chain(on_right).chain([middle]) {
        if index < count && asked[index] {
            move_off(order, index, side);
        }
    }
}

/// Moves flights off each other from the middle outward, where of the two that meet there
/// one was pushed into the next.
fn spread(order: &mut [Flight]) {
    let on_left = on_left(order);
    for index in on_left + 1..order.len() {
        move_off(order, index, Side::Left);
    }
    for index in (1..on_left).rev() {
        move_off(order, index - 1, Side::Right);
    }
}

/// Moves a flight off its neighbour on a side, if there is one.
#[inline(never)]
fn move_off(order: &mut [Flight], index: usize, side: Side) {
    let (left, rest) = order.split_at_mut(index);
    let Some((own, right)) = rest.split_first_mut() else {
        return;
    };
    let neighbour = match side {
        Side::Left => left.last(),
        Side::Right => right.first(),
    };
    if let Some(neighbour) = neighbour {
        own.clear_of(neighbour, side);
    }
}

/// Lifts flights, of those `asked` about, out of the piles (right and left), each over
/// those that fly between it and a pile.
fn lift_off(order: &mut [Flight], asked: &[bool], piles: [&Pile; 2]) {
    let down = |flight: &&Flight| flight.leaf().is_down();
    let right = order.len() - order.iter().rev().take_while(down).count();
    let left = order.iter().take_while(down).count();
    for (index, flight) in order.iter_mut().enumerate().filter(|(k, _)| asked[*k]) {
        let ranks = [
            right.saturating_sub(index),
            (index + 1).saturating_sub(left),
        ];
        flight.lift_off(piles, ranks.map(|rank| OVER * rank as f32));
    }
}

/// Draws flights that would go through each other only a part of the way from what was
/// drawn of them last, which did not; and with them those that they then meet.
fn hold_back(order: &mut [Flight], piles: [&Pile; 2]) {
    let mut back = [false; MOST_FLIGHTS];
    while find_crossings(order, &mut back, TOUCH) {
        each(order, &back, &Flight::hold_back);
        let is_clear = |order: &mut [Flight], touch: Touch, (part, cleared): (f32, bool)| {
            draw_part(order, &back, part, cleared, piles);
            (1..order.len())
                .all(|right| back[right - 1..=right] != [true; 2] || !cross(order, right, touch))
        };
        // Over a pile that grew even the last picture may be clear no more.
        let _ = [TOUCH, ALMOST].into_iter().any(|touch| {
            let mut ways = [(0.5, true), (0.0, true), (0.0, false)].into_iter();
            ways.any(|way| is_clear(order, touch, way))
        });
    }
}

/// Looks for neighbours that are drawn through each other, one of whom at least was not
/// `met` before, and adds them to these. Answers whether there are any. `touch` is
/// as in [`Flight::is_drawn_through`].
fn find_crossings(order: &mut [Flight], met: &mut [bool], touch: Touch) -> bool {
    let mut any = false;
    for right in 1..order.len() {
        if met[right - 1..=right] != [true; 2] && cross(order, right, touch) {
            met[right - 1..=right].fill(true);
            any = true;
        }
    }
    any
}

/// Whether a flight is drawn through the one on its left; see [`find_crossings`].
fn cross(order: &mut [Flight], right: usize, touch: Touch) -> bool {
    let (left, right) = order.split_at_mut(right);
    left.last_mut()
        .is_some_and(|left| left.is_drawn_through(&mut right[0], touch))
}

/// Draws those that are held back a part of the way, moved clear of each other or not.
fn draw_part(order: &mut [Flight], back: &[bool], part: f32, cleared: bool, piles: [&Pile; 2]) {
    each(order, back, &|flight| flight.draw_part(part));
    lift_off(order, back, piles);
    // Half-way between two pictures leaves are nearer to each other than in either, and
    // what lies on a pile that grew was lifted to one height.
    if cleared {
        settle(order, back, piles);
    }
}

/// Has each of the flights `asked` about do something.
fn each(order: &mut [Flight], asked: &[bool], act: &dyn Fn(&mut Flight)) {
    let asked = order.iter_mut().zip(asked).filter(|(_, asked)| **asked);
    asked.for_each(|(flight, _)| act(flight));
}
