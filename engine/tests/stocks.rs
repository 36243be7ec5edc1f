//! A book of four stocks at once: each leaf is what it would be in a book of that stock alone.

use turnleaf_engine::book::{Board, Book, Paper};
use turnleaf_engine::{
    LooseLeaf, LooseSettings, ModelKind, Shape, Side, Stock, Surface, TurnModel,
};

const PAGE: [f64; 2] = [0.14, 0.21];
const TICK: f64 = 1.0 / 120.0;
const WIDTH: f32 = PAGE[0] as f32;

/// The first leaves of the book, front to back: bible paper is the book's own.
const STOCKS: [Stock; 4] = [Stock::CARD, Stock::BOARD, Stock::COATED, Stock::BIBLE];

/// Books without thickness: their leaves lie on a table, whatever they are made of.
fn book(stock: Stock, thickness: f64) -> Book {
    let mut book = Book::new(PAGE[0], PAGE[1], 12, thickness).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    let is_paper = book.set_paper(&Paper {
        stock,
        assist: false,
        ..Paper::default()
    });
    assert!(is_paper);
    book
}

fn mixed(thickness: f64) -> Book {
    let mut book = book(Stock::BIBLE, thickness);
    for (leaf, stock) in (0..).zip(&STOCKS) {
        assert!(book.set_leaf_stock(leaf..leaf + 1, stock));
    }
    book
}

/// What is seen of a leaf that a hand holds above the table, and then lets go.
#[derive(Debug, PartialEq)]
struct Seen {
    /// Its droop: how far it is bent from the line between spine and fore-edge, over the width.
    droop: f32,
    /// Ticks until its fore-edge is next to the table.
    fall: u32,
}

/// Where the hand is at a tick: it goes slowly up to 60 degrees, and holds.
fn hand(tick: u32) -> [f32; 3] {
    let angle = (tick as f32 / 240.0).min(1.0) * 60.0f32.to_radians();
    let reach = 0.97 * WIDTH;
    [
        reach * angle.cos(),
        0.5 * PAGE[1] as f32,
        reach * angle.sin(),
    ]
}

const HELD: u32 = 480;

/// What is seen of a leaf of a book.
fn look(book: &mut Book, leaf: u32) -> Seen {
    book.lay(leaf);
    let id = book.pick_up(Side::Right, leaf, leaf + 1).unwrap();
    book.grab(id, 0, 1.0, 0.5);
    for tick in 0..HELD {
        book.hold(id, 0, hand(tick));
        book.step(1);
    }
    book.update();
    let droop = bend(book.surface(0).unwrap());
    book.release(id, 0);
    let mut fall = 0;
    while book.surface(0).is_some_and(is_up) {
        book.step(1);
        book.update();
        fall += 1;
        assert!(fall < 600, "leaf {leaf} never falls");
    }
    for _ in 0..600 {
        book.step(1);
    }
    assert_eq!(book.flights(), 0, "leaf {leaf} never rests");
    Seen { droop, fall }
}

/// What `lab` sees of such a leaf, over a table and by any model.
fn look_loose(kind: ModelKind, stock: Stock) -> Seen {
    let settings = LooseSettings::leaf(kind, PAGE, stock);
    let mut leaf = LooseLeaf::new(settings).unwrap();
    leaf.grab(1.0, 0.5);
    for tick in 0..HELD {
        leaf.pull(hand(tick));
        leaf.advance(TICK);
    }
    let mut surface = Surface::new(2, 2);
    leaf.write_surface(&mut surface);
    let droop = bend(&surface);
    leaf.release();
    let mut fall = 0;
    while is_up(&surface) {
        leaf.advance(TICK);
        leaf.write_surface(&mut surface);
        fall += 1;
    }
    Seen { droop, fall }
}

fn is_up(surface: &Surface) -> bool {
    surface.position(surface.columns - 1, surface.rows / 2)[2] > 0.01 * WIDTH
}

/// The greatest distance of a drawn point from the line between spine and fore-edge, over the
/// width.
fn bend(surface: &Surface) -> f32 {
    let mut most = 0.0f32;
    for row in 0..surface.rows {
        let at = |column| surface.position(column, row);
        let [a, b] = [at(0), at(surface.columns - 1)];
        let [dx, dz] = [b[0] - a[0], b[2] - a[2]];
        for column in 0..surface.columns {
            let p = at(column);
            let off = (p[0] - a[0]) * dz - (p[2] - a[2]) * dx;
            most = most.max(off.abs() / (dx * dx + dz * dz).sqrt());
        }
    }
    most / WIDTH
}

