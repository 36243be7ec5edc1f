//! The grid of a page that is torn along a path: two four-sided grids that meet there.
//!
//! The nodes of the path are there twice, once for each piece, in two rows one after the
//! other between which there are no cells. So one sheet has both pieces, with the same rows
//! and columns for solver and sweeps, and is two sheets once nothing ties those rows. Each
//! piece is mapped onto its rectangle of nodes from its four sides (Coons 1967).

use super::flat::{Place, length, twice_area};
use super::piece_outline::Outline;
use super::torn_path::{even_stations, onto_edge, places_along, smooth, strayed};

/// Fewest and most columns: the path's nodes, no farther apart than paper needs to bend along
/// it, and no more than a frame has time for.
const COLUMNS: [usize; 2] = [6, 16];

/// Fewest and most rows of a piece: a sheet has at least four.
const ROWS: [usize; 2] = [4, 14];

/// Least area of a triangle, over that of half a mean cell: cells of a small piece are small.
const LEAST_AREA: f64 = 0.02;

/// How a page's places are counted along the path and across it: as they are, or turned by a
/// quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Width and height of the page, metres.
    page: [f64; 2],
    /// Whether it is turned clockwise by a quarter: u of the frame is v of the page.
    is_turned: bool,
}

impl Frame {
    /// Width and height of the page in the frame, metres.
    pub fn size(self) -> [f64; 2] {
        let [width, height] = self.page;
        if self.is_turned {
            [height, width]
        } else {
            self.page
        }
    }

    /// Whether u of the frame is v of the page.
    pub fn is_turned(self) -> bool {
        self.is_turned
    }

    /// Returns u and v in the frame of a place at u and v of the page.
    pub fn of_page(self, [u, v]: [f32; 2]) -> [f32; 2] {
        if self.is_turned { [v, 1.0 - u] } else { [u, v] }
    }

    /// Returns u and v on the page of a place in the frame, metres.
    pub fn on_page(self, place: Place) -> [f64; 2] {
        let size = self.size();
        let [u, v] = [0, 1].map(|axis| place[axis] / size[axis]);
        if self.is_turned { [1.0 - v, u] } else { [u, v] }
    }

    fn metres_of_page(self, [u, v]: [f64; 2]) -> Place {
        let [width, height] = self.size();
        if self.is_turned {
            [v * width, (1.0 - u) * height]
        } else {
            [u * width, v * height]
        }
    }
}

/// The grid of a page that is torn along a path.
#[derive(Clone, Debug)]
pub(crate) struct TornGrid {
    /// How its page's places are counted.
    pub frame: Frame,
    /// The path from one edge to another, along rising u of the frame, metres: as a hand tears
    /// along it.
    pub path: Vec<Place>,
    /// Whether it is torn from the end of the path, and not from its beginning.
    pub is_from_end: bool,
    /// The path from where it is torn on, as a hand would tear that did not stray, metres.
    pub course: Vec<Place>,
    /// How far along the path its nodes lie, metres; None where they do evenly.
    pub stations: Option<Vec<f64>>,
    /// About how wide cells are on this page, metres.
    pub spacing: f64,
    /// How far apart the nodes of its path were at first, metres.
    pub opening_spacing: f64,
    /// Nodes along the path.
    pub columns: usize,
    /// Rows of the piece at the foot, on the right of the path, and of the one at the head.
    pub rows: [usize; 2],
    /// Where the nodes lie in the frame, metres, row by row from the foot.
    pub places: Vec<Place>,
    /// Diagonals of cells that are cut along them alone: in their corners the paper goes
    /// straight on.
    pub diagonals: Vec<[usize; 2]>,
}

impl TornGrid {
    /// The grid of a page of a size, metres, that is torn along a path, u and v of places on the
    /// page each 0 to 1, from the edge next to the first to the edge next to the last. Cells are
    /// about `cell` metres wide.
    ///
    /// None where the path has fewer than two places or leaves the page, both its ends lie on one
    /// edge, or a piece is narrower than a cell or more crooked than a grid can be.
    pub fn new(page: [f64; 2], path: &[[f64; 2]], cell: f64) -> Option<Self> {
        let is_on_page = |at: &f64| (0.0..=1.0).contains(at);
        if path.len() < 2 || !path.as_flattened().iter().all(is_on_page) {
            return None;
        }
        let upright = Frame {
            page,
            is_turned: false,
        };
        let [from, to] = [path[0], path[path.len() - 1]].map(|at| upright.metres_of_page(at));
        let frame = Frame {
            is_turned: (to[1] - from[1]).abs() > (to[0] - from[0]).abs(),
            ..upright
        };
        let size = frame.size();
        let mut path: Vec<Place> = path.iter().map(|at| frame.metres_of_page(*at)).collect();
        let last = path.len() - 1;
        for end in [0, last] {
            path[end] = onto_edge(path[end], size);
        }
        let is_from_end = path[last][0] < path[0][0];
        if is_from_end {
            path.reverse();
        }
        let smoothed = smooth(path);
        let path = strayed(&smoothed, size);
        let mut course = smoothed;
        if is_from_end {
            course.reverse();
        }
        let outlines = Outline::of_both(&path, size)?;
        let cells = |length: f64| libm::round(length / cell) as usize + 1;
        let along = length(&path) + length(&outlines[0].far) + length(&outlines[1].far);
        let columns = cells(along / 3.0).clamp(COLUMNS[0], COLUMNS[1]);
        let rows = [0, 1].map(|piece| cells(outlines[piece].across()).clamp(ROWS[0], ROWS[1]));
        let grid = Self {
            frame,
            is_from_end,
            course,
            stations: None,
            spacing: cell,
            opening_spacing: length(&path) / (columns - 1) as f64,
            columns,
            rows,
            places: Vec::new(),
            diagonals: Vec::new(),
            path,
        };
        grid.mapped(&outlines)
    }

