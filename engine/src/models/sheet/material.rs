//! Where a sheet's nodes lie on the flat paper.
//!
//! On a sheet without creases they are spaced evenly. A crease runs along edges and
//! diagonals of cells, whose nodes are moved onto its line; the others follow so that
//! cells change as little as they can ([`creased_grid`](super::creased_grid)). The grid itself stays: the same nodes in the
//! same rows, for contacts, grabs and drawing.

use super::flat::{distance, twice_area, weights};
use super::settings::{CAN_CREASE, CAN_TEAR, SheetSettings};
use crate::grid::cut_cell;
use core::ops::Range;

/// The nodes on the flat paper, and where it is creased.
#[derive(Clone, Debug)]
pub(super) struct Material {
    /// Nodes along a row.
    pub columns: usize,
    /// Rows, from the foot.
    pub rows: usize,
    /// Metres along u and v, row by row.
    pub places: Vec<[f64; 2]>,
    /// Whether nodes are spaced evenly, as by the settings' cells.
    pub is_even: bool,
    /// Whether cells may fold along either diagonal, and every edge keeps its bend.
    pub crumples: bool,
    /// Mean sides of a cell, and the sheet's, metres.
    pub cell: [f64; 2],
    /// The paper's width and height, metres.
    pub size: [f64; 2],
    /// Edges of the grid and diagonals of cells that lie on creases: two nodes, the
    /// lower first, and the number of the crease.
    pub folds: Vec<([usize; 2], usize)>,
    /// Other diagonals along which cells are cut, and not along both.
    pub diagonals: Vec<[usize; 2]>,
    /// Whether it is a page that is torn across, or a piece of one.
    pub is_torn: bool,
    /// Of paper that is torn across, how many rows from the foot lie before the tear.
    pub seam: Option<usize>,
}

impl Material {
    /// An even grid.
    pub fn even(settings: &SheetSettings) -> Self {
        let (columns, rows) = (settings.columns, settings.rows);
        let cell = settings.cell();
        let along = |count: usize, side: f64| (0..count).map(|i| i as f64 * side).collect();
        Self {
            is_even: true,
            cell,
            ..Self::over(along(columns, cell[0]), along(rows, cell[1]))
        }
    }

    /// An even grid of paper that crumples.
    pub fn crumpled(settings: &SheetSettings) -> Self {
        Self {
            crumples: true,
            ..Self::even(settings)
        }
    }

    /// Both diagonals of a cell with their length, metres: of paper that crumples neither can be
    /// longer, and either may be shorter. None of any other.
    pub fn slack_diagonals(&self, foot: usize) -> Option<[([usize; 2], f64); 2]> {
        let head = foot + self.columns;
        let edges = [[foot, head + 1], [foot + 1, head]];
        self.crumples
            .then(|| edges.map(|edge| (edge, distance(self.places[edge[0]], self.places[edge[1]]))))
    }

    /// A grid of columns and rows at such distances from the spine and from the foot,
    /// metres, each rising from 0.
    pub fn over(columns: Vec<f64>, rows: Vec<f64>) -> Self {
        let last = |list: &[f64]| list[list.len() - 1];
        let mean = |list: &[f64]| last(list) / (list.len() - 1) as f64;
        let places = rows
            .iter()
            .flat_map(|v| columns.iter().map(move |u| [*u, *v]))
            .collect();
        Self {
            columns: columns.len(),
            rows: rows.len(),
            places,
            is_even: false,
            crumples: false,
            cell: [mean(&columns), mean(&rows)],
            size: [last(&columns), last(&rows)],
            folds: Vec::new(),
            diagonals: Vec::new(),
            is_torn: false,
            seam: None,
        }
    }

    /// The rows that hang together: all, or those before and those beyond a tear.
    pub fn runs(&self) -> [Range<usize>; 2] {
        let seam = if CAN_TEAR { self.seam } else { None };
        let seam = seam.unwrap_or(self.rows);
        [0..seam, seam..self.rows]
    }

    /// The rows that hang together with one.
    pub fn run_of(&self, row: usize) -> Range<usize> {
        let [before, beyond] = self.runs();
        if before.contains(&row) {
            before
        } else {
            beyond
        }
    }

    /// Width and height that u and v of grabs are parts of, metres.
    pub fn paper(&self, settings: &SheetSettings) -> [f64; 2] {
        // Those of the grid of a sheet that is not torn differ by rounding.
        if CAN_TEAR && self.is_torn {
            self.size
        } else {
            [settings.width, settings.height]
        }
    }

    /// Whether nodes are spaced evenly, as by the settings' cells: always in engines that crease
    /// no sheets.
    fn is_even(&self) -> bool {
        !CAN_CREASE || self.is_even
    }

    /// Distance of a node from the next in its row, metres.
    pub fn along_u(&self, node: usize) -> f64 {
        if self.is_even() {
            return self.cell[0];
        }
        distance(self.places[node], self.places[node + 1])
    }

