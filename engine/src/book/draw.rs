//! The leaves in flight as they are drawn: clear of each other, of themselves and of the
//! piles.
//!
//! Where leaves have come deep into each other, moving what is drawn out of the way
//! is not enough: a crumpled leaf has folds in which no one knows any more on which
//! side the other belongs. There the picture does not follow the paper through
//! another leaf but goes only as far as it can, and catches up when the paper has come
//! clear. The picture drawn last, piles and all, is clear; so there is always one that is,
//! also where the work that one picture may take is spent. Lengths are those of a page 0.14 m
//! wide, and in proportion for others.

use super::flight::{CUTTING, Flight, MOVING, Tolerance};
use super::limits::MOST_FLIGHTS;
use super::pile::Pile;
use crate::contact::tolerance::{GRAZING, OVER_PILE, ROUNDING, TOUCHING};
use crate::contact::work::Work;
use crate::grid::Side;

/// Where no more fly than this, there is room for them.
const FEW: usize = 3;

/// Work that separating may take in one picture, and the search for what is drawn through what,
/// nanoseconds; what was begun is ended.
const SEPARATING: u32 = 2_000_000;
const SEARCHING: u32 = 1_500_000;

/// Every flight, as a set of bits.
const ALL: u16 = u16::MAX;

/// Work that the search may take beyond that once only what is not known to be clear is held back,
/// nanoseconds.
const HOLDING: u32 = 500_000;

/// Steps back from what is wanted to the last picture: that turned with the paper, and that itself.
const STEPS: u8 = 2;

/// Draws flights, from the left to the right, between the piles (right and left), or between
/// those that were drawn `last`. Returns whether these piles are to be drawn, and the work
/// that separating and searching took, nanoseconds.
pub fn draw(order: &mut [Flight], piles: [&Pile; 2], last: [&Pile; 2]) -> (bool, u32) {
    let are_few = order.len() <= FEW;
    for index in 0..order.len() {
        let over = over_piles(order, index);
        order[index].draw(piles, over, last, are_few);
    }
    if has_folds(order) {
        order.iter_mut().for_each(Flight::find_parts);
        for right in 1..order.len() {
            if let [left, right] = &mut order[right - 1..=right] {
                left.order_flaps(right);
            }
        }
    }
    let separating = &mut Work::new(SEPARATING);
    resolve(order, ALL, piles, separating);
    let mut searching = Work::new(SEARCHING);
    let mut crossings = Crossings::default();
    // Most are clear by now, and only those that are not are worth more work.
    let tolerance = [ROUNDING, if are_few { GRAZING } else { TOUCHING }];
    let met = crossings.find(order, tolerance, &mut searching);
    let mut is_followed = true;
    if met != 0 || searching.is_spent() {
        // What is next to it is moved off it; all others are clear where they are.
        let set = met | met << 1 | met >> 1;
        for (index, flight) in order.iter_mut().enumerate() {
            if set >> index & 1 == 1 {
                flight.draw_again(met >> index & 1 == 1);
                crossings.forget(index);
            }
        }
        resolve(order, set, piles, separating);
        separate_outward(order, set, piles, separating);
        if !has_folds(order) {
            push_off_piles(order, set, piles, separating);
        }
        order.iter_mut().for_each(Flight::want);
        is_followed = hold_back(order, crossings, [piles, last], separating, &mut searching);
    }
    for flight in order {
        flight.show();
    }
    (is_followed, separating.done() + searching.done())
}

/// How many of the flights, from the left, are over the left pile.
pub fn on_left(order: &[Flight]) -> usize {
    let over = |flight: &&Flight| flight.leaf().fraction_turned() > 0.5;
    order.iter().take_while(over).count()
}

/// Moves flights, of a set of them, off each other and out of the piles.
fn resolve(order: &mut [Flight], set: u16, piles: [&Pile; 2], work: &mut Work) {
    separate(order, set, piles, work);
    if !has_folds(order) {
        push_off_piles(order, set, piles, work);
    }
}

/// Whether any flight is creased. Then each is moved off what it lies upon, the pile and its own
/// parts at once: any of these may push it into another.
fn has_folds(order: &[Flight]) -> bool {
    order.iter().any(Flight::is_creased)
}

