//! The leaf in flight: what its tests have in common.

#[cfg(feature = "creases")]
mod folded;
mod held;
mod played;
mod released;
mod sizes;

use super::super::{Board, Book};
use super::*;
use crate::random::for_seeds;
use crate::stock::Stock;

const WIDTH: f32 = 0.14;

/// A book that lies open at leaf 40 of 100.
fn book() -> Book {
    let mut book = Book::new(0.14, 0.21, 100, 0.012).unwrap();
    *book.board_mut(0) = Board::new(Side::Left);
    book.lay(40);
    book
}

fn leaf(book: &Book) -> &Leaf {
    book.flights.order()[0].leaf()
}

/// Steps until nothing flies; `each` sees the book after every tick. Returns
/// the ticks it took.
fn rest(book: &mut Book, mut each: impl FnMut(&Book)) -> u32 {
    for tick in 0..2000 {
        if book.flights() == 0 {
            return tick;
        }
        book.step(1);
        each(book);
    }
    panic!("the leaves never came to rest");
}

/// The greatest strain and the greatest depth of the leaves in flight.
fn worst(book: &Book) -> (f32, f32) {
    let leaves = book.flights.order().iter().map(|flight| flight.leaf());
    leaves.fold((0.0, 0.0), |(strain, depth), leaf| {
        (
            f32::max(strain, leaf.sheet().max_edge_strain()),
            f32::max(depth, leaf.in_book_space().depth),
        )
    })
}
