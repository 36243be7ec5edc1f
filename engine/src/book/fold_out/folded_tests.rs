//! Flaps that are folded more than once.

use super::tests::{AROUND, BOOKS, Course, FOLD, GUTTER, SIDES, open_book};
use super::*;
use crate::book::stillness::LONGEST_FALL;
use crate::stock::Stock;

/// Widths of flaps, each in so many panels: in two and in three, as wide as they may be and narrow.
const FOLDINGS: [(f64, usize); 4] = [(1.94, 2), (2.91, 3), (1.0, 2), (1.2, 3)];

fn folded(book: &Book, side: Side, (width, panels): (f64, usize)) -> FoldOut {
    let place = FlapPlace {
        side,
        fold: FOLD,
        width,
        panels,
    };
    FoldOut::new(book, place, AROUND).unwrap()
}

/// Which of its book, its side and its folding a flap has, by their numbers.
type Choice = [usize; 3];

/// Every book, side and folding once or more.
const SOME: [Choice; 4] = [[0, 0, 0], [1, 1, 1], [2, 0, 2], [0, 1, 3]];

/// Every folding on each side of every book.
fn all_choices() -> impl Iterator<Item = Choice> {
    let number = 0..BOOKS.len() * SIDES.len() * FOLDINGS.len();
    number.map(|k| [k / 8, k / 4 % 2, k % 4])
}

/// Calls with a book, words for what it is, a shut flap of it and how this is folded.
fn each_flap(
    choices: impl IntoIterator<Item = Choice>,
    mut call: impl FnMut(&Book, &str, FoldOut, (f64, usize)),
) {
    for [book, side, folding] in choices {
        let ((stock, thickness), side, folding) = (BOOKS[book], SIDES[side], FOLDINGS[folding]);
        let book = open_book(stock, thickness);
        let grammage = stock.grammage;
        let what = format!("{grammage} kg/m2 {thickness} m {side:?} {folding:?}");
        call(&book, &what, folded(&book, side, folding), folding);
    }
}

/// How far the drawn points of each panel of a shut flap are at most under the one that it lies upon,
/// metres, but over the gutter: there points next to each other differ in height by more.
fn sunk(flap: &FoldOut) -> f32 {
    let points = flap.surface().positions.as_chunks::<3>().0;
    let mesh = flap.paper_mesh().unwrap();
    let panel_of = |point: usize| {
        let u = mesh.places[point][0] * flap.panels.count as f32;
        // None on a fold.
        ((u - u.round()).abs() > 0.05).then_some(u as usize)
    };
    let panels: Vec<_> = (0..points.len()).map(panel_of).collect();
    let mut deepest: f32 = 0.0;
    for (point, x) in points
        .iter()
        .enumerate()
        .filter(|(_, x)| x[0].abs() > GUTTER)
    {
        let Some(panel) = panels[point].filter(|panel| *panel > 0) else {
            continue;
        };
        let under = (0..points.len()).filter(|other| panels[*other] == Some(panel - 1));
        let apart = |other: usize| (points[other][0] - x[0]).hypot(points[other][1] - x[1]);
        let nearest = under
            .min_by(|a, b| apart(*a).total_cmp(&apart(*b)))
            .unwrap();
        deepest = deepest.max(points[nearest][2] - x[2]);
    }
    deepest
}

/// Whether every fold is open, or shut, but for half a radian.
fn is_turned(flap: &FoldOut, is_open: bool) -> bool {
    let angles = flap.fold_angles();
    let all = angles[..flap.panels.count].iter().map(|angle| angle.abs());
    all.clone().all(|angle| {
        if is_open {
            angle < 0.5
        } else {
            angle > PI - 0.5
        }
    })
}

/// Asserts what holds for any flap that was turned and let go.
fn assert_sound(course: &Course, what: &str) {
    assert!(course.strain < 1e-4, "{what}: {course:?}");
    assert!(course.depth < 1e-4, "{what}: {course:?}");
}

#[test]
fn a_folded_flap_begins_shut_panel_upon_panel() {
    each_flap(all_choices(), |_, what, flap, _| {
        assert!(is_turned(&flap, false), "{what}: {:?}", flap.fold_angles());
        assert!(sunk(&flap) < 1e-4, "{what}: {}", sunk(&flap));
    });
}

#[test]
fn every_fold_opens_and_shuts_again() {
    open_and_shut(SOME);
}

#[test]
#[ignore = "long: make test-long"]
fn every_fold_opens_and_shuts_again_in_every_book() {
    open_and_shut(all_choices());
}

