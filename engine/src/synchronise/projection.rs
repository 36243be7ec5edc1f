//! Displacements projected onto piecewise-linear functions of the distance from the
//! dog-ear line.

use crate::grid::Grid;

/// The least-squares projection onto piecewise-linear functions of distance.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    /// Lanes of the free nodes.
    lanes: Vec<usize>,
    /// For each node its knot below and the weight of the knot above.
    place: Vec<(usize, f32)>,
    /// Value at each knot from the displacements: `[knot][node]`.
    fit: Vec<f32>,
}

impl Projection {
    /// Onto functions of the distance from a line at an angle with the spine, radians.
    pub fn new(angle: f32, grid: &Grid, free: &[f32]) -> Self {
        let (sin, cos) = libm::sincos(f64::from(angle));
        let distance = |column: usize, row: usize| {
            column as f64 * f64::from(grid.du()) * cos + row as f64 * f64::from(grid.dv()) * sin
        };
        let nodes: Vec<(usize, f64)> = (0..grid.rows)
            .flat_map(|row| (0..grid.columns).map(move |column| (column, row)))
            .map(|(column, row)| (grid.lane(column, row), distance(column, row)))
            .filter(|&(lane, _)| free[lane] > 0.0)
            .collect();
        let low = nodes.iter().map(|n| n.1).fold(f64::INFINITY, f64::min);
        let high = nodes.iter().map(|n| n.1).fold(f64::NEG_INFINITY, f64::max);
        let spacing = f64::from(grid.du()) * cos * cos + f64::from(grid.dv()) * sin * sin;
        if nodes.is_empty() {
            return Self {
                lanes: vec![],
                place: vec![],
                fit: vec![],
            };
        }
        // A span that is a whole number of spacings, but for rounding, stays one.
        let intervals = ((high - low) / spacing - 1e-6).ceil().max(1.0) as usize;
        let scale = if high > low {
            intervals as f64 / (high - low)
        } else {
            0.0
        };
        let place: Vec<(usize, f64)> = nodes
            .iter()
            .map(|&(_, distance)| {
                let along = (distance - low) * scale;
                let knot = (along.floor() as usize).min(intervals - 1);
                (knot, along - knot as f64)
            })
            .collect();
        Self {
            lanes: nodes.iter().map(|n| n.0).collect(),
            fit: least_squares(&place, intervals + 1),
            place: place
                .iter()
                .map(|&(knot, part)| (knot, part as f32))
                .collect(),
        }
    }

    /// Projects the displacements from rest along one axis.
    pub fn apply(&self, rest: &[f32], position: &mut [f32]) {
        let count = self.lanes.len();
        if count == 0 {
            return;
        }
        // Knots are evaluated two at a time as the nodes need them, in a small
        // array: at most the nodes' own number of knots.
        let mut knots = [0.0f32; MOST_KNOTS];
        for (knot, fit) in knots.iter_mut().zip(self.fit.chunks_exact(count)) {
            *knot = self
                .lanes
                .iter()
                .zip(fit)
                .fold(0.0, |sum, (&lane, weight)| {
                    sum + weight * (position[lane] - rest[lane])
                });
        }
        for (&lane, &(knot, part)) in self.lanes.iter().zip(&self.place) {
            let (near, far) = (knots[knot], knots[knot + 1]);
            position[lane] = rest[lane] + (near + part * (far - near));
        }
    }
}

/// More knots than any grid of 16 x 16 nodes has along any direction, unless
/// its cells are extremely narrow.
const MOST_KNOTS: usize = 64;

/// For each knot the weights of the nodes' values in the least-squares fit of a
/// piecewise-linear function: (B^T B)^-1 B^T, by Gauss-Jordan in f64. A hair of
/// ridge keeps a knot that no node determines from being singular.
fn least_squares(place: &[(usize, f64)], knots: usize) -> Vec<f32> {
    assert!(
        knots <= MOST_KNOTS,
        "the cells are too narrow for a dog-ear line"
    );
    let count = place.len();
    let width = knots + count;
    let mut m = vec![0.0f64; knots * width];
    for (node, &(knot, part)) in place.iter().enumerate() {
        let hats = [(knot, 1.0 - part), (knot + 1, part)];
        for (i, a) in hats {
            for (j, b) in hats {
                m[i * width + j] += a * b;
            }
            m[i * width + knots + node] += a;
        }
    }
    for i in 0..knots {
        m[i * width + i] += 1e-12;
    }
    for pivot in 0..knots {
        let inverse = 1.0 / m[pivot * width + pivot];
        for j in 0..width {
            m[pivot * width + j] *= inverse;
        }
        for i in (0..knots).filter(|&i| i != pivot) {
            let factor = m[i * width + pivot];
            for j in 0..width {
                m[i * width + j] -= factor * m[pivot * width + j];
            }
        }
    }
    (0..knots)
        .flat_map(|i| m[i * width + knots..(i + 1) * width].to_vec())
        .map(|weight| weight as f32)
        .collect()
}
