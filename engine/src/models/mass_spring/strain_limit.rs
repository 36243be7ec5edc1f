//! Keeping springs from stretching, after the step.
//!
//! Provot's way (Provot 1995, section 5) shortens what is too long, spring by
//! spring. The sweeps instead solve for the length of all springs of a column,
//! then of a row, at once: one Newton step for the Lagrange multipliers of a
//! chain of length constraints, whose matrix is tridiagonal. Shear springs and
//! the table take turns with them until all agree.

use super::settings::StrainLimit;
use super::springs::SpringSystem;
use crate::grid::Grid;

/// Part of the limit that projections aim at, so that what the later ones
/// disturb still ends within it.
const MARGIN: f32 = 0.8;

/// Strain before the first round up to which grabs do not give way.
const FIRM: f32 = 0.02;

/// Room for one chain of nodes.
#[derive(Clone, Debug)]
struct Chain {
    direction: Vec<[f32; 3]>,
    excess: Vec<f32>,
    diagonal: Vec<f32>,
    beside: Vec<f32>,
}

/// Projections of one grid.
#[derive(Clone, Debug)]
pub(crate) struct Limiter {
    kind: StrainLimit,
    chain: Chain,
}

impl Limiter {
    /// A limiter of a kind for leaves of a grid.
    pub fn new(kind: StrainLimit, grid: &Grid) -> Self {
        let count = grid.columns.max(grid.rows);
        let chain = Chain {
            direction: vec![[0.0; 3]; count],
            excess: vec![0.0; count],
            diagonal: vec![0.0; count],
            beside: vec![0.0; count],
        };
        Self { kind, chain }
    }

    /// Whether velocities are to follow from the positions reached.
    pub fn moves_velocity(&self) -> bool {
        matches!(self.kind, StrainLimit::Sweeps { .. })
    }

    /// Projects the nodes, each moved by its weight. Weights are `firm`, 0 for
    /// every node that is fixed or held; where much is to be projected they are
    /// `yielding`, and grabs give way rather than crumple the sheet.
    pub fn apply(
        &mut self,
        grid: &Grid,
        springs: &SpringSystem,
        (firm, yielding): (&[f32], &[f32]),
        floor: bool,
        position: &mut [Vec<f32>; 3],
    ) {
        match self.kind {
            StrainLimit::Off => {}
            StrainLimit::Provot { limit, passes } => {
                for _ in 0..passes {
                    shorten(springs, firm, limit, position);
                }
            }
            StrainLimit::Sweeps { limit, passes } => {
                let range = springs.strain(position);
                let easy = range.max <= FIRM && range.min >= -FIRM;
                let weight = if easy { firm } else { yielding };
                for _ in 0..passes {
                    self.sweep(grid, springs, weight, limit * MARGIN, position);
                    if floor {
                        put_on_table(&mut position[2][..grid.lanes()], weight);
                    }
                    let range = springs.strain(position);
                    if range.max <= limit && range.min >= -limit {
                        break;
                    }
                }
            }
        }
    }

    /// Shear springs, then columns, then rows.
    fn sweep(
        &mut self,
        grid: &Grid,
        springs: &SpringSystem,
        inverse_mass: &[f32],
        limit: f32,
        position: &mut [Vec<f32>; 3],
    ) {
        for family in &springs.families[2..4] {
            let bounds = (family.rest * (1.0 - limit), family.rest * (1.0 + limit));
            for (a, b) in family.springs() {
                project(a, b, (inverse_mass[a], inverse_mass[b]), bounds, position);
            }
        }
        for column in 0..grid.columns {
            let lanes = (column, grid.stride, grid.rows);
            self.chain.hold(lanes, grid.dv(), inverse_mass, position);
        }
        for row in 0..grid.rows {
            let lanes = (row * grid.stride, 1, grid.columns);
            self.chain.hold(lanes, grid.du(), inverse_mass, position);
        }
    }
}