/// Droop by 0.3 % of the width and fall by a tenth and a tick: a book's leaf has fewer nodes
/// than one over a table, and is bound.
#[test]
fn a_leaf_droops_and_falls_as_its_stock_does_alone_in_a_book_and_in_the_lab() {
    let mut book_of_four = mixed(0.0);
    let mut droops = Vec::new();
    for (leaf, stock) in (0..).zip(STOCKS) {
        let found = look(&mut book_of_four, leaf);
        let alone = look(&mut book(stock, 0.0), leaf);
        assert!(
            (found.droop - alone.droop).abs() < 1e-5,
            "{found:?} {alone:?}"
        );
        assert_eq!(found.fall, alone.fall);
        let loose = look_loose(ModelKind::Sheet, stock);
        assert!(
            (found.droop - loose.droop).abs() < 3e-3,
            "{found:?} {loose:?}"
        );
        assert!(
            found.fall.abs_diff(loose.fall) <= 1 + loose.fall / 10,
            "{found:?} {loose:?}"
        );
        droops.push(found.droop);
        if stock == Stock::BOARD {
            let rigid = look_loose(ModelKind::Kinematic(Shape::Rigid), stock);
            assert!(found.fall.abs_diff(rigid.fall) <= 1, "{found:?} {rigid:?}");
        }
    }
    // The others are of the book's own.
    assert_eq!(
        look(&mut book_of_four, 7),
        look(&mut book(Stock::BIBLE, 0.0), 7)
    );
    // Card, board, coated, bible.
    assert!(droops[1] < 0.01 && droops[1] < droops[0]);
    assert!(droops[0] < droops[2] && droops[2] < droops[3]);
}

#[test]
fn four_stocks_fly_at_once_and_a_board_stays_flat() {
    let mut book = mixed(0.012);
    for side in [Side::Right, Side::Left] {
        for leaf in 0..4 {
            let leaf = if side == Side::Right { leaf } else { 3 - leaf };
            let id = book.pick_up(side, leaf, leaf + 1).unwrap();
            book.play(id, side.opposite(), 0.8);
            book.step(18);
        }
        assert_eq!(book.flights(), 4);
        let mut ticks = 0;
        while book.flights() > 0 {
            book.step(1);
            book.update();
            for index in 0..book.flights() {
                assert!(book.strain(index).unwrap() < 0.01);
                // Between the piles as it is drawn.
                if book.caliper(index) == Some(Stock::BOARD.caliper as f32) {
                    let bend = bend(book.surface(index).unwrap());
                    assert!(bend < 0.01, "{bend}");
                }
            }
            ticks += 1;
            assert!(ticks < 1200, "they never rest");
        }
        assert_eq!(book.read(), if side == Side::Right { 4 } else { 0 });
    }
}

#[test]
fn a_leaf_counts_by_its_caliper_in_the_piles() {
    let height = |book: &mut Book, read| {
        book.lay(read);
        let pile = book.pile(Side::Left);
        pile.curves()[2 * pile.columns() - 1]
    };
    let mut book = mixed(0.004);
    let total = height(&mut book, 12);
    assert!((total - 4e-3).abs() < 1e-4, "{total} m");
    // 0.3 + 1.6 + 0.14 mm of coated, and nine leaves of 40 um.
    let sum = 0.3 + 1.6 + 0.14 + 9.0 * 0.04;
    for (read, part) in [(1, 0.3), (2, 1.9), (3, 2.04), (4, 2.08)] {
        let [found, wanted] = [height(&mut book, read), 4e-3 * part / sum];
        assert!((found - wanted).abs() < 1e-4, "{found} m for {wanted}");
    }
    // Of its own stock again, all count alike.
    book.clear_leaf_stocks();
    let [third, all] = [height(&mut book, 4), height(&mut book, 12)];
    assert!((3.0 * third - all).abs() < 2e-4, "{third} m");
}

#[test]
fn missing_leaves_and_invalid_stocks_are_rejected() {
    let mut book = mixed(0.004);
    let none = Stock {
        grammage: f64::NAN,
        ..Stock::CARD
    };
    for (leaves, stock) in [(3..3, Stock::CARD), (11..13, Stock::CARD), (0..1, none)] {
        assert!(!book.set_leaf_stock(leaves, &stock));
    }
}
