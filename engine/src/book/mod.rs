//! The mechanics of a bound book: how resting pages lie, and how a leaf sits
//! between them.
//!
//! Book space: metres; x across the spine to the right, y along the spine to
//! the head, z up from the boards; the gutter lies at x = 0, z = 0.

pub mod block;
pub mod leaf;
pub mod seat;

/// A side of the open book.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Right of the spine, where x is positive.
    Right,
    /// Left of the spine, where x is negative.
    Left,
}

impl Side {
    /// The sign of x on this side: 1 on the right, -1 on the left.
    pub fn sign(self) -> f32 {
        match self {
            Side::Right => 1.0,
            Side::Left => -1.0,
        }
    }

    /// The other side.
    pub fn opposite(self) -> Side {
        match self {
            Side::Right => Side::Left,
            Side::Left => Side::Right,
        }
    }
}