/// Moves each flight, of a set of them, off the one that it lies upon.
fn separate(order: &mut [Flight], set: u16, piles: [&Pile; 2], work: &mut Work) {
    let (on_left, count) = (on_left(order), order.len());
    let on_right = (on_left..count).rev().map(|index| (index, Side::Right));
    // Last, the two that meet in the middle.
    let middle = (on_left, Side::Left);
    let on_left = (0..on_left).map(|index| (index, Side::Left));
    for (index, side) in on_left.chain(on_right).chain([middle]) {
        if index < count && set >> index & 1 == 1 {
            // Where a flap reaches over the spine each may lie upon the other.
            let other = match side {
                Side::Left => index.wrapping_sub(1),
                Side::Right => index + 1,
            };
            if other < count && set >> other & 1 == 1 && order[index].lies_open_beside(side) {
                move_off(order, other, side.opposite(), piles, work);
            }
            move_off(order, index, side, piles, work);
        }
    }
}

/// Moves flights, of a set of them, off each other from the middle outward, where of the two that
/// meet there one was pushed into the next.
fn separate_outward(order: &mut [Flight], set: u16, piles: [&Pile; 2], work: &mut Work) {
    let (on_left, count) = (on_left(order), order.len());
    let on_right = (on_left + 1..count).map(|index| (index, Side::Left));
    let on_left = (1..on_left).rev().map(|index| (index - 1, Side::Right));
    for (index, side) in on_right.chain(on_left) {
        if set >> index & 1 == 1 {
            move_off(order, index, side, piles, work);
        }
    }
}

/// Moves a flight off its neighbour on a side, if there is one.
#[inline(never)]
fn move_off(order: &mut [Flight], index: usize, side: Side, piles: [&Pile; 2], work: &mut Work) {
    let has_folds = has_folds(order);
    let over = over_piles(order, index);
    let (left, rest) = order.split_at_mut(index);
    let Some((own, right)) = rest.split_first_mut() else {
        return;
    };
    let neighbour = match side {
        Side::Left => left.last(),
        Side::Right => right.first(),
    };
    let is_creased = own.is_creased();
    let [folded, whole] = [true, false]
        .map(|is_folded| neighbour.filter(|other| (is_creased || other.is_creased()) == is_folded));
    if let Some(neighbour) = whole {
        own.separate_from(neighbour, side, work);
        let after_next = match side {
            Side::Left => left.len().checked_sub(2).map(|next| &left[next]),
            Side::Right => right.get(1),
        };
        if let Some(after_next) = after_next.filter(|other| !other.is_creased()) {
            own.separate_rim_from(after_next, side, work);
        }
    }
    if has_folds {
        let neighbour = folded.map(|neighbour| (neighbour, side));
        own.separate_folded(neighbour, piles, over, work);
    }
}

/// Pushes flights, of a set of them, out of the piles (right and left), each over those that
/// fly between it and a pile.
fn push_off_piles(order: &mut [Flight], set: u16, piles: [&Pile; 2], work: &mut Work) {
    for index in 0..order.len() {
        if set >> index & 1 == 1 {
            let over = over_piles(order, index);
            order[index].push_off_piles(piles, over, work);
        }
    }
}

/// How far a flight is kept over the piles (right and left), by how many fly between it and each, and
/// by the layers of those of them whose folds are shut.
fn over_piles(order: &[Flight], index: usize) -> [f32; 2] {
    let down = |flight: &&Flight| flight.leaf().is_down();
    let right = order.len() - order.iter().rev().take_while(down).count();
    let left = order.iter().take_while(down).count();
    let ranks = [
        right.saturating_sub(index),
        (index + 1).saturating_sub(left),
    ];
    let layers = [&order[index + 1..], &order[..index]]
        .map(|between| between.iter().map(Flight::height_of_layers).sum::<f32>());
    [0, 1].map(|side| OVER_PILE * ranks[side] as f32 + layers[side])
}

