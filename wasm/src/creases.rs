//! Books whose leaves can be creased: what the viewer calls beside the functions of all books.

use turnleaf_engine::SheetCrease;
use turnleaf_engine::book::Book;

use crate::books::{BOOKS, book_functions};
use crate::live::Nothing;
use crate::side;

/// Numbers of a crease: two places on it (u and v, 0 to 1) and its rest angle, radians.
const NUMBERS: usize = 5;

/// Creases that one call gives, at most.
const MOST: usize = 16;

/// Where the creases that `tl_book_crease` is to make are written, f64.
static mut CREASES: [f64; NUMBERS * MOST] = [0.0; NUMBERS * MOST];

/// Where creases are written before `tl_book_crease` is called: for each u, v, u, v and rest
/// angle, f64; 16 at most.
#[unsafe(no_mangle)]
pub extern "C" fn tl_creases() -> *mut f64 {
    (&raw mut CREASES).cast()
}

book_functions! {
    /// Creases a leaf (from 0) along so many lines as are written, pressed by hand, in place of
    /// those it has; 0 where it cannot be.
    fn tl_book_crease(book, leaf: u32, count: usize) -> u32 {
        // SAFETY: from one thread by the crate's contract, so that nothing else uses it.
        let written = unsafe { CREASES };
        let stock = book.stock_of(leaf);
        let width = book.size()[0];
        let creases: Vec<SheetCrease> = written
            .chunks_exact(NUMBERS)
            .take(count)
            .map(|line| {
                let through = [[line[0], line[1]], [line[2], line[3]]];
                SheetCrease::pressed(through, line[4], &stock, width)
            })
            .collect();
        (count <= MOST && book.crease(leaf, &creases)).into()
    }
    /// Turns the rest of a crease of a leaf to an angle, radians, -pi to pi. Nothing happens
    /// where it is beyond, or there is no such crease or the leaf is not drawn by itself.
    fn tl_book_press(book, leaf: u32, crease: usize, rest: f32) { book.press(leaf, crease, rest) }
    /// Lets seconds pass in which nothing moves: creases of covered leaves creep. None pass where they
    /// are not finite or below 0.
    fn tl_book_wait(book, seconds: f64) { book.wait(seconds) }
    /// Whether a creased leaf lies upon the pile of a side: the first of those drawn on the
    /// left, the last on the right.
    fn tl_book_lies_creased(book, on: u32) -> u32 { book.lies_creased(side(on)).into() }
}
