//! A riffle of leaves that no hand holds is drawn where its paper is.

use turnleaf_engine::book::{Board, Book};
use turnleaf_engine::trials::Riffle;
use turnleaf_engine::{Side, Stock};

#[test]
fn leaves_of_a_riffle_are_not_drawn_behind_their_paper() {
    for leaves in [2, 3, 4, 5, 6, 8, 10, 12] {
        let mut riffle = Riffle::new(Stock::BOOK, leaves);
        for frame in 0..120 {
            riffle.frame();
            let book = riffle.book();
            let lags = (0..book.flights()).filter_map(|index| book.lag(index));
            let lag = lags.fold(0.0, f32::max);
            assert!(lag < 1e-3, "{leaves} leaves, frame {frame}: {lag} m");
        }
    }
}

/// The steep page of a thick book at its first quarter: what is kept over it also at the spine was
/// drawn through the leaf over it there, and then all stood still, up to 277 mm behind.
#[test]
fn leaves_that_a_held_key_turns_in_a_thick_book_are_not_drawn_behind_their_paper() {
    let mut book = Book::new(0.14, 0.21, 120, 0.0108).expect("these are a book's sizes");
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(30);
    for tick in 0..240 {
        let turned = tick / 9;
        if tick % 9 == 0 && turned < 12 {
            let flight = book.pick_up(Side::Right, 30 + turned, 31 + turned);
            book.play(flight.expect("it lies uppermost"), Side::Left, 0.8);
        }
        book.step(1);
        if tick % 2 == 1 {
            book.update();
            let lags = (0..book.flights()).filter_map(|index| book.lag(index));
            let lag = lags.fold(0.0, f32::max);
            assert!(lag < 1e-3, "tick {tick}: {lag} m");
        }
    }
}
