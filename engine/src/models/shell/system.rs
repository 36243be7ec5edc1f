//! The linear system of a Newton step: gradient and Hessian of a potential.

use std::collections::BTreeSet;

use super::mesh::Mesh;
use super::vector::{Block, Vector};
use crate::band::Band;

/// Gradient and Hessian over the free nodes. A node that is held keeps a row of
/// the unit matrix, so that its step is zero.
#[derive(Clone, Debug)]
pub(super) struct System {
    matrix: Band<f64>,
    gradient: Vec<f64>,
    /// First of the three rows of each node: numbered along the shorter side,
    /// which makes the band narrow.
    first: Vec<usize>,
    /// Whether each node is held.
    pub held: Vec<bool>,
}

impl System {
    /// A system over all nodes of a grid, none of them held.
    pub fn new(mesh: &Mesh) -> Self {
        let short = mesh.columns.min(mesh.rows);
        let across = mesh.rows < mesh.columns;
        let number = |(column, row): (usize, usize)| {
            3 * if across {
                column * mesh.rows + row
            } else {
                row * mesh.columns + column
            }
        };
        // The furthest apart that any two nodes meet is two cells along both
        // sides: in the hinges over the legs of a triangle.
        let half_bandwidth = (3 * (2 * short + 2) + 2).min(3 * mesh.nodes() - 1);
        Self {
            matrix: Band::new(3 * mesh.nodes(), half_bandwidth),
            gradient: vec![0.0; 3 * mesh.nodes()],
            first: mesh.places().map(number).collect(),
            held: vec![false; mesh.nodes()],
        }
    }

    /// Of nodes that are coupled within groups: numbered from one end of the mesh to the
    /// other, neighbours of a node one after the other, from the node of fewest on
    /// (reverse Cuthill and McKee), which makes the band narrow.
    pub fn coupling<'a>(held: Vec<bool>, groups: impl Iterator<Item = &'a [usize]>) -> Self {
        let nodes = held.len();
        let mut neighbours = vec![BTreeSet::new(); nodes];
        for group in groups {
            let free: Vec<usize> = group.iter().copied().filter(|node| !held[*node]).collect();
            for &node in &free {
                neighbours[node].extend(free.iter().copied());
            }
        }
        let order = cuthill_mckee(&neighbours);
        let mut first = vec![0; nodes];
        for (number, &node) in order.iter().rev().enumerate() {
            first[node] = 3 * number;
        }
        let widths = neighbours.iter().zip(&first).flat_map(|(others, here)| {
            let apart = |other: &usize| here.abs_diff(first[*other]);
            others.iter().map(apart).collect::<Vec<_>>()
        });
        let half_bandwidth = (widths.fold(0, usize::max) + 2).min(3 * nodes - 1);
        Self {
            matrix: Band::new(3 * nodes, half_bandwidth),
            gradient: vec![0.0; 3 * nodes],
            first,
            held,
        }
    }

    /// Zero, but for the ones of held nodes.
    pub fn clear(&mut self) {
        self.gradient.fill(0.0);
        self.matrix.clear();
        for (&first, &held) in self.first.iter().zip(&self.held) {
            if held {
                for row in first..first + 3 {
                    self.matrix.add(row, row, 1.0);
                }
            }
        }
    }

    /// Adds the derivative of the potential by a node's place.
    pub fn add_gradient(&mut self, node: usize, gradient: Vector) {
        if !self.held[node] {
            let first = self.first[node];
            for axis in 0..3 {
                self.gradient[first + axis] += gradient[axis];
            }
        }
    }

    /// Whether the block of two nodes lies in the half that is kept. Elements
    /// offer both (a, b) and (b, a).
    pub fn wants(&self, a: usize, b: usize) -> bool {
        self.first[a] >= self.first[b] && !self.held[a] && !self.held[b]
    }

    /// Adds the second derivative by the places of two nodes, if it is wanted.
    pub fn add_block(&mut self, a: usize, b: usize, block: Block) {
        if !self.wants(a, b) {
            return;
        }
        let (row, column) = (self.first[a], self.first[b]);
        for i in 0..3 {
            let columns = if a == b { i + 1 } else { 3 };
            for j in 0..columns {
                self.matrix.add(row + i, column + j, block[i][j]);
            }
        }
    }

    /// Adds the same second derivative for all three axes, if it is wanted.
    pub fn add_scalar(&mut self, a: usize, b: usize, value: f64) {
        if self.wants(a, b) {
            for axis in 0..3 {
                let (row, column) = (self.first[a] + axis, self.first[b] + axis);
                self.matrix.add(row, column, value);
            }
        }
    }

    /// Factorises the Hessian. Returns whether it is positive definite.
    pub fn factorise(&mut self) -> bool {
        self.matrix.factorise() == 0
    }

    /// The Newton step of each node, and the derivative of the potential along it.
    pub fn newton_step(&self) -> (Vec<Vector>, f64) {
        let mut step: Vec<f64> = self.gradient.iter().map(|g| -g).collect();
        self.matrix.solve(&mut step);
        let slope = step.iter().zip(&self.gradient).map(|(s, g)| s * g).sum();
        (self.by_node(&step), slope)
    }

    /// The solution of the factorised Hessian for a force on each node.
    pub fn solve(&self, forces: &[Vector]) -> Vec<Vector> {
        let mut solution = vec![0.0; self.gradient.len()];
        for ((&first, force), held) in self.first.iter().zip(forces).zip(&self.held) {
            if !held {
                solution[first..first + 3].copy_from_slice(force);
            }
        }
        self.matrix.solve(&mut solution);
        self.by_node(&solution)
    }

    /// The derivative of the potential by the place of each node.
    pub fn gradient(&self) -> Vec<Vector> {
        self.by_node(&self.gradient)
    }

    fn by_node(&self, values: &[f64]) -> Vec<Vector> {
        let of = |&first: &usize| [values[first], values[first + 1], values[first + 2]];
        self.first.iter().map(of).collect()
    }
}

/// Nodes in layers from one that lies at an end of the mesh.
fn cuthill_mckee(neighbours: &[BTreeSet<usize>]) -> Vec<usize> {
    let from = |start: usize| {
        let mut order = vec![start];
        let mut known = vec![false; neighbours.len()];
        known[start] = true;
        let mut next = 0;
        while next < order.len() {
            let mut others: Vec<usize> = neighbours[order[next]].iter().copied().collect();
            others.retain(|other| !known[*other]);
            others.sort_by_key(|other| neighbours[*other].len());
            for other in others {
                known[other] = true;
                order.push(other);
            }
            next += 1;
        }
        order
    };
    let mut order = Vec::with_capacity(neighbours.len());
    let mut known = vec![false; neighbours.len()];
    // Each part of the mesh for itself. What is reached last from anywhere lies at an end.
    for node in 0..neighbours.len() {
        if !known[node] {
            let mut part = from(node);
            for _ in 0..2 {
                part = from(part[part.len() - 1]);
            }
            for &node in &part {
                known[node] = true;
            }
            order.extend(part);
        }
    }
    order
}
