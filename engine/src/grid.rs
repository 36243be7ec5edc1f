//! A rectangular grid of nodes in padded flat arrays, one array an axis.

use crate::lanes::ROW_LANES;

/// Side of the spine on which a leaf rests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// x below 0.
    Left,
    /// x above 0.
    Right,
}

impl Side {
    /// The other side.
    pub const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// -1 on the left, 1 on the right.
    pub const fn sign(self) -> f32 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// The feet at the spine of the cells of a grid, each cell's first node, row by row.
pub(crate) fn cells(columns: usize, rows: usize) -> impl Iterator<Item = usize> {
    (0..columns * (rows - 1)).filter(move |node| node % columns + 1 < columns)
}

/// The two triangles of the cell of a foot, cut along the diagonal that begins there, or if
/// `is_falling` along the other. Their corners go around as u to v does.
#[inline]
pub(crate) fn cut_cell(foot: usize, columns: usize, is_falling: bool) -> [[usize; 3]; 2] {
    let head = foot + columns;
    if is_falling {
        [[foot, foot + 1, head], [foot + 1, head + 1, head]]
    } else {
        [[foot, foot + 1, head + 1], [foot, head + 1, head]]
    }
}

/// Numbers of nodes and the size of the leaf that they cover, evenly spaced.
///
/// Arrays over the grid hold it row by row from the foot, each row from the
/// spine to the fore-edge and padded to a multiple of eight lanes; eight more
/// lanes at the end let a shifted read of the last row stay inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Nodes from the spine to the fore-edge, at least 2.
    pub columns: usize,
    /// Nodes from the foot to the head, at least 2.
    pub rows: usize,
    /// From the spine to the fore-edge, in the model's unit of length.
    pub width: f32,
    /// From the foot to the head, likewise.
    pub height: f32,
    /// Lanes from one row to the next.
    pub stride: usize,
}

impl Grid {
    /// A grid of `columns` x `rows` nodes over a leaf of that size.
    pub fn new(columns: usize, rows: usize, width: f32, height: f32) -> Self {
        let stride = columns.next_multiple_of(ROW_LANES);
        Self {
            columns,
            rows,
            width,
            height,
            stride,
        }
    }

    /// Lanes that belong to rows.
    pub fn lanes(&self) -> usize {
        self.rows * self.stride
    }

    /// Length of an array over the grid.
    pub fn padded(&self) -> usize {
        self.lanes() + ROW_LANES
    }

    /// Distance between columns, in the unit of the width.
    pub fn du(&self) -> f32 {
        self.width / (self.columns - 1) as f32
    }

    /// Distance between rows, likewise.
    pub fn dv(&self) -> f32 {
        self.height / (self.rows - 1) as f32
    }

    /// Lane of the node in `column` and `row`.
    pub fn lane(&self, column: usize, row: usize) -> usize {
        row * self.stride + column
    }

    /// Lanes of all nodes, row by row.
    pub fn node_lanes(&self) -> impl Iterator<Item = usize> + use<> {
        let (columns, stride) = (self.columns, self.stride);
        (0..self.rows).flat_map(move |row| row * stride..row * stride + columns)
    }

    /// An array over the grid, padded, of zeros.
    pub fn zeros(&self) -> Vec<f32> {
        vec![0.0; self.padded()]
    }

    /// Three such arrays: for x, y and z.
    pub fn zeros3(&self) -> [Vec<f32>; 3] {
        [self.zeros(), self.zeros(), self.zeros()]
    }

    /// Where each node of a flat leaf rests on one side of the spine: x, y, z in the unit of the width.
    pub fn rest(&self, side: Side) -> [Vec<f32>; 3] {
        let mut rest = self.zeros3();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let lane = self.lane(column, row);
                rest[0][lane] = side.sign() * (column as f32 * self.du());
                rest[1][lane] = row as f32 * self.dv();
            }
        }
        rest
    }

    /// Share of a cell's area that belongs to a node: 1 inside, 1/2 at an edge,
    /// 1/4 at a corner.
    pub fn area_fraction(&self, column: usize, row: usize) -> f32 {
        let half = |i: usize, count: usize| if i == 0 || i + 1 == count { 0.5 } else { 1.0 };
        half(column, self.columns) * half(row, self.rows)
    }

    /// Copies nodes out as x, y, z of each, without the padding.
    pub fn interleave(&self, axes: &[Vec<f32>; 3], out: &mut [f32]) {
        assert_eq!(out.len(), 3 * self.columns * self.rows, "3 floats a node");
        for (lane, out) in self.node_lanes().zip(out.chunks_exact_mut(3)) {
            for axis in 0..3 {
                out[axis] = axes[axis][lane];
            }
        }
    }

    /// Copies x, y, z of each node in.
    pub fn deinterleave(&self, from: &[f32], axes: &mut [Vec<f32>; 3]) {
        assert_eq!(from.len(), 3 * self.columns * self.rows, "3 floats a node");
        for (lane, from) in self.node_lanes().zip(from.chunks_exact(3)) {
            for axis in 0..3 {
                axes[axis][lane] = from[axis];
            }
        }
    }
}
