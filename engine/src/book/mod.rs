//! The mechanics of a bound book: how resting pages lie, how a leaf in flight
//! moves and sits between them, and how the cover boards swing.
//!
//! Book space: metres; x across the spine to the right, y along the spine to
//! the head, z up from the boards; the gutter lies at x = 0, z = 0.

mod block;
mod board;
mod leaf;
mod seat;

pub use block::{LAYERS, Pile, crowded_columns};
pub use board::Board;
pub use leaf::{Leaf, Phase, TICK};
pub use seat::seat;

use crate::grid::Side;
use crate::surface::Surface;

/// Columns of the drawn leaf and of every pile: enough for the sharp bend out
/// of the gutter.
const COLUMNS: usize = 49;

/// Rows of the drawn leaf.
const ROWS: usize = 25;

/// Grammage of the leaves, kg/m^2: ordinary book paper.
const GRAMMAGE: f32 = 0.070;

/// A book that lies open: two piles of pages, at most one leaf of paper in
/// flight, and two cover boards.
pub struct Book {
    width: f64,
    leaves: u32,
    thickness: f64,
    u: Vec<f32>,
    /// Leaves on the left, with the leaf in flight on the right and on the left.
    read: (f32, f32),
    /// Each side's pile at either end of `read`, then closed flat.
    ends: [[Pile; 3]; 2],
    /// The piles as they lie now, right and left.
    piles: [Pile; 2],
    leaf: Leaf,
    surface: Surface,
    boards: [Board; 2],
}

impl Book {
    /// A book of `leaves` pages of paper, `width` x `height` metres, together
    /// `thickness` metres thick, open before the first.
    ///
    /// None where a size is not finite, not positive or beyond 10 m.
    pub fn new(width: f64, height: f64, leaves: u32, thickness: f64) -> Option<Book> {
        let is_size = |size: f64| size.is_finite() && size > 0.0 && size <= 10.0;
        if !is_size(width) || !is_size(height) || !(0.0..=1.0).contains(&thickness) {
            return None;
        }
        let u = crowded_columns(COLUMNS);
        let side = |side| {
            let open = Pile::new(side, width, 0.0, &u);
            [open.clone(), open, Pile::closed(side, width, thickness, &u)]
        };
        let ends = [side(Side::Right), side(Side::Left)];
        let piles = [ends[0][0].clone(), ends[1][0].clone()];
        let leaf = Leaf::new(width as f32, height as f32, GRAMMAGE, &u, ROWS);
        let mut book = Book {
            width,
            leaves,
            thickness,
            u,
            read: (f32::NAN, f32::NAN),
            ends,
            piles,
            leaf,
            surface: Surface::new(COLUMNS, ROWS),
            boards: [Board::new(Side::Right), Board::new(Side::Right)],
        };
        book.lay(0.0);
        Some(book)
    }

    /// Lays the book open with `read` leaves of paper on the left (clamped to
    /// those there are) and none in flight.
    pub fn lay(&mut self, read: f32) {
        self.open_between(read, read);
        self.leaf.lay(Side::Right);
        self.update();
    }

    /// Takes up the uppermost leaf of side `from`. While it lies on the right,
    /// `low` leaves are on the left; once it lies on the left, `high`.
    pub fn lift(&mut self, from: Side, low: f32, high: f32) {
        self.open_between(low, high);
        self.leaf.lay(from);
        self.update();
    }

    /// The hand that holds the leaf in flight pulls it to `place`, in book
    /// space, metres.
    pub fn hold(&mut self, place: [f32; 3]) {
        // Asked before the clamp below, which would take what is no number for 0.
        if !place.iter().all(|x| x.is_finite()) {
            return;
        }
        // The model's leaf turns over a flat table; the piles lift the drawn
        // one. What lies between the two is taken off the hand's place.
        let node = self.leaf.grabbed_point();
        let (u, v) = self.leaf.grabbed_at();
        let drawn = self.drawn_at(u, v);
        let lift = (drawn[2] - node[2]).max(0.0);
        self.leaf
            .hold([place[0], place[1], (place[2] - lift).max(0.0)]);
    }

    /// Brings the drawn surface and the piles up to date with leaf and boards.
    pub fn update(&mut self) {
        let turned = self.leaf.share_turned();
        // The front board shuts the block on the right, the back board the left.
        let shut = [
            closing(self.boards[0].angle()),
            closing(core::f32::consts::PI - self.boards[1].angle()),
        ];
        for side in 0..2 {
            let [low, high, closed] = &self.ends[side];
            self.piles[side].blend(low, high, turned);
            if shut[side] > 0.0 {
                self.piles[side].blend_toward(closed, shut[side]);
            }
        }
        self.leaf.write_surface(&mut self.surface);
        seat(&mut self.surface.positions, &self.piles[0], &self.piles[1]);
        self.surface.update_normals();
        self.surface.touch();
    }

