//! Books: what the viewer calls.
//!
//! A book is the address of a boxed [`Book`], 0 where none could be made. The typed
//! wrapper around these functions is the viewer's `engine/wasm_book.ts`; the comments
//! of `engine/book_engine.ts` say what each does.

use turnleaf_engine::book::{Book, Paper, Phase, TICK};
use turnleaf_engine::{Grain, Side, Stock};

use crate::drawn::{Drawn, drawn};
use crate::live::{Live, Nothing};
use crate::side;

/// Ticks of one call at most: a minute's. More are left out.
pub(crate) const MOST_TICKS: u32 = 60 * 120;

/// The books that are alive.
pub(crate) static BOOKS: Live<Book> = Live::new();

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
pub(crate) const OVER: u32 = 7;

/// Length of a tick, by which books and boards are stepped, seconds.
#[unsafe(no_mangle)]
pub extern "C" fn tl_tick() -> f32 {
    TICK
}

/// Makes a book of `leaves` pages of paper, `width` x `height` metres (1 mm to 10 m),
/// together `thickness` metres thick (0 to 1); 0 where the sizes are not such.
#[unsafe(no_mangle)]
pub extern "C" fn tl_book_new(width: f64, height: f64, leaves: u32, thickness: f64) -> *mut Book {
    match Book::new(width, height, leaves, thickness) {
        Some(book) => BOOKS.keep(book),
        None => core::ptr::null_mut(),
    }
}

/// Frees a book.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_book_drop(book: *mut Book) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { BOOKS.take(book) });
}

/// Changes a book's paper; returns whether leaves can be made of it.
fn change(book: &mut Book, how: impl FnOnce(&mut Paper)) -> bool {
    let mut paper = *book.paper();
    how(&mut paper);
    book.set_paper(&paper)
}

/// Makes all leaves of a book of one stock.
fn set_stock(book: &mut Book, stock: Stock) -> bool {
    book.clear_leaf_stocks();
    change(book, |paper| paper.stock = stock)
}

/// The preset stock of a number.
fn preset(number: usize) -> Option<Stock> {
    Stock::PRESETS.get(number).map(|(_, stock)| *stock)
}

