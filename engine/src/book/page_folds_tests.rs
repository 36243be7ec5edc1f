//! Leaves folded along whole pages in a book: across, and in three as a letter.

use super::limits::MOST_STEPPING;
use super::*;
use crate::book::parts_depth::depth_of_parts;

/// How deep in each other parts of a leaf that lies are drawn at most, metres.
const DEEP: f32 = 1e-4;

fn fold(from: [f64; 2], to: [f64; 2], degrees: f64) -> SheetCrease {
    SheetCrease::pressed([from, to], degrees.to_radians(), &Stock::BOOK, 0.14)
}

/// Parallel to the spine.
fn along(u: f64, degrees: f64) -> SheetCrease {
    fold([u, 0.0], [u, 1.0], degrees)
}

/// Folded in two, parallel to the spine.
fn in_two() -> Vec<SheetCrease> {
    vec![along(0.6, 160.0)]
}

/// Folded along a line from the foot to the head, farther out there.
fn across() -> Vec<SheetCrease> {
    vec![fold([0.5, 0.0], [0.75, 1.0], 160.0)]
}

/// Folded in three, the outer part between the others.
fn as_letter() -> Vec<SheetCrease> {
    vec![along(0.4, 160.0), along(0.7, 175.0)]
}

/// Folded in three, each fold against the other.
fn as_zigzag() -> Vec<SheetCrease> {
    vec![along(0.35, 165.0), along(0.68, -165.0)]
}

fn toward_verso(creases: &[SheetCrease]) -> Vec<SheetCrease> {
    let turn = |crease: &SheetCrease| SheetCrease {
        rest: -crease.rest,
        ..*crease
    };
    creases.iter().map(turn).collect()
}

/// A book open at leaf 5, which is folded.
fn book(creases: &[SheetCrease]) -> Book {
    let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(5);
    assert!(book.crease(5, creases));
    book
}

/// The deepest that a part of the only leaf is drawn in another, metres.
fn depth(book: &Book, creases: &[SheetCrease]) -> f32 {
    depth_of(book, 0, creases)
}

/// The same of the leaf at an index, counted from the left.
fn depth_of(book: &Book, index: usize, creases: &[SheetCrease]) -> f32 {
    let surface = book.surface(index).unwrap();
    depth_of_parts(surface, book.paper_mesh(index).unwrap(), creases)
}

/// Turns the uppermost leaf of a side over. Returns the greatest strain of its edges in a frame.
fn turn(book: &mut Book, from: Side) -> f32 {
    let low = match from {
        Side::Right => book.read(),
        Side::Left => book.read() - 1,
    };
    let id = book.pick_up(from, low, low + 1).unwrap();
    book.play(id, from.opposite(), 0.8);
    let mut strain: f32 = 0.0;
    for _ in 0..500 {
        if book.flights() == 0 && book.is_asleep() {
            return strain;
        }
        book.step(2);
        book.update();
        strain = strain.max(book.strain(0).unwrap());
    }
    panic!("leaf {low} never came to rest");
}

/// Turns a leaf that is folded so over and back, folded to the recto's side and to the
/// verso's, and checks how it lies each time.
fn turns_over_and_back(creases: &[SheetCrease]) {
    for creases in [creases.to_vec(), toward_verso(creases)] {
        let mut book = book(&creases);
        for k in 0..=4 {
            let deep = depth(&book, &creases);
            println!("turn {k}: {:.3} mm", 1e3 * deep);
            assert!(deep < DEEP, "{deep} m after {k} turns");
            for (number, (rests, made)) in book.creases(5).iter().zip(&creases).enumerate() {
                let off = (rests.rest - made.rest).to_degrees().abs();
                assert!(off < 1.0, "{off} degrees after {k} turns");
                let leaf = book.flights.order()[0].leaf();
                let [angle, _] = leaf.sheet().crease_angle(number).unwrap();
                println!("  crease {number} at {:.0} degrees", angle.to_degrees());
                assert!(
                    angle * made.rest.signum() as f32 > 1.57,
                    "{angle} after {k} turns"
                );
            }
            let from = [Side::Right, Side::Left][k % 2];
            let strain = turn(&mut book, from);
            assert!(strain < 0.01, "{strain} in turn {k}");
            assert!(book.lies_creased(from.opposite()));
        }
    }
}

