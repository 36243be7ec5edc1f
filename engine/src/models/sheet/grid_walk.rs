//! Finds in which triangle of a material a place lies, cell by cell from one nearby.

use super::flat::{Place, twice_area, weights};
use super::material::Material;
use crate::grid::cut_cell;
use core::ops::Range;

/// Where a place lies on a material.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocatedPlace {
    /// The nodes of the triangle in which it lies, or next to which.
    pub corners: [usize; 3],
    /// The weights with which these have it as their mean.
    pub weights: [f64; 3],
}

impl LocatedPlace {
    /// The least of its weights: below 0 beside the triangle.
    pub fn least(&self) -> f64 {
        let [a, b, c] = self.weights;
        a.min(b).min(c)
    }

    /// The mean of the corners' numbers, three of each node.
    pub fn mean(&self, values: &[f32]) -> [f32; 3] {
        let of = |node: usize, axis: usize| f64::from(values[3 * node + axis]);
        core::array::from_fn(|axis| {
            let parts = self.corners.iter().zip(self.weights);
            parts
                .map(|(corner, weight)| weight * of(*corner, axis))
                .sum::<f64>() as f32
        })
    }
}

/// Locates a place among the cells of rows that hang together, from the cell of a node on. Beside
/// all of them it is located by one of those at the rim.
pub(super) fn locate(
    material: &Material,
    run: &Range<usize>,
    place: Place,
    near: usize,
) -> LocatedPlace {
    let columns = material.columns;
    let mut column = (near % columns).min(columns - 2);
    let mut row = (near / columns).clamp(run.start, run.end - 2);
    let mut best: Option<LocatedPlace> = None;
    // A cell is passed once on the way to any other.
    for _ in 0..columns + run.len() {
        let foot = row * columns + column;
        for located in in_cell(material, foot, place) {
            if best.is_none_or(|best| located.least() > best.least()) {
                best = Some(located);
            }
        }
        if best.is_some_and(|best| best.least() >= 0.0) {
            break;
        }
        let [a, b, c, d] =
            [foot, foot + 1, foot + columns, foot + columns + 1].map(|node| material.places[node]);
        let is_right_of = |from: Place, to: Place| twice_area(from, to, place) < 0.0;
        let (from_column, from_row) = (column, row);
        if is_right_of(b, d) {
            column = (column + 1).min(columns - 2);
        } else if is_right_of(c, a) {
            column = column.saturating_sub(1);
        }
        if is_right_of(a, b) {
            row = row.saturating_sub(1).max(run.start);
        } else if is_right_of(d, c) {
            row = (row + 1).min(run.end - 2);
        }
        if (column, row) == (from_column, from_row) {
            break;
        }
    }
    best.unwrap_or(LocatedPlace {
        corners: [near; 3],
        weights: [1.0, 0.0, 0.0],
    })
}

/// Where a place lies by each triangle into which a cell may be cut that is none too flat for that.
fn in_cell(
    material: &Material,
    foot: usize,
    place: Place,
) -> impl Iterator<Item = LocatedPlace> + '_ {
    let cut = |is_falling: bool| cut_cell(foot, material.columns, is_falling);
    let ([a, b], [c, d]) = (cut(false), cut(true));
    let triangles = [a, b, c, d];
    let places = triangles.map(|corners| corners.map(|node| material.places[node]));
    let areas = places.map(|[a, b, c]| twice_area(a, b, c));
    let most = areas.iter().fold(0.0, |most: f64, area| most.max(*area));
    let counts = move |k: &usize| areas[*k] > FLAT * most;
    (0..4).filter(counts).map(move |k| LocatedPlace {
        corners: triangles[k],
        weights: weights(place, places[k]),
    })
}

/// Area of a triangle, over the greatest of its cell, that is as good as none.
const FLAT: f64 = 1e-6;
