use super::bound_rows::{STAPLE, TIES};
use super::fracture::work_of;
use super::*;
use crate::book::stillness::LONGEST_FALL;
use crate::book::{Board, Book};
use crate::grid::Side;
use crate::models::sheet::SheetCrease;
use crate::stock::Stock;

pub(super) const AROUND: TableAround = TableAround {
    table: -0.004,
    rim: 0.003,
};

const LINES: [TearLine; 3] = [TearLine::Perforated, TearLine::Stapled, TearLine::Sewn];

/// A book of A5 pages open in the middle, with the uppermost leaf of a side in flight and held
/// at a place, a little off its page.
pub(super) fn held(side: Side, stock: Stock, at: [f32; 2]) -> (Book, u32) {
    held_folded(side, stock, at, &[])
}

/// The same, of a leaf that is folded along lines before.
pub(super) fn held_folded(
    side: Side,
    stock: Stock,
    [u, v]: [f32; 2],
    lines: &[SheetCrease],
) -> (Book, u32) {
    let mut book = Book::new(0.148, 0.21, 100, 0.01).unwrap();
    let mut paper = *book.paper();
    paper.stock = stock;
    assert!(book.set_paper(&paper));
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(50);
    let low = if side == Side::Right { 50 } else { 49 };
    if !lines.is_empty() {
        assert!(book.crease(low, lines));
        book.step(120);
    }
    let id = book.pick_up(side, low, low + 1).unwrap();
    book.grab(id, 0, u, v);
    for tick in 0..60 {
        let up = 0.02 * tick as f32 / 60.0;
        book.hold(id, 0, [side.sign() * u * 0.147, v * 0.21, 0.006 + up]);
        book.step(1);
    }
    book.update();
    (book, id)
}

/// The hand's place at first, and the way in which it pulls: outward and up.
pub(super) fn pulled(side: Side, [u, v]: [f32; 2], away: f32) -> [f32; 3] {
    let x = side.sign() * (u * 0.147 + 0.8 * away);
    [x, v * 0.21, 0.026 + 0.6 * away]
}

/// Pulls a leaf at a place, `speed` metres a tick, until it is off. Returns it, how far it was
/// pulled, and the rows that were bound after each tick.
pub(super) fn tear_off(
    book: &Book,
    id: u32,
    line: TearLine,
    (side, at): (Side, [f32; 2]),
) -> (TornLeaf, f32, Vec<core::ops::Range<usize>>) {
    let mut leaf = TornLeaf::tear(book, id, line, 0..NODES[1], AROUND).unwrap();
    leaf.grab(0, at[0], at[1]);
    let mut bound = vec![leaf.bound()];
    for tick in 1..400 {
        let away = 0.0005 * tick as f32;
        leaf.pull(0, pulled(side, at, away));
        leaf.step(book, 1);
        leaf.update(book);
        bound.push(leaf.bound());
        if leaf.bound().is_empty() {
            return (leaf, away, bound);
        }
    }
    panic!("{line:?} holds at {:?}", leaf.bound());
}

/// A sheet of a stock that was torn out and lies on the table beside the book, where it was let
/// go `x` metres from the spine.
pub(super) fn lying(stock: Stock, x: f32) -> (Book, TornLeaf) {
    let at = [0.95, 0.9];
    let (book, id) = held(Side::Right, stock, at);
    let (mut leaf, away, _) = tear_off(&book, id, TearLine::Perforated, (Side::Right, at));
    let [from, to] = [pulled(Side::Right, at, away), [x, 0.2, 0.02]];
    for tick in 0..240 {
        let part = (tick as f32 / 200.0).min(1.0);
        let to = core::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]));
        leaf.pull(0, to);
        leaf.step(&book, 1);
    }
    leaf.release();
    settle(&mut leaf, &book);
    leaf.take_work();
    (book, leaf)
}

/// Steps until it lies still. Returns the greatest edge strain on the way.
pub(super) fn settle(leaf: &mut TornLeaf, book: &Book) -> f32 {
    let mut worst = 0.0f32;
    while !leaf.is_asleep() {
        leaf.step(book, 1);
        worst = worst.max(leaf.sheet().max_edge_strain());
    }
    leaf.update(book);
    worst
}

/// How far the lowest place of a sheet's edges and nodes is inside what it lies on, metres.
pub(super) fn deepest(leaf: &TornLeaf, book: &Book) -> f32 {
    let x = leaf.surface().positions.as_chunks::<3>().0;
    let inside = x.iter().map(|[x, y, z]| {
        let [width, height] = book.size().map(|side| side as f32);
        let over_pages = x.abs() < width && (0.0..height).contains(y);
        let over_board =
            x.abs() < width + AROUND.rim && (-AROUND.rim..height + AROUND.rim).contains(y);
        let floor = if over_pages {
            let side = if *x < 0.0 { Side::Left } else { Side::Right };
            book.pile(side).height(x.abs())
        } else if over_board {
            0.0
        } else {
            AROUND.table
        };
        floor - z
    });
    inside.fold(0.0, f32::max)
}