    /// The same with the nodes of its path, which follows from it and from the sides of the pieces.
    /// None where both ends of the path lie on one edge, or a piece is narrower than a cell or more
    /// crooked than a grid can be.
    pub(super) fn over_page(self) -> Option<Self> {
        let outlines = Outline::of_both(&self.path, self.frame.size())?;
        self.mapped(&outlines)
    }

    /// The same with its nodes where its path has them. None where a piece is narrower than a
    /// cell or more crooked than a grid can be.
    fn mapped(mut self, outlines: &[Outline; 2]) -> Option<Self> {
        if outlines.iter().any(|piece| piece.across() < self.spacing) {
            return None;
        }
        let (columns, rows) = (self.columns, self.rows);
        let near = places_along(&self.path, &self.stations());
        let [foot, head] = [0, 1].map(|piece| outlines[piece].map(&near, rows[piece]));
        // From the foot up: the foot's rows come from its far side to the path.
        let rows_up = foot.chunks(columns).rev().chain(head.chunks(columns));
        self.places = rows_up.flatten().copied().collect();
        let top = columns * (rows[0] + rows[1] - 1);
        let [low, high] = [&outlines[0], &outlines[1]].map(|outline| outline.straight);
        self.diagonals.clear();
        self.diagonals.extend(low.map(|is_right| {
            let corner = if is_right { columns - 1 } else { 0 };
            [
                corner,
                if is_right {
                    2 * columns - 2
                } else {
                    columns + 1
                },
            ]
        }));
        self.diagonals.extend(high.map(|is_right| {
            let corner = if is_right { top + columns - 1 } else { top };
            [
                corner - columns - usize::from(is_right) + usize::from(!is_right),
                corner,
            ]
        }));
        self.is_sound().then_some(self)
    }

    /// How far along the path each of its nodes lies, metres.
    pub(super) fn stations(&self) -> Vec<f64> {
        let even = || even_stations(length(&self.path), self.columns);
        self.stations.clone().unwrap_or_else(even)
    }

    /// The length of path that belongs to each of its nodes where they lie evenly on it, metres:
    /// half of the way to either neighbour.
    pub fn lengths(&self) -> Vec<f64> {
        let step = length(&self.path) / (self.columns - 1) as f64;
        let ends = [0, self.columns - 1];
        let part = |column: usize| if ends.contains(&column) { 0.5 } else { 1.0 };
        (0..self.columns)
            .map(|column| part(column) * step)
            .collect()
    }

    /// Mean sides of its cells, metres.
    pub fn cell(&self) -> [f64; 2] {
        let count = (self.columns - 1) as f64;
        let row = |row: usize| length(&self.places[row * self.columns..(row + 1) * self.columns]);
        let rows = self.rows[0] + self.rows[1];
        let along: f64 = (0..rows).map(row).sum::<f64>() / rows as f64;
        let [width, height] = self.frame.size();
        let area = width * height / (count * (rows - 2) as f64);
        [along / count, area * count / along]
    }

    /// Area of all its cells, m^2.
    #[cfg(test)]
    pub fn area(&self) -> f64 {
        let columns = self.columns;
        let feet = (0..columns * (self.rows[0] + self.rows[1] - 1))
            .filter(|foot| (foot + 1) % columns != 0 && foot / columns + 1 != self.rows[0]);
        let of = |foot: usize| {
            let nodes = [foot, foot + 1, foot + columns + 1, foot + columns];
            let [a, b, c, d] = nodes.map(|node| self.places[node]);
            twice_area(a, b, c).midpoint(twice_area(a, c, d))
        };
        feet.map(of).sum()
    }

