//! The engine's face for the browser: `extern "C"` functions over numbers and
//! flat arrays in linear memory, no bindings generator.
//!
//! A book is a handle: the address of a boxed [`Book`], 0 where none could be
//! made. The typed wrapper around these functions is the viewer's
//! `engine/engine.ts`; its comments say what each does.
//!
//! # Safety
//! Every function that takes a handle needs one that `tl_book_new` returned and
//! `tl_book_drop` has not freed, from one thread: the wrapper sees to that.

#![allow(clippy::missing_safety_doc, reason = "said once, above")]

mod bench;

use turnleaf_engine::Side;
use turnleaf_engine::book::{Book, Phase};

fn side(number: u32) -> Side {
    if number == 0 { Side::Right } else { Side::Left }
}

fn phase_number(phase: Phase) -> u32 {
    match phase {
        Phase::Resting(Side::Right) => 0,
        Phase::Resting(Side::Left) => 1,
        Phase::Held => 2,
        Phase::Falling(Side::Right) => 3,
        Phase::Playing(_) => 4,
        Phase::Falling(Side::Left) => 5,
    }
}

/// Makes a book of `leaves` pages of paper, `width` x `height` metres, together
/// `thickness` metres thick; 0 where the sizes are not those of a book.
#[unsafe(no_mangle)]
pub extern "C" fn tl_book_new(width: f64, height: f64, leaves: u32, thickness: f64) -> *mut Book {
    match Book::new(width, height, leaves, thickness) {
        Some(book) => Box::into_raw(Box::new(book)),
        None => core::ptr::null_mut(),
    }
}

/// Frees a book.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_book_drop(book: *mut Book) {
    // SAFETY: a handle by the crate's contract, not used again.
    drop(unsafe { Box::from_raw(book) });
}

/// Declares exported functions on a book, each a call to the engine.
macro_rules! book_functions {
    ($($(#[$doc:meta])* fn $name:ident($book:ident $(, $arg:ident: $type:ty)*) $(-> $result:ty)? $body:block)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($book: *mut Book $(, $arg: $type)*) $(-> $result)? {
            // SAFETY: a live handle by the crate's contract.
            let $book = unsafe { &mut *$book };
            $body
        }
    )*};
}

book_functions! {
    /// Lays the book open with `read` leaves on the left and none in flight.
    fn tl_book_lay(book, read: f32) { book.lay(read) }
    /// Takes up the uppermost leaf of a side.
    fn tl_book_lift(book, from: u32, low: f32, high: f32) { book.lift(side(from), low, high) }
    /// A hand takes hold of the leaf in flight at (u, v).
    fn tl_book_grab(book, u: f32, v: f32) { book.leaf_mut().grab(u, v) }
    /// The hand pulls to a place in book space, metres.
    fn tl_book_hold(book, x: f32, y: f32, z: f32) { book.hold([x, y, z]) }
    /// The hand lets go.
    fn tl_book_release(book) { book.leaf_mut().release() }
    /// Plays the recorded turn to a side, `seconds` for a whole one.
    fn tl_book_play(book, to: u32, seconds: f32) { book.leaf_mut().play(side(to), seconds) }
    /// Steps the leaf by whole ticks; answers its phase.
    fn tl_book_step(book, ticks: u32) -> u32 {
        book.leaf_mut().step(ticks);
        phase_number(book.leaf().phase())
    }
    /// Brings the drawn surface and the piles up to date.
    fn tl_book_update(book) { book.update() }
    /// Points along a row of a leaf, and along a curve of a pile.
    fn tl_book_columns(book) -> usize { book.surface().columns }
    /// Rows of a leaf.
    fn tl_book_rows(book) -> usize { book.surface().rows }
    /// Curves of a pile.
    fn tl_book_layers(_book) -> usize { turnleaf_engine::book::LAYERS }
    /// u of each column, f32.
    fn tl_book_u(book) -> *const f32 { book.columns().as_ptr() }
    /// Positions of the leaf's surface, f32 x, y, z.
    fn tl_book_positions(book) -> *const f32 { book.surface().positions.as_ptr() }
    /// Normals of the leaf's surface, f32 x, y, z.
    fn tl_book_normals(book) -> *const f32 { book.surface().normals.as_ptr() }
    /// Version of the leaf's surface.
    fn tl_book_version(book) -> u32 { book.surface().version }
    /// Curves of the pile on a side, f32 x, z.
    fn tl_book_pile(book, on: u32) -> *const f32 { book.pile(side(on)).curves().as_ptr() }
    /// A hand holds a board at an angle, radians.
    fn tl_board_hold(book, cover: u32, angle: f32) { book.board_mut(cover).hold(angle) }
    /// The hand lets the board go.
    fn tl_board_release(book, cover: u32) { book.board_mut(cover).release() }
    /// Swings a board to a side, `seconds` for a half turn.
    fn tl_board_play(book, cover: u32, to: u32, seconds: f32) {
        book.board_mut(cover).play(side(to), seconds)
    }
    /// Puts a board down on a side.
    fn tl_board_lay(book, cover: u32, on: u32) {
        *book.board_mut(cover) = turnleaf_engine::book::Board::new(side(on))
    }
    /// Steps a board by whole ticks; answers its phase.
    fn tl_board_step(book, cover: u32, ticks: u32) -> u32 {
        book.board_mut(cover).step(ticks);
        phase_number(book.board_mut(cover).phase())
    }
    /// A board's angle, radians.
    fn tl_board_angle(book, cover: u32) -> f32 { book.board_mut(cover).angle() }
}
