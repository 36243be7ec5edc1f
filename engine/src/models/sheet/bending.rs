//! The bending energy on the grid of nodes: constant coefficients, built once.
//!
//! The energy is quadratic in positions, so its Hessian is one matrix for all
//! shapes, the same for x, y and z, and carries the two directions of the grain.
//! Curvatures are second differences at the nodes, twists mixed differences in
//! the cells. At a clamped edge the curvature of the first half cell is
//! 2 (x1 - x0 - du t) / du^2 with the clamp's tangent t, and the nodes next to
//! it are weighted by Gregory's rule, without which the error of a hanging page
//! is of first order.

use super::settings::{Root, SheetSettings};
use crate::band::Band;
use crate::rigidity::Rigidity;

/// Node offsets (columns, rows) that the energy couples.
const OFFSETS: [(isize, isize); 13] = [
    (0, -2),
    (-1, -1),
    (0, -1),
    (1, -1),
    (-2, 0),
    (-1, 0),
    (0, 0),
    (1, 0),
    (2, 0),
    (-1, 1),
    (0, 1),
    (1, 1),
    (0, 2),
];

/// Weights of the quadrature at the nodes from a clamped edge on (Gregory):
/// times the half cell of the first, they integrate smooth functions to third
/// order from values at nodes that the clamp's half-cell curvature is one of.
const GREGORY: [f64; 3] = [4.0 / 3.0, 6.0 / 7.0, 24.0 / 23.0];

/// A node of a difference: its column and row; the column -1 is the place that
/// the clamp's tangent points to.
type Term = (isize, isize, f64);

/// The Hessian of the bending energy, and its product with positions.
#[derive(Clone, Debug)]
pub(super) struct Bending {
    /// Lanes from a node to each of [`OFFSETS`].
    lanes: [isize; 13],
    /// For each offset a coefficient a node, thrice for x, y, z.
    coefficients: Vec<Vec<f32>>,
    /// For each row the coefficient of column 1 with the clamp's tangent.
    to_tangent: Vec<f32>,
    /// For each node the stiffness of its curvature across the spine, N m^3.
    along_u: Vec<f32>,
    columns: usize,
    rows: usize,
    du: f32,
}

impl Bending {
    /// The bending of an even grid of nodes, clamped or free at the spine as the settings say.
    pub fn new(settings: &SheetSettings) -> Bending {
        let (columns, rows) = (settings.columns, settings.rows);
        let mut sum = Sum {
            columns,
            coefficients: vec![[0.0; 13]; columns * rows],
            to_tangent: vec![0.0; rows],
            along_u: vec![0.0; columns * rows],
        };
        let d = Rigidity::of(&settings.stock, settings.grain);
        for row in 0..rows {
            for column in 0..columns {
                add_node(&mut sum, settings, &d, column, row);
            }
        }
        let [du, dv] = settings.cell();
        let c = 1.0 / (du * dv);
        for row in 0..rows as isize - 1 {
            for column in 0..columns as isize - 1 {
                let twist = [
                    (column, row, c),
                    (column + 1, row, -c),
                    (column, row + 1, -c),
                    (column + 1, row + 1, c),
                ];
                sum.add(&twist, &twist, 4.0 * d.d66 * du * dv);
            }
        }
        let coefficients = (0..13)
            .map(|k| {
                let of = |node: &[f64; 13]| [node[k] as f32; 3];
                sum.coefficients.iter().flat_map(of).collect()
            })
            .collect();
        Bending {
            lanes: OFFSETS.map(|(i, j)| 3 * (j * columns as isize + i)),
            coefficients,
            to_tangent: sum.to_tangent.iter().map(|&k| k as f32).collect(),
            along_u: sum.along_u.iter().map(|&k| k as f32).collect(),
            columns,
            rows,
            du: du as f32,
        }
    }

    /// Adds the Hessian times `scale` of the nodes from column `first` on.
    pub fn add_to(&self, band: &mut Band<f32>, first: usize, scale: f32) {
        let moving = self.columns - first;
        for row in 0..self.rows {
            for column in first..self.columns {
                let node = row * self.columns + column;
                let own = row * moving + column - first;
                for (k, (i, j)) in OFFSETS.iter().enumerate() {
                    let (column, row) = (column as isize + i, row as isize + j);
                    let other = row * moving as isize + column - first as isize;
                    let value = self.coefficients[k][3 * node];
                    if value == 0.0 || column < first as isize || other > own as isize {
                        continue;
                    }
                    for axis in 0..3 {
                        band.add(3 * own + axis, 3 * other as usize + axis, scale * value);
                    }
                }
            }
        }
    }

    /// Subtracts the Hessian times `positions` from `forces`. `tangents` are,
    /// for each row, the places to which the clamp's tangent points, one cell
    /// from the spine.
    ///
    /// Each row of the Hessian sums to nothing, so it acts on differences from
    /// the node's own place; on places themselves its rounding would pull the
    /// sheet toward the origin.
    pub fn subtract_forces(&self, positions: &[f32], tangents: &[f32], forces: &mut [f32]) {
        let all = positions.len();
        for (lanes, coefficients) in self.lanes.iter().zip(&self.coefficients) {
            if *lanes == 0 {
                continue;
            }
            let start = (-lanes).max(0) as usize;
            let end = (all as isize - lanes).min(all as isize) as usize;
            let from = (start as isize + lanes) as usize;
            let others = &positions[from..from + end - start];
            let (own, k) = (&positions[start..end], &coefficients[start..end]);
            let terms = own.iter().zip(others).zip(k);
            for (force, ((own, other), k)) in forces[start..end].iter_mut().zip(terms) {
                *force -= k * (other - own);
            }
        }
        self.subtract_stiffening(positions, tangents, forces);
        for (row, (k, tangent)) in self
            .to_tangent
            .iter()
            .zip(tangents.chunks_exact(3))
            .enumerate()
        {
            let at = 3 * (row * self.columns + 1);
            for axis in 0..3 {
                forces[at + axis] -= k * (tangent[axis] - positions[at + axis]);
            }
        }
    }

