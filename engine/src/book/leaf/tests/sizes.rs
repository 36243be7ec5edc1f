//! Leaves of other sizes, and of books drawn at another scale.

use super::*;

/// The parts of a thing move in time by the root of its size, and fingers are as strong as what they
/// turn is large: a leaf of 20 mm stayed where it was let go, one of 1.5 m was put down through the
/// air after 2.5 s and no hand could lift it.
#[test]
fn leaves_of_all_sizes_are_turned_and_fall() {
    for (width, stock, help, alone) in [
        (0.02, Stock::BOOK, 0.15..0.25, 0.1..0.6),
        (0.075, Stock::BOOK, 0.3..0.45, 0.3..0.9),
        (0.21, Stock::BOOK, 0.5..0.7, 0.5..1.6),
        (0.42, Stock::COATED, 0.7..1.0, 0.7..3.0),
        (1.5, Stock::BOARD, 1.3..1.8, 1.5..8.5),
    ] {
        let size = [width, 1.5 * width];
        let open = |assist: bool| {
            let mut book = Book::new(size[0], size[1], 20, 0.0018).unwrap();
            book.set_paper(&Paper {
                stock,
                assist,
                ..Paper::default()
            });
            *book.board_mut(0) = Board::new(Side::Left);
            book.lay(10);
            book
        };
        for (is_helped, expected) in [(true, help), (false, alone)] {
            let mut book = open(is_helped);
            let id = book.pick_up(Side::Right, 10, 11).unwrap();
            book.grab(id, 0, 1.0, 0.5);
            let radius = 0.96 * width as f32;
            for tick in 0..480 {
                let (sin, cos) = (1.95 * (tick as f32 / 360.0).min(1.0)).sin_cos();
                book.hold(id, 0, [radius * cos, 0.75 * width as f32, radius * sin]);
                book.step(1);
            }
            let turned = leaf(&book).turned;
            assert!((0.5..0.75).contains(&turned), "{width} m: {turned}");
            book.release(id, 0);
            let took = rest(&mut book, |_| {}) as f32 * TICK;
            assert!(expected.contains(&took), "{width} m, {is_helped}: {took} s");
            assert_eq!(book.landed(), [1, 0], "{width} m, {is_helped}");
            // Left alone, limp paper falls to the side that most of it is over.
            assert!(!is_helped || book.read() == 11, "{width} m");
        }
        let mut book = open(true);
        let id = book.pick_up(Side::Right, 10, 11).unwrap();
        book.play(id, Side::Left, 2.0);
        let took = rest(&mut book, |_| {}) as f32 * TICK;
        assert!((took / 2.0 - 1.0).abs() < 0.05, "{width} m: {took} s for 2");
    }
}

/// What book space is drawn at another scale moves as the book itself of that size.
#[test]
fn a_scaled_book_moves_as_the_large_one() {
    for (scale, stock) in [
        (0.25, Stock::BOOK),
        (0.6, Stock::CARD),
        (2.0, Stock::COATED),
    ] {
        let turn = |size: f64, scale: f64| {
            let mut book = Book::new(0.14 * size, 0.21 * size, 20, 0.0018 * size).unwrap();
            book.set_paper(&Paper {
                stock,
                scale,
                ..Paper::default()
            });
            *book.board_mut(0) = Board::new(Side::Left);
            book.lay(10);
            let id = book.pick_up(Side::Right, 10, 11).unwrap();
            book.grab(id, 0, 1.0, 0.5);
            let mut turned = vec![];
            for tick in 0..300 {
                let (sin, cos) = (1.8 * (tick as f32 / 180.0).min(1.0)).sin_cos();
                let radius = 0.135 * size as f32;
                book.hold(id, 0, [radius * cos, 0.105 * size as f32, radius * sin]);
                book.step(1);
                turned.push(leaf(&book).turned);
            }
            book.release(id, 0);
            let seconds = rest(&mut book, |book| {
                if book.flights() > 0 {
                    turned.push(leaf(book).turned);
                }
            }) as f32
                * TICK;
            (turned, seconds)
        };
        let ((small, in_small), (large, in_large)) = (turn(1.0, scale), turn(scale, 1.0));
        let ways = small.iter().zip(&large).map(|(a, b)| (a - b).abs());
        let most = ways.fold(0.0, f32::max);
        let what = format!("scale {scale}: {most}, {in_small} and {in_large} s");
        assert!(most < 0.06 && (in_small - in_large).abs() < 0.06, "{what}");
    }
}
