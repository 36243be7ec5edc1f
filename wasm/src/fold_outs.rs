//! Flaps of fold-outs: the viewer's `engine/flap_sheets.ts` wraps these functions.
//!
//! A flap is the address of a boxed [`FoldOut`], 0 where none could be made. Each step names the
//! book on and beside whose pages it lies.

use turnleaf_engine::book::{Book, FlapPlace, FoldOut, TableAround};

use crate::books::{BOOKS, MOST_TICKS};
use crate::drawn::{Drawn, drawn};
use crate::live::{Live, live_functions};
use crate::side;

/// The flaps that are alive.
pub(crate) static FLAPS: Live<FoldOut> = Live::new();

/// Makes the flap of a fold-out on the uppermost page of a side (0 right), shut: with its fold so
/// far from the spine (0.5 to 1 of the page's width) and so wide, in so many panels (1 to 3), each
/// 0.05 to the fold's distance wide; over a table at a height (-1 to 0 m), with boards that reach so
/// far beyond the pages (0 to 1 m). 0 where no leaf lies there or a number is another.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_flap_new(
    book: *mut Book,
    on: u32,
    fold: f64,
    width: f64,
    panels: usize,
    table: f32,
    rim: f32,
) -> *mut FoldOut {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let book = unsafe { BOOKS.get(book) };
    let place = FlapPlace {
        side: side(on),
        fold,
        width,
        panels,
    };
    let around = TableAround { table, rim };
    match book.and_then(|book| FoldOut::new(book, place, around)) {
        Some(flap) => FLAPS.keep(flap),
        None => core::ptr::null_mut(),
    }
}

/// Frees a flap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_flap_drop(flap: *mut FoldOut) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { FLAPS.take(flap) });
}

/// Steps a flap by so many ticks, a minute's at most, on and beside its book, and brings what is
/// drawn of it up to date.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_flap_step(flap: *mut FoldOut, book: *mut Book, ticks: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses them.
    if let (Some(flap), Some(book)) = unsafe { (FLAPS.get(flap), BOOKS.get(book)) } {
        flap.step(book, ticks.min(MOST_TICKS));
        flap.update(book);
    }
}

live_functions! {
    FLAPS: FoldOut;
    /// A hand takes hold at (u, v), each 0 to 1 or the nearer of these, u from the fold. Nothing
    /// happens where one is not finite.
    fn tl_flap_grab(flap, u: f32, v: f32) { flap.grab(u, v) }
    /// The hand pulls to a place in book space, metres, each -1000 to 1000 or the nearer of
    /// these. Nothing happens where one is not finite.
    fn tl_flap_pull(flap, x: f32, y: f32, z: f32) { flap.pull([x, y, z]) }
    /// The hand lets go.
    fn tl_flap_release(flap) { flap.release() }
    /// A hand turns it open, or shut (0), and lets go.
    fn tl_flap_turn(flap, is_to_open: u32) { flap.turn(is_to_open != 0) }
    /// Angle at which the end of its first panel is seen from the fold, radians: 0 open and level, pi shut.
    fn tl_flap_angle(flap) -> f32 { flap.angle() }
    /// Whether it does not move until the next command.
    fn tl_flap_asleep(flap) -> u32 { flap.is_asleep().into() }
    /// What is drawn of it.
    fn tl_flap_surface(flap) -> *const Drawn {
        drawn(flap.surface(), flap.paper_mesh(), flap.caliper())
    }
}
