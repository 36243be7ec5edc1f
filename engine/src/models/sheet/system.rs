//! The linear system of a step: forces on the right, the banded matrix on the
//! left. The nodes of the spine's column do not move and have no unknowns.

use crate::band::Band;

/// No unknown's number.
const NONE: u32 = u32::MAX;

/// Forces on all nodes and the matrix over those that move, three unknowns
/// each, u fastest.
#[derive(Clone, Debug)]
pub(super) struct System {
    columns: usize,
    first: usize,
    /// Number of the first unknown of each node; that of one that does not move is [`NONE`].
    numbers: Vec<u32>,
    /// Newtons; x, y, z of every node, also of those that do not move.
    pub forces: Vec<f32>,
    /// The lower half of the matrix, N/m.
    pub matrix: Band<f32>,
    unknowns: Vec<f32>,
}

impl System {
    /// A system whose elements reach over at most two rows and `reach` nodes.
    pub fn new(columns: usize, rows: usize, first: usize, reach: usize) -> System {
        let moving = columns - first;
        let order = 3 * moving * rows;
        let number = |node: usize| {
            let (row, column) = (node / columns, node % columns);
            if column < first {
                NONE
            } else {
                (3 * (row * moving + column - first)) as u32
            }
        };
        System {
            columns,
            first,
            numbers: (0..columns * rows).map(number).collect(),
            forces: vec![0.0; 3 * columns * rows],
            // Nodes two rows apart are coupled by bending.
            matrix: Band::new(order, (6 * moving + 3 * reach + 2).min(order - 1)),
            unknowns: vec![0.0; order],
        }
    }

    /// Whether a node moves.
    #[inline(always)]
    pub fn moves(&self, node: usize) -> bool {
        self.numbers[node] != NONE
    }

    /// Number of the first unknown of a node that moves.
    #[inline(always)]
    pub fn unknown(&self, node: usize) -> usize {
        self.numbers[node] as usize
    }

    /// Adds a force, N, to a node.
    #[inline(always)]
    pub fn push(&mut self, node: usize, force: [f32; 3]) {
        for axis in 0..3 {
            self.forces[3 * node + axis] += force[axis];
        }
    }

    /// Adds `k`, N/m, to the three diagonal entries of a node.
    pub fn add_diagonal(&mut self, node: usize, k: f32) {
        let at = self.unknown(node);
        let width = self.matrix.half_bandwidth();
        for axis in 0..3 {
            self.matrix.row_mut(at + axis)[width] += k;
        }
    }

    /// Adds the block a b^T (its lower part, where `node` is `other`) at the row
    /// of `node` and the column of `other`, which is not after it.
    #[inline(always)]
    pub fn add_product(&mut self, node: usize, other: usize, a: [f32; 3], b: [f32; 3]) {
        let (row, column) = (self.unknown(node), self.unknown(other));
        let width = self.matrix.half_bandwidth();
        for i in 0..3 {
            let from = column + width - (row + i);
            let entries = &mut self.matrix.row_mut(row + i)[from..];
            let last = if node == other { i } else { 2 };
            for k in 0..=last {
                entries[k] += a[i] * b[k];
            }
        }
    }

    /// Where in the matrix the block of two nodes is, the second not after the first; the place
    /// before the first row where either does not move.
    pub fn block_place(&self, node: usize, other: usize) -> usize {
        let is_moved = |node: usize| node < self.numbers.len() && self.moves(node);
        if is_moved(node) && is_moved(other) {
            self.matrix.place(self.unknown(node), self.unknown(other))
        } else {
            0
        }
    }

    /// Adds the block `across` times one plus `along` times d d^T of a spring
    /// between nodes `a` and `b` > `a`.
    #[inline(always)]
    pub fn add_spring(&mut self, a: usize, b: usize, d: [f32; 3], along: f32, across: f32) {
        let scaled = d.map(|d| along * d);
        let (moves_a, moves_b) = (self.moves(a), self.moves(b));
        if moves_a {
            self.add_product(a, a, scaled, d);
            self.add_diagonal(a, across);
        }
        if moves_b {
            self.add_product(b, b, scaled, d);
            self.add_diagonal(b, across);
        }
        if moves_a && moves_b {
            self.add_product(b, a, scaled.map(|s| -s), d);
            let (row, column) = (self.unknown(b), self.unknown(a));
            let width = self.matrix.half_bandwidth();
            for axis in 0..3 {
                self.matrix.row_mut(row + axis)[column + width - row] -= across;
            }
        }
    }

    /// Solves for the displacements and adds them to `positions`; returns
    /// whether all is finite, and changes nothing where it is not.
    pub fn solve(&mut self, positions: &mut [f32]) -> bool {
        let (row, skip) = (3 * self.columns, 3 * self.first);
        let moving = row - skip;
        for (to, from) in self
            .unknowns
            .chunks_exact_mut(moving)
            .zip(self.forces.chunks_exact(row))
        {
            to.copy_from_slice(&from[skip..]);
        }
        self.matrix.factorise();
        self.matrix.solve(&mut self.unknowns);
        if !self.unknowns.iter().all(|x| x.is_finite()) {
            return false;
        }
        for (to, from) in positions
            .chunks_exact_mut(row)
            .zip(self.unknowns.chunks_exact(moving))
        {
            for (to, from) in to[skip..].iter_mut().zip(from) {
                *to += from;
            }
        }
        true
    }
}
