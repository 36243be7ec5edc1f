//! The nodes of a leaf.

use super::vector::{Vector, cross, difference, length, scale};

/// A regular grid of nodes, numbered row by row from the foot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mesh {
    /// Nodes from the spine to the fore-edge.
    pub columns: usize,
    /// Nodes from the foot to the head.
    pub rows: usize,
    /// Distance between columns, m.
    pub du: f64,
    /// Distance between rows, m.
    pub dv: f64,
}

impl Mesh {
    /// Number of the node in a column and a row.
    pub fn node(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// How many nodes there are.
    pub fn nodes(&self) -> usize {
        self.columns * self.rows
    }

    /// Columns and rows of all nodes, by number.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (columns, rows) = (self.columns, self.rows);
        (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
    }

    /// Columns and rows of the foot corner by the spine of each cell.
    pub fn cells(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (columns, rows) = (self.columns - 1, self.rows - 1);
        (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
    }

    /// Width that belongs to a column, m.
    pub fn width_at(&self, column: usize) -> f64 {
        self.du * half_at_ends(column, self.columns)
    }

    /// Height that belongs to a row, m.
    pub fn height_at(&self, row: usize) -> f64 {
        self.dv * half_at_ends(row, self.rows)
    }

    /// Derivatives of the place by u and by v in metres at a node: central
    /// differences, one-sided at the edges.
    pub fn tangents(&self, column: usize, row: usize, x: &[Vector]) -> [Vector; 2] {
        let (left, right) = neighbours(column, self.columns);
        let (below, above) = neighbours(row, self.rows);
        let between =
            |from: usize, to: usize, apart: f64| scale(1.0 / apart, difference(x[to], x[from]));
        let (du, dv) = (
            (right - left) as f64 * self.du,
            (above - below) as f64 * self.dv,
        );
        [
            between(self.node(left, row), self.node(right, row), du),
            between(self.node(column, below), self.node(column, above), dv),
        ]
    }

    /// Unit normal at each node.
    pub fn normals(&self, x: &[Vector]) -> Vec<Vector> {
        let normal = |(column, row): (usize, usize)| {
            let [u, v] = self.tangents(column, row, x);
            let n = cross(u, v);
            scale(1.0 / length(n).max(f64::MIN_POSITIVE), n)
        };
        self.places().map(normal).collect()
    }
}

fn half_at_ends(i: usize, count: usize) -> f64 {
    if i == 0 || i + 1 == count { 0.5 } else { 1.0 }
}

fn neighbours(i: usize, count: usize) -> (usize, usize) {
    (i.saturating_sub(1), (i + 1).min(count - 1))
}