#[test]
fn a_page_folded_in_two_turns_over_and_back_and_stays_folded() {
    turns_over_and_back(&in_two());
}

#[test]
fn a_page_folded_across_turns_over_and_back_and_stays_folded() {
    turns_over_and_back(&across());
}

#[test]
fn a_page_folded_as_a_letter_turns_over_and_back_and_stays_folded() {
    turns_over_and_back(&as_letter());
}

#[test]
fn a_page_folded_as_a_zigzag_turns_over_and_back_and_stays_folded() {
    turns_over_and_back(&as_zigzag());
}

/// The hand that turns a folded page holds its folds shut: they neither open nor go through each
/// other, and open only once the page lies. Not those of [`across`], which reach beyond the page.
#[test]
fn folds_are_held_shut_while_a_page_is_turned() {
    for made in [in_two(), as_letter(), as_zigzag(), dog_ear()] {
        for creases in [made.clone(), toward_verso(&made)] {
            let mut book = book(&creases);
            let id = book.pick_up(Side::Right, 5, 6).unwrap();
            book.play(id, Side::Left, 0.8);
            let (mut frames, mut shut) = (0, 0);
            while book.flights() > 0 {
                book.step(2);
                book.update();
                frames += 1;
                let deep = depth(&book, &creases);
                assert!(deep < 5.0 * DEEP, "{deep} m in frame {frames}");
                let leaf = book.flights.order()[0].leaf();
                if frames < 15 || !leaf.is_held_shut() {
                    continue;
                }
                for number in 0..creases.len() {
                    let [angle, _] = leaf.sheet().crease_angle(number).unwrap();
                    assert!(angle.abs() > 2.8, "{angle} in frame {frames}");
                }
                shut += 1;
            }
            assert!(shut > 10, "{shut} frames");
        }
    }
}

/// Of two pages that face each other and are folded so that what is folded over ends at the spine,
/// one is turned onto the other: the folds of both are shut before they meet, where there is room
/// for all layers, and nothing is drawn behind its paper.
#[test]
fn a_folded_page_is_turned_onto_a_folded_one() {
    for stock in ["bible", "book", "board"] {
        let mut book = Book::new(0.14, 0.21, 40, 0.004).unwrap();
        let paper = Paper {
            stock: Stock::named(stock).unwrap(),
            ..Paper::default()
        };
        assert!(book.set_paper(&paper));
        *book.board_mut(0) = Board::new(Side::Left);
        assert!(book.crease(4, &[along(0.5, -160.0)]));
        assert!(book.crease(5, &[along(0.5, 160.0)]));
        book.lay(5);
        book.step(300);
        book.update();
        let id = book.pick_up(Side::Right, 5, 6).unwrap();
        book.play(id, Side::Left, 0.8);
        let mut frames = 0;
        while book.phase(id).is_some() {
            book.step(2);
            book.update();
            frames += 1;
            assert!(frames < 300, "{stock} never came to rest");
            for index in 0..book.drawn_leaves() {
                let behind = book.lag(index).unwrap_or(0.0);
                assert!(
                    behind < 1e-3,
                    "{stock}, leaf {index}, frame {frames}: {behind} m"
                );
            }
        }
    }
}

#[test]
fn a_fold_that_is_pressed_goes_to_the_side_to_which_it_is_pressed() {
    let flat = vec![SheetCrease {
        rest: 0.0,
        ..along(0.6, 0.0)
    }];
    let mut book = book(&flat);
    book.pick_up(Side::Right, 5, 6).unwrap();
    for step in 1..=60 {
        book.press(5, 0, 160f32.to_radians() * step as f32 / 60.0);
        book.step(1);
    }
    for _ in 0..300 {
        book.step(1);
    }
    book.update();
    assert!(book.lies_creased(Side::Right));
    let deep = depth(&book, &in_two());
    assert!(deep < DEEP, "{deep} m");
}

