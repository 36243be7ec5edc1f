//! Curves of which every point depends on four numbers alone, however many nodes
//! there are: cubic Hermite pieces, and cubic B-splines, whose coefficients are
//! first found from the nodes by one short sweep a row and a column.
//!
//! Where there are many nodes this is a fraction of the work of a full sum.

use super::samples::check_samples;
use super::spline::End;
use crate::lanes::Four;

/// For each sample the first of its four numbers, and their weights.
#[derive(Clone, Debug)]
struct Taps {
    first: Vec<usize>,
    weights: Vec<[f32; 4]>,
}

impl Taps {
    fn new(samples: &[f32], at: impl Fn(f32) -> (usize, [f64; 4])) -> Self {
        let (first, weights) = samples
            .iter()
            .map(|&sample| {
                let (first, weights) = at(sample);
                (first, weights.map(|weight| weight as f32))
            })
            .unzip();
        Self { first, weights }
    }

    /// Of cubic pieces whose tangent at a node is the difference of its
    /// neighbours (Catmull and Rom 1974), and at an end that of the parabola
    /// through three nodes.
    #[cfg(feature = "interpolations")]
    fn hermite(nodes: usize, samples: &[f32]) -> Self {
        Self::new(samples, |sample| {
            let t = f64::from(sample) * (nodes - 1) as f64;
            let left = (t as usize).min(nodes - 2);
            let t = t - left as f64;
            let first = left.saturating_sub(1).min(nodes - 4);
            let mut weights = [0.0; 4];
            let (t2, t3) = (t * t, t * t * t);
            let mut tangent = |node: usize, weight: f64| {
                let mut add = |node: usize, part: f64| weights[node - first] += weight * part;
                if node == 0 {
                    add(0, -1.5);
                    add(1, 2.0);
                    add(2, -0.5);
                } else if node + 1 == nodes {
                    add(node, 1.5);
                    add(node - 1, -2.0);
                    add(node - 2, 0.5);
                } else {
                    add(node + 1, 0.5);
                    add(node - 1, -0.5);
                }
            };
            tangent(left, t3 - 2.0 * t2 + t);
            tangent(left + 1, t3 - t2);
            weights[left - first] += 2.0 * t3 - 3.0 * t2 + 1.0;
            weights[left + 1 - first] += 3.0 * t2 - 2.0 * t3;
            (first, weights)
        })
    }

    /// Of cubic B-splines of `nodes` + 2 coefficients.
    fn b_spline(nodes: usize, samples: &[f32]) -> Self {
        Self::new(samples, |sample| {
            let t = f64::from(sample) * (nodes - 1) as f64;
            let left = (t as usize).min(nodes - 2);
            let t = t - left as f64;
            let (s, cube) = (1.0 - t, |x: f64| x * x * x);
            let weights = [
                cube(s),
                4.0 - 6.0 * t * t + 3.0 * cube(t),
                4.0 - 6.0 * s * s + 3.0 * cube(s),
                cube(t),
            ];
            (left, weights.map(|weight| weight / 6.0))
        })
    }
}

/// From the values at equally spaced nodes to the coefficients of the spline
/// through them, one before the first node and one after the last.
#[derive(Clone, Debug)]
struct Filter {
    nodes: usize,
    /// The first node whose coefficient is not known at once.
    first: usize,
    /// What the sweep divides by, from that node on.
    pivots: Vec<f32>,
}

impl Filter {
    fn new(nodes: usize, start: End) -> Self {
        let first = match start {
            End::Natural => 1,
            End::NotAKnot => 2,
        };
        let mut pivots: Vec<f32> = Vec::new();
        for k in first..nodes - 1 {
            let before = if k == first {
                0.0
            } else {
                f64::from(pivots[k - 1 - first])
            };
            pivots.push((1.0 / (4.0 - before)) as f32);
        }
        Self {
            nodes,
            first,
            pivots,
        }
    }

    /// Coefficients of `lines` lines, each `apart` from the one before and its
    /// numbers `step` from one another, where the values lie now one further on:
    /// the coefficient of a node takes the place of its value. All lines go on
    /// together, as each waits long for its own last number.
    fn run(&self, all: &mut [Four], (lines, apart): (usize, usize), step: usize) {
        let place = |line: usize, node: usize| line * apart + (node + 1) * step;
        let times = |value: f32| Four::splat(value);
        let (n, six, four) = (self.nodes, times(6.0), times(4.0));
        if self.first == 2 {
            // The first two pieces are one cubic. The values of its ends are kept
            // where nothing is yet.
            for line in 0..lines {
                let value = [0, 1, 2].map(|node| all[place(line, node)]);
                all[line * apart] = value[1];
                all[place(line, 1)] =
                    (times(8.0) * value[1] - value[0] - value[2]) * times(1.0 / 6.0);
            }
        }
        for k in self.first..n - 1 {
            let pivot = times(self.pivots[k - self.first]);
            for line in 0..lines {
                let before = all[place(line, k - 1)];
                all[place(line, k)] = (six * all[place(line, k)] - before) * pivot;
            }
        }
        for k in (self.first..n - 1).rev() {
            let pivot = times(self.pivots[k - self.first]);
            for line in 0..lines {
                // The last node's own value is its coefficient: no curvature there.
                let after = all[place(line, k + 1)];
                all[place(line, k)] = all[place(line, k)] - pivot * after;
            }
        }
        for line in 0..lines {
            let (start, at) = (line * apart, |node: usize| place(line, node));
            if self.first == 2 {
                let (first, second) = (all[at(0)], all[start]);
                all[at(0)] = six * second - four * all[at(1)] - all[at(2)];
                all[start] = six * first - four * all[at(0)] - all[at(1)];
            } else {
                all[start] = times(2.0) * all[at(0)] - all[at(1)];
            }
            all[at(n)] = times(2.0) * all[at(n - 1)] - all[at(n - 2)];
        }
    }
}

