//! Leaves that are torn out of books: the viewer's `engine/torn_sheets.ts` wraps these functions.
//!
//! A torn leaf is the address of a boxed [`TornLeaf`], 0 where none could be made. It outlives
//! its book: each step names the book on and beside which it lies.

use turnleaf_engine::book::{Book, TableAround, TearLine, TornLeaf, step_together, wake_upon};

use crate::books::{BOOKS, MOST_TICKS};
use crate::drawn::{Drawn, drawn};
use crate::live::{Live, live_functions};

/// The torn leaves that are alive.
pub(crate) static TORN: Live<TornLeaf> = Live::new();

/// Loose sheets that one call steps, at most.
const MOST_SHEETS: usize = 16;

/// Where the addresses of the loose sheets that are stepped together are written.
static mut SHEETS: [usize; MOST_SHEETS] = [0; MOST_SHEETS];

/// Begins to tear the leaf of a flight out of a book: of one that is sewn (0), stapled (1) or
/// perforated (2) and still bound between two rows of its 14, from the foot; over a table at
/// a height (-1 to 0 m), with boards that reach so far beyond the pages (0 to 1 m). 0 where
/// there is no such flight or a number is another.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_new(
    book: *mut Book,
    id: u32,
    line: u32,
    low: usize,
    high: usize,
    table: f32,
    rim: f32,
) -> *mut TornLeaf {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let book = unsafe { BOOKS.get(book) };
    let line = match line {
        0 => TearLine::Sewn,
        1 => TearLine::Stapled,
        2 => TearLine::Perforated,
        _ => return core::ptr::null_mut(),
    };
    let around = TableAround { table, rim };
    match book.and_then(|book| TornLeaf::tear(book, id, line, low..high, around)) {
        Some(leaf) => TORN.keep(leaf),
        None => core::ptr::null_mut(),
    }
}

/// A loose sheet of a book's paper, which nothing was torn to make: over a table at a height (-1 to
/// 0 m), with boards that reach so far beyond the pages (0 to 1 m). 0 where a number is another.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_blank(book: *mut Book, table: f32, rim: f32) -> *mut TornLeaf {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let book = unsafe { BOOKS.get(book) };
    match book.and_then(|book| TornLeaf::blank(book, TableAround { table, rim })) {
        Some(leaf) => TORN.keep(leaf),
        None => core::ptr::null_mut(),
    }
}

/// Frees a torn leaf.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_drop(leaf: *mut TornLeaf) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    drop(unsafe { TORN.take(leaf) });
}

/// Steps a torn leaf by so many ticks, a minute's at most, on and beside a book, and brings what
/// is drawn of it up to date.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_step(leaf: *mut TornLeaf, book: *mut Book, ticks: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses them.
    if let (Some(leaf), Some(book)) = unsafe { (TORN.get(leaf), BOOKS.get(book)) } {
        leaf.step(book, ticks.min(MOST_TICKS));
        leaf.update(book);
    }
}

/// Where the addresses of loose sheets are written before `tl_torn_step_together` or
/// `tl_torn_wake_upon` is called: usize, 16 at most.
#[unsafe(no_mangle)]
pub extern "C" fn tl_torn_sheets() -> *mut usize {
    (&raw mut SHEETS).cast()
}

/// Steps the loose sheets that are written, `count` of them, by so many ticks, a minute's at most,
/// on and beside a book and upon each other, and brings what is drawn of them up to date. Addresses
/// that are none, and an address that is there twice, count once at most.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_step_together(count: usize, book: *mut Book, ticks: u32) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses them.
    if let Some(book) = unsafe { BOOKS.get(book) } {
        let (mut sheets, _) = written(count, 0);
        step_together(&mut sheets, book, ticks.min(MOST_TICKS));
    }
}

/// Wakes what lies upon one of the loose sheets that are written, `count` of them: the one at an
/// index, which is about to be freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_wake_upon(count: usize, index: usize, book: *mut Book) {
    // SAFETY: from one thread by the crate's contract, so that no other call uses them.
    if let Some(book) = unsafe { BOOKS.get(book) }
        && let (mut sheets, Some(gone)) = written(count, index)
    {
        wake_upon(&mut sheets, gone, book);
    }
}