fn open_and_shut(choices: impl IntoIterator<Item = Choice>) {
    each_flap(choices, |book, what, mut flap, _| {
        for is_to_open in [true, false] {
            let mut course = Course::default();
            flap.turn(is_to_open);
            course.until_asleep(&mut flap, book);
            let angles = flap.fold_angles().map(f32::to_degrees);
            let what = format!("{what} {is_to_open}: {angles:.0?}");
            println!("{what} {course:?}");
            assert_sound(&course, &what);
            assert!(is_turned(&flap, is_to_open), "{what}");
            // Two stages and what the fall may take.
            assert!(course.ticks < 180 + LONGEST_FALL + 1, "{what}: {course:?}");
            if !is_to_open {
                println!("  sunk by {} m", sunk(&flap));
                assert!(sunk(&flap) < 1e-4, "{what}: {}", sunk(&flap));
            }
        }
    });
}

/// Carries what a hand holds at the edge over an arch, from one distance beyond the fold to another,
/// as fractions of the flap's width, within two seconds.
fn carry(flap: &mut FoldOut, book: &Book, width: f64, [from, to]: [f32; 2], course: &mut Course) {
    flap.grab(1.0, 0.5);
    let reach = (width * 0.148) as f32;
    for tick in 1..=260 {
        let part = (tick as f32 / 240.0).min(1.0);
        let out = from + part * (to - from);
        let arch = 0.62 * (1.0 - (out * out).min(1.0)).sqrt();
        let place = [flap.side.sign() * reach * out, 0.105, reach * arch];
        flap.pull(core::array::from_fn(|axis| flap.foot[axis] + place[axis]));
        course.step(flap, book);
    }
}

#[test]
fn a_hand_draws_it_open_by_its_edge_and_pushes_it_shut() {
    draw_open_and_push_shut(SOME);
}

#[test]
#[ignore = "long: make test-long"]
fn a_hand_draws_it_open_by_its_edge_and_pushes_it_shut_in_every_book() {
    draw_open_and_push_shut(all_choices());
}

fn draw_open_and_push_shut(choices: impl IntoIterator<Item = Choice>) {
    each_flap(choices, |book, what, mut flap, (width, panels)| {
        let shut = if panels == 2 { 0.0 } else { -0.33 };
        for ways in [[shut, 0.97], [0.95, shut]] {
            let mut course = Course::default();
            carry(&mut flap, book, width, ways, &mut course);
            flap.release();
            course.until_asleep(&mut flap, book);
            let is_open = ways[1] > 0.5;
            let what = format!("{what} {ways:?}: {:.2?}", flap.fold_angles());
            println!("{what} {course:?}");
            assert_sound(&course, &what);
            assert!(is_turned(&flap, is_open), "{what}");
        }
    });
}

#[test]
fn let_go_it_is_turned_to_the_side_on_which_its_first_panel_is() {
    let book = open_book(Stock::BOOK, 0.01);
    for side in SIDES {
        for (to, is_open) in [(0.3, false), (0.7, true)] {
            let mut flap = folded(&book, side, (1.94, 2));
            let mut course = Course::default();
            carry(&mut flap, &book, 1.94, [0.0, to], &mut course);
            flap.release();
            course.until_asleep(&mut flap, &book);
            assert!(is_turned(&flap, is_open), "{to}: {:?}", flap.fold_angles());
        }
    }
}

#[test]
fn its_edge_goes_as_far_as_the_hand_has_since_it_first_pulled() {
    let book = open_book(Stock::BOOK, 0.01);
    for side in SIDES {
        let reach = (1.94 * 0.148) as f32;
        let ends = [0.0, 0.4].map(|first: f32| {
            let mut flap = folded(&book, side, (1.94, 2));
            flap.grab(1.0, 0.5);
            let x = flap.foot[0];
            // Nothing is stepped between the two, as where the flap is made while a hand draws it.
            for out in [first, 0.7] {
                flap.pull([x + side.sign() * reach * out, 0.105, 0.0]);
            }
            for _ in 0..120 {
                flap.step(&book, 1);
            }
            flap.fold_angles()[0]
        });
        assert!(
            ends[0] < FRAC_PI_2 && ends[1] > FRAC_PI_2,
            "{side:?} {ends:?}"
        );
    }
}

#[test]
fn panels_that_are_too_many_or_too_wide_are_rejected() {
    let book = open_book(Stock::BOOK, 0.01);
    for (width, panels, is_one) in [
        (2.9, 3, true),
        (2.9, 2, false),
        (3.9, 4, false),
        (0.1, 3, false),
        (0.9, 0, false),
    ] {
        let place = FlapPlace {
            side: Side::Right,
            fold: FOLD,
            width,
            panels,
        };
        assert_eq!(
            FoldOut::new(&book, place, AROUND).is_some(),
            is_one,
            "{place:?}"
        );
    }
}
