//! What draws a crumpled sheet: flat facets between its nodes.
//!
//! A cell whose sides keep their lengths folds along the diagonal that stays as long as it
//! was; the other one shrinks. So a cell is drawn as four triangles about the middle of the
//! longer diagonal: two and two of them are flat, whichever way it folds, and the mesh stays
//! the same.

use crate::vector::{dot, sub};

/// Points along a side of a mesh of facets over so many nodes: the nodes, and one between two.
pub(super) const fn points(nodes: usize) -> usize {
    2 * nodes - 1
}

/// Writes the points of the facets over a grid of `columns` x `rows` nodes: x, y, z of each,
/// row by row from the foot.
pub(super) fn write(columns: usize, rows: usize, nodes: &[f32], out: &mut [f32]) {
    let (x, out) = (nodes.as_chunks::<3>().0, out.as_chunks_mut::<3>().0);
    let middle = |a: usize, b: usize| core::array::from_fn(|axis| x[a][axis].midpoint(x[b][axis]));
    for (point, place) in out.iter_mut().enumerate() {
        let (i, j) = (point % points(columns), point / points(columns));
        let foot = (j / 2) * columns + i / 2;
        *place = match (i % 2, j % 2) {
            (0, 0) => x[foot],
            (1, 0) => middle(foot, foot + 1),
            (0, _) => middle(foot, foot + columns),
            _ => {
                let head = foot + columns;
                let [rising, falling] = [[foot, head + 1], [foot + 1, head]];
                let square = |[a, b]: [usize; 2]| {
                    let d = sub(x[b], x[a]);
                    dot(d, d)
                };
                let [a, b] = if square(rising) >= square(falling) {
                    rising
                } else {
                    falling
                };
                middle(a, b)
            }
        };
    }
    debug_assert_eq!(out.len(), points(columns) * points(rows));
}
