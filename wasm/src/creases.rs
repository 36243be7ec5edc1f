//! Books whose leaves can be creased: what the viewer calls beside the functions of all books.

use turnleaf_engine::FoldLine;
use turnleaf_engine::book::{Book, CreasedMesh};

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
        let creases: Vec<FoldLine> = written
            .chunks_exact(NUMBERS)
            .take(count)
            .map(|line| {
                let through = [[line[0], line[1]], [line[2], line[3]]];
                FoldLine::pressed(through, line[4], &stock, width)
            })
            .collect();
        (count <= MOST && book.crease(leaf, &creases)).into()
    }
    /// Turns the rest of a crease of a leaf to an angle, radians, -pi to pi. Nothing happens
    /// where it is beyond, or there is no such crease or the leaf is not drawn by itself.
    fn tl_book_press(book, leaf: u32, crease: usize, rest: f32) { book.press(leaf, crease, rest) }
    /// Lets seconds pass in which nothing moves: creases of covered leaves creep.
    fn tl_book_wait(book, seconds: f64) { book.wait(seconds) }
    /// Whether a creased leaf lies upon the pile of a side: the first of those drawn on the
    /// left, the last on the right.
    fn tl_book_lies_creased(book, on: u32) -> u32 { book.lies_creased(side(on)).into() }
    /// Leaves drawn by themselves: in flight, and creased upon a pile.
    fn tl_book_drawn(book) -> usize { book.drawn_leaves() }
    /// u and v of the points of the leaf at an index, f32; 0 where it is not creased.
    fn tl_book_places(book, index: usize) -> *const f32 {
        book.creased_mesh(index).map_or(core::ptr::null(), |mesh: &CreasedMesh| mesh.places.as_ptr())
    }
    /// The points of its triangles, u32, three by three; and the part of the leaf that each
    /// belongs to, u16: as many as `tl_book_triangles` says.
    fn tl_book_corners(book, index: usize) -> *const u32 {
        book.creased_mesh(index).map_or(core::ptr::null(), |mesh| mesh.triangles.as_ptr())
    }
    fn tl_book_parts(book, index: usize) -> *const u16 {
        book.creased_mesh(index).map_or(core::ptr::null(), |mesh| mesh.parts.as_ptr())
    }
    /// Number of its triangles.
    fn tl_book_triangles(book, index: usize) -> usize {
        book.creased_mesh(index).map_or(0, |mesh| mesh.parts.len())
    }
    /// Rises when the mesh of the leaf at an index changes; 0 where there is none.
    fn tl_book_topology(book, index: usize) -> u32 {
        book.surface(index).map_or(0, |surface| surface.topology)
    }
}