/// The loose sheets that are written, each once, and where the one at an index is among them.
fn written(count: usize, index: usize) -> (Vec<&'static mut TornLeaf>, Option<usize>) {
    // SAFETY: from one thread by the crate's contract, so that nothing else uses it.
    let addresses = unsafe { SHEETS };
    let addresses = &addresses[..count.min(MOST_SHEETS)];
    let (mut sheets, mut found) = (Vec::new(), None);
    for (k, address) in addresses.iter().enumerate() {
        if addresses[..k].contains(address) {
            continue;
        }
        // SAFETY: as above; and each address is looked up once.
        if let Some(sheet) = unsafe { TORN.get(*address as *mut TornLeaf) } {
            if k == index {
                found = Some(sheets.len());
            }
            sheets.push(sheet);
        }
    }
    (sheets, found)
}

/// Begins to tear a loose sheet across, from (`u0`, `v0`) to (`u1`, `v1`) on its page; the path
/// turns with the pull of both grabs unless `turns` is 0. Returns whether it does: 0 or 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_across(
    leaf: *mut TornLeaf,
    u0: f64,
    v0: f64,
    u1: f64,
    v1: f64,
    turns: u32,
) -> u32 {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    let leaf = unsafe { TORN.get(leaf) };
    leaf.is_some_and(|leaf| leaf.tear_across(&[[u0, v0], [u1, v1]], turns != 0))
        .into()
}

/// Parts a sheet that is torn through: returns the piece on the left of the path, and leaves the
/// other in its place. 0 where it is not torn through.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tl_torn_part(leaf: *mut TornLeaf) -> *mut TornLeaf {
    // SAFETY: from one thread by the crate's contract, so that no other call uses it.
    match unsafe { TORN.get(leaf) }.and_then(TornLeaf::part) {
        Some(piece) => TORN.keep(piece),
        None => core::ptr::null_mut(),
    }
}

live_functions! {
    TORN: TornLeaf;
    /// A grab, 0 or 1, takes hold at (u, v), each 0 to 1 or the nearer of these. Nothing happens
    /// where one is not finite.
    fn tl_torn_grab(leaf, grab: usize, u: f32, v: f32) { leaf.grab(grab, u, v) }
    /// A grab, 0 or 1, pulls to a place in book space, metres, each -1000 to 1000 or the nearer
    /// of these. Nothing happens where one is not finite.
    fn tl_torn_pull(leaf, grab: usize, x: f32, y: f32, z: f32) { leaf.pull(grab, [x, y, z]) }
    /// All grabs are released.
    fn tl_torn_release(leaf) { leaf.release() }
    /// Tears what still holds at the spine or across, without work.
    fn tl_torn_cut(leaf) { leaf.cut() }
    /// The first row, from the foot, at which it is bound; 0 once it is off.
    fn tl_torn_bound_low(leaf) -> usize { leaf.bound().start }
    /// The row after the last at which it is bound; 0 once it is off.
    fn tl_torn_bound_high(leaf) -> usize { leaf.bound().end }
    /// Crumples one that is off. Returns whether it is being crumpled from now on.
    fn tl_torn_crumple(leaf) -> u32 { leaf.crumple().into() }
    /// Whether it is crumpled: its surface is one of facets then.
    fn tl_torn_crumpled(leaf) -> u32 { leaf.is_crumpled().into() }
    /// How far it is torn across, metres along the path; infinite once it is torn through.
    fn tl_torn_opened(leaf) -> f32 { leaf.opened() }
    /// Its place among loose sheets that were stepped together, from the table up; the greatest
    /// number of one that was not.
    fn tl_torn_layer(leaf) -> u32 { leaf.layer() }
    /// Work done in tearing and crumpling since it was last asked for, J.
    fn tl_torn_work(leaf) -> f32 { leaf.take_work() }
    /// Whether it does not move until the next command.
    fn tl_torn_asleep(leaf) -> u32 { leaf.is_asleep().into() }
    /// What is drawn of it.
    fn tl_torn_surface(leaf) -> *const Drawn {
        drawn(leaf.surface(), leaf.paper_mesh(), leaf.caliper())
    }
}