/// Interpolation by four numbers a sample and direction.
#[derive(Clone, Debug)]
pub(crate) struct Local {
    u: Taps,
    v: Taps,
    filters: Option<[Filter; 2]>,
    /// Columns and rows of what the taps weigh: nodes or coefficients.
    size: (usize, usize),
    weighed: Vec<Four>,
    /// Rows of points, each with a float to spare.
    rows: Vec<f32>,
}

impl Local {
    /// By cubic Hermite pieces.
    #[cfg(feature = "interpolations")]
    pub fn hermite((columns, rows): (usize, usize), u: &[f32], v: &[f32]) -> Self {
        let taps = (Taps::hermite(columns, u), Taps::hermite(rows, v));
        Self::new((columns, rows), taps, None)
    }

    /// By the cubic splines of [`Interpolation::spline`](super::Interpolation::spline),
    /// the same surface but for rounding.
    ///
    /// # Panics
    /// As that.
    pub fn b_spline((columns, rows): (usize, usize), u: &[f32], v: &[f32]) -> Self {
        assert!(columns >= 4 && rows >= 4, "a spline needs 4 nodes");
        check_samples(u);
        check_samples(v);
        let taps = (Taps::b_spline(columns, u), Taps::b_spline(rows, v));
        let filters = [
            Filter::new(columns, End::NotAKnot),
            Filter::new(rows, End::Natural),
        ];
        Self::new((columns + 2, rows + 2), taps, Some(filters))
    }

    fn new(size: (usize, usize), (u, v): (Taps, Taps), filters: Option<[Filter; 2]>) -> Self {
        let width = 3 * u.first.len() + 1;
        Self {
            weighed: vec![Four::splat(0.0); size.0 * size.1],
            rows: vec![0.0; size.1 * width],
            u,
            v,
            filters,
            size,
        }
    }

    /// Columns and rows of the points.
    pub fn samples(&self) -> (usize, usize) {
        (self.u.first.len(), self.v.first.len())
    }

    /// Interpolates nodes given as x, y, z of each, row by row, into `points`.
    ///
    /// # Panics
    /// If `nodes` is too short for the grid, or `points` is not `3 * samples` long.
    pub fn apply_interleaved(&mut self, nodes: &[f32], points: &mut [f32]) {
        assert_eq!(points.len(), 3 * self.u.first.len() * self.v.first.len());
        let margin = if self.filters.is_some() { 2 } else { 0 };
        let (nodes, columns) = (nodes.as_chunks::<3>().0, self.size.0 - margin);
        self.apply(|column, row| nodes[row * columns + column], points);
    }

    /// Interpolates nodes into points, x, y, z of each.
    #[inline(always)]
    pub fn apply(&mut self, node: impl Fn(usize, usize) -> [f32; 3], points: &mut [f32]) {
        let (columns, rows) = self.size;
        // Coefficients have a margin of one around the nodes.
        let margin = usize::from(self.filters.is_some());
        for row in margin..rows - margin {
            for column in margin..columns - margin {
                let [x, y, z] = node(column - margin, row - margin);
                self.weighed[row * columns + column] = Four::new([x, y, z, 0.0]);
            }
        }
        if let Some([along_u, along_v]) = &self.filters {
            // Rows of nodes, and then all columns, those of the margins too.
            let nodes = &mut self.weighed[columns..(rows - 1) * columns];
            along_u.run(nodes, (rows - 2, columns), 1);
            along_v.run(&mut self.weighed, (columns, 1), columns);
        }
        let width = 3 * self.u.first.len();
        for (four, out) in self
            .weighed
            .chunks_exact(columns)
            .zip(self.rows.chunks_exact_mut(width + 1))
        {
            for (k, (&first, w)) in self.u.first.iter().zip(&self.u.weights).enumerate() {
                let sum = weigh(
                    w,
                    [
                        four[first],
                        four[first + 1],
                        four[first + 2],
                        four[first + 3],
                    ],
                );
                // The fourth float is written over by the next point.
                out[3 * k..3 * k + 4].copy_from_slice(&sum.array());
            }
        }
        for ((&first, w), out) in self
            .v
            .first
            .iter()
            .zip(&self.v.weights)
            .zip(points.chunks_exact_mut(width))
        {
            let row = |k: usize| &self.rows[(first + k) * (width + 1)..][..width];
            sum_rows(w, [row(0), row(1), row(2), row(3)], out);
        }
    }
}

#[inline(always)]
fn weigh(w: &[f32; 4], of: [Four; 4]) -> Four {
    let part = |k: usize| Four::splat(w[k]) * of[k];
    (part(0) + part(1)) + (part(2) + part(3))
}

#[inline(always)]
fn sum_rows(w: &[f32; 4], rows: [&[f32]; 4], out: &mut [f32]) {
    let rest = out.len() / 4 * 4;
    let fours = rows.map(|row| row.as_chunks::<4>().0);
    for (k, out) in out.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        *out = weigh(w, fours.map(|row| Four::new(row[k]))).array();
    }
    for k in rest..out.len() {
        out[k] = (w[0] * rows[0][k] + w[1] * rows[1][k]) + (w[2] * rows[2][k] + w[3] * rows[3][k]);
    }
}