    /// The leaf in flight.
    pub fn leaf(&self) -> &Leaf {
        &self.leaf
    }

    /// The leaf in flight, to be held, played and stepped.
    pub fn leaf_mut(&mut self) -> &mut Leaf {
        &mut self.leaf
    }

    /// The front board (0) or the back board (any other number).
    pub fn board_mut(&mut self, number: u32) -> &mut Board {
        &mut self.boards[number.min(1) as usize]
    }

    /// u of each column of the surface and of the piles.
    pub fn columns(&self) -> &[f32] {
        &self.u
    }

    /// The drawn surface of the leaf in flight, as of the last update.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The pages at rest on a side, as of the last update.
    pub fn pile(&self, side: Side) -> &Pile {
        &self.piles[index(side)]
    }

    fn open_between(&mut self, low: f32, high: f32) {
        if !low.is_finite() || !high.is_finite() {
            return;
        }
        let most = self.leaves as f32;
        let read = (low.clamp(0.0, most), high.clamp(0.0, most));
        if read == self.read {
            return;
        }
        for (end, read) in [(0, read.0), (1, read.1)] {
            let share = read as f64 / (self.leaves.max(1)) as f64;
            for (side, share) in [(Side::Right, 1.0 - share), (Side::Left, share)] {
                let thickness = self.thickness * share;
                self.ends[index(side)][end] = Pile::new(side, self.width, thickness, &self.u);
            }
        }
        self.read = read;
    }

    /// The drawn place of a point of the leaf, by the nearest point of the mesh.
    fn drawn_at(&self, u: f32, v: f32) -> [f32; 3] {
        let column = self.u.partition_point(|&at| at < u).min(COLUMNS - 1);
        let row = libm::roundf(v * (ROWS - 1) as f32) as usize;
        self.surface.position(column, row.min(ROWS - 1))
    }
}

/// How far a board at `angle` above the block it shuts has pressed the pages
/// flat: 0 from upright on, 1 when shut.
fn closing(angle: f32) -> f32 {
    let t = (1.0 - angle / core::f32::consts::FRAC_PI_2).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Where a side stands in arrays of two: right, then left, as in the browser's face.
fn index(side: Side) -> usize {
    match side {
        Side::Right => 0,
        Side::Left => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_finite(book: &Book) -> bool {
        let piles = [Side::Right, Side::Left].map(|side| book.pile(side).curves());
        book.surface().positions.iter().all(|x| x.is_finite())
            && piles
                .iter()
                .all(|curves| curves.iter().all(|x| x.is_finite()))
    }

    #[test]
    fn a_book_has_a_size() {
        assert!(Book::new(0.14, 0.21, 0, 0.0).is_some_and(|book| is_finite(&book)));
        assert!(Book::new(f64::NAN, 0.21, 10, 0.01).is_none());
        assert!(Book::new(0.14, 0.0, 10, 0.01).is_none());
        assert!(Book::new(0.14, 0.21, 10, f64::NAN).is_none());
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut book = Book::new(0.14, 0.21, 10, 0.01).unwrap();
        book.lay(4.0);
        let right = book.pile(Side::Right).curves().to_vec();
        book.lay(f32::NAN);
        assert_eq!(book.pile(Side::Right).curves(), right);
        book.lift(Side::Right, f32::NAN, 5.0);
        assert_eq!(book.pile(Side::Right).curves(), right);
        book.lift(Side::Right, 4.0, 5.0);
        book.hold([0.1, 0.1, 0.1]);
        book.leaf_mut().grab(1.0, 0.5);
        for place in [[f32::NAN, 0.1, 0.1], [0.0, 0.1, f32::NAN]] {
            book.hold(place);
            book.leaf_mut().step(40);
            let held = book.leaf().grabbed_point();
            assert!((held[0] - 0.14).abs() < 1e-3, "{held:?} after {place:?}");
        }
        book.update();
        assert!(is_finite(&book));
    }

    #[test]
    fn more_leaves_read_than_there_are_is_all_of_them() {
        let mut book = Book::new(0.14, 0.21, 10, 0.01).unwrap();
        book.lay(10.0);
        let left = book.pile(Side::Left).curves().to_vec();
        book.lay(99.0);
        assert_eq!(book.pile(Side::Left).curves(), left);
    }
}
