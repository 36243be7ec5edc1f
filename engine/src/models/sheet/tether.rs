//! Springs that tie nodes to places or to each other and give way, as what holds a leaf that is
//! torn out or across.
//!
//! A pin holds a node exactly, and the sweeps with it; tethers and ties are further springs of
//! the solve, so that their energy says when what they stand for has been torn.

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

    /// Adds the spring's force and stiffness to the system of a step that begins at `positions`.
    pub(super) fn add_to(&self, system: &mut System, positions: &[f32]) {
        let x = positions.as_chunks::<3>().0[self.node];
        let pull = core::array::from_fn(|axis| self.stiffness * (self.place[axis] - x[axis]));
        system.push(self.node, pull);
        system.add_diagonal(self.node, self.stiffness);
    }
}

/// A spring between two nodes that is at rest where they are at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tie {
    /// Numbers of the nodes, row by row, rising.
    pub nodes: [usize; 2],
    /// N/m.
    pub stiffness: f32,
}

impl Tie {
    /// Energy of the spring where the nodes are at `positions` (x, y, z of each, metres), J.
    pub fn energy(&self, positions: &[f32]) -> f32 {
        let between = self.between(positions);
        0.5 * self.stiffness * dot(between, between)
    }

    /// Adds the spring's forces and stiffness to the system of a step that begins at `positions`.
    pub(super) fn add_to(&self, system: &mut System, positions: &[f32]) {
        let [a, b] = self.nodes;
        let between = self.between(positions);
        system.push(a, between.map(|d| self.stiffness * d));
        system.push(b, between.map(|d| -self.stiffness * d));
        system.add_spring(a, b, between, 0.0, self.stiffness);
    }

    fn between(&self, positions: &[f32]) -> [f32; 3] {
        let x = positions.as_chunks::<3>().0;
        sub(x[self.nodes[1]], x[self.nodes[0]])
    }
}
