//! What is drawn of a folded leaf, wherever another model has it in the paper's place.

use core::f32::consts::PI;

use super::flight::Flight;
use super::*;
use crate::contact::tolerance::SLIVER;
use crate::contact::work::Work;
use crate::random::Random;

const PAGE: [f32; 2] = [0.14, 0.21];
const ROWS: usize = 27;

/// A book open in its middle.
fn open_book() -> Book {
    let [width, height] = PAGE.map(f64::from);
    let mut book = Book::new(width, height, 40, 0.004).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(20);
    book
}

/// A flight of a leaf on the right, folded in two, that a grab holds.
fn folded(u: &[f32], degrees: f64) -> Flight {
    let size = PAGE.map(f64::from);
    let mut flight = Flight::new(Leaf::new(size, &Paper::default(), 0.0, (u, ROWS)), u, ROWS);
    let through = [[0.5, 0.0], [0.5, 1.0]];
    let line = SheetCrease::pressed(through, degrees.to_radians(), &Stock::BOOK, size[0]);
    assert!(flight.crease(&[line]));
    flight.take_up(1, Side::Right, 0, 1);
    flight.leaf_mut().grab(0, 0.5, 0.5);
    flight
}

/// Writes the leaf of a flight over its paper: up to its fold at one angle from the table, beyond at
/// another, radians, but for what would be under the table.
fn bend(flight: &mut Flight, angles: [f32; 2]) {
    let places = flight.paper_mesh().unwrap().places.clone();
    let [(sin, cos), (far_sin, far_cos)] = angles.map(libm::sincosf);
    let points = flight.override_surface().as_chunks_mut::<3>().0;
    for (point, [u, v]) in points.iter_mut().zip(&places) {
        let [near, far] = [u.min(0.5), (u - 0.5).max(0.0)].map(|u| u * PAGE[0]);
        let x = near * cos + far * far_cos;
        let z = near * sin + far * far_sin;
        *point = [x, v * PAGE[1], z.max(0.0)];
    }
}

/// Facing pages folded in two open their flaps against each other over the spine, one comes to lie
/// upon the other, and what is drawn of them goes with their paper when one is turned. It stood, as
/// each flap was to lie upon the other. A few frames are still behind.
#[test]
fn flaps_that_meet_over_the_spine_are_drawn_where_their_paper_is() {
    for stock in [Stock::BOOK, Stock::CARD] {
        let mut book = open_book();
        let paper = Paper {
            stock,
            ..Paper::default()
        };
        assert!(book.set_paper(&paper));
        for (leaf, degrees) in [(19, -160f64), (20, 160.0)] {
            let through = [[0.5, 0.0], [0.5, 1.0]];
            let rest = degrees.to_radians();
            let line = SheetCrease::pressed(through, rest, &stock, f64::from(PAGE[0]));
            assert!(book.crease(leaf, &[line]));
        }
        book.lay(20);
        let lag = |book: &Book| {
            let leaves = 0..book.drawn_leaves();
            let lags = leaves.filter_map(|index| book.lag(index));
            lags.fold(0.0, f32::max)
        };
        let frame = |book: &mut Book| {
            book.step(2);
            book.update();
            lag(book)
        };
        for _ in 0..300 {
            frame(&mut book);
        }
        assert_eq!(lag(&book), 0.0, "they lie");
        let id = book.pick_up(Side::Right, 20, 21).unwrap();
        book.play(id, Side::Left, 0.8);
        let mut behind = 0;
        for _ in 0..120 {
            behind += usize::from(frame(&mut book) > 5e-3);
        }
        assert!(behind <= 12, "{behind} of 120 frames");
    }
}