/// Draws flights that would go through each other, or through themselves, as they were drawn last,
/// which did not: turned about the spine with their paper or, where they would still, where they were;
/// and with them those that they then meet. Once no work is left, it is those that are not known to be
/// clear; and all, once none is left of [`HOLDING`] for what these meet. Returns whether the piles,
/// those of now and those drawn last, go on too: not where they would grow into what is drawn as it was.
fn hold_back(
    order: &mut [Flight],
    mut crossings: Crossings,
    [piles, last]: [[&Pile; 2]; 2],
    separating: &mut Work,
    work: &mut Work,
) -> bool {
    let mut piles_go_on = true;
    let mut is_short = false;
    loop {
        let mut found = crossings.find(order, [ROUNDING, TOUCHING], work);
        if work.is_spent() {
            if is_short {
                order.iter_mut().for_each(Flight::draw_last);
                return false;
            }
            is_short = true;
            found |= crossings.unknown(order);
            work.allow(HOLDING);
        }
        if found == 0 {
            return piles_go_on;
        }
        let mut moved = 0;
        for (index, flight) in order.iter_mut().enumerate() {
            if found >> index & 1 == 0 {
                continue;
            }
            let step = crossings.step_back(index, is_short);
            work.spend(MOVING);
            if step == 0 {
                flight.draw_last();
                piles_go_on &= flight.is_clear_of(piles);
            } else {
                flight.draw_carried();
                moved |= 1 << index;
            }
        }
        // What is turned may come nearer to others than what was drawn last.
        push_off_piles(order, moved, piles, separating);
        resolve(order, moved, piles, separating);
        if !piles_go_on {
            // What goes on may go on into piles that do not.
            for index in 0..order.len() {
                if crossings.steps[index] > 0 && !order[index].is_clear_of(last) {
                    push_off_piles(order, 1 << index, last, separating);
                    crossings.forget(index);
                }
            }
        }
    }
}

/// What is known of which flights are drawn through which, by their numbers from the left.
struct Crossings {
    /// How many steps each is drawn away from the last picture, of [`STEPS`].
    steps: [u8; MOST_FLIGHTS],
    /// Flights that have been cut as they are drawn.
    cut: u16,
    /// For each flight those on its right, or itself, that it is clear of.
    clear: [u16; MOST_FLIGHTS],
}

impl Default for Crossings {
    fn default() -> Crossings {
        Crossings {
            steps: [STEPS; MOST_FLIGHTS],
            cut: 0,
            clear: [0; MOST_FLIGHTS],
        }
    }
}

impl Crossings {
    /// Finds flights that are drawn through others or themselves, of those that may be: as
    /// a set of bits. Of two that have not come equally far, it is the one that has come
    /// farther. `tolerance` is as in [`Flight::is_drawn_through`].
    fn find(&mut self, order: &mut [Flight], tolerance: Tolerance, work: &mut Work) -> u16 {
        let mut found = 0;
        for left in 0..order.len() {
            let mut may_meet_round = false;
            for right in left..order.len() {
                if !self.is_asked(order, [left, right], &mut may_meet_round) {
                    continue;
                }
                if work.is_spent() {
                    return found;
                }
                let [step, other] = [left, right].map(|index| self.steps[index]);
                if self.is_through(order, [left, right], tolerance, work) {
                    found |= u16::from(step >= other) << left | u16::from(other >= step) << right;
                } else {
                    self.clear[left] |= 1 << right;
                }
            }
        }
        found
    }

    /// Flights that may be drawn through others or themselves, and are not known not to be: as a set
    /// of bits.
    fn unknown(&self, order: &[Flight]) -> u16 {
        let mut unknown = 0;
        for left in 0..order.len() {
            let mut may_meet_round = false;
            for right in left..order.len() {
                if self.is_asked(order, [left, right], &mut may_meet_round) {
                    unknown |= 1 << left | 1 << right;
                }
            }
        }
        // Those drawn last are where they are.
        let moved = (0..order.len()).filter(|index| self.steps[*index] > 0);
        unknown & moved.fold(0, |set, index| set | 1 << index)
    }

    /// Whether a flight may be drawn through one on its right, or itself, and is not known not to be.
    /// Asked of those on its right one after another, it keeps whether any between is crumpled.
    fn is_asked(
        &self,
        order: &[Flight],
        [left, right]: [usize; 2],
        may_meet_round: &mut bool,
    ) -> bool {
        // What is not next to each other meets only round what is crumpled.
        *may_meet_round |= order[right].may_be_crumpled();
        let may_meet = match right - left {
            0 => order[left].may_be_folded(),
            1 => order[left].needs_crossing_test() || order[right].needs_crossing_test(),
            _ => *may_meet_round,
        };
        // The last picture is clear.
        let are_last = self.steps[left].max(self.steps[right]) == 0;
        may_meet && !are_last && self.clear[left] >> right & 1 == 0
    }