#[test]
fn a_leaf_comes_off_from_the_end_at_which_it_is_pulled() {
    for line in LINES {
        for (side, v) in [(Side::Right, 0.95), (Side::Left, 0.05)] {
            let at = [0.95, v];
            let (book, id) = held(side, Stock::BOOK, at);
            let (_, _, bound) = tear_off(&book, id, line, (side, at));
            for pair in bound.windows(2) {
                let [before, after] = [&pair[0], &pair[1]];
                let is_smaller = before.start <= after.start && after.end <= before.end;
                assert!(is_smaller || after.is_empty(), "{before:?}, {after:?}");
            }
            let middle = bound.iter().rfind(|rows| !rows.is_empty()).unwrap();
            let from_foot = middle.start > NODES[1] - middle.end;
            assert_eq!(from_foot, v < 0.5, "{line:?}: {middle:?}");
        }
    }
}

#[test]
fn the_work_of_tearing_is_that_of_the_paper_which_binds_it() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::COATED] {
        let along = work_of(stock.caliper, 0.21);
        let wanted = [along * TIES, work_of(stock.caliper, 2.0 * STAPLE), along];
        let mut pulls = [0.0; 3];
        for (k, line) in LINES.into_iter().enumerate() {
            let at = [0.95, 0.95];
            let (book, id) = held(Side::Right, stock, at);
            let (mut leaf, away, _) = tear_off(&book, id, line, (Side::Right, at));
            pulls[k] = away;
            let work = f64::from(leaf.take_work());
            assert!((work / wanted[k] - 1.0).abs() < 1e-4, "{line:?}: {work} J");
            assert_eq!(leaf.take_work(), 0.0);
        }
        assert!(pulls[0] < pulls[2], "{pulls:?}");
    }
}

#[test]
fn a_gentle_pull_tears_nothing() {
    let at = [0.95, 0.5];
    let (book, id) = held(Side::Right, Stock::BOOK, at);
    let mut leaf = TornLeaf::tear(&book, id, TearLine::Sewn, 0..NODES[1], AROUND).unwrap();
    leaf.grab(0, at[0], at[1]);
    for _ in 0..240 {
        leaf.pull(0, pulled(Side::Right, at, 0.004));
        leaf.step(&book, 1);
    }
    assert_eq!(leaf.bound(), 0..NODES[1]);
    // Let go, it falls, and hangs on the spine.
    leaf.release();
    for _ in 0..600 {
        leaf.step(&book, 1);
    }
    leaf.update(&book);
    assert_eq!(leaf.bound(), 0..NODES[1]);
    assert!(leaf.is_asleep());
    assert!(leaf.take_work() == 0.0);
}

#[test]
fn a_sheet_that_is_off_keeps_its_lengths_and_comes_to_rest_on_what_lies_there() {
    for stock in [Stock::BIBLE, Stock::BOOK, Stock::CARD] {
        let at = [0.95, 0.9];
        let (book, id) = held(Side::Right, stock, at);
        let (leaf, away, _) = tear_off(&book, id, TearLine::Perforated, (Side::Right, at));
        // On the table beside the book; across its fore-edge; on its pages; over the gutter.
        for x in [0.36f32, 0.22, 0.14, 0.06] {
            let [from, to] = [pulled(Side::Right, at, away), [x, 0.2, 0.08]];
            let mut leaf = leaf.clone();
            let mut worst = 0.0f32;
            for tick in 0..240 {
                let part = (tick as f32 / 120.0).min(1.0);
                leaf.pull(
                    0,
                    core::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis])),
                );
                leaf.step(&book, 1);
                worst = worst.max(leaf.sheet().max_edge_strain());
            }
            leaf.release();
            let mut ticks = 0;
            while !leaf.is_asleep() {
                leaf.step(&book, 1);
                worst = worst.max(leaf.sheet().max_edge_strain());
                ticks += 1;
            }
            leaf.update(&book);
            let x = &leaf.surface().positions;
            assert!(x.iter().all(|x| x.is_finite()));
            assert!(worst < 0.01, "{worst}");
            assert_eq!(deepest(&leaf, &book), 0.0, "{to:?}");
            assert!(ticks < LONGEST_FALL, "{to:?}: {ticks}");
        }
    }
}

#[test]
fn what_is_no_leaf_or_no_table_is_rejected() {
    let (book, id) = held(Side::Right, Stock::BOOK, [0.95, 0.95]);
    let whole = 0..NODES[1];
    let tear = |id, rows, around| TornLeaf::tear(&book, id, TearLine::Sewn, rows, around).is_some();
    assert!(tear(id, whole.clone(), AROUND));
    assert!(!tear(id + 1, whole.clone(), AROUND));
    assert!(!tear(id, 0..NODES[1] + 1, AROUND));
    for table in [f32::NAN, 1.0, -2.0] {
        assert!(!tear(id, whole.clone(), TableAround { table, ..AROUND }));
    }
    for rim in [f32::NAN, -1.0, 2.0] {
        assert!(!tear(id, whole.clone(), TableAround { rim, ..AROUND }));
    }
}
