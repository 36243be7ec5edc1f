//! The nodes of a sheet as four at a time are worked on: a list for each coordinate, by rows.
//!
//! Rows are filled up until the columns that move, and all columns, are groups of four, and
//! so are the rows. What fills them up never moves: each node is 1 from the next in its row
//! and its column.

/// Places of nodes, metres.
#[derive(Clone, Debug)]
pub(super) struct LaneNodes {
    columns: usize,
    /// Nodes from one row to the next.
    pub stride: usize,
    /// x, y and z of the nodes, a list each.
    pub axes: [Vec<f32>; 3],
}

impl LaneNodes {
    /// Nodes of which those in columns before `first` do not move.
    pub fn new(columns: usize, rows: usize, first: usize) -> Self {
        let stride =
            (first + (columns - first).next_multiple_of(4)).max(columns.next_multiple_of(4));
        // The last group of cells is loaded with the nodes beside it.
        let count = stride * rows.next_multiple_of(4) + 4;
        let fill = |of: fn(usize, usize) -> usize| {
            (0..count)
                .map(|at| of(at % stride, at / stride) as f32)
                .collect()
        };
        Self {
            columns,
            stride,
            axes: [fill(|column, _| column), fill(|_, row| row), fill(|_, _| 0)],
        }
    }

    /// How many numbers each list has.
    pub fn len(&self) -> usize {
        self.axes[0].len()
    }

    /// Where a node is in the lists.
    pub fn at(&self, node: usize) -> usize {
        node / self.columns * self.stride + node % self.columns
    }

    /// Where the nodes of a pair are.
    pub fn pair(&self, nodes: [usize; 2]) -> [usize; 2] {
        nodes.map(|node| self.at(node))
    }

    /// Takes over x, y, z of every node.
    pub fn read(&mut self, positions: &[f32]) {
        let [x, y, z] = &mut self.axes;
        let axes = x
            .chunks_mut(self.stride)
            .zip(y.chunks_mut(self.stride))
            .zip(z.chunks_mut(self.stride));
        for (row, ((x, y), z)) in positions.chunks_exact(3 * self.columns).zip(axes) {
            let axes = x.iter_mut().zip(y).zip(z);
            for ([own_x, own_y, own_z], ((x, y), z)) in row.as_chunks::<3>().0.iter().zip(axes) {
                (*x, *y, *z) = (*own_x, *own_y, *own_z);
            }
        }
    }

    /// Writes x, y, z of every node.
    pub fn write(&self, positions: &mut [f32]) {
        let [x, y, z] = &self.axes;
        let axes = x
            .chunks(self.stride)
            .zip(y.chunks(self.stride))
            .zip(z.chunks(self.stride));
        for (row, ((x, y), z)) in positions.chunks_exact_mut(3 * self.columns).zip(axes) {
            let axes = x.iter().zip(y).zip(z);
            for (own, ((x, y), z)) in row.as_chunks_mut::<3>().0.iter_mut().zip(axes) {
                *own = [*x, *y, *z];
            }
        }
    }

    /// The place of a node.
    #[inline(always)]
    pub fn get(&self, at: usize) -> [f32; 3] {
        let [x, y, z] = &self.axes;
        [x[at], y[at], z[at]]
    }

    /// Moves a node along a direction times `far`.
    #[inline(always)]
    pub fn shift(&mut self, at: usize, far: f32, direction: [f32; 3]) {
        for (axis, direction) in self.axes.iter_mut().zip(direction) {
            axis[at] += far * direction;
        }
    }
}