/// Declares exported functions on a book, each a call to the engine.
macro_rules! book_functions {
    ($($(#[$doc:meta])* fn $name:ident($book:ident $(, $arg:ident: $type:ty)*) $(-> $result:ty)? $body:block)*) => {$(
        $(#[$doc])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($book: *mut Book $(, $arg: $type)*) $(-> $result)? {
            // SAFETY: from one thread by the crate's contract, so that no other call uses it.
            let Some($book) = (unsafe { BOOKS.get($book) }) else {
                return Nothing::NOTHING;
            };
            $body
        }
    )*};
}
#[cfg(any(feature = "creases", test))]
pub(crate) use book_functions;

book_functions! {
    /// Makes all leaves of a preset stock, by its number; 0 where there is none.
    fn tl_book_set_stock(book, number: usize) -> u32 {
        preset(number).is_some_and(|stock| set_stock(book, stock)).into()
    }
    /// Makes all leaves of a stock in figures: kg/m^2 (0.001 to 5), m (1e-6 to 0.01), N m
    /// (1e-8 to 10); 0 where one is beyond.
    fn tl_book_set_figures(book, grammage: f64, caliper: f64, along: f64, across: f64) -> u32 {
        let stock = Stock::new(grammage, caliper, along, across);
        stock.is_ok_and(|stock| set_stock(book, stock)).into()
    }
    /// Makes the leaves from `first` to before `end` (from 0) of a preset stock, by its number;
    /// 0 where there are no such leaves or there is no such stock.
    fn tl_book_set_leaf_stock(book, first: u32, end: u32, number: usize) -> u32 {
        preset(number).is_some_and(|stock| book.set_leaf_stock(first..end, &stock)).into()
    }
    /// Makes such leaves of a stock in figures, as `tl_book_set_figures`.
    fn tl_book_set_leaf_figures(
        book, first: u32, end: u32, grammage: f64, caliper: f64, along: f64, across: f64
    ) -> u32 {
        let stock = Stock::new(grammage, caliper, along, across);
        stock.is_ok_and(|stock| book.set_leaf_stock(first..end, &stock)).into()
    }
    /// Binds the leaves with their grain across the spine, or along it (0), and with a
    /// stiffness in N (0 to 1); 0 where it is beyond.
    fn tl_book_set_binding(book, across_spine: u32, stiffness: f64) -> u32 {
        let grain = if across_spine == 0 { Grain::AlongSpine } else { Grain::AcrossSpine };
        change(book, |paper| (paper.grain, paper.binding) = (grain, stiffness)).into()
    }
    /// Sets the velocity of the air, m/s (each -20 to 20); 0 where one is beyond.
    fn tl_book_set_wind(book, x: f64, y: f64, z: f64) -> u32 {
        change(book, |paper| paper.wind = [x, y, z]).into()
    }
    /// Says whether a leaf let go is helped over to its side, or not (0).
    fn tl_book_set_assist(book, on: u32) {
        change(book, |paper| paper.assist = on != 0);
    }
    /// Has leaves move as in a book so many times as large as book space: 0.02 to 50. Returns 1, or
    /// 0 if it is not between these, and nothing changes.
    fn tl_book_set_scale(book, scale: f64) -> u32 {
        change(book, |paper| paper.scale = scale).into()
    }
    /// Lays the book open with `read` leaves, or all there are, on the left and none in
    /// flight.
    fn tl_book_lay(book, read: u32) { book.lay(read) }
    /// Takes up the uppermost leaves of a side; returns the flight's number, or 0 where
    /// `low` and `high` do not name these, or 16 flights are in the air.
    fn tl_book_lift(book, from: u32, low: u32, high: u32) -> u32 {
        book.pick_up(side(from), low, high).unwrap_or(0)
    }
    /// A hand (0 to 3) takes hold of a flight at (u, v), each 0 to 1 or the nearer of
    /// these. Nothing happens where one is not finite.
    fn tl_book_grab(book, id: u32, hand: u32, u: f32, v: f32) { book.grab(id, hand, u, v) }
    /// The hand pulls to a place in book space, metres, each -1000 to 1000 or the nearer of
    /// these. Nothing happens where one is no number or infinite.
    fn tl_book_hold(book, id: u32, hand: u32, x: f32, y: f32, z: f32) {
        book.hold(id, hand, [x, y, z])
    }
    /// The hand lets go.
    fn tl_book_release(book, id: u32, hand: u32) { book.release(id, hand) }
    /// Plays the recorded turn to a side, `seconds` for a whole one: 0.2 to 600 or the
    /// nearer of these, 0.8 where they are not finite.
    fn tl_book_play(book, id: u32, to: u32, seconds: f32) { book.play(id, side(to), seconds) }
    /// Steps all flights by whole ticks, at most a minute's (7200).
    fn tl_book_step(book, ticks: u32) { book.step(ticks.min(MOST_TICKS)) }
    /// Begins a frame.
    fn tl_book_begin_frame(book) { book.begin_frame() }
    /// Steps all flights by whole ticks, at most a minute's (7200), and by fewer where those of
    /// the frame are more work than one may have. Returns by how many.
    fn tl_book_step_frame(book, ticks: u32) -> u32 { book.step_frame(ticks.min(MOST_TICKS)) }
    /// Whether nothing moves until the next command: what is in the air is held and lies still.
    fn tl_book_asleep(book) -> u32 { book.is_asleep().into() }
    /// What a flight is doing; 7 where there is none of that number.
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
    /// u of each column, f32, 0 to 1.
    fn tl_book_u(book) -> *const f32 { book.columns().as_ptr() }
    /// What is drawn of a leaf that is drawn by itself, by its index from the left; 0 where there is
    /// none.
    fn tl_book_surface(book, index: usize) -> *const Drawn {
        book.surface(index).map_or(core::ptr::null(), |surface| {
            let caliper = book.caliper(index).unwrap_or(0.0);
            drawn(surface, book.paper_mesh(index), caliper)
        })
    }
    /// Points of such a leaf over a flat table, f32 x, y, z in metres, to be written over before the
    /// next update:
    /// that draws them in place of the sheet, unless one is not within 1 km. 0 where there
    /// is none.
    fn tl_book_dress(book, index: usize) -> *mut f32 {
        book.override_surface(index).map_or(core::ptr::null_mut(), |points| points.as_mut_ptr())
    }
    /// Curves of the pile on a side, f32 x, z in metres: from the uppermost page to the board, each from
    /// the spine to the fore-edge.
    fn tl_book_pile(book, on: u32) -> *const f32 { book.pile(side(on)).curves().as_ptr() }
    /// A hand holds a board (0 the front, any other number the back) at an angle, radians,
    /// 0 to pi or the nearer of these. Nothing happens where it is not finite.
    fn tl_board_hold(book, cover: u32, angle: f32) { book.board_mut(cover).hold(angle) }
    /// The hand lets the board go.
    fn tl_board_release(book, cover: u32) { book.board_mut(cover).release() }
    /// Swings a board to a side, `seconds` for a half turn: 0.05 to 600 or the nearer of
    /// these, 1 where they are not finite.
    fn tl_board_play(book, cover: u32, to: u32, seconds: f32) {
        book.board_mut(cover).play(side(to), seconds)
    }
    /// Puts a board down on a side.
    fn tl_board_lay(book, cover: u32, on: u32) {
        *book.board_mut(cover) = turnleaf_engine::book::Board::new(side(on))
    }
    /// Steps a board by whole ticks, at most a minute's (7200); returns its phase, numbered as a
    /// flight's.
    fn tl_board_step(book, cover: u32, ticks: u32) -> u32 {
        book.board_mut(cover).step(ticks.min(MOST_TICKS));
        phase_number(book.board_mut(cover).phase())
    }
    /// A board's angle, radians: 0 flat on the right, pi flat on the left.
    fn tl_board_angle(book, cover: u32) -> f32 { book.board_mut(cover).angle() }
}
