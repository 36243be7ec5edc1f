//! The nodes of a leaf, and how its edges are held.

use super::vector::{Vector, advance, cross, difference, length, scale};

/// Marks the node beyond a clamped edge, which follows from the clamp.
pub(super) const GHOST: usize = usize::MAX;

/// A regular grid of nodes, numbered row by row from the foot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mesh {
    pub columns: usize,
    pub rows: usize,
    /// Distance between columns, m.
    pub du: f64,
    /// Distance between rows, m.
    pub dv: f64,
}

impl Mesh {
    pub fn node(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

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

/// The clamps at the spine and at the fore-edge: where there is one, the unit
/// direction in which the leaf would go on beyond that edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clamps {
    pub spine: Option<Vector>,
    pub fore_edge: Option<Vector>,
}

impl Clamps {
    /// Whether the nodes of a column are held by a clamp.
    pub fn hold(&self, column: usize, mesh: &Mesh) -> bool {
        self.beyond(column, mesh).is_some()
    }

    /// Direction beyond a clamped edge column, None elsewhere.
    pub fn beyond(&self, column: usize, mesh: &Mesh) -> Option<Vector> {
        if column == 0 {
            self.spine
        } else if column + 1 == mesh.columns {
            self.fore_edge
        } else {
            None
        }
    }

    /// Place of a node, or where it is a ghost that of the node beyond `edge`.
    pub fn place(&self, node: usize, edge: usize, mesh: &Mesh, x: &[Vector]) -> Vector {
        if node != GHOST {
            return x[node];
        }
        let beyond = self.beyond(edge % mesh.columns, mesh).unwrap_or_default();
        advance(x[edge], mesh.du, beyond)
    }

    /// Factors of the stiffness across each column that make clamped ends exact
    /// to third order: one over the weights of Gregory's rule, relative to those
    /// of the trapezoidal rule. The turn of a leaf between two places is the
    /// integral of moment over stiffness, and this is the better quadrature.
    pub fn end_weights(&self, mesh: &Mesh) -> Vec<f64> {
        let mut weights = vec![1.0; mesh.columns];
        for (i, weight) in [4.0 / 3.0, 6.0 / 7.0, 24.0 / 23.0].into_iter().enumerate() {
            if self.spine.is_some() {
                weights[i] = weight;
            }
            if self.fore_edge.is_some() {
                weights[mesh.columns - 1 - i] = weight;
            }
        }
        weights
    }
}