    /// Distance of a node from the next in its column, metres.
    pub fn along_v(&self, node: usize) -> f64 {
        if self.is_even() {
            return self.cell[1];
        }
        distance(self.places[node], self.places[node + self.columns])
    }

    /// The nodes at the foot and by the spine of all cells.
    pub fn cells(&self) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        let [before, beyond] = self.runs();
        let is_cell = move |foot: &usize| {
            !(foot + 1).is_multiple_of(columns) && foot / columns + 1 != before.end
        };
        (0..columns * beyond.end.saturating_sub(1)).filter(is_cell)
    }

    /// The diagonal along which a cell is folded or cut alone, two nodes, the lower first.
    pub fn folded_diagonal(&self, foot: usize) -> Option<[usize; 2]> {
        if self.is_even() {
            return None;
        }
        let head = foot + self.columns;
        let ends = [[foot, head + 1], [foot + 1, head]];
        let folds = self.folds.iter().map(|(edge, _)| edge);
        let mut edges = folds.chain(&self.diagonals);
        edges.find(|edge| ends.contains(edge)).copied()
    }

    /// By how much the square of a cell's rising diagonal is more than that of its falling
    /// one, m^2.
    pub fn skew(&self, foot: usize) -> f64 {
        if self.is_even() {
            return 0.0;
        }
        let head = foot + self.columns;
        let square = |a: usize, b: usize| {
            let d = distance(self.places[a], self.places[b]);
            d * d
        };
        square(foot, head + 1) - square(foot + 1, head)
    }

    /// Area of a cell, m^2.
    pub fn area(&self, foot: usize) -> f64 {
        let head = foot + self.columns;
        let [a, b, c, d] = [foot, foot + 1, head, head + 1].map(|node| self.places[node]);
        twice_area(a, b, d).midpoint(twice_area(a, d, c))
    }

    /// Mean lengths of a cell's opposite sides along u and along v, metres.
    pub fn sides(&self, foot: usize) -> [f64; 2] {
        [
            self.along_u(foot)
                .midpoint(self.along_u(foot + self.columns)),
            self.along_v(foot).midpoint(self.along_v(foot + 1)),
        ]
    }

    /// Area that belongs to a node, m^2: a quarter of each cell that it is a corner of.
    pub fn area_at(&self, node: usize) -> f64 {
        let columns = self.columns;
        let (column, row) = (node % columns, node / columns);
        let left = column.checked_sub(1);
        let right = (column + 1 < columns).then_some(column);
        let run = self.run_of(row);
        let below = (row > run.start).then(|| row - 1);
        let above = (row + 1 < run.end).then_some(row);
        let feet = [(left, below), (right, below), (left, above), (right, above)];
        let feet = feet
            .iter()
            .filter_map(|(i, j)| Some((*j)? * columns + (*i)?));
        if self.is_even() {
            return 0.25 * feet.count() as f64 * self.cell[0] * self.cell[1];
        }
        feet.map(|foot| 0.25 * self.area(foot)).sum()
    }

    /// Moves numbers of nodes, three each, to those of another material on the same paper:
    /// what lies at its places.
    pub fn carry(&self, to: &Material, values: &mut [f32]) {
        let old = values.to_vec();
        let of = |node: usize| [0, 1, 2].map(|axis| f64::from(old[3 * node + axis]));
        for (node, place) in to.places.iter().enumerate() {
            if *place == self.places[node] {
                continue;
            }
            let (corners, weights) = self.around(*place);
            for axis in 0..3 {
                let parts = corners.iter().zip(weights);
                let sum: f64 = parts
                    .map(|(corner, weight)| weight * of(*corner)[axis])
                    .sum();
                values[3 * node + axis] = sum as f32;
            }
        }
    }

    /// The triangle in which a place lies, or next to which: its corners, with the weights
    /// of their means there.
    fn around(&self, place: [f64; 2]) -> ([usize; 3], [f64; 3]) {
        let mut best = ([0; 3], [1.0, 0.0, 0.0], f64::NEG_INFINITY);
        for corners in self.cells().flat_map(|foot| cut(self, foot, false)) {
            let weights = self.weights(&corners, place);
            let least = weights[0].min(weights[1]).min(weights[2]);
            if least > best.2 {
                best = (corners, weights, least);
            }
        }
        (best.0, best.1)
    }

    /// The [weights] of the corners of a triangle of nodes at a place.
    pub fn weights(&self, corners: &[usize; 3], place: [f64; 2]) -> [f64; 3] {
        weights(place, corners.map(|node| self.places[node]))
    }
}

/// Cuts a cell into two triangles, along its fold if it has one, else along its rising or
/// its falling diagonal. Their nodes go around as u to v does.
pub(super) fn cut(material: &Material, foot: usize, rising: bool) -> [[usize; 3]; 2] {
    let folded = material.folded_diagonal(foot);
    let is_rising = folded.map_or(rising, |edge| edge[0] == foot);
    cut_cell(foot, material.columns, !is_rising)
}
