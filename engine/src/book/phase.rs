//! What a leaf or a board is doing.

use crate::grid::Side;

/// What a leaf or a board is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It lies still on a side.
    Resting(Side),
    /// A grab holds it.
    Held,
    /// It falls to a side by itself.
    Falling(Side),
    /// It is turned to a side.
    Playing(Side),
}

impl Phase {
    /// The side where it rests or is headed for; None while a grab holds it.
    pub fn side(self) -> Option<Side> {
        match self {
            Phase::Held => None,
            Phase::Resting(side) | Phase::Falling(side) | Phase::Playing(side) => Some(side),
        }
    }
}
