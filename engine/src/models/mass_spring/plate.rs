//! Linear bending stiffness: the quadratic energy of a nearly inextensible
//! plate, 1/2 integral of (D_u |x_uu|^2 + D_v |x_vv|^2 + 4 D_t |x_uv|^2), by
//! second differences over the padded grid (Bergou et al. 2006, "A quadratic
//! bending model for inextensible surfaces", is the same idea on triangles).
//! Its forces are linear in the positions, with constant coefficients.

use super::settings::Plate;
use crate::grid::Grid;

/// Bending forces of one grid.
#[derive(Clone, Debug)]
pub(crate) struct Bending {
    stencils: Vec<Stencil>,
    loss: f32,
    lanes: usize,
    /// Positions, run ahead by the loss: x + loss * v.
    ahead: [Vec<f32>; 3],
    /// Weighted difference of each stencil, after `lead` lanes of zeros.
    difference: Vec<f32>,
    lead: usize,
}

/// A difference over three or four nodes.
#[derive(Clone, Debug)]
struct Stencil {
    /// Lanes from the first node to each, with the sign and weight of each.
    terms: Vec<(usize, f32)>,
    /// Stiffness by the lane of the first node, 0 where the stencil leaves the grid.
    stiffness: Vec<f32>,
}

impl Stencil {
    fn new(
        grid: &Grid,
        terms: Vec<(usize, f32)>,
        across: usize,
        up: usize,
        stiffness: impl Fn(usize, usize) -> f32,
    ) -> Self {
        let mut lanes = vec![0.0; (grid.rows - up) * grid.stride];
        for row in 0..grid.rows - up {
            for column in 0..grid.columns - across {
                lanes[grid.lane(column, row)] = stiffness(column, row);
            }
        }
        Self {
            terms,
            stiffness: lanes,
        }
    }
}

impl Bending {
    /// Bending of a plate, or nothing when it has no stiffness.
    pub fn new(grid: &Grid, plate: &Plate) -> Option<Self> {
        if plate.u == 0.0 && plate.v == 0.0 && plate.twist == 0.0 {
            return None;
        }
        let (du, dv, next) = (grid.du(), grid.dv(), grid.stride);
        let half = |i: usize, count: usize| if i == 0 || i + 1 == count { 0.5 } else { 1.0 };
        let along_u = plate.u * dv / (du * du * du);
        let along_v = plate.v * du / (dv * dv * dv);
        let twist = 4.0 * plate.twist / (du * dv);
        let line = |step: usize| vec![(0, 1.0), (step, -2.0), (2 * step, 1.0)];
        let cell = vec![(0, 1.0), (1, -1.0), (next, -1.0), (next + 1, 1.0)];
        let stencils = vec![
            Stencil::new(grid, line(1), 2, 0, |_, row| along_u * half(row, grid.rows)),
            Stencil::new(grid, line(next), 0, 2, |column, _| {
                along_v * half(column, grid.columns)
            }),
            Stencil::new(grid, cell, 1, 1, |_, _| twist),
        ];
        let lead = 2 * next;
        Some(Self {
            stencils,
            loss: plate.loss,
            lanes: grid.lanes(),
            ahead: grid.zeros3(),
            difference: vec![0.0; lead + grid.lanes()],
            lead,
        })
    }

    /// Adds the bending forces on every node to `force`.
    pub fn add_forces(
        &mut self,
        position: &[Vec<f32>; 3],
        velocity: &[Vec<f32>; 3],
        force: &mut [Vec<f32>; 3],
    ) {
        for axis in 0..3 {
            for ((ahead, x), v) in self.ahead[axis]
                .iter_mut()
                .zip(&position[axis])
                .zip(&velocity[axis])
            {
                *ahead = x + self.loss * v;
            }
            for stencil in &self.stencils {
                let count = stencil.stiffness.len();
                self.difference.fill(0.0);
                let difference = &mut self.difference[self.lead..self.lead + count];
                for &(shift, weight) in &stencil.terms {
                    let x = &self.ahead[axis][shift..shift + count];
                    for i in 0..count {
                        difference[i] += weight * x[i];
                    }
                }
                for i in 0..count {
                    difference[i] *= stencil.stiffness[i];
                }
                let sum = &mut force[axis][..self.lanes];
                for &(shift, weight) in &stencil.terms {
                    // The difference pulls each of its nodes against its weight.
                    let from = self.lead - shift.min(self.lead);
                    let skip = shift.saturating_sub(self.lead);
                    let pull = &self.difference[from..];
                    for (sum, pull) in sum[skip..].iter_mut().zip(pull) {
                        *sum -= weight * pull;
                    }
                }
            }
        }
    }

    /// Energy of bending, J.
    pub fn energy(&self, position: &[Vec<f32>; 3]) -> f64 {
        let mut energy = 0.0;
        for stencil in &self.stencils {
            for (first, &stiffness) in stencil
                .stiffness
                .iter()
                .enumerate()
                .filter(|(_, k)| **k > 0.0)
            {
                for axis in position {
                    let term = |&(shift, weight): &(usize, f32)| {
                        f64::from(weight) * f64::from(axis[first + shift])
                    };
                    let difference: f64 = stencil.terms.iter().map(term).sum();
                    energy += 0.5 * f64::from(stiffness) * difference * difference;
                }
            }
        }
        energy
    }
}
