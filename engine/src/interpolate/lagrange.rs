//! Tensor-product Lagrange interpolation, the paper's third improvement
//! (Shangguan and Zeng 2014, section 2.2.2): one polynomial through all nodes
//! of a row, one through all nodes of a column.
//!
//! The weights depend on the sample positions alone and are computed once.
//! Interpolation runs in two separable passes, along u and then along v, which
//! for 6 x 6 nodes and 26 x 26 points takes 30 kflop where the plain sum over
//! 36 nodes takes 146. Both nodes and samples of the second pass usually lie
//! symmetrically about the middle; then the weights are split into an even and
//! an odd part, and each product serves two rows, which halves the work again.
//!
//! The order of operations is fixed: the same bits on every target.

use crate::lanes::Four;

/// Highest number of nodes along a side. Polynomials through more equally
/// spaced nodes swing too far between them to be of use.
const MOST_NODES: usize = 16;

/// Interpolates a grid of equally spaced nodes at fixed sample positions.
#[derive(Clone, Debug)]
pub struct Lagrange {
    nodes: (usize, usize),
    samples: (usize, usize),
    /// Weight of each node at each sample along u, each repeated for x, y, z:
    /// `[node][padded]`.
    along_u: Vec<f32>,
    along_v: AlongV,
    /// Rows of nodes after the first pass: `[row][padded]`.
    rows: Vec<Four>,
    /// Floats of a row of points: 3 * samples.0, rounded up to twelves.
    padded: usize,
}

/// The second pass: folded about the middle where nodes and samples allow it.
#[derive(Clone, Debug)]
enum AlongV {
    /// For each pair of rows, of the six weights the three even and the three
    /// odd ones, each repeated over four lanes.
    FoldedSix(Vec<[Four; 6]>),
    /// For each row of points a weight for each row of nodes.
    General(Vec<f32>),
}

impl Lagrange {
    /// Prepares interpolation from `columns` x `rows` equally spaced nodes, at
    /// u, v = 0..1, to the points at every pair of `u` and `v`.
    ///
    /// # Panics
    /// If there are fewer than 2 or more than 16 nodes along a side, or fewer
    /// than 2 samples along one, or if samples do not rise or leave 0..1.
    pub fn new(columns: usize, rows: usize, u: &[f32], v: &[f32]) -> Self {
        for nodes in [columns, rows] {
            assert!((2..=MOST_NODES).contains(&nodes), "2 to 16 nodes a side");
        }
        for samples in [u, v] {
            assert!(samples.len() >= 2, "at least 2 samples a side");
            assert!(
                samples.windows(2).all(|pair| pair[0] < pair[1]),
                "samples must rise"
            );
            let ends = [samples[0], samples[samples.len() - 1]];
            assert!(ends[0] >= 0.0 && ends[1] <= 1.0, "samples must lie in 0..1");
        }
        let padded = (3 * u.len()).next_multiple_of(12);
        let mut along_u = vec![0.0; columns * padded];
        for (sample, &position) in u.iter().enumerate() {
            for (node, weight) in lagrange_weights(columns, position).into_iter().enumerate() {
                let at = node * padded + 3 * sample;
                along_u[at..at + 3].fill(weight);
            }
        }
        Self {
            nodes: (columns, rows),
            samples: (u.len(), v.len()),
            along_u,
            along_v: AlongV::new(rows, v),
            rows: vec![Four::ZERO; rows * padded / 4],
            padded,
        }
    }

    /// Columns and rows of the nodes.
    pub fn nodes(&self) -> (usize, usize) {
        self.nodes
    }

    /// Columns and rows of the points.
    pub fn samples(&self) -> (usize, usize) {
        self.samples
    }

    /// Interpolates nodes given as one array per axis, each row `stride` floats
    /// long, into `points` (x, y, z of each point, row by row).
    ///
    /// # Panics
    /// If an array is too short for the grid, or `points` is not
    /// `3 * samples` long.
    pub fn apply(&mut self, axes: [&[f32]; 3], stride: usize, points: &mut [f32]) {
        let width = 3 * self.samples.0;
        assert_eq!(points.len(), width * self.samples.1);
        for row in 0..self.nodes.1 {
            let at = row * stride..row * stride + self.nodes.0;
            let [x, y, z] = axes.map(|axis| &axis[at.clone()]);
            let lanes = self.padded / 4;
            let out = &mut self.rows[row * lanes..(row + 1) * lanes];
            pass_along_u(&self.along_u, self.padded, [x, y, z], out);
        }
        match &self.along_v {
            AlongV::FoldedSix(weights) => {
                folded_pass_along_v(weights, &self.rows, self.padded / 4, width, points);
            }
            AlongV::General(weights) => {
                general_pass_along_v(weights, &self.rows, self.padded / 4, width, points);
            }
        }
    }
}