#[test]
fn a_leaf_that_lies_is_creased_anew_as_it_comes_to_lie() {
    let mut book = book(&in_two());
    assert!(book.crease(5, &across()));
    assert!(book.lies_creased(Side::Right));
    assert!(depth(&book, &across()) < DEEP);
    assert!(book.crease(5, &[]));
    assert_eq!([book.drawn_leaves(), book.creases(5).len()], [0, 0]);
}

/// Across the corner of foot and fore-edge, 30 mm from it.
fn dog_ear() -> Vec<SheetCrease> {
    vec![fold([1.0 - 0.03 / 0.14, 0.0], [1.0, 0.03 / 0.21], 160.0)]
}

/// Steps and draws a book until nothing moves, leaf 5 uncovered on the right, and checks in every
/// frame that this leaf is not drawn in itself, and that no frame is more work than one may be.
fn open_folds(book: &mut Book, creases: &[SheetCrease], when: &str) {
    for frame in 0..500 {
        let index = book.drawn_leaves() - 1;
        let deep = depth_of(book, index, creases);
        assert!(deep < DEEP, "{when}: {deep} m in frame {frame}");
        if book.is_asleep() {
            return;
        }
        let mut work = 0;
        for _ in 0..2 {
            book.step(1);
            work += book.tick_work();
        }
        // Of two ticks no more than what a frame may have, and so of what uncovers it.
        assert!(work < MOST_STEPPING, "{work} ns in frame {frame}");
        book.update();
        assert!(book.strain(index.min(book.drawn_leaves() - 1)).unwrap() < 0.01);
    }
    panic!("it never came to rest");
}

fn check_rests(book: &Book, creases: &[SheetCrease]) {
    let leaf = book.flights.order().last().unwrap().leaf();
    for (number, (rests, made)) in book.creases(5).iter().zip(creases).enumerate() {
        let off = (rests.rest - made.rest).to_degrees().abs();
        assert!(off < 1.0, "crease {number} rests {off} degrees off");
        let [angle, _] = leaf.sheet().crease_angle(number).unwrap();
        let angle = angle.to_degrees() * made.rest.signum() as f32;
        // Folded, and no longer pressed flat.
        assert!((91.0..179.0).contains(&angle), "crease {number} at {angle}");
    }
}

/// A folded leaf comes out from under another pressed flat, and opens to its creases' rests while
/// that one turns and after; laid open, it does so by itself.
fn opens_where_it_is_uncovered(creases: &[SheetCrease]) {
    for creases in [creases.to_vec(), toward_verso(creases)] {
        let mut book = book(&creases);
        open_folds(&mut book, &creases, "made");
        check_rests(&book, &creases);
        let id = book.pick_up(Side::Left, 4, 5).unwrap();
        book.play(id, Side::Right, 0.8);
        while book.flights() > 0 {
            book.step(1);
        }
        assert_eq!([book.read(), book.drawn_leaves() as u32], [4, 0]);
        let id = book.pick_up(Side::Right, 4, 5).unwrap();
        let leaf = book.flights.order().last().unwrap().leaf();
        let heights = leaf.sheet().positions().as_chunks::<3>().0.iter();
        let highest = heights.fold(0.0, |most: f32, [_, _, z]| most.max(*z));
        assert!(highest < 1e-3, "{highest} m high while it is pressed");
        book.play(id, Side::Left, 0.8);
        open_folds(&mut book, &creases, "uncovered");
        check_rests(&book, &creases);
        assert!(book.lies_creased(Side::Right));
        // At rest nothing more is done.
        let at = book.surface(0).unwrap().positions.clone();
        book.step(20);
        book.update();
        assert_eq!(book.surface(0).unwrap().positions, at);
        book.lay(0);
        book.lay(5);
        assert!(!book.is_asleep());
        open_folds(&mut book, &creases, "laid open");
        check_rests(&book, &creases);
    }
}

#[test]
fn an_uncovered_letter_opens_over_the_next_frames() {
    // Its end is a little shorter than what it lies in, as a letter's is.
    opens_where_it_is_uncovered(&[along(0.4, 160.0), along(0.72, 175.0)]);
}

#[test]
fn an_uncovered_zigzag_opens_over_the_next_frames() {
    opens_where_it_is_uncovered(&as_zigzag());
}

