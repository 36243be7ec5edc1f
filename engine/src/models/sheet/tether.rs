//! Springs that tie nodes to places and give way, as what holds a leaf that is torn out.
//!
//! A pin holds a node exactly, and the sweeps with it; a tether is one more spring of the
//! solve, so that its energy says when what it stands for has been torn.

use super::system::System;
use crate::vector::{dot, sub};

/// A spring between a node and a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tether {
    /// Number of the node, row by row.
    pub node: usize,
    /// Where the spring is at rest, metres.
    pub place: [f32; 3],
    /// N/m.
    pub stiffness: f32,
}

impl Tether {
    /// Energy of the spring where the nodes are at `positions` (x, y, z of each, metres), J.
    pub fn energy(&self, positions: &[f32]) -> f32 {
        let x = positions.as_chunks::<3>().0[self.node];
        let away = sub(x, self.place);
        0.5 * self.stiffness * dot(away, away)
    }

    pub(super) fn add_to(&self, system: &mut System, positions: &[f32]) {
        let x = positions.as_chunks::<3>().0[self.node];
        let pull = core::array::from_fn(|axis| self.stiffness * (self.place[axis] - x[axis]));
        system.push(self.node, pull);
        system.add_diagonal(self.node, self.stiffness);
    }
}