impl AlongV {
    fn new(nodes: usize, samples: &[f32]) -> Self {
        let weights: Vec<Vec<f32>> = samples
            .iter()
            .map(|&v| lagrange_weights(nodes, v))
            .collect();
        let count = samples.len();
        let symmetric =
            (0..count).all(|i| (samples[i] + samples[count - 1 - i] - 1.0).abs() < 2e-7);
        if nodes != 6 || !symmetric {
            return Self::General(weights.concat());
        }
        let pairs = (0..count.div_ceil(2)).map(|row| {
            core::array::from_fn(|i| {
                let (near, far) = (weights[row][i % 3], weights[row][5 - i % 3]);
                Four::splat(if i < 3 { near + far } else { near - far } * 0.5)
            })
        });
        Self::FoldedSix(pairs.collect())
    }
}

/// The weights of `nodes` equally spaced nodes on 0..1 for a value at
/// `position`. They sum to 1, and are exact for polynomials of a degree below
/// `nodes`. Computed in f64 from exact node numbers.
///
/// # Panics
/// If there are fewer than 2 nodes.
pub fn lagrange_weights(nodes: usize, position: f32) -> Vec<f32> {
    assert!(nodes >= 2);
    let t = f64::from(position) * (nodes - 1) as f64;
    (0..nodes)
        .map(|j| {
            let product = (0..nodes)
                .filter(|&m| m != j)
                .map(|m| (t - m as f64) / (j as f64 - m as f64))
                .product::<f64>();
            product as f32
        })
        .collect()
}

/// `count` equally spaced samples, the first 0 and the last 1.
///
/// # Panics
/// If `count` is below 2.
pub fn uniform_samples(count: usize) -> Vec<f32> {
    assert!(count >= 2);
    let last = (count - 1) as f64;
    (0..count).map(|i| (i as f64 / last) as f32).collect()
}

/// One row of nodes to one row of points, twelve floats (four points) at a time.
#[inline]
fn pass_along_u(weights: &[f32], padded: usize, node: [&[f32]; 3], out: &mut [Four]) {
    let mut pattern = [[Four::ZERO; 3]; MOST_NODES];
    let count = node[0].len();
    for k in 0..count {
        let [x, y, z] = [node[0][k], node[1][k], node[2][k]];
        pattern[k] = [Four([x, y, z, x]), Four([y, z, x, y]), Four([z, x, y, z])];
    }
    for (chunk, out) in out.chunks_exact_mut(3).enumerate() {
        let mut sum = [Four::ZERO; 3];
        for (k, pattern) in pattern[..count].iter().enumerate() {
            let at = k * padded + 12 * chunk;
            let weights = &weights[at..at + 12];
            for part in 0..3 {
                sum[part] = sum[part] + Four::load(weights, 4 * part) * pattern[part];
            }
        }
        out.copy_from_slice(&sum);
    }
}

/// Six rows of nodes to all rows of points, two rows of points at a time.
fn folded_pass_along_v(
    weights: &[[Four; 6]],
    rows: &[Four],
    lanes: usize,
    width: usize,
    points: &mut [f32],
) {
    let last = points.len() / width - 1;
    for lane in 0..width.div_ceil(4) {
        let at = 4 * lane;
        let node: [Four; 6] = core::array::from_fn(|k| rows[k * lanes + lane]);
        let sum: [Four; 3] = core::array::from_fn(|k| node[k] + node[5 - k]);
        let difference: [Four; 3] = core::array::from_fn(|k| node[k] - node[5 - k]);
        for (row, w) in weights.iter().enumerate() {
            let even = w[0] * sum[0] + w[1] * sum[1] + w[2] * sum[2];
            let odd = w[3] * difference[0] + w[4] * difference[1] + w[5] * difference[2];
            let near = &mut points[row * width..(row + 1) * width];
            (even + odd).store(near, at);
            let far = &mut points[(last - row) * width..(last - row + 1) * width];
            (even - odd).store(far, at);
        }
    }
}

/// Any number of rows of nodes to all rows of points, one row at a time.
fn general_pass_along_v(
    weights: &[f32],
    rows: &[Four],
    lanes: usize,
    width: usize,
    points: &mut [f32],
) {
    let nodes = rows.len() / lanes;
    for (w, out) in weights
        .chunks_exact(nodes)
        .zip(points.chunks_exact_mut(width))
    {
        for lane in 0..width.div_ceil(4) {
            let mut sum = Four::ZERO;
            for (k, &weight) in w.iter().enumerate() {
                sum = sum + Four::splat(weight) * rows[k * lanes + lane];
            }
            sum.store(out, 4 * lane);
        }
    }
}