    /// Second differences fall short of the angle by which a hinge bends: 2
    /// sin(a/2) of a. What is missing is a small force, taken where the sheet is.
    /// Without it a page hangs too softly where it bends within a cell.
    fn subtract_stiffening(&self, positions: &[f32], tangents: &[f32], forces: &mut [f32]) {
        let (x, forces) = (positions.as_chunks::<3>().0, forces.as_chunks_mut::<3>().0);
        let tangents = tangents.as_chunks::<3>().0;
        let (u, quarter) = (1.0 / (self.du * self.du), 0.25 * self.du * self.du);
        for row in 0..self.rows {
            let start = row * self.columns;
            for node in start..start + self.columns - 1 {
                if self.along_u[node] == 0.0 {
                    continue;
                }
                let root = node == start;
                let (before, u) = if root {
                    (tangents[row], 2.0 * u)
                } else {
                    (x[node - 1], u)
                };
                let d: [f32; 3] = core::array::from_fn(|axis| {
                    let middle = if root {
                        before[axis]
                    } else {
                        2.0 * x[node][axis] - before[axis]
                    };
                    u * (x[node + 1][axis] - middle)
                });
                let s2 = quarter * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                let s2 = if root { 0.25 * s2 } else { s2 };
                let k = self.along_u[node] * stiffening(s2) * u;
                for axis in 0..3 {
                    let force = k * d[axis];
                    forces[node + 1][axis] -= force;
                    if !root {
                        forces[node][axis] += 2.0 * force;
                        forces[node - 1][axis] -= force;
                    }
                }
            }
        }
    }
}

/// By how much more than linearly a hinge resists, given the square of half
/// its second difference in units of a cell: asin(s) / (s sqrt(1 - s^2)) - 1,
/// the gradient of the squared angle over that of the squared chord, by its
/// series and bounded.
fn stiffening(s2: f32) -> f32 {
    let s2 = s2.min(0.5);
    s2 * (2.0 / 3.0 + s2 * (8.0 / 15.0 + s2 * (16.0 / 35.0)))
}

struct Sum {
    columns: usize,
    coefficients: Vec<[f64; 13]>,
    to_tangent: Vec<f64>,
    along_u: Vec<f64>,
}

impl Sum {
    /// Adds the Hessian of `k` a.b for differences a and b, as far as it acts on
    /// nodes.
    fn add(&mut self, a: &[Term], b: &[Term], k: f64) {
        for &(column, row, of_a) in a {
            if column < 0 {
                continue;
            }
            for &(other, other_row, of_b) in b {
                let value = k * of_a * of_b;
                if other < 0 {
                    // Only the column next to the spine is free and sees it.
                    if column == 1 {
                        self.to_tangent[row as usize] += value;
                    }
                    continue;
                }
                let apart = (other - column, other_row - row);
                let at = OFFSETS.iter().position(|offset| *offset == apart);
                let at = at.expect("differences reach two nodes at most");
                self.coefficients[row as usize * self.columns + column as usize][at] += value;
            }
        }
    }
}

/// The curvatures of one node and what they cost.
fn add_node(sum: &mut Sum, settings: &SheetSettings, d: &Rigidity, column: usize, row: usize) {
    let [du, dv] = settings.cell();
    let (i, j) = (column as isize, row as isize);
    let (u, v) = (1.0 / (du * du), 1.0 / (dv * dv));
    let clamped = settings.root != Root::Free;
    let along_u: Option<[Term; 3]> = if column == 0 {
        clamped.then_some([(1, j, 2.0 * u), (-1, j, -2.0 * u), (0, j, 0.0)])
    } else if column + 1 < settings.columns {
        Some([(i - 1, j, u), (i, j, -2.0 * u), (i + 1, j, u)])
    } else {
        None
    };
    let along_v: Option<[Term; 3]> = (row > 0 && row + 1 < settings.rows).then_some([
        (i, j - 1, v),
        (i, j, -2.0 * v),
        (i, j + 1, v),
    ]);
    let area = settings.area(column, row);
    let node = row * settings.columns + column;
    let mut weight = match settings.root {
        Root::Free => 1.0,
        Root::Clamped | Root::Hinged(_) => GREGORY.get(column).copied().unwrap_or(1.0),
    };
    if let (0, Root::Hinged(stiffness)) = (column, settings.root) {
        // The half cell of paper and the hinge bend one behind the other.
        let paper = 2.0 * d.d11 * weight / du;
        weight *= stiffness / (stiffness + paper);
    }
    match (along_u, along_v) {
        (Some(a), Some(b)) => {
            sum.along_u[node] = d.d11 * weight * area;
            sum.add(&a, &a, sum.along_u[node]);
            sum.add(&b, &b, d.d22 * area);
            // Without its hinge's curvature a node has no part in Poisson's effect.
            let part = if column == 0 {
                weight / GREGORY[0]
            } else {
                1.0
            };
            sum.add(&a, &b, d.d12 * part * area);
            sum.add(&b, &a, d.d12 * part * area);
        }
        // A free edge curls as it likes across itself.
        (Some(a), None) => {
            sum.along_u[node] = d.free_d11() * weight * area;
            sum.add(&a, &a, sum.along_u[node]);
        }
        (None, Some(b)) => sum.add(&b, &b, d.free_d22() * area),
        (None, None) => {}
    }
}