#[test]
fn an_uncovered_dog_ear_opens_over_the_next_frames() {
    opens_where_it_is_uncovered(&dog_ear());
}

/// Two folds that cross at a slant cannot both be shut: the first is, and no edge is stretched.
#[test]
fn folds_that_cross_are_pressed_as_far_as_paper_can_be() {
    let creases = [along(0.55, 160.0), fold([0.2, 0.0], [1.0, 0.8], 160.0)];
    let mut book = book(&creases);
    let strain = |book: &Book| book.strain(0).unwrap();
    assert!(strain(&book) < 0.01, "{} as it is laid", strain(&book));
    for tick in 0..400 {
        book.step(1);
        assert!(strain(&book) < 0.01, "{} in tick {tick}", strain(&book));
    }
}

/// A page of 73 x 20 mm: the rows of its nodes are 1.5 mm apart, and the parts of a folded leaf lie nearly half a
/// millimetre above each other. Pressed flat on either side none of its edges is stretched.
#[test]
fn a_small_leaf_that_is_pressed_flat_keeps_its_lengths() {
    for rest in [160.0, -160.0] {
        let creases = [
            fold([0.89, 0.0], [1.0, 0.38], rest),
            fold([0.89, 1.0], [1.0, 0.62], rest),
        ];
        let mut book = Book::new(0.073, 0.02, 40, 0.004).unwrap();
        book.lay(5);
        assert!(book.crease(5, &creases));
        for read in [5, 6] {
            book.lay(read);
            let strain = book.strain(0).unwrap();
            assert!(strain < 1e-3, "{strain}, {read} read, {rest} degrees");
        }
    }
}

/// A letter folded over a dog-ear, on the recto of a page of 148 x 198 mm: as it opens from pressed flat
/// it springs up, is turned over to its side by a grab of its own, and does not come to lie clear of
/// itself there. It was opened anew each time, and never came to rest.
#[test]
fn a_leaf_that_springs_up_as_it_opens_comes_to_rest() {
    let creases = [
        fold([0.536, 0.0], [1.0, 0.348], 160.0),
        along(0.7, -175.0),
        along(0.4, -160.0),
    ];
    let mut book = Book::new(0.1485, 0.198, 14, 0.005).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    assert!(book.crease(8, &creases));
    book.lay(8);
    let mut ticks = 0;
    while !book.is_asleep() {
        book.step(1);
        ticks += 1;
        assert!(ticks < 2400, "not at rest after 20 s");
    }
}

/// Over its page it is pressed flat and lies folded; below its page it has no room at the spine, lies
/// open while it is pressed, and then holds the page up.
#[test]
fn a_flap_that_reaches_beyond_the_spine_is_pressed_flat_on_either_side() {
    for read in [5, 6] {
        for degrees in [160.0, -160.0] {
            let creases = [along(0.35, degrees)];
            let mut book = book(&creases);
            book.lay(read);
            let is_over = (read == 5) == (degrees > 0.0);
            let angle = |book: &Book| {
                let leaf = book.flights.order()[0].leaf();
                leaf.sheet().crease_angle(0).unwrap()[0].to_degrees() * degrees.signum() as f32
            };
            let pressed = angle(&book);
            assert_eq!(pressed > 170.0, is_over, "{pressed} degrees, {read} read");
            for tick in 0..200 {
                let strain = book.strain(0).unwrap();
                assert!(strain < 0.01, "{strain} in tick {tick}, {read} read");
                if tick % 10 == 0 {
                    book.update();
                    let deep = depth(&book, &creases);
                    assert!(deep < DEEP, "{deep} m in tick {tick}, {read} read");
                }
                book.step(1);
            }
            for _ in 0..400 {
                book.step(1);
            }
            assert!(book.is_asleep(), "{degrees}, {read} read");
            let open = angle(&book);
            assert!(open > if is_over { 150.0 } else { 45.0 }, "{open} degrees");
            let off = book.creases(5)[0].rest - creases[0].rest;
            assert!(off.abs() < 1e-6, "its rest is {off} rad off");
        }
    }
}
