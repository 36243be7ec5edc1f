//! What draws a crumpled sheet: flat facets between its nodes.
//!
//! A cell whose sides keep their lengths folds along the diagonal that stays as long as it
//! was; the other one shrinks. So a cell is drawn as four triangles about the middle of the
//! longer diagonal: two and two of them are flat, whichever way it folds, and the mesh stays
//! the same.

use crate::grid::{cells, cut_cell};
use crate::paper_mesh::PaperMesh;
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

/// How such a mesh of `columns` x `rows` points, both odd, lies on its flat paper: each facet, the
/// two triangles next to a side of a cell of the nodes, has a part of its own, so that light
/// breaks at its edges.
pub(super) fn mesh(columns: usize, rows: usize) -> PaperMesh {
    let even = |at: usize, points: usize| at as f32 / (points - 1) as f32;
    let mut mesh = PaperMesh {
        places: (0..columns * rows)
            .map(|point| [even(point % columns, columns), even(point / columns, rows)])
            .collect(),
        ..PaperMesh::default()
    };
    for foot in cells(columns, rows) {
        let [column, row] = [foot % columns, foot / columns];
        // The nodes' cell that it is a quarter of, and the middle of that.
        let cell = (row / 2) * (columns / 2) + column / 2;
        let middle = [column, row].map(|at| at as i32 | 1);
        // Each is cut along the diagonal that goes to that middle.
        for corners in cut_cell(foot, columns, (column + row) % 2 == 1) {
            // From there to the side that a triangle lies next to is farther than along it.
            let [across, up] = corners.iter().fold([0, 0], |[across, up], corner| {
                let [column, row] = [corner % columns, corner / columns].map(|at| at as i32);
                [across + column - middle[0], up + row - middle[1]]
            });
            let side = if up.abs() > across.abs() {
                1 + up.signum()
            } else {
                2 - across.signum()
            };
            mesh.triangles.push(corners.map(|corner| corner as u32));
            // Part 0 is what is not folded over, which no facet is.
            mesh.parts.push((4 * cell + side as usize + 1) as u16);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn facets_cover_the_sheet_once_four_to_a_cell_each_with_a_part_of_its_own() {
        let mesh = mesh(7, 5);
        let mut areas: BTreeMap<u16, f32> = BTreeMap::new();
        for (corners, part) in mesh.parted_triangles() {
            let [a, b, c] = corners.map(|corner| mesh.places[corner]);
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            // Around as u to v does.
            assert!(twice > 0.0);
            *areas.entry(part).or_default() += 0.5 * twice;
            // Each reaches the middle of a cell of the nodes.
            let is_middle = |corner: usize| corner % 7 % 2 == 1 && corner / 7 % 2 == 1;
            assert_eq!(corners.into_iter().filter(|at| is_middle(*at)).count(), 1);
        }
        assert_eq!(
            areas.keys().copied().collect::<Vec<_>>(),
            (1..=24).collect::<Vec<_>>()
        );
        assert!(areas.values().all(|area| (area - 1.0 / 24.0).abs() < 1e-6));
    }
}
