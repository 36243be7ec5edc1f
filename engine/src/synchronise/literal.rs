//! The paper's text word for word: groups of masses by their distance from a line that
//! is taken anew at each step.

use crate::grid::Grid;

/// How far a mass is from its rest before it counts as moved, and how much the
/// distances of one group differ, over the spacing of the masses.
const LITERAL_TOLERANCE: f32 = 0.01;

/// Moves every mass by the mean displacement of those at its distance from the
/// dog-ear line; none where no mass of the free edges has moved.
pub(super) fn synchronise(grid: &Grid, rest: &[Vec<f32>; 3], position: &mut [Vec<f32>; 3]) {
    let tolerance = LITERAL_TOLERANCE * grid.du().min(grid.dv());
    let Some([from, to]) = dog_ear_line(grid, rest, position, tolerance) else {
        return;
    };
    let place = |lane: usize| [rest[0][lane], rest[1][lane]];
    let [[x0, y0], [x1, y1]] = [place(from), place(to)];
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = (dx * dx + dy * dy).sqrt();
    let mut masses: Vec<(f32, usize)> = grid
        .node_lanes()
        .map(|lane| {
            let [x, y] = place(lane);
            ((dx * (y - y0) - dy * (x - x0)) / length, lane)
        })
        .collect();
    masses.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for group in masses.chunk_by(|a, b| b.0 - a.0 < tolerance) {
        for axis in 0..3 {
            let (rest, position) = (&rest[axis], &mut position[axis]);
            let sum = group
                .iter()
                .fold(0.0, |sum, &(_, lane)| sum + (position[lane] - rest[lane]));
            let mean = sum / group.len() as f32;
            for &(_, lane) in group {
                position[lane] = rest[lane] + mean;
            }
        }
    }
}

/// The end points of the dog-ear line, if a mass of the free edges has moved.
fn dog_ear_line(
    grid: &Grid,
    rest: &[Vec<f32>; 3],
    position: &[Vec<f32>; 3],
    tolerance: f32,
) -> Option<[usize; 2]> {
    let foot = (0..grid.columns).map(|column| (column, 0));
    let fore_edge = (1..grid.rows - 1).map(|row| (grid.columns - 1, row));
    let head = (0..grid.columns)
        .rev()
        .map(|column| (column, grid.rows - 1));
    let way: Vec<usize> = foot
        .chain(fore_edge)
        .chain(head)
        .map(|(column, row)| grid.lane(column, row))
        .collect();
    let has_moved = |&lane: &usize| {
        let square = |axis: usize| {
            let d = position[axis][lane] - rest[axis][lane];
            d * d
        };
        square(0) + square(1) + square(2) > tolerance * tolerance
    };
    let first = way.iter().position(has_moved)?;
    let last = way.iter().rposition(has_moved)?;
    let [from, to] = [first.saturating_sub(1), (last + 1).min(way.len() - 1)];
    Some([way[from], way[to]])
}
