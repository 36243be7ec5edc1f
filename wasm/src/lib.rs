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

#[cfg(target_arch = "wasm32")]
mod allocator;
#[cfg(feature = "models")]
mod models;
#[cfg(feature = "trials")]
mod trials;

use turnleaf_engine::book::{Book, Paper, Phase, TICK};
use turnleaf_engine::{Grain, Side, Stock};

#[cfg(target_arch = "wasm32")]
#[global_allocator]
static ALLOCATOR: allocator::Blocks = allocator::Blocks::new();

fn side(number: u32) -> Side {
    if number == 0 { Side::Right } else { Side::Left }
}

fn phase_number(phase: Phase) -> u32 {
    match phase {
        Phase::Resting(Side::Right) => 0,
        Phase::Resting(Side::Left) => 1,
        Phase::Held => 2,
        Phase::Falling(Side::Right) => 3,
        Phase::Falling(Side::Left) => 4,
        Phase::Playing(Side::Right) => 5,
        Phase::Playing(Side::Left) => 6,
    }
}

/// The phase of a flight that is over.
const OVER: u32 = 7;

/// Length of a tick, by which books and boards are stepped, seconds.
#[unsafe(no_mangle)]
pub extern "C" fn tl_tick() -> f32 {
    TICK
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

/// Changes a book's paper; answers whether leaves can be made of it.
fn change(book: &mut Book, how: impl FnOnce(&mut Paper)) -> bool {
    let mut paper = *book.paper();
    how(&mut paper);
    book.set_paper(&paper)
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
    /// Makes the leaves of a preset stock, by its number; 0 where there is none.
    fn tl_book_set_stock(book, number: usize) -> u32 {
        let stock = Stock::NAMES.get(number).and_then(|name| Stock::named(name));
        stock.is_some_and(|stock| change(book, |paper| paper.stock = stock)).into()
    }
    /// Makes the leaves of a stock in figures: kg/m^2, m, N m; 0 where it is none.
    fn tl_book_set_figures(book, grammage: f64, caliper: f64, along: f64, across: f64) -> u32 {
        let stock = Stock::new(grammage, caliper, along, across);
        stock.is_ok_and(|stock| change(book, |paper| paper.stock = stock)).into()
    }
    /// Binds the leaves with their grain across the spine or along it, and with a
    /// stiffness in N; 0 where it is none.
    fn tl_book_set_binding(book, across_spine: u32, stiffness: f64) -> u32 {
        let grain = if across_spine == 0 { Grain::AlongSpine } else { Grain::AcrossSpine };
        change(book, |paper| (paper.grain, paper.binding) = (grain, stiffness)).into()
    }
    /// Sets the velocity of the air, m/s; 0 where it is none.
    fn tl_book_set_wind(book, x: f64, y: f64, z: f64) -> u32 {
        change(book, |paper| paper.wind = [x, y, z]).into()
    }
    /// Whether a leaf let go is helped over to its side.
    fn tl_book_set_assist(book, on: u32) {
        change(book, |paper| paper.assist = on != 0);
    }
    /// Lays the book open with `read` leaves on the left and none in flight.
    fn tl_book_lay(book, read: u32) { book.lay(read) }
    /// Takes up the uppermost leaves of a side; answers the flight's number, or 0.
    fn tl_book_lift(book, from: u32, low: u32, high: u32) -> u32 {
        book.lift(side(from), low, high).unwrap_or(0)
    }
    /// A hand takes hold of a flight at (u, v).
    fn tl_book_grab(book, id: u32, hand: u32, u: f32, v: f32) { book.grab(id, hand, u, v) }
    /// The hand pulls to a place in book space, metres.
    fn tl_book_hold(book, id: u32, hand: u32, x: f32, y: f32, z: f32) {
        book.hold(id, hand, [x, y, z])
    }
    /// The hand lets go.
    fn tl_book_release(book, id: u32, hand: u32) { book.release(id, hand) }
    /// Plays the recorded turn to a side, `seconds` for a whole one.
    fn tl_book_play(book, id: u32, to: u32, seconds: f32) { book.play(id, side(to), seconds) }
    /// Steps all flights by whole ticks.
    fn tl_book_step(book, ticks: u32) { book.step(ticks) }
    /// What a flight is doing.
    fn tl_book_phase(book, id: u32) -> u32 { book.phase(id).map_or(OVER, phase_number) }
    /// Leaves of the left pile.
    fn tl_book_read(book) -> u32 { book.read() }
    /// Leaves in flight.
    fn tl_book_flights(book) -> usize { book.flights() }
    /// Brings the drawn surfaces and the piles up to date.
    fn tl_book_update(book) { book.update() }
    /// Points along a row of a leaf, and along a curve of a pile.
    fn tl_book_columns(book) -> usize { book.columns().len() }
    /// Rows of a leaf.
    fn tl_book_rows(book) -> usize { book.rows() }
    /// Curves of a pile.
    fn tl_book_layers(_book) -> usize { turnleaf_engine::book::LAYERS }
    /// u of each column, f32.
    fn tl_book_u(book) -> *const f32 { book.columns().as_ptr() }
    /// Positions of a flight's surface, f32 x, y, z; by its index from the left.
    fn tl_book_positions(book, index: usize) -> *const f32 {
        book.surface(index).map_or(core::ptr::null(), |s| s.positions.as_ptr())
    }
    /// Points of a flight over a flat table, to be written over before the next update:
    /// that draws them in place of the sheet.
    fn tl_book_dress(book, index: usize) -> *mut f32 {
        book.dress(index).map_or(core::ptr::null_mut(), |points| points.as_mut_ptr())
    }
    /// Normals of a flight's surface, f32 x, y, z.
    fn tl_book_normals(book, index: usize) -> *const f32 {
        book.surface(index).map_or(core::ptr::null(), |s| s.normals.as_ptr())
    }
    /// Version of a flight's surface.
    fn tl_book_version(book, index: usize) -> u32 { book.surface(index).map_or(0, |s| s.version) }
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