/// One of Provot's rounds: projects every spring that is too long.
fn shorten(springs: &SpringSystem, firm: &[f32], limit: f32, position: &mut [Vec<f32>; 3]) {
    for family in springs.families.iter().filter(|family| family.holds_shape) {
        for (a, b) in family.springs() {
            let free = |lane: usize| if firm[lane] > 0.0 { 1.0 } else { 0.0 };
            let bounds = (0.0, family.rest * (1.0 + limit));
            project(a, b, (free(a), free(b)), bounds, position);
        }
    }
}

/// Brings the distance of two nodes between bounds, moving each by its weight.
fn project(
    a: usize,
    b: usize,
    weight: (f32, f32),
    bounds: (f32, f32),
    position: &mut [Vec<f32>; 3],
) {
    let total = weight.0 + weight.1;
    let d = [0, 1, 2].map(|axis| position[axis][b] - position[axis][a]);
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    let wanted = if length > bounds.1 {
        bounds.1
    } else if length < bounds.0 {
        bounds.0
    } else {
        return;
    };
    if total > 0.0 && length > 0.0 {
        let part = (length - wanted) / (length * total);
        for axis in 0..3 {
            position[axis][a] += weight.0 * part * d[axis];
            position[axis][b] -= weight.1 * part * d[axis];
        }
    }
}

/// Puts free nodes below the table onto it.
fn put_on_table(height: &mut [f32], inverse_mass: &[f32]) {
    for (z, &weight) in height.iter_mut().zip(inverse_mass) {
        if *z < 0.0 && weight > 0.0 {
            *z = 0.0;
        }
    }
}

impl Chain {
    /// Brings all distances between successive nodes (first lane, step, count)
    /// to `rest` at once.
    fn hold(
        &mut self,
        lanes: (usize, usize, usize),
        rest: f32,
        inverse_mass: &[f32],
        position: &mut [Vec<f32>; 3],
    ) {
        let (first, step, count) = lanes;
        let links = count - 1;
        let lane = |k: usize| first + k * step;
        for k in 0..links {
            let (a, b) = (lane(k), lane(k + 1));
            let d = [0, 1, 2].map(|axis| position[axis][b] - position[axis][a]);
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 1e-30).sqrt();
            self.direction[k] = d.map(|d| d / length);
            let weight = inverse_mass[a] + inverse_mass[b];
            // A link between two held nodes has nothing to give.
            self.excess[k] = if weight > 0.0 { length - rest } else { 0.0 };
            self.diagonal[k] = if weight > 0.0 { weight } else { 1.0 };
            if k > 0 {
                let (d, e) = (self.direction[k], self.direction[k - 1]);
                self.beside[k] = -inverse_mass[a] * (d[0] * e[0] + d[1] * e[1] + d[2] * e[2]);
            }
        }
        self.solve(links);
        for k in 0..links {
            let (a, b) = (lane(k), lane(k + 1));
            for axis in 0..3 {
                let pull = self.excess[k] * self.direction[k][axis];
                position[axis][a] += inverse_mass[a] * pull;
                position[axis][b] -= inverse_mass[b] * pull;
            }
        }
    }

    /// Thomas's algorithm on the symmetric tridiagonal system, in place.
    fn solve(&mut self, links: usize) {
        for k in 1..links {
            let factor = self.beside[k] / self.diagonal[k - 1];
            self.diagonal[k] -= factor * self.beside[k];
            self.excess[k] -= factor * self.excess[k - 1];
            // Between held ends a straight chain is one constraint too many.
            if self.diagonal[k] < 1e-3 * (-self.beside[k]).abs() {
                self.diagonal[k] = 1e-3 * self.beside[k].abs();
            }
        }
        for k in (0..links).rev() {
            let above = if k + 1 < links {
                self.beside[k + 1] * self.excess[k + 1]
            } else {
                0.0
            };
            self.excess[k] = (self.excess[k] - above) / self.diagonal[k];
        }
    }
}