    fn is_through(
        &mut self,
        order: &mut [Flight],
        [left, right]: [usize; 2],
        tolerance: Tolerance,
        work: &mut Work,
    ) -> bool {
        let [own, other] = [left, right].map(|index| &order[index]);
        if left + 1 == right && own.is_known_clear_of(other) {
            return own.is_drawn_past(other);
        }
        for index in [left, right] {
            if self.cut >> index & 1 == 0 {
                self.cut |= 1 << index;
                work.spend(CUTTING);
                order[index].cut_drawn();
            }
        }
        let (before, after) = order.split_at_mut(right);
        let last = &mut after[0];
        match before.get(left) {
            Some(first) => first.is_drawn_through(last, left + 1 == right, tolerance, work),
            None => last.is_drawn_through_itself(work),
        }
    }

    /// Takes a flight a step back toward the last picture, or all the way; returns where it is then.
    fn step_back(&mut self, index: usize, all_the_way: bool) -> u8 {
        self.forget(index);
        self.steps[index] = if all_the_way {
            0
        } else {
            self.steps[index] - 1
        };
        self.steps[index]
    }

    /// Says that a flight is drawn elsewhere.
    fn forget(&mut self, index: usize) {
        self.cut &= !(1 << index);
        self.clear[index] = 0;
        for clear in &mut self.clear {
            *clear &= !(1 << index);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::leaf::Leaf;
    use crate::book::limits::NODES;
    use crate::book::paper::Paper;
    use crate::book::{Board, Book};
    use crate::contact::crossing::Tiles;
    use crate::contact::mesh::Mesh;
    use crate::contact::tolerance::AT_FACET;

    const WIDTH: f32 = 0.14;

    /// A flight that lies on a side and is drawn at places by u and v, 0 to 1.
    fn drawn(side: Side, place: impl Fn(f32, f32) -> [f32; 3]) -> Flight {
        let columns = 4 * NODES[0] - 3;
        let u: Vec<f32> = (0..columns)
            .map(|column| column as f32 / (columns - 1) as f32)
            .collect();
        let rows = 27;
        let leaf = Leaf::new([f64::from(WIDTH), 0.21], &Paper::default(), 0.0, (&u, rows));
        let mut flight = Flight::new(leaf, &u, rows);
        flight.take_up(0, side, 0, 1);
        let points = flight.override_surface().as_chunks_mut::<3>().0;
        for (node, point) in points.iter_mut().enumerate() {
            let v = (node / columns) as f32 / (rows - 1) as f32;
            *point = place(u[node % columns], v);
        }
        flight.want();
        flight.draw_again(false);
        flight
    }

    /// A flight that lies on a side and is drawn level at a height, metres.
    fn level(side: Side, height: f32) -> Flight {
        drawn(side, |u, v| [side.sign() * WIDTH * u, 0.21 * v, height])
    }

    /// Least and greatest height of what is drawn of a flight on its outer half, metres.
    fn heights(flight: &Flight) -> [f32; 2] {
        let points = flight.surface().positions.as_chunks::<3>().0.iter();
        let outer = points.filter(|point| point[0].abs() > 0.5 * WIDTH);
        outer.fold([f32::MAX, f32::MIN], |[low, high], point| {
            [low.min(point[2]), high.max(point[2])]
        })
    }

    /// On either side each leaf is moved off the one under it, whichever of the two pairs of three
    /// leaves overlaps; the lowest stays where it is.
    #[test]
    fn leaves_are_moved_off_the_one_that_they_lie_upon() {
        let overlapping = [[1e-3, 0.8e-3, 5e-3], [1e-3, 3e-3, 2.8e-3]];
        for (on_left, on_right) in [(0, 1), (1, 0), (0, 0), (1, 1)] {
            let (left, right) = (overlapping[on_left], overlapping[on_right]);
            let mut order: Vec<Flight> = left
                .iter()
                .map(|height| level(Side::Left, *height))
                .chain(right.iter().rev().map(|height| level(Side::Right, *height)))
                .collect();
            let book = Book::new(f64::from(WIDTH), 0.21, 10, 0.001).unwrap();
            let [right, left] = &book.piles;
            separate(&mut order, ALL, [right, left], &mut Work::new(u32::MAX));
            for (piled, side) in [([0, 1, 2], "left"), ([5, 4, 3], "right")] {
                let [low, middle, top] = piled.map(|index| heights(&order[index]));
                assert_eq!(low, [1e-3; 2], "the lowest on the {side}");
                assert!(middle[0] > low[1], "{middle:?} over {low:?} on the {side}");
                assert!(top[0] > middle[1], "{top:?} over {middle:?} on the {side}");
            }
        }
    }

    /// The fore-edge of the uppermost of three hangs over that of the middle one, which reaches less
    /// far, and into the lowest.
    #[test]
    fn what_reaches_beyond_the_rim_of_its_neighbour_is_moved_off_the_leaf_after_that() {
        let flat = |reach: f32, z: f32| move |u: f32, v: f32| [reach * WIDTH * u, 0.21 * v, z];
        let hanging = |u: f32, v: f32| {
            let z = if u > 0.99 { 0.6e-3 } else { 1.4e-3 };
            [WIDTH * u, 0.21 * v, z]
        };
        let mut order = [
            drawn(Side::Right, hanging),
            drawn(Side::Right, flat(0.95, 1.2e-3)),
            drawn(Side::Right, flat(1.0, 1e-3)),
        ];
        let book = Book::new(f64::from(WIDTH), 0.21, 10, 0.001).unwrap();
        let [right, left] = &book.piles;
        separate(&mut order, ALL, [right, left], &mut Work::new(u32::MAX));
        let [least, _] = heights(&order[0]);
        assert!(least > 1e-3, "{least} m");
    }

    /// Two that cross at a small angle, so that no edge is farther than a sliver through a facet, are
    /// drawn through each other where the fore-edge of one is deep in the other.
    #[test]
    fn what_only_grazes_where_it_crosses_is_drawn_through_where_its_fore_edge_is_deep() {
        let sloping =
            |end: f32| move |u: f32, v: f32| [WIDTH * u, 0.21 * v, 2e-3 + end * (2.0 * u - 1.0)];
        for (end, is_through) in [(0.03e-3, false), (-0.03e-3, false), (-0.5e-3, true)] {
            let mut pair = [
                drawn(Side::Right, sloping(end)),
                drawn(Side::Right, sloping(0.0)),
            ];
            pair.iter_mut().for_each(Flight::cut_drawn);
            let [over, under] = &pair;
            let work = &mut Work::new(u32::MAX);
            let found = over.is_drawn_through(under, true, [ROUNDING, TOUCHING], work);
            assert_eq!(found, is_through, "{end} m");
        }
    }

    /// Wind folds a leaf of more than a metre that no hand has held, and it is not drawn through
    /// itself.
    #[test]
    fn a_leaf_that_the_wind_folds_is_not_drawn_through_itself() {
        let [width, height] = [1.2, 0.76];
        let mut book = Book::new(width, height, 8, 0.8e-3).expect("a book's figures");
        let paper = Paper {
            wind: [-8.0, -9.5, 9.5],
            assist: false,
            ..Paper::default()
        };
        assert!(book.set_paper(&paper), "these are a paper's figures");
        *book.board_mut(0) = Board::new(Side::Left);
        book.lay(5);
        let flight = { book.pick_up(Side::Left, 4, 5) }.expect("it lies uppermost");
        book.play(flight, Side::Right, 0.8);
        let mut tiles = Tiles::default();
        let mut sharpest = 1.0f32;
        while book.flights() > 0 {
            book.step(2);
            book.update();
            let Some(surface) = book.surface(0) else {
                break;
            };
            let normals = surface.normals.as_chunks::<3>().0;
            let middle = normals[normals.len() / 2];
            let along = |n: &[f32; 3]| n[0] * middle[0] + n[1] * middle[1] + n[2] * middle[2];
            sharpest = normals.iter().map(along).fold(sharpest, f32::min);
            tiles.cut(Mesh::of(surface));
            let apart = AT_FACET * width as f32 / WIDTH;
            assert!(!tiles.cross_themselves(apart, &mut Work::new(u32::MAX)));
        }
        assert!(sharpest < -0.9, "it was folded: {sharpest}");
    }
}