/// A leaf that stands is folded back through itself down to the pages, and next to another there is
/// no more work to move it off that: its parts, moved off each other, go sideways as well as up.
#[test]
fn parts_that_are_moved_off_each_other_are_not_drawn_in_the_piles() {
    let book = open_book();
    let [right, left] = &book.piles;
    let u = crowded_columns(right.columns());
    let mut random = Random::new(1);
    for degrees in [170.0, -170.0] {
        let [mut flight, mut other] = [0, 1].map(|_| folded(&u, degrees));
        other.draw([right, left], [0.0; 2], [right, left], false);
        other.find_parts();
        for picture in 0..100 {
            let page = random.between(0.0, PI);
            bend(&mut flight, [page, page + PI + random.between(-0.2, 0.2)]);
            flight.draw([right, left], [0.0; 2], [right, left], false);
            flight.find_parts();
            let next = Some((&other, Side::Right));
            flight.separate_folded(next, [right, left], [0.0; 2], &mut Work::new(0));
            let is_clear = flight.is_clear_of([right, left]);
            assert!(is_clear, "picture {picture}, folded by {degrees} degrees");
        }
    }
}

/// Once no work is left a leaf's parts are moved off each other in so many rounds, and not by every
/// look at it.
#[test]
fn rounds_of_moving_parts_are_bounded_where_no_work_is_left() {
    let book = open_book();
    let [right, left] = &book.piles;
    let mut flight = folded(&crowded_columns(right.columns()), 170.0);
    for _ in 0..2 {
        bend(&mut flight, [0.5 * PI, 1.5 * PI + 0.1]);
        flight.draw([right, left], [0.0; 2], [right, left], false);
    }
    let mut separate = || {
        let work = &mut Work::new(0);
        flight.separate_folded(None, [right, left], [0.0; 2], work);
        work.done()
    };
    let [first, second] = [separate(), separate()];
    assert!(first > 0, "it is looked at");
    assert_eq!(second, 0);
}

/// What is held back goes with its paper as it was drawn last: nothing of it is stretched or bent.
#[test]
fn a_leaf_that_is_held_back_turns_with_its_paper_and_keeps_its_lengths() {
    let book = open_book();
    let [right, left] = &book.piles;
    let mut flight = folded(&crowded_columns(right.columns()), 170.0);
    let [flat, half] = [0.3, 0.5 * PI];
    bend(&mut flight, [flat, flat + 0.5]);
    flight.draw([right, left], [0.0; 2], [right, left], false);
    flight.show();
    let lengths = |flight: &Flight| -> Vec<f32> {
        let points = flight.surface().positions.as_chunks::<3>().0;
        let edges = points
            .windows(2)
            .map(|ends| crate::vector::sub(ends[1], ends[0]));
        edges
            .map(|edge| crate::vector::dot(edge, edge).sqrt())
            .collect()
    };
    let before = lengths(&flight);
    bend(&mut flight, [half, half - 0.5]);
    flight.draw([right, left], [0.0; 2], [right, left], false);
    flight.draw_last();
    let last = flight.lag();
    flight.draw_carried();
    assert!(flight.lag() < 0.6 * last, "{} of {last} m", flight.lag());
    for (now, before) in lengths(&flight).iter().zip(before) {
        assert!((now - before).abs() < 1e-6, "{now} of {before} m");
    }
}

/// It was drawn last as the page that it was in the pile, and so is where it must be held back.
#[test]
fn a_leaf_that_comes_out_of_a_pile_is_held_back_as_its_page() {
    let book = open_book();
    let [right, left] = &book.piles;
    let mut flight = folded(&crowded_columns(right.columns()), 170.0);
    let over = |flight: &Flight| {
        let points = flight.surface().positions.as_chunks::<3>().0.iter();
        // The column at the spine is everyone's.
        let free = points.filter(|[x, _, _]| *x > 0.0);
        let heights = free.map(|[x, _, z]| z - right.height(*x));
        heights.fold(0.0, |most: f32, height| most.max(height.abs()))
    };
    flight.draw([right, left], [0.0; 2], [right, left], false);
    assert!(over(&flight) > 1e-3, "{} m", over(&flight));
    flight.draw_last();
    assert!(over(&flight) < SLIVER, "{} m", over(&flight));
    let outermost = flight.surface().positions.chunks_exact(3);
    let widest = outermost.fold(0.0, |most: f32, point| most.max(point[0]));
    assert!(widest > 0.9 * PAGE[0], "{widest} m wide");
}