    /// Whether no cell is turned over or nearly flat, whichever way it is cut.
    fn is_sound(&self) -> bool {
        let columns = self.columns;
        let [width, height] = self.frame.size();
        let cells = (columns - 1) * (self.rows[0] + self.rows[1] - 2);
        let least = LEAST_AREA * width * height / cells as f64;
        let mut feet = (0..columns * (self.rows[0] + self.rows[1] - 1))
            .filter(|foot| (foot + 1) % columns != 0 && foot / columns + 1 != self.rows[0]);
        feet.all(|foot| {
            let [a, b, c, d] = [foot, foot + 1, foot + columns, foot + columns + 1];
            let rising = [[a, b, d], [a, d, c]];
            let falling = [[a, b, c], [b, d, c]];
            let ways = match self
                .diagonals
                .iter()
                .find(|edge| **edge == [a, d] || **edge == [b, c])
            {
                Some(edge) if *edge == [a, d] => [rising, rising],
                Some(_) => [falling, falling],
                None => [rising, falling],
            };
            ways.as_flattened().iter().all(|corners| {
                let [a, b, c] = corners.map(|node| self.places[node]);
                twice_area(a, b, c) > least
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::flat::distance;
    use super::super::torn_path::POINTS;
    use super::*;

    const PAGE: [f64; 2] = [0.148, 0.21];
    const CELL: f64 = 0.0164;

    /// Area of the cells of rows of a grid, m^2.
    fn area(grid: &TornGrid, rows: core::ops::Range<usize>) -> f64 {
        let columns = grid.columns;
        let feet = rows.flat_map(|row| (0..columns - 1).map(move |k| row * columns + k));
        let of = |foot: usize| {
            let nodes = [foot, foot + 1, foot + columns + 1, foot + columns];
            let [a, b, c, d] = nodes.map(|node| grid.places[node]);
            0.5 * (twice_area(a, b, c) + twice_area(a, c, d))
        };
        feet.map(of).sum()
    }

    #[test]
    fn pieces_fill_the_page() {
        for (from, to) in [
            ([0.0, 0.5], [1.0, 0.5]),
            ([1.0, 0.3], [0.0, 0.7]),
            ([0.4, 1.0], [0.6, 0.0]),
            ([0.0, 0.4], [0.5, 0.0]),
            ([0.5, 0.0], [0.0, 0.4]),
            ([0.6, 1.0], [1.0, 0.7]),
            ([0.0, 0.9], [0.3, 0.0]),
            ([1.0, 0.2], [0.2, 1.0]),
            ([0.0, 0.0], [1.0, 1.0]),
        ] {
            let grid = TornGrid::new(PAGE, &[from, to], CELL);
            let grid = grid.unwrap_or_else(|| panic!("{from:?} to {to:?}"));
            let [foot, head] = grid.rows;
            assert_eq!(grid.places.len(), grid.columns * (foot + head));
            let areas = [area(&grid, 0..foot - 1), area(&grid, foot..foot + head - 1)];
            let all = PAGE[0] * PAGE[1];
            // Nodes on the path cut its bends.
            let off = (areas[0] + areas[1]) / all - 1.0;
            assert!(off.abs() < 1e-9, "{from:?} to {to:?}: {off}");
            assert!(areas.iter().all(|area| *area > 0.02 * all), "{areas:?}");
            for column in 0..grid.columns {
                let [low, high] =
                    [foot - 1, foot].map(|row| grid.places[row * grid.columns + column]);
                assert_eq!(low, high);
            }
            let first = if grid.is_from_end { POINTS - 1 } else { 0 };
            let at = grid.frame.on_page(grid.path[first]);
            assert!(distance(at, from) < 1e-12, "{at:?} for {from:?}");
        }
    }

    #[test]
    fn a_bent_path_is_followed() {
        let path = [[0.0, 0.4], [0.5, 0.6], [1.0, 0.4]];
        let grid = TornGrid::new(PAGE, &path, CELL).unwrap();
        let highest = grid.path.iter().fold(0.0, |most: f64, [_, y]| most.max(*y));
        assert!((0.53..0.6).contains(&(highest / PAGE[1])), "{highest}");
        assert!((grid.lengths().iter().sum::<f64>() / length(&grid.path) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_path_across_the_page_is_rejected() {
        for path in [
            vec![],
            vec![[0.0, 0.5]],
            vec![[0.0, 0.5], [1.2, 0.5]],
            vec![[0.0, f64::NAN], [1.0, 0.5]],
            // Along an edge, or from it back to it.
            vec![[0.0, 0.3], [0.0, 0.8]],
            vec![[0.2, 0.0], [0.5, 0.4], [0.8, 0.0]],
            // Narrower than a cell.
            vec![[0.0, 0.97], [1.0, 0.97]],
            vec![[0.0, 0.5], [0.0, 0.5]],
        ] {
            assert!(TornGrid::new(PAGE, &path, CELL).is_none(), "{path:?}");
        }
    }
}
